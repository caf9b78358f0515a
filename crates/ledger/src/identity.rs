//! What makes two files the same.

use sha2::{Digest, Sha256};

/// SHA-256 over named parts, each name and each part behind its length.
///
/// ```
/// let of = |revision: u64| ledger::Identity::default().with("numbers", revision.to_le_bytes()).hex();
/// assert_eq!(of(1), of(1));
/// assert_ne!(of(1), of(2));
/// ```
#[derive(Debug, Clone, Default)]
pub struct Identity(Sha256);

impl Identity {
    /// With one part more; the order counts.
    #[must_use]
    pub fn with(mut self, name: &str, part: impl AsRef<[u8]>) -> Self {
        for bytes in [name.as_bytes(), part.as_ref()] {
            self.0.update((bytes.len() as u64).to_le_bytes());
            self.0.update(bytes);
        }
        self
    }

    /// Sixty-four hexadecimal digits.
    pub fn hex(self) -> String {
        format!("{:x}", self.0.finalize())
    }
}
