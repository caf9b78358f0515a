//! Hash of the settings, and checksum of the content.

use crate::content::Content;
use crate::schema;
use sha2::{Digest, Sha256};

/// Id of a table: the first 16 hexadecimal digits of SHA-256 over the major format version and the grid with all
/// defaults.
///
/// Two tables with the same id were made with the same settings, independent of machine and date.
pub fn settings_id(grid: &str) -> String {
    let mut hash = Sha256::new();
    hash.update(schema::MAJOR_READ.to_string().as_bytes());
    hash.update([0]);
    hash.update(grid.as_bytes());
    let mut id = format!("{:x}", hash.finalize());
    id.truncate(16);
    id
}

/// SHA-256 over the content of a table, except the creation time, the software version and the revision.
///
/// Numbers enter as little-endian bytes, preceded by lengths and texts, in the order of [`Content`].
pub fn content_hash(content: &Content) -> String {
    let mut hash = Sha256::new();
    hash.update(content.origin.grid.as_bytes());
    let asked = content.origin.accuracy_asked;
    for number in [asked, content.cell_width, content.r_max, content.z_max] {
        hash.update(number.to_le_bytes());
    }
    hash.update((content.stencil_points as u64).to_le_bytes());
    for axis in [
        &content.origin.accuracy_reached,
        &content.r,
        &content.z,
        &content.pulse_lengths,
        &content.between_r,
        &content.between_z,
    ] {
        hash.update((axis.len() as u64).to_le_bytes());
        for value in axis {
            hash.update(value.to_le_bytes());
        }
    }
    for slice in &content.slices {
        hash.update(slice.poisson_ratio.to_le_bytes());
        hash.update(slice.role.name().as_bytes());
        hash.update((slice.cells as u64).to_le_bytes());
        add_lists(&mut hash, &slice.lists());
        add_lists(&mut hash, &slice.verification.lists());
    }
    for between in &content.between {
        hash.update(between.poisson_ratio.to_le_bytes());
        add_lists(&mut hash, &between.verification.lists());
    }
    format!("{:x}", hash.finalize())
}

fn add_lists(hash: &mut Sha256, lists: &[(&str, &[f32])]) {
    let mut bytes = Vec::with_capacity(1 << 16);
    for (_, list) in lists {
        hash.update((list.len() as u64).to_le_bytes());
        for chunk in list.chunks(1 << 14) {
            bytes.clear();
            bytes.extend(chunk.iter().flat_map(|value| value.to_le_bytes()));
            hash.update(&bytes);
        }
    }
}
