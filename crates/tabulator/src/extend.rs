//! Adds slices, places and times to a finished table, computing only what it lacks.

use crate::assemble::BuildSummary;
use crate::build::compute;
use crate::error::BuildError;
use crate::grid::Grid;
use crate::journal::title;
use crate::known::Known;
use crate::progress::Progress;
use crate::rows::TableWork;
use lookup::Table;
use output::{Existing, Output};
use std::path::Path;
use std::time::Instant;

/// What a table is to have in addition.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Extension {
    /// Poisson ratios with a slice of their own; those that are there already are left.
    pub exact_ratios: Vec<f64>,
    /// Radius to be served, in r0.
    pub r_max: Option<f64>,
    /// Depth to be served, in r0.
    pub z_max: Option<f64>,
    /// Multiple of the last arrival at which the time cells end.
    pub time_factor: Option<f64>,
}

/// Extends the table at `path`; it is replaced when the larger one is complete and verified.
///
/// An interrupted run goes on where it stopped. An extension by nothing writes the table anew in the present format,
/// without computing a number. Nodes keep their numbers: an extended axis goes on from its
/// last node at its last spacing.
///
/// # Errors
/// [`BuildError`]: a table that cannot be read or is not what its settings say, a value outside its range or
/// less than what the table has, or as [`crate::build`].
pub fn extend(
    path: &Path,
    extension: &Extension,
    progress: &dyn Progress,
) -> Result<BuildSummary, BuildError> {
    let started = Instant::now();
    let output = Output::claim(path, Existing::Replace)?;
    let content = Table::open(path)?.into_content();
    let base = lookup::same_hash(path, &content)?;
    let present = content.origin.grid.clone();
    let mut grid = Grid::parse(&present).map_err(|error| error.in_file(path))?;
    let known = Known { content };
    apply(&mut grid, &known, extension)?;
    grid.validate()?;
    let title = title(&grid.to_toml()?, Some(&base));
    // one that became the table which is there may go
    let drops = |settings: &str| settings == present;
    let work = TableWork::new(&grid, Some(&known), progress)?;
    compute(&work, &output, &title, drops, started)
}

fn apply(grid: &mut Grid, known: &Known, extension: &Extension) -> Result<(), BuildError> {
    for &nu in &extension.exact_ratios {
        if known.slice(nu).is_none() && !grid.exact_ratios.contains(&nu) {
            grid.exact_ratios.push(nu);
        }
    }
    grid.exact_ratios.sort_by(f64::total_cmp);
    for (key, axis, wanted) in [
        ("r_max", &mut grid.r, extension.r_max),
        ("z_max", &mut grid.z, extension.z_max),
    ] {
        if let Some(wanted) = wanted {
            grows(key, wanted, axis.end())?;
            if wanted > axis.end() {
                axis.extended_to = Some(wanted);
            }
        }
    }
    if let Some(wanted) = extension.time_factor {
        grows("time_factor", wanted, grid.time_factor)?;
        grid.time_factor = wanted;
    }
    Ok(())
}

fn grows(key: &str, value: f64, present: f64) -> Result<(), BuildError> {
    if value >= present {
        return Ok(());
    }
    let sentence =
        format!("{key} = {value} is less than the {present} that the table has: tables only grow");
    Err(BuildError::of_key(key, value, None, sentence))
}
