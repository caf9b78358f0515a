//! A table in parts: shards computed apart, joined into one.

use crate::assemble::{Summary, complete};
use crate::block::{self, Block, Row};
use crate::error::BuildError;
use crate::grid::Grid;
use crate::journal::{self, title};
use crate::progress::Progress;
use crate::rows::{rows, usable};
use ledger::Shard;
use output::{Existing, Output, Role, apart};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Instant;

/// Computes a part of the blocks of `grid` into the file `path`, to be joined by [`merge`].
///
/// Given again, it goes on where it stopped; when all blocks of the part are there it does nothing.
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
    let work: Vec<Block> = block::all(grid)
        .into_iter()
        .skip(shard.index - 1)
        .step_by(shard.count)
        .collect();
    let text = grid.to_toml()?;
    let output = Output::claim(path, Existing::Replace)?;
    let (journal, finished) = journal::open(&output.real, &title(&text, None), |_| false)?;
    let finished = usable(grid, &work, finished, None)?;
    let journal = Mutex::new(journal);
    rows(grid, &work, finished, Some(&journal), None, progress)?;
    Ok(work.len())
}

/// Joins the shards at `parts` into a table at `path`.
///
/// # Errors
/// [`BuildError`]: a file that is no shard, shards of different settings, blocks that are missing, or as [`build`](crate::build).
pub fn merge(
    parts: &[PathBuf],
    path: &Path,
    existing: Existing,
    progress: &dyn Progress,
) -> Result<Summary, BuildError> {
    let started = Instant::now();
    let inputs: Vec<Role> = (parts.iter())
        .map(|part| ("a shard", part.clone()))
        .collect();
    apart(&[path], &inputs)?;
    let output = Output::claim(path, existing)?;
    let (grid, found) = read_all(parts)?;
    let work = block::all(&grid);
    let mut found = usable(&grid, &work, found, None)?;
    let missing: Vec<&Block> = work
        .iter()
        .filter(|block| !found.contains_key(block))
        .collect();
    if let Some(first) = missing.first() {
        let (missing, total, row) = (missing.len(), work.len(), first.row);
        let poisson_ratio = grid.ratio_of(**first)?;
        let sentence = format!(
            "{missing} of {total} blocks are missing, the first for poisson_ratio = {poisson_ratio}, row {row}: all shards are needed, each finished"
        );
        return Err(BuildError::refused(None, sentence));
    }
    let rows = work
        .iter()
        .filter_map(|block| found.remove(block))
        .collect();
    let summary = complete(&grid, &work, rows, &output, None, progress)?;
    Ok(Summary {
        wall_s: started.elapsed().as_secs_f64(),
        ..summary
    })
}

/// The settings that all shards share, valid, and all their blocks.
fn read_all(parts: &[PathBuf]) -> Result<(Grid, HashMap<Block, Row>), BuildError> {
    let mut settings: Option<(String, Grid)> = None;
    let mut found = HashMap::new();
    for part in parts {
        let (text, rows) = journal::read(part)?;
        match &settings {
            Some((first, _)) if *first != text => {
                let sentence = format!(
                    "{} was made with other settings than {}: shards of one table have the same grid",
                    part.display(),
                    parts[0].display()
                );
                return Err(BuildError::refused(Some(part), sentence));
            }
            Some(_) => {}
            None => {
                let grid = Grid::parse(&text).map_err(|error| error.in_file(part))?;
                settings = Some((text, grid));
            }
        }
        found.extend(rows);
    }
    let none = || "a table is joined from one shard or more".to_owned();
    let (_, grid) = settings.ok_or_else(|| BuildError::refused(None, none()))?;
    Ok((grid, found))
}
