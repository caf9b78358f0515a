//! Which nodes of a damaged file cannot be read.

use super::error::TableError;
use super::open::open;
use crate::content::FIELDS;
use crate::schema;
use ledger::Dataset;
use std::ops::Range;
use std::path::Path;

/// Where nodes of the table at `path` share a damaged chunk of a dataset, in words; nothing if all can be read.
///
/// # Errors
/// [`TableError`] when the file cannot be opened, or axes or groups cannot be read.
pub fn damaged_patches(path: &Path) -> Result<Vec<String>, TableError> {
    let source = open(path)?;
    let root = source.root();
    let r: Vec<f64> = source.list(&root, schema::R)?;
    let z: Vec<f64> = source.list(&root, schema::Z)?;
    let mut found = Vec::new();
    for slice in source.listed(&root)? {
        for dataset in [
            schema::REMAINDER,
            schema::MOMENT,
            schema::CURVATURE,
            schema::TAIL,
        ] {
            // One that is not there has no patches; reading the table says that it is not.
            let Ok((data, shape)) = source.dataset(&slice.place, dataset) else {
                continue;
            };
            let [_, _, fields, last] = shape;
            for (across, down) in patches(&data, shape, [r.len(), z.len()]) {
                let patch = [across.clone(), down.clone(), 0..fields, 0..last];
                if data.block::<f32>(&patch, u64::MAX).is_err() {
                    found.push(format!(
                        "nu = {}, r/r0 = {} .. {}, z/r0 = {} .. {}: {dataset}",
                        slice.ratio,
                        r[across.start],
                        r[across.end - 1],
                        z[down.start],
                        z[down.end - 1]
                    ));
                }
            }
        }
    }
    Ok(found)
}

/// Rows and columns of each chunk; none where the shape is not that of the axes.
fn patches(
    data: &Dataset,
    [r, z, fields, _]: [usize; 4],
    [rows, columns]: [usize; 2],
) -> Vec<(Range<usize>, Range<usize>)> {
    let chunk = data.chunk().unwrap_or_default();
    let &[high, wide, ..] = chunk.as_slice() else {
        return Vec::new();
    };
    if [r, z, fields] != [rows, columns, FIELDS] || high.min(wide) == 0 {
        return Vec::new();
    }
    let mut patches = Vec::new();
    for i in (0..rows).step_by(high) {
        for k in (0..columns).step_by(wide) {
            patches.push((i..(i + high).min(rows), k..(k + wide).min(columns)));
        }
    }
    patches
}
