//! SHA-256 as text: of bytes, and of named parts that identify a file.

use sha2::{Digest, Sha256};

/// SHA-256 over consecutive pieces of bytes, as sixty-four hexadecimal digits.
///
/// ```
/// // FIPS 180-2, appendix B.1
/// let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
/// assert_eq!(ledger::sha256_hex([b"ab".as_slice(), b"c"]), abc);
/// ```
pub fn sha256_hex<'a>(pieces: impl IntoIterator<Item = &'a [u8]>) -> String {
    let mut hash = Sha256::new();
    pieces.into_iter().for_each(|bytes| hash.update(bytes));
    format!("{:x}", hash.finalize())
}

/// SHA-256 over named parts; each name and each part is preceded by its length.
///
/// ```
/// let of = |revision: u64| ledger::Identity::default().with("numbers", revision.to_le_bytes()).hex();
/// assert_eq!(of(1), of(1));
/// assert_ne!(of(1), of(2));
/// ```
#[derive(Debug, Clone, Default)]
pub struct Identity(Sha256);

impl Identity {
    /// Adds a part; the order matters.
    #[must_use]
    pub fn with(mut self, name: &str, part: impl AsRef<[u8]>) -> Self {
        for bytes in [name.as_bytes(), part.as_ref()] {
            self.0.update((bytes.len() as u64).to_le_bytes());
            self.0.update(bytes);
        }
        self
    }

    /// The hash as sixty-four hexadecimal digits.
    pub fn hex(self) -> String {
        format!("{:x}", self.0.finalize())
    }
}
