//! From a grid to a complete, verified file.

use crate::assemble::{Summary, complete};
use crate::block;
use crate::error::BuildError;
use crate::grid::Grid;
use crate::journal::{self, journal_of, title};
use crate::known::Known;
use crate::progress::Progress;
use crate::rows::{rows, usable};
use output::Title;
use output::{Existing, Output, OutputError};
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
pub fn build_over(
    grid: &Grid,
    path: &Path,
    existing: Existing,
    progress: &dyn Progress,
) -> Result<Summary, BuildError> {
    let started = Instant::now();
    grid.validate()?;
    let text = grid.to_toml()?;
    let output = match Output::claim(path, existing) {
        Err(exists @ OutputError::Exists { .. }) => {
            clear(grid, path, &text)?;
            return Err(exists.into());
        }
        claimed => claimed?,
    };
    let drops = |_: &str| existing == Existing::Replace;
    let title = title(&text, None);
    compute(grid, &output, &title, drops, None, progress, started)
}

/// Computes what neither a journal nor a known table has, and writes the table; the journal goes when it is there.
pub(crate) fn compute(
    grid: &Grid,
    output: &Output,
    title: &Title,
    drops: impl Fn(&str) -> bool,
    known: Option<&Known>,
    progress: &dyn Progress,
    started: Instant,
) -> Result<Summary, BuildError> {
    let work = block::all(grid);
    let (journal, found) = journal::open(&journal_of(output), title, drops)?;
    let mut finished = usable(grid, &work, found, known)?;
    let resumed_blocks = finished.len();
    if let Some(known) = known {
        for &block in &work {
            if let Some(row) = known.row(grid, block)? {
                finished.insert(block, row);
            }
        }
    }
    let journal = Mutex::new(journal);
    let rows = rows(grid, &work, finished, Some(&journal), known, progress)?;
    let summary = complete(grid, &work, rows, output, known, progress)?;
    journal
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner)
        .remove();
    Ok(Summary {
        wall_s: started.elapsed().as_secs_f64(),
        resumed_blocks,
        ..summary
    })
}

/// Removes the journal of a finished table: a run that was killed after it had named the table has left it.
fn clear(grid: &Grid, path: &Path, settings: &str) -> Result<(), BuildError> {
    let output = Output::claim(path, Existing::Replace)?;
    let journal = journal_of(&output);
    let Ok((found, rows)) = journal::read(&journal) else {
        return Ok(());
    };
    let work = block::all(grid);
    let whole = found == settings && usable(grid, &work, rows, None)?.len() == work.len();
    if whole && lookup::read(path).is_ok_and(|content| content.origin.grid == settings) {
        let _ = std::fs::remove_file(&journal);
    }
    Ok(())
}
