//! Location of damage: the nodes of a file that cannot be read.

use super::chunks::patches;
use super::error::TableError;
use super::open::open;
use crate::content::FIELDS;
use crate::schema;
use std::path::Path;

/// Descriptions of the nodes of the table at `path` that share a damaged chunk of a dataset; empty if all can be read.
///
/// # Errors
/// [`TableError`] if the file cannot be opened, or its axes or groups cannot be read.
pub fn damaged_patches(path: &Path) -> Result<Vec<String>, TableError> {
    let source = open(path)?;
    let root = &source.file.root;
    let r: Vec<f64> = source.list(root, schema::R)?;
    let z: Vec<f64> = source.list(root, schema::Z)?;
    let mut found = Vec::new();
    for slice in source.listed()? {
        for dataset in [
            schema::REMAINDER,
            schema::MOMENT,
            schema::CURVATURE,
            schema::TAIL,
        ] {
            // a missing dataset has no patches; reading the table reports it
            let Ok((data, shape)) = source.dataset(&slice.place, dataset) else {
                continue;
            };
            let chunk = data.chunk().filter(|chunk| !chunk.contains(&0));
            let (Some(&[high, wide, ..]), [rows, columns, FIELDS, last]) =
                (chunk.as_deref(), shape)
            else {
                continue;
            };
            // a dataset whose shape does not fit the axes has no patches either
            if [rows, columns] != [r.len(), z.len()] {
                continue;
            }
            for [across, down] in patches([rows, columns], [high, wide]) {
                let patch = [across.clone(), down.clone(), 0..FIELDS, 0..last];
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
