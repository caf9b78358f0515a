//! Building: from a grid to a complete, verified file.

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

/// Builds the table of `grid` at `path`, which must not exist; resumes an interrupted build.
///
/// # Errors
/// [`BuildError`]: a setting is outside its range, the file exists or cannot be written, or a value cannot be computed.
pub fn build(
    grid: &Grid,
    path: &Path,
    progress: &dyn Progress,
) -> Result<BuildSummary, BuildError> {
    build_over(grid, path, Existing::Keep, progress)
}

/// [`build`] with a choice of whether an existing file is kept or replaced.
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

/// Computes the numbers that neither a journal nor a known table contains, writes the table and removes the journal.
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

/// Removes the journal of a finished table, which remains if a run was killed after it had named the table.
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
