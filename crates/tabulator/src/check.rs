//! Whether a finished table is what it says: checksum, completeness, and a sample computed again.

use crate::build::plan;
use crate::error::BuildError;
use crate::grid::Grid;
use lookup::{Content, Slice, Table, TableError};
use rayon::prelude::*;
use std::path::Path;

/// A stored number that differs from the exact kernels.
#[derive(Debug, Clone, PartialEq)]
pub struct BadNode {
    /// Poisson's ratio of the slice.
    pub poisson_ratio: f64,
    /// Radius of the node in r0.
    pub r: f64,
    /// Depth of the node in r0.
    pub z: f64,
    /// Name of the field.
    pub field: &'static str,
    /// Largest difference in time from the exact cell averages, over the largest average there.
    pub relative_difference: f64,
}

/// What [`check_table`] found.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckReport {
    /// Nodes computed again.
    pub nodes_checked: usize,
    /// Largest relative difference among them.
    pub largest_difference: f64,
    /// Nodes beyond the tolerance.
    pub bad: Vec<BadNode>,
}

/// Largest difference that single precision and the kernel's tolerance explain.
fn allowed(tolerance: f64) -> f64 {
    2e-7 + 100.0 * tolerance
}

/// Reads the table at `path`, compares its checksum, validates it, and computes `sample` nodes again.
///
/// `seed` picks the nodes; the same seed picks the same ones.
///
/// # Errors
/// [`BuildError`] when the file cannot be read or accepted, its checksum or its settings do not fit, or
/// the exact kernels fail. Nodes with wrong values are not an error but a finding.
pub fn check_table(path: &Path, sample: usize, seed: u64) -> Result<CheckReport, BuildError> {
    let content = lookup::read(path)?;
    lookup::check_hash(path, &content)?;
    let table = Table::new(content)?;
    let content = table.content();
    let grid = Grid::of(content)?;
    same_axes(&grid, content)?;
    let nodes = content.r.len() * content.z.len();
    let total = nodes * content.slices.len();
    let plans = content
        .slices
        .iter()
        .map(|slice| plan(&grid, slice.poisson_ratio))
        .collect::<Result<Vec<_>, _>>()?;
    let found: Vec<Vec<(f64, BadNode)>> = picks(total, sample, seed)
        .into_par_iter()
        .map(|pick| {
            let (index, node) = (pick / nodes, pick % nodes);
            let (r, z) = (
                content.r[node / content.z.len()],
                content.z[node % content.z.len()],
            );
            let exact = plans[index].compute(r, z)?;
            Ok((0..6)
                .map(|field| {
                    difference(&content.slices[index], node, [r, z], field, &exact.averages)
                })
                .collect())
        })
        .collect::<Result<_, BuildError>>()?;
    let limit = allowed(grid.tolerance);
    Ok(CheckReport {
        nodes_checked: found.len(),
        largest_difference: found
            .iter()
            .flatten()
            .fold(0.0, |most, (d, _)| most.max(*d)),
        bad: found
            .into_iter()
            .flatten()
            .filter(|(d, _)| *d > limit)
            .map(|(_, bad)| bad)
            .collect(),
    })
}

/// Compares one field of one node with the exact averages, relative to the largest of its kind there.
fn difference(
    slice: &Slice,
    node: usize,
    [r, z]: [f64; 2],
    field: usize,
    exact: &[halfspace::Six],
) -> (f64, BadNode) {
    let stored = &slice.remainder[(node * 6 + field) * slice.cells..][..slice.cells];
    let group = if field < 2 { 0..2 } else { 2..6 };
    let scale = exact
        .iter()
        .flat_map(|six| six[group.clone()].iter())
        .fold(0.0_f64, |most, x| most.max(x.abs()));
    let most = stored.iter().zip(exact).fold(0.0_f64, |most, (&a, b)| {
        most.max((f64::from(a) - b[field]).abs())
    });
    let relative_difference = most / scale.max(f64::MIN_POSITIVE);
    let field = lookup::schema::FIELD_NAMES[field];
    (
        relative_difference,
        BadNode {
            poisson_ratio: slice.poisson_ratio,
            r,
            z,
            field,
            relative_difference,
        },
    )
}

/// The axes and cells must be those of the settings.
fn same_axes(grid: &Grid, content: &Content) -> Result<(), BuildError> {
    let shape = |item: &str, needed: usize, found: usize| TableError::Shape {
        item: item.to_owned(),
        needed,
        found,
    };
    for (item, needed, found) in [
        ("r", &grid.nodes()[0], &content.r),
        ("z", &grid.nodes()[1], &content.z),
    ] {
        if needed.len() != found.len() {
            return Err(shape(item, needed.len(), found.len()).into());
        }
    }
    for slice in &content.slices {
        let needed = grid.cells()?;
        if needed != slice.cells {
            return Err(shape("time", needed, slice.cells).into());
        }
    }
    Ok(())
}

/// `count` different numbers below `total`, all of them if there are no more, by a fixed generator.
fn picks(total: usize, count: usize, seed: u64) -> Vec<usize> {
    if count >= total {
        return (0..total).collect();
    }
    let mut state = seed;
    let mut chosen = std::collections::BTreeSet::new();
    while chosen.len() < count {
        // SplitMix64 (Steele, Lea and Flood 2014).
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = state;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        chosen.insert(((x ^ (x >> 31)) % total as u64) as usize);
    }
    chosen.into_iter().collect()
}
