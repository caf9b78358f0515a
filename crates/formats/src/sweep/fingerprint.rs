//! What makes two sweeps the same.

use super::axis::{Axis, Values};
use super::schema;
use contact::NUMBERS_REVISION;
use impact::numbers::FIELDS_REVISION;
use sha2::{Digest, Sha256};

/// SHA-256 of the program's version, the revision of its numbers, the format, everything spelled out, the files that were read, and of axes whose
/// values are not spelled out.
pub(super) fn fingerprint(resolved: &str, files: &[String], axes: &[Axis]) -> [u8; 32] {
    let mut hash = Sha256::new();
    let mut add = |part: &[u8]| {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    };
    let numbers = NUMBERS_REVISION.to_string();
    let parts = [
        env!("CARGO_PKG_VERSION"),
        &numbers,
        schema::FORMAT_VERSION,
        resolved,
    ];
    for part in parts.into_iter().chain(files.iter().map(String::as_str)) {
        add(part.as_bytes());
    }
    for column in axes.iter().flat_map(|axis| &axis.columns) {
        add(column.name().as_bytes());
        match &column.values {
            Values::Numbers(numbers) => {
                for number in numbers {
                    add(&number.to_le_bytes());
                }
            }
            // the distribution is spelled out
            Values::Drawn(_) => {}
            Values::Texts(words) => {
                for word in words {
                    add(word.as_bytes());
                }
            }
        }
    }
    hash.finalize().into()
}

/// The same with fields whose kernels have an identity, and with the revision of their numbers.
pub(super) fn with_fields(fingerprint: &[u8; 32], kernels: &str) -> [u8; 32] {
    let mut hash = Sha256::new();
    hash.update(fingerprint);
    hash.update(FIELDS_REVISION.to_le_bytes());
    hash.update(kernels.as_bytes());
    hash.finalize().into()
}

/// Sixty-four digits.
pub(super) fn hexadecimal(hash: &[u8; 32]) -> String {
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The hash of sixty-four digits.
pub(crate) fn from_hexadecimal(digits: &str) -> Option<[u8; 32]> {
    let mut hash = [0; 32];
    if digits.len() != 64 || !digits.is_ascii() {
        return None;
    }
    for (i, byte) in hash.iter_mut().enumerate() {
        *byte = u8::from_str_radix(&digits[2 * i..2 * i + 2], 16).ok()?;
    }
    Some(hash)
}
