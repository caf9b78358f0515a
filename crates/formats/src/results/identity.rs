//! What makes the results of two scenes the same, whatever their kernels.

use super::schema;
use crate::scene::resolved;
use contact::NUMBERS_REVISION;
use impact::numbers::FIELDS_REVISION;
use impact::{Load, Scene};
use sha2::{Digest, Sha256};

/// SHA-256, in hexadecimal, of the resolved scene with the samples of its force record, of the program's version, of the
/// revisions of its numbers and of the format.
#[must_use]
pub fn scene_sha256(scene: &Scene) -> String {
    let mut hash = Sha256::new();
    let mut add = |part: &[u8]| {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    };
    // wherever its record lies
    let mut placeless = scene.clone();
    if let Load::Record(record) = &mut placeless.load {
        record.file = None;
    }
    let revisions = format!("{NUMBERS_REVISION} {FIELDS_REVISION}");
    for part in [
        env!("CARGO_PKG_VERSION"),
        &revisions,
        schema::FORMAT_VERSION,
        &resolved(&placeless),
    ] {
        add(part.as_bytes());
    }
    if let Load::Record(record) = &scene.load {
        for number in record.time_s().iter().chain(record.force_n()) {
            add(&number.to_le_bytes());
        }
    }
    hash.finalize()
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}
