//! Shards: parts of a table that are computed separately and then merged.

use crate::assemble::{BuildSummary, complete};
use crate::error::BuildError;
use crate::grid::Grid;
use crate::journal::{records, title};
use crate::progress::Progress;
use crate::rows::TableWork;
use ledger::Shard;
use output::{Existing, Output, Role, apart};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Computes a part of the blocks of `grid` and writes it to the file `path`, for [`merge`].
///
/// The same call resumes an interrupted run; it does nothing if all blocks of the part are finished.
///
/// # Errors
/// As [`build`](crate::build).
pub fn build_shard(
    grid: &Grid,
    shard: Shard,
    path: &Path,
    progress: &dyn Progress,
) -> Result<usize, BuildError> {
    grid.validate()?;
    let mut work = TableWork::new(grid, None, progress)?;
    let own = work.blocks.into_iter().skip(shard.index - 1);
    work.blocks = own.step_by(shard.count).collect();
    let text = grid.to_toml()?;
    let output = Output::claim(path, Existing::Replace)?;
    let (journal, finished) = work.open(&output.real, &title(&text, None), |_| false)?;
    work.rows(finished, Some(&journal))?;
    Ok(work.blocks.len())
}

/// Merges the shards at `parts` into a table at `path`.
///
/// # Errors
/// [`BuildError`]: a file is not a shard, shards have different settings, blocks are missing, or as [`build`](crate::build).
pub fn merge(
    parts: &[PathBuf],
    path: &Path,
    existing: Existing,
    progress: &dyn Progress,
) -> Result<BuildSummary, BuildError> {
    let started = Instant::now();
    let inputs: Vec<Role> = (parts.iter())
        .map(|part| ("a shard", part.clone()))
        .collect();
    apart(&[path], &inputs)?;
    let output = Output::claim(path, existing)?;
    let Some(first) = parts.first() else {
        let none = "a table is merged from at least one shard";
        return Err(BuildError::refused(None, none.to_owned()));
    };
    let settings = records(first)?.title.about;
    let grid = Grid::parse(&settings).map_err(|error| error.in_file(first))?;
    let work = TableWork::new(&grid, None, progress)?;
    let mut found = HashMap::new();
    for part in parts {
        let mut records = records(part)?;
        if records.title.about != settings {
            let sentence = format!(
                "{} has other settings than {}: all shards of a table have the same grid",
                part.display(),
                first.display()
            );
            return Err(BuildError::refused(Some(part), sentence));
        }
        records.all(|(_, kept)| work.take(&mut found, &kept));
    }
    let mut missing = work.blocks.clone();
    missing.retain(|block| !found.contains_key(block));
    if let Some(&first) = missing.first() {
        let (missing, total, row) = (missing.len(), work.blocks.len(), first.row);
        let (poisson_ratio, ..) = work.place(first);
        let sentence = format!(
            "{missing} of {total} blocks are missing, the first for poisson_ratio = {poisson_ratio}, row {row}: all shards are needed, each finished"
        );
        return Err(BuildError::refused(None, sentence));
    }
    let blocks = work.blocks.iter();
    let rows = blocks.filter_map(|block| found.remove(block)).collect();
    complete(&work, rows, &output, started)
}
