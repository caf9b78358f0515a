//! Extension of a finished table by slices, places and times; only the missing numbers are computed.

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

/// Additions to a table.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Extension {
    /// Poisson ratios that get an exact slice; existing slices are kept.
    pub exact_ratios: Vec<f64>,
    /// New largest distance from the axis in r0.
    pub r_max: Option<f64>,
    /// New largest depth in r0.
    pub z_max: Option<f64>,
    /// New end of the time cells, as a multiple of the last arrival.
    pub time_factor: Option<f64>,
}

/// Extends the table at `path`; the file is replaced when the larger table is complete and verified.
///
/// An interrupted run can be resumed by the same call. An empty extension rewrites the table in the present format
/// without computing a number. Existing nodes keep their numbers; an axis is extended with its last spacing.
///
/// # Errors
/// [`BuildError`]: the table cannot be read or does not match its settings, a value is outside its range or less than in the
/// table, or as [`crate::build`].
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
    // a journal with the settings of the present table may be removed
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
