//! From a grid to a complete, verified file.

use crate::assemble::{BuildSummary, complete};
use crate::error::BuildError;
use crate::grid::Grid;
use crate::journal::{journal_of, records, title};
use crate::progress::Progress;
use crate::rows::TableWork;
use output::{Existing, Output, OutputError, Title};
use std::collections::HashMap;
use std::path::Path;
use std::sync::PoisonError;
use std::time::Instant;

/// Builds the table of `grid` at `path`, which must not exist.
///
/// # Errors
/// [`BuildError`]: a setting outside its range, a file in the way, a value that cannot be computed, a full disk.
pub fn build(
    grid: &Grid,
    path: &Path,
    progress: &dyn Progress,
) -> Result<BuildSummary, BuildError> {
    build_over(grid, path, Existing::Keep, progress)
}

/// [`build`] with a choice of what happens to a file that is there already.
pub fn build_over(
    grid: &Grid,
    path: &Path,
    existing: Existing,
    progress: &dyn Progress,
) -> Result<BuildSummary, BuildError> {
    let started = Instant::now();
    grid.validate()?;
    let text = grid.to_toml()?;
    let work = TableWork::new(grid, None, progress)?;
    let output = match Output::claim(path, existing) {
        Err(exists @ OutputError::Exists { .. }) => {
            clear(&work, path, &text)?;
            return Err(exists.into());
        }
        claimed => claimed?,
    };
    let drops = |_: &str| existing == Existing::Replace;
    compute(&work, &output, &title(&text, None), drops, started)
}

/// Computes what neither a journal nor a known table has, and writes the table; the journal goes when it is there.
pub(crate) fn compute(
    work: &TableWork<'_>,
    output: &Output,
    title: &Title,
    drops: impl Fn(&str) -> bool,
    started: Instant,
) -> Result<BuildSummary, BuildError> {
    let (journal, mut finished) = work.open(&journal_of(output), title, drops)?;
    let resumed_blocks = finished.len();
    work.add_known(&mut finished);
    let rows = work.rows(finished, Some(&journal))?;
    let summary = complete(work, rows, output, started)?;
    let journal = journal.into_inner().unwrap_or_else(PoisonError::into_inner);
    journal.remove();
    Ok(BuildSummary {
        resumed_blocks,
        ..summary
    })
}

/// Removes the journal of a finished table: a run that was killed after it had named the table has left it.
fn clear(work: &TableWork<'_>, path: &Path, settings: &str) -> Result<(), BuildError> {
    let journal = journal_of(&Output::claim(path, Existing::Replace)?);
    let Ok(mut records) = records(&journal) else {
        return Ok(());
    };
    let mut found = HashMap::new();
    records.all(|(_, kept)| work.take(&mut found, &kept));
    let whole = records.title.about == settings && found.len() == work.blocks.len();
    if whole && lookup::read(path).is_ok_and(|content| content.origin.grid == settings) {
        let _ = std::fs::remove_file(&journal);
    }
    Ok(())
}
