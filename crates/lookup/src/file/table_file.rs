//! A table on disk, of which the part that a question needs is loaded.

use super::blend::Blend;
use super::error::TableError;
use super::open::open;
use super::read::Nodes;
use crate::content::{Content, Role};
use crate::error::LookupError;
use crate::hash::settings_id;
use crate::ratio::{self, Served};
use crate::series::stencil::locate;
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
    id: String,
}

impl TableFile {
    /// The table at `path`; reads what is not a slice.
    ///
    /// A file of a format before 2.4 is read whole and its content compared with the hash that it states, which takes
    /// seconds: nothing else covers all of its bytes.
    ///
    /// # Errors
    /// [`TableError`]: the file is absent, not a kernel table, of an unknown version, incomplete or damaged.
    pub fn open(path: &Path) -> Result<Self, TableError> {
        let source = open(path)?;
        let (content, _) = source.head()?;
        if !source.is_sealed() {
            source.compare(&source.everything()?)?;
        }
        Ok(Self {
            path: path.to_owned(),
            id: settings_id(&content.origin.grid),
        })
    }

    /// Identity of the settings that it was made with, when it was opened.
    #[must_use]
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Where the file is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Refuses a Poisson ratio that the table does not serve and places (r, z) in r0 beyond it, without loading numbers.
    ///
    /// # Errors
    /// [`TableError`]; or [`LookupError::Outside`] with the axis and the range.
    pub fn serves(
        &self,
        poisson_ratio: f64,
        farthest: [f64; 2],
    ) -> Result<Result<(), LookupError>, TableError> {
        let (content, listed) = open(&self.path)?.head()?;
        let outside = |axis, value, min, max| {
            Ok(Err(LookupError::Outside {
                axis,
                value,
                min,
                max,
            }))
        };
        let ends = [("r/r0", content.r_max), ("z/r0", content.z_max)];
        for ((axis, max), value) in ends.into_iter().zip(farthest) {
            if value > max {
                return outside(axis, value, 0.0, max);
            }
        }
        let grid = listed.iter().filter(|slice| slice.role == Role::Grid);
        let (min, max) = grid.fold((f64::NAN, f64::NAN), |(min, max), slice| {
            (slice.ratio.min(min), slice.ratio.max(max))
        });
        let exact = |ratio: f64| (ratio - poisson_ratio).abs() < ratio::SAME;
        let inside = (min..=max).contains(&poisson_ratio);
        if inside || listed.iter().any(|slice| exact(slice.ratio)) {
            Ok(Ok(()))
        } else {
            outside("poisson_ratio", poisson_ratio, min, max)
        }
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
        let source = open(&self.path)?;
        let (mut content, listed) = source.head()?;
        let served = listed
            .iter()
            .map(|slice| Served::new(slice.ratio, slice.role))
            .collect::<Result<Vec<_>, _>>()
            .map_err(|error| source.content(error))?;
        let wanted = nodes(&content, farthest).unwrap_or(Nodes::all(&content));
        cut(&mut content, &wanted);
        let weights =
            ratio::weights(&served, poisson_ratio).map_err(|error| source.content(error))?;
        match weights.as_deref() {
            Some([(index, _)]) => {
                let slice = source.slice(&content, &listed[*index], &wanted)?;
                content.slices.push(slice);
            }
            Some(weights) if ratio::between(&content, &served, poisson_ratio).is_some() => {
                let mut blend = Blend::new(&content, &served, poisson_ratio);
                for &(index, weight) in weights {
                    let slice = source.slice(&content, &listed[index], &wanted)?;
                    let added = blend.add(index, weight, slice);
                    added.map_err(|error| source.content(error))?;
                }
                let slice = blend.finish().map_err(|error| source.content(error))?;
                content.slices.push(slice);
            }
            Some(_) | None => {
                for slice in &listed {
                    let slice = source.slice(&content, slice, &wanted)?;
                    content.slices.push(slice);
                }
            }
        }
        Table::new(content).map_err(|error| source.content(error))
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
