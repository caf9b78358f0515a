//! Which nodes of a damaged file cannot be read.

use crate::content::FIELDS;
use crate::error::TableError;
use crate::read::open;
use crate::schema;
use hdf5::{Dataset, Group};
use ndarray::s;
use std::ops::Range;
use std::path::Path;

/// Nodes that share a damaged chunk of a dataset.
#[derive(Debug, Clone, PartialEq)]
pub struct DamagedPatch {
    /// Poisson's ratio of the slice.
    pub poisson_ratio: f64,
    /// Name of the dataset.
    pub dataset: &'static str,
    /// First and last radius in r0.
    pub r: [f64; 2],
    /// First and last depth in r0.
    pub z: [f64; 2],
}

/// The patches of nodes in the table at `path` that cannot be read; none if all can.
///
/// # Errors
/// [`TableError`] when the file cannot be opened, or axes or groups cannot be read.
pub fn damaged_patches(path: &Path) -> Result<Vec<DamagedPatch>, TableError> {
    let source = open(path)?;
    let root: &Group = &source.file;
    let r: Vec<f64> = source.array(root, schema::R)?.0;
    let z: Vec<f64> = source.array(root, schema::Z)?.0;
    let slices = source.group(root, schema::SLICES)?;
    let names = slices
        .member_names()
        .map_err(|error| source.item(schema::SLICES, &error))?;
    let mut found = Vec::new();
    for name in names {
        let group = source.group(&slices, &name)?;
        let poisson_ratio = source.number(&group, schema::POISSON_RATIO)?;
        for dataset in [
            schema::REMAINDER,
            schema::MOMENT,
            schema::CURVATURE,
            schema::TAIL,
        ] {
            // One that is not there has no patches; reading the table says that it is not.
            let Ok(data) = group.dataset(dataset) else {
                continue;
            };
            for (across, down) in patches(&data, r.len(), z.len()) {
                let selection = s![across.clone(), down.clone(), .., ..];
                if data.read_slice::<f32, _, ndarray::Ix4>(selection).is_err() {
                    found.push(DamagedPatch {
                        poisson_ratio,
                        dataset,
                        r: [r[across.start], r[across.end - 1]],
                        z: [z[down.start], z[down.end - 1]],
                    });
                }
            }
        }
    }
    Ok(found)
}

/// Rows and columns of each chunk; none where the shape is not that of the axes.
fn patches(data: &Dataset, rows: usize, columns: usize) -> Vec<(Range<usize>, Range<usize>)> {
    let (shape, chunk) = (data.shape(), data.chunk().unwrap_or_default());
    let (&[r, z, FIELDS, _], &[high, wide, ..]) = (shape.as_slice(), chunk.as_slice()) else {
        return Vec::new();
    };
    if r != rows || z != columns {
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
