//! From a grid to a complete, verified file.

use crate::block;
use crate::error::BuildError;
use crate::grid::Grid;
use crate::journal::{Journal, Task};
use crate::output::{Existing, beside, refuse};
use crate::progress::Progress;
use crate::rows::{rows, usable};
use crate::summary::{Summary, complete};
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// Builds the table of `grid` at `path`, which must not exist.
///
/// # Errors
/// [`BuildError`]: a setting outside its range, a file in the way, a value that cannot be computed, a full disk.
pub fn build(grid: &Grid, path: &Path, progress: &dyn Progress) -> Result<Summary, BuildError> {
    build_over(grid, path, Existing::Keep, progress)
}

/// [`build`] with a choice of what happens to a file that is there already.
///
/// # Errors
/// As [`build`].
pub fn build_over(
    grid: &Grid,
    path: &Path,
    existing: Existing,
    progress: &dyn Progress,
) -> Result<Summary, BuildError> {
    let started = Instant::now();
    grid.validate()?;
    refuse(path, existing)?;
    let work = block::all(grid);
    let text = grid.to_toml()?;
    let (journal, finished) =
        Journal::open(&beside(path, ".journal"), Task::Build { grid: &text })?;
    // Another run may have finished the table before this one had the journal.
    if let Err(error) = refuse(path, existing) {
        journal.remove()?;
        return Err(error);
    }
    let finished = usable(grid, &work, finished, None)?;
    let resumed_blocks = finished.len();
    let journal = Mutex::new(journal);
    let rows = rows(grid, &work, finished, Some(&journal), None, progress)?;
    let summary = complete(grid, &work, rows, path, None, progress)?;
    journal
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner)
        .remove()?;
    Ok(Summary {
        resumed_blocks,
        wall_s: started.elapsed().as_secs_f64(),
        ..summary
    })
}
