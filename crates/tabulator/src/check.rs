//! Whether a finished table is what it says: checksums, completeness, finiteness, and a sample computed again.

use crate::build::plan;
use crate::error::BuildError;
use crate::grid::Grid;
use crate::point::PointKernels;
use halfspace::Six;
use lookup::{Content, DamagedPatch, Slice, Table, TableError};
use lookup::{content_hash, damaged_patches, schema};
use rayon::prelude::*;
use std::path::Path;

/// A stored number that differs from the exact kernels or is none.
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
    /// Name of the dataset.
    pub dataset: &'static str,
    /// Largest difference from the exact numbers, over the largest cell average of the displacements or stresses
    /// there; NaN where a stored number is not finite.
    pub relative_difference: f64,
}

/// What [`check_table`] found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CheckReport {
    /// Nodes computed again.
    pub nodes_checked: usize,
    /// Largest relative difference of averages and tails among them.
    pub largest_difference: f64,
    /// Whether the content is that of the stated SHA-256.
    pub hash_right: bool,
    /// Nodes beyond the tolerance or not finite.
    pub bad: Vec<BadNode>,
    /// Nodes that cannot be read; nothing else is then checked.
    pub damaged: Vec<DamagedPatch>,
}

impl CheckReport {
    /// Whether nothing is wrong.
    #[must_use]
    pub fn is_good(&self) -> bool {
        self.hash_right && self.bad.is_empty() && self.damaged.is_empty()
    }
}

/// Largest difference of averages and tails that single precision and the kernel's tolerance explain.
fn allowed(tolerance: f64) -> f64 {
    2e-7 + 100.0 * tolerance
}

/// The same of moments, which are computed and rounded to about 1e-5, and at fronts within 30 times that.
const ALLOWED_OF_MOMENTS: f64 = 4e-4;

/// Reads the table at `path`, compares its checksums, validates it, and computes `sample` nodes again.
///
/// `seed` picks the nodes; the same seed picks the same ones.
///
/// # Errors
/// [`BuildError`] when the file cannot be read or accepted, its settings do not fit, or the exact kernels
/// fail. Nodes with wrong values, or that a checksum of the file gives away, are not an error but a finding.
pub fn check_table(path: &Path, sample: usize, seed: u64) -> Result<CheckReport, BuildError> {
    let content = match lookup::read(path) {
        Ok(content) => content,
        Err(error @ TableError::Item { .. }) => {
            let damaged = damaged_patches(path)?;
            if damaged.is_empty() {
                return Err(error.into());
            }
            return Ok(CheckReport {
                damaged,
                ..CheckReport::default()
            });
        }
        Err(error) => return Err(error.into()),
    };
    let hash_right = lookup::stated_hash(path)? == content_hash(&content);
    let bad = not_finite(&content);
    if !bad.is_empty() {
        return Ok(CheckReport {
            hash_right,
            bad,
            ..CheckReport::default()
        });
    }
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
    let limit = allowed(grid.tolerance);
    let found: Vec<(f64, Vec<BadNode>)> = picks(total, sample, seed)
        .into_par_iter()
        .map(|pick| {
            let (index, node) = (pick / nodes, pick % nodes);
            let [r, z] = place(content, node);
            let exact = plans[index].compute(r, z)?;
            Ok(compare(
                content,
                &content.slices[index],
                node,
                &exact,
                limit,
            ))
        })
        .collect::<Result<_, BuildError>>()?;
    Ok(CheckReport {
        nodes_checked: found.len(),
        largest_difference: found.iter().fold(0.0, |most, (d, _)| most.max(*d)),
        hash_right,
        bad: found.into_iter().flat_map(|(_, bad)| bad).collect(),
        damaged: Vec::new(),
    })
}

fn place(content: &Content, node: usize) -> [f64; 2] {
    let depths = content.z.len();
    [content.r[node / depths], content.z[node % depths]]
}

/// The datasets of the nodes of a slice.
fn datasets(slice: &Slice) -> [(&'static str, &[f32]); 4] {
    [
        (schema::REMAINDER, &slice.remainder),
        (schema::MOMENT, &slice.moment),
        (schema::CURVATURE, &slice.curvature),
        (schema::TAIL, &slice.tail),
    ]
}

/// Nodes and fields with numbers that are infinite or NaN.
fn not_finite(content: &Content) -> Vec<BadNode> {
    let nodes = content.r.len() * content.z.len();
    let mut bad = Vec::new();
    for slice in &content.slices {
        for (dataset, values) in datasets(slice) {
            let each = (values.len() / (6 * nodes).max(1)).max(1);
            for (index, row) in values.chunks_exact(each).enumerate().take(6 * nodes) {
                if row.iter().all(|x| x.is_finite()) {
                    continue;
                }
                let [r, z] = place(content, index / 6);
                bad.push(BadNode {
                    poisson_ratio: slice.poisson_ratio,
                    r,
                    z,
                    field: schema::FIELD_NAMES[index % 6],
                    dataset,
                    relative_difference: f64::NAN,
                });
            }
        }
    }
    bad
}

/// The largest difference of averages and tails of a node from the exact ones, and all that are not allowed.
fn compare(
    content: &Content,
    slice: &Slice,
    node: usize,
    exact: &PointKernels,
    limit: f64,
) -> (f64, Vec<BadNode>) {
    let [r, z] = place(content, node);
    let lists: [(&[Six], f64); 4] = [
        (&exact.averages, limit),
        (&exact.moments, ALLOWED_OF_MOMENTS),
        (&exact.curvatures, ALLOWED_OF_MOMENTS),
        (&exact.tail, limit),
    ];
    let (mut largest, mut bad) = (0.0_f64, Vec::new());
    for ((dataset, values), (exact_values, limit)) in datasets(slice).into_iter().zip(lists) {
        let each = exact_values.len();
        for (f, field) in schema::FIELD_NAMES.into_iter().enumerate() {
            let stored = &values[(node * 6 + f) * each..][..each];
            let group = if f < 2 { 0..2 } else { 2..6 };
            let scale = exact
                .averages
                .iter()
                .flat_map(|six| six[group.clone()].iter())
                .fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
            let most = stored
                .iter()
                .zip(exact_values)
                .fold(0.0_f64, |most, (&a, b)| {
                    most.max((f64::from(a) - b[f]).abs())
                });
            let relative_difference = most / scale;
            if dataset == schema::REMAINDER || dataset == schema::TAIL {
                largest = largest.max(relative_difference);
            }
            if relative_difference > limit {
                bad.push(BadNode {
                    poisson_ratio: slice.poisson_ratio,
                    r,
                    z,
                    field,
                    dataset,
                    relative_difference,
                });
            }
        }
    }
    (largest, bad)
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
        if let Some(i) = (0..found.len()).find(|&i| needed[i] != found[i]) {
            return Err(TableError::Value {
                item: format!("{item}[{i}]"),
                value: found[i],
                range: "the node that the settings say",
            }
            .into());
        }
    }
    let slices: Vec<f64> = grid.slices().iter().map(|slice| slice.0).collect();
    if slices.len() != content.slices.len() {
        return Err(shape("slices", slices.len(), content.slices.len()).into());
    }
    for (slice, ratio) in content.slices.iter().zip(slices) {
        if slice.poisson_ratio != ratio {
            return Err(TableError::Value {
                item: "poisson_ratio".to_owned(),
                value: slice.poisson_ratio,
                range: "the ratio that the settings say",
            }
            .into());
        }
        if slice.tail_terms(content.r.len() * content.z.len()) != grid.tail_terms {
            let found = slice.tail_terms(content.r.len() * content.z.len());
            return Err(shape("tail", grid.tail_terms, found).into());
        }
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
