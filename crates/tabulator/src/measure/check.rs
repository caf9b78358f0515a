//! Check of a finished table: checksums, completeness, finite values, and a recomputed sample.

use crate::error::BuildError;
use crate::grid::Grid;
use halfspace::random;
use lookup::{BadTable, Content, ContentError, Numbers, Slice, Table};
use lookup::{content_hash, damaged_patches, schema};
use rayon::prelude::*;
use std::path::Path;

/// Result of [`check_table`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CheckReport {
    /// Number of recomputed nodes.
    pub nodes_checked: usize,
    /// Largest relative difference of their averages and tails.
    pub largest_difference: f64,
    /// Whether the content has the stated SHA-256.
    pub hash_right: bool,
    /// Places of numbers that differ by more than the tolerance or are not finite, each with a description.
    pub bad: Vec<String>,
    /// Places of nodes that cannot be read; if there are any, nothing else is checked.
    pub damaged: Vec<String>,
}

impl CheckReport {
    /// Whether the check found no error.
    pub fn is_good(&self) -> bool {
        self.hash_right && self.bad.is_empty() && self.damaged.is_empty()
    }
}

/// Largest allowed difference of moments: they are computed and rounded to about 1e-5, and at fronts to 30 times that.
const ALLOWED_OF_MOMENTS: f64 = 4e-4;
/// Largest allowed difference of moments in tables of revision 1, most of which were derived from five averages.
const ALLOWED_OF_FIRST_MOMENTS: f64 = 5e-3;

/// Reads the table at `path`, compares its checksums, validates it, and recomputes `sample` nodes.
///
/// `seed` determines the selected nodes.
///
/// # Errors
/// [`BuildError`] if the file cannot be read or validated, its settings do not fit, or the exact kernels fail. Nodes with wrong
/// values or wrong checksums are part of the report, not an error.
pub fn check_table(path: &Path, sample: usize, seed: u64) -> Result<CheckReport, BuildError> {
    let content = match lookup::read(path) {
        Ok(content) => content,
        Err(error) if matches!(error.what, BadTable::Item { .. } | BadTable::Damaged(_)) => {
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
    let wrong = |error: ContentError| BadTable::Wrong(error.to_string()).of(path);
    let table = Table::new(content).map_err(wrong)?;
    let content = table.content();
    let grid = Grid::parse(&content.origin.grid).map_err(|error| error.in_file(path))?;
    same_axes(&grid, grid.cells()?, content).map_err(wrong)?;
    let nodes = content.r.len() * content.z.len();
    let total = nodes * content.slices.len();
    let plan = |slice: &Slice| grid.point(slice.poisson_ratio);
    let plans: Vec<_> = content.slices.iter().map(plan).collect::<Result<_, _>>()?;
    // averages and tails may differ by the rounding to single precision and the tolerance of the kernels
    let limit = 2e-7 + 100.0 * grid.tolerance;
    let found: Vec<(f64, Vec<String>)> = picks(total, sample, seed)
        .into_par_iter()
        .map(|pick| {
            let (index, node) = (pick / nodes, pick % nodes);
            let [r, z] = place(content, node);
            let exact = plans[index].compute(r, z)?;
            let slice = &content.slices[index];
            Ok(compare(content, slice, node, &exact, limit))
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

/// Description of a node of a slice.
fn named(content: &Content, slice: &Slice, node: usize) -> String {
    let [r, z] = place(content, node);
    format!("nu = {}, r/r0 = {r}, z/r0 = {z}", slice.poisson_ratio)
}

/// Descriptions of nodes and fields with infinite numbers or NaN.
fn not_finite(content: &Content) -> Vec<String> {
    let nodes = content.r.len() * content.z.len();
    let mut bad = Vec::new();
    for slice in &content.slices {
        for (dataset, values) in slice.lists() {
            let each = (values.len() / (6 * nodes).max(1)).max(1);
            for (index, row) in values.chunks_exact(each).enumerate().take(6 * nodes) {
                if row.iter().all(|x| x.is_finite()) {
                    continue;
                }
                let field = schema::FIELD_NAMES[index % 6];
                let node = named(content, slice, index / 6);
                bad.push(format!("{node}: {field} ({dataset}) is not finite"));
            }
        }
    }
    bad
}

/// The largest difference of the averages and tails of a node from the exact ones, and descriptions of those above the
/// limit.
fn compare(
    content: &Content,
    slice: &Slice,
    node: usize,
    exact: &Numbers,
    limit: f64,
) -> (f64, Vec<String>) {
    let of_moments = if content.origin.numbers_revision == 1 {
        ALLOWED_OF_FIRST_MOMENTS
    } else {
        ALLOWED_OF_MOMENTS
    };
    let limits = [limit, of_moments, of_moments, limit];
    let lists = exact.iter().zip(limits);
    let (mut largest, mut bad) = (0.0_f64, Vec::new());
    for ((dataset, values), (exact_values, limit)) in slice.lists().into_iter().zip(lists) {
        let each = exact_values.len();
        for (f, field) in schema::FIELD_NAMES.into_iter().enumerate() {
            let stored = &values[(node * 6 + f) * each..][..each];
            let group = if f < 2 { 0..2 } else { 2..6 };
            let scale = exact[0]
                .iter()
                .flat_map(|six| six[group.clone()].iter())
                .fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
            let pairs = stored.iter().zip(exact_values);
            let differences = pairs.map(|(&a, b)| (f64::from(a) - b[f]).abs());
            let most = differences.fold(0.0, f64::max);
            let relative_difference = most / scale;
            if dataset == schema::REMAINDER || dataset == schema::TAIL {
                largest = largest.max(relative_difference);
            }
            if relative_difference > limit {
                let node = named(content, slice, node);
                let differs = format!("differs by {relative_difference:.1e}");
                bad.push(format!("{node}: {field} ({dataset}) {differs}"));
            }
        }
    }
    (largest, bad)
}

/// Checks that axes and cells match the settings.
fn same_axes(grid: &Grid, cells: usize, content: &Content) -> Result<(), ContentError> {
    let [r, z] = grid.nodes();
    let ratios: Vec<f64> = grid.slices().iter().map(|slice| slice.0).collect();
    let found: Vec<f64> = content.slices.iter().map(|s| s.poisson_ratio).collect();
    same("r", &r, &content.r)?;
    same("z", &z, &content.z)?;
    same("slices", &ratios, &found)?;
    let nodes = content.r.len() * content.z.len();
    for slice in &content.slices {
        same_length("tail", grid.tail_terms, slice.tail_terms(nodes))?;
        same_length("time", cells, slice.cells)?;
    }
    Ok(())
}

/// Checks that a list matches the settings.
fn same(item: &str, needed: &[f64], found: &[f64]) -> Result<(), ContentError> {
    same_length(item, needed.len(), found.len())?;
    match (0..found.len()).find(|&i| needed[i] != found[i]) {
        Some(i) => Err(ContentError::Wrong(format!(
            "{item}[{i}] = {}, allowed: the value of the settings",
            found[i]
        ))),
        None => Ok(()),
    }
}

fn same_length(item: &str, needed: usize, found: usize) -> Result<(), ContentError> {
    if needed == found {
        return Ok(());
    }
    let wrong = format!("{item} has {found} values, needed {needed}");
    Err(ContentError::Wrong(wrong))
}

/// `count` different numbers below `total`, or all if there are fewer, in ascending order.
fn picks(total: usize, count: usize, seed: u64) -> Vec<usize> {
    if count >= total {
        return (0..total).collect();
    }
    let mut chosen = std::collections::BTreeSet::new();
    let draws = (0..).map(|index| (random::number(seed, index) % total as u64) as usize);
    for pick in draws {
        if chosen.len() == count {
            break;
        }
        chosen.insert(pick);
    }
    chosen.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn picks_are_different_and_repeat() {
        let picked = picks(1000, 50, 3);
        assert_eq!(picked.len(), 50);
        assert!(picked.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(picked, picks(1000, 50, 3));
        assert_ne!(picked, picks(1000, 50, 4));
        assert_eq!(picks(3, 10, 1), [0, 1, 2]);
    }
}
