//! Table on disk, of which only the needed part is loaded.

use super::error::{BadTable, TableError};
use super::open::open;
use super::read::{Listed, Window};
use super::source::TableSource;
use crate::certificate::{Measured, SAFETY};
use crate::content::{Content, FIELDS, Role, Slice, Verification};
use crate::error::LookupError;
use crate::hash::settings_id;
use crate::ratio::{self, Served};
use crate::series::stencil::locate;
use crate::table::Table;
use halfspace::DomainError;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A kernel table on disk.
///
/// [`Self::part`] returns a [`Table`] with one slice for a Poisson ratio, at the nodes that some places need. Its
/// values there equal those of the whole table; between slices they differ by the rounding of stored values.
#[derive(Debug, Clone)]
pub struct TableFile {
    path: PathBuf,
    id: String,
    reach: [f64; 2],
}

impl TableFile {
    /// Opens the table at `path` and reads everything except the slices.
    ///
    /// A file of a format before 2.4 has no seal. It is read completely and its content is compared with the stated
    /// hash, which takes seconds.
    ///
    /// # Errors
    /// [`TableError`]: the file does not exist, is not a kernel table, has an unknown version, or is incomplete or
    /// damaged.
    pub fn open(path: &Path) -> Result<Self, TableError> {
        let source = open(path)?;
        let (content, _) = source.head()?;
        if !source.file.is_sealed() {
            source.proven()?;
        }
        Ok(Self {
            path: path.to_owned(),
            id: settings_id(&content.origin.grid),
            reach: [content.r_max, content.z_max],
        })
    }

    /// Hash of the settings of the table, as of its opening.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Largest r and z of the table in r0, as of its opening.
    pub fn reach(&self) -> [f64; 2] {
        self.reach
    }

    /// Path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Checks that the table covers a Poisson ratio and places (r, z) in r0, without loading numbers.
    ///
    /// # Errors
    /// [`TableError`], or [`LookupError::Outside`] with the axis and the range.
    pub fn serves(
        &self,
        poisson_ratio: f64,
        farthest: [f64; 2],
    ) -> Result<Result<(), LookupError>, TableError> {
        let source = open(&self.path)?;
        let (content, listed) = source.head()?;
        let ends = [("r/r0", content.r_max), ("z/r0", content.z_max)];
        for ((axis, max), value) in ends.into_iter().zip(farthest) {
            if value > max {
                return Ok(Err(LookupError::outside(axis, value, [0.0, max])));
            }
        }
        Ok(ratio::weights(&served(&source, &listed)?, poisson_ratio).map(drop))
    }

    /// Loads the part for a Poisson ratio and for places (r, z) in r0 from the first to the last corner of `span`.
    ///
    /// Between slices the numbers are interpolated once, here. If the table does not cover the ratio, all slices are
    /// loaded, so that errors of lookups contain the range. If it does not cover the span, the part ends where the
    /// table ends.
    ///
    /// # Errors
    /// As [`Table::open`], and [`BadTable::Changed`].
    pub fn part(&self, poisson_ratio: f64, span: [[f64; 2]; 2]) -> Result<Table, TableError> {
        let source = open(&self.path)?;
        let (mut content, listed) = source.head()?;
        if settings_id(&content.origin.grid) != self.id {
            return Err(BadTable::Changed.of(&self.path));
        }
        let served = served(&source, &listed)?;
        let (wanted, first) = window(&content, span);
        let weights = ratio::weights(&served, poisson_ratio);
        let between = ratio::between(&content, &served, poisson_ratio);
        content.slices = match (weights.as_deref(), between) {
            (Ok([(index, _)]), _) => vec![source.slice(&content, &listed[*index], &wanted)?],
            (Ok(weights), Some(between)) => {
                let slices: Vec<_> = weights.iter().map(|&(i, w)| (&listed[i], w)).collect();
                let sum = source.sum(&content, &slices, &wanted)?;
                let of = |index: usize| source.errors(&content, &listed[index], &wanted);
                let [below, above] = ratio::beside(&served, weights, poisson_ratio);
                let beside = [of(above)?, of(below)?];
                let coordinates = weights.iter().map(|&(i, _)| served[i].coordinate);
                let added = Measured::between(&content, between, coordinates, poisson_ratio);
                let added = added.map_err(|error| source.wrong(error))?;
                vec![Slice {
                    poisson_ratio,
                    role: Role::Exact,
                    verification: blended(&content, &wanted.meshes, beside, &added),
                    ..sum
                }]
            }
            (_, _) => {
                let slice = |slice| source.slice(&content, slice, &wanted);
                listed.iter().map(slice).collect::<Result<_, _>>()?
            }
        };
        let reach = [content.r_max, content.z_max];
        cut(&mut content, &wanted);
        let table = Table::part(content, first, source.decoded.get(), reach);
        table.map_err(|error| source.wrong(error))
    }
}

/// Poisson's ratios and roles of the slices of a file.
fn served(source: &TableSource, listed: &[Listed]) -> Result<Vec<Served>, TableError> {
    let slices = listed.iter();
    let slices = slices.map(|slice| Served::new(slice.ratio, slice.role));
    let served: Result<_, DomainError> = slices.collect();
    served.map_err(|error| source.wrong(error))
}

/// The window of nodes and meshes that the places of a span need, and the first mesh that contains any of the places.
fn window(content: &Content, span: [[f64; 2]; 2]) -> (Window, [usize; 2]) {
    let mut wanted = Window::all(content);
    let mut first = [0; 2];
    for (axis, nodes) in [&content.r, &content.z].into_iter().enumerate() {
        let served = &nodes[..=wanted.meshes[axis].end];
        let end = served[served.len() - 1];
        let [nearest, farthest] = span.map(|place| locate(served, place[axis].min(end)));
        let (Some(nearest), Some(farthest)) = (nearest, farthest) else {
            continue;
        };
        // the error of a mesh depends on its neighbours too, and a table has at least the nodes of one stencil
        let beyond = content.stencil_points / 2;
        let last = nodes.len() - content.stencil_points;
        let from = nearest.saturating_sub(beyond.max(1)).min(last);
        let to = (farthest + 2)
            .max(from + beyond)
            .min(wanted.meshes[axis].end);
        wanted.meshes[axis] = from..to;
        wanted.nodes[axis] = from..(to + beyond).min(nodes.len());
        first[axis] = if from == 0 { 0 } else { nearest - from };
    }
    (wanted, first)
}

/// Reduces the axes to the nodes that are read.
fn cut(content: &mut Content, wanted: &Window) {
    let Content { r, z, .. } = content;
    for (axis, nodes) in [r, z].into_iter().enumerate() {
        let Range { start, end } = wanted.nodes[axis];
        nodes.truncate(end);
        nodes.drain(..start);
    }
    let [across, down] = [0, 1].map(|axis| wanted.meshes[axis].len());
    (content.r_max, content.z_max) = (content.r[across], content.z[down]);
}

/// Errors of numbers interpolated between two slices: the larger of the slices' errors and of the error measured
/// between them, the latter in proportion to the node polynomial.
fn blended(
    content: &Content,
    meshes: &[Range<usize>; 2],
    [above, below]: [Verification; 2],
    added: &Measured<'_>,
) -> Verification {
    let mut found = above;
    for (i, &error) in below.error.iter().enumerate() {
        found.error[i] = found.error[i].max(error);
        if below.direct[i].abs() > found.direct[i].abs() {
            (found.direct[i], found.looked_up[i]) = (below.direct[i], below.looked_up[i]);
        }
    }
    let [across, down] = content.probes();
    let [across, down] = [&across[meshes[0].clone()], &down[meshes[1].clone()]];
    let places = across
        .iter()
        .flat_map(|&r| down.iter().map(move |&z| [r, z]));
    let of_place = content.pulse_lengths.len() * FIELDS;
    for (place, errors) in places.zip(found.error.chunks_exact_mut(of_place)) {
        let around = added.around(place);
        for (index, error) in errors.iter_mut().enumerate() {
            let more = added.most(&around, index / FIELDS, index % FIELDS);
            *error += (more / SAFETY) as f32;
        }
    }
    found
}
