//! A table on disk, of which the part that a question needs is loaded.

use crate::certificate::{Added, SAFETY};
use crate::content::{Content, FIELDS, Role, Slice, Verification};
use crate::error::TableError;
use crate::ratio::{self, Served};
use crate::read::{self, Listed, Nodes, Source};
use crate::schema;
use crate::stencil::locate;
use crate::table::Table;
use std::path::{Path, PathBuf};

/// A kernel table on disk.
///
/// A part of it is a [`Table`] of its own: one slice at a Poisson ratio, at the nodes that places up to some distance
/// and depth need.
/// It answers there as the whole does, between slices but for the rounding of stored values.
#[derive(Debug, Clone)]
pub struct TableFile {
    path: PathBuf,
}

impl TableFile {
    /// The table at `path`; reads what is not a slice.
    ///
    /// # Errors
    /// [`TableError`]: the file is absent, not a kernel table, of an unknown version or incomplete.
    pub fn open(path: &Path) -> Result<Self, TableError> {
        read::open(path)?.head()?;
        Ok(Self {
            path: path.to_owned(),
        })
    }

    /// Where the file is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The part for a Poisson ratio and for places (r, z) in r0 no farther than `farthest`.
    ///
    /// Between slices their numbers are interpolated once, here.
    /// Where the table does not serve the ratio or reach so far, its slices or nodes are loaded whole, so that the
    /// answers can say what range is.
    ///
    /// # Errors
    /// As [`Table::open`].
    pub fn part(&self, poisson_ratio: f64, farthest: [f64; 2]) -> Result<Table, TableError> {
        let source = read::open(&self.path)?;
        let (mut content, groups) = source.head()?;
        let served = groups
            .iter()
            .map(|(ratio, role, _)| Served::new(*ratio, *role))
            .collect::<Result<Vec<_>, _>>()?;
        let wanted = nodes(&content, farthest).unwrap_or(Nodes::all(&content));
        cut(&mut content, &wanted);
        match ratio::weights(&served, poisson_ratio)?.as_deref() {
            Some([(index, _)]) => {
                let slice = source.slice(&groups[*index].2, &wanted)?;
                content.slices.push(slice);
            }
            Some(weights) if ratio::between(&content, &served, poisson_ratio).is_some() => {
                let slice = blend(&source, &groups, weights, &wanted, poisson_ratio)?;
                let verification =
                    blend_errors(&content, &served, weights, slice.1, poisson_ratio)?;
                content.slices.push(Slice {
                    verification,
                    ..slice.0
                });
            }
            _ => {
                for (_, _, group) in &groups {
                    content.slices.push(source.slice(group, &wanted)?);
                }
            }
        }
        Table::new(content)
    }
}

/// The nodes that places up to `farthest` need, with the meshes beside them; nothing where the table ends before.
fn nodes(content: &Content, farthest: [f64; 2]) -> Option<Nodes> {
    let mut wanted = Nodes::all(content);
    for (axis, nodes) in [&content.r, &content.z].into_iter().enumerate() {
        let served = nodes.get(..=wanted.meshes[axis])?;
        // the neighbours of a mesh tell its error too, and a table has at least the nodes of one stencil
        let beyond = content.stencil_points / 2;
        let meshes = (locate(served, farthest[axis])? + 2).max(beyond);
        wanted.meshes[axis] = meshes.min(wanted.meshes[axis]);
        wanted.nodes[axis] = (wanted.meshes[axis] + beyond).min(nodes.len());
    }
    Some(wanted)
}

/// Cuts the axes to the nodes read.
fn cut(content: &mut Content, wanted: &Nodes) {
    let [columns, rows] = wanted.meshes;
    if let (Some(&r_max), Some(&z_max)) = (content.r.get(columns), content.z.get(rows)) {
        (content.r_max, content.z_max) = (r_max, z_max);
    }
    content.r.truncate(wanted.nodes[0]);
    content.z.truncate(wanted.nodes[1]);
}

/// The numbers of slices interpolated at a ratio, without errors, and the verification of the two slices beside it.
fn blend(
    source: &Source<'_>,
    groups: &[Listed],
    weights: &[(usize, f64)],
    wanted: &Nodes,
    poisson_ratio: f64,
) -> Result<(Slice, Vec<Verification>), TableError> {
    let mut sums: [Vec<f64>; 4] = Default::default();
    let mut beside: Vec<(f64, Verification)> = Vec::new();
    let mut cells = 0;
    for &(index, weight) in weights {
        let (ratio, _, group) = &groups[index];
        let slice = source.slice(group, wanted)?;
        if cells != 0 && slice.cells != cells {
            return Err(TableError::Shape {
                item: format!("slices/{}/time", schema::slice_name(*ratio)),
                needed: cells,
                found: slice.cells,
            });
        }
        cells = slice.cells;
        let numbers = [
            &slice.remainder,
            &slice.moment,
            &slice.curvature,
            &slice.tail,
        ];
        for (sum, values) in sums.iter_mut().zip(numbers) {
            sum.resize(values.len(), 0.0);
            for (s, &value) in sum.iter_mut().zip(values) {
                *s += weight * f64::from(value);
            }
        }
        beside.push((ratio - poisson_ratio, slice.verification));
    }
    beside.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    let above = beside.iter().position(|(distance, _)| *distance > 0.0);
    let below = beside.iter().position(|(distance, _)| *distance < 0.0);
    let [remainder, moment, curvature, tail] =
        sums.map(|sum| sum.into_iter().map(|x| x as f32).collect());
    let slice = Slice {
        poisson_ratio,
        role: Role::Exact,
        cells,
        remainder,
        moment,
        curvature,
        tail,
        verification: Verification::default(),
    };
    let two = [above, below].into_iter().flatten();
    Ok((slice, two.map(|i| beside[i].1.clone()).collect()))
}

/// Errors of the interpolated numbers: the larger of the slices beside and, in proportion to the node polynomial, what
/// was measured between them.
fn blend_errors(
    content: &Content,
    served: &[Served],
    weights: &[(usize, f64)],
    beside: Vec<Verification>,
    poisson_ratio: f64,
) -> Result<Verification, TableError> {
    let mut found = Verification::default();
    for slice in beside {
        if found.error.is_empty() {
            found = slice;
            continue;
        }
        for (i, &error) in slice.error.iter().enumerate() {
            if error > found.error[i] {
                found.error[i] = error;
            }
            if slice.direct[i].abs() > found.direct[i].abs() {
                (found.direct[i], found.looked_up[i]) = (slice.direct[i], slice.looked_up[i]);
            }
        }
    }
    let Some(between) = ratio::between(content, served, poisson_ratio) else {
        return Ok(found);
    };
    let coordinates: Vec<f64> = weights.iter().map(|&(i, _)| served[i].coordinate).collect();
    let added = Added::new(content, between, &coordinates, poisson_ratio)?;
    let [across, down] = content.probes();
    let places = across
        .iter()
        .flat_map(|&r| down.iter().map(move |&z| (r, z)));
    let pulses = content.pulse_lengths.len();
    for (place, (r, z)) in places.enumerate() {
        let around = added.around([r, z]);
        for pulse in 0..pulses {
            for field in 0..FIELDS {
                let index = (place * pulses + pulse) * FIELDS + field;
                found.error[index] += (added.most(&around, pulse, field) / SAFETY) as f32;
            }
        }
    }
    Ok(found)
}
