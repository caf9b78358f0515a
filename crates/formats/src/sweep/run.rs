//! Runs a sweep block by block.

use super::block::Block;
use super::journal::{Header, Journal, JournalError};
use super::schema;
use super::spec::Spec;
use super::template::Templates;
use crate::error::SceneError;
use contact::{Ratios, Tabulated};
use output::Existing;
use sha2::{Digest, Sha256};
use std::path::Path;
use std::time::Instant;
use thiserror::Error;

/// Rows of a block at most.
pub const BLOCK: usize = 32_768;

/// Rows of the first block of a run; the following ones have as many as take [`BLOCK_S`].
pub const FIRST_BLOCK: usize = 64;

/// Time in s that the computation of a block is to take: what a kill costs.
pub const BLOCK_S: f64 = 2.0;

/// A sweep that could not be run; scenes that fail are rows, not errors.
#[derive(Debug, Error)]
pub enum SweepError {
    /// The sweep or its base scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The journal cannot be used.
    #[error(transparent)]
    Journal(#[from] JournalError),
}

/// All rows of a sweep.
#[derive(Debug)]
pub struct Done {
    /// Blocks in the order of their rows.
    pub blocks: Vec<Block>,
    /// Rows that an earlier run had computed.
    pub resumed: usize,
    /// Removed once the results are written.
    pub journal: Journal,
}

/// Distinct Poisson's ratios of targets up to which each has its own response.
const FEW: usize = 256;

/// Computes all rows that the journal at `part` does not hold yet.
///
/// The rows of another sweep are replaced where `existing` says so.
/// `watch` is told after each block how many rows are done; while it says true the sweep goes on,
/// otherwise nothing is returned and the journal keeps what is done.
/// Results do not depend on how rows are divided into blocks.
///
/// # Errors
/// [`SweepError`].
pub fn run_sweep(
    spec: &Spec,
    part: &Path,
    existing: Existing,
    mut watch: impl FnMut(usize) -> bool,
) -> Result<Option<Done>, SweepError> {
    let rows = spec.rows();
    let templates = Templates::new(spec)?;
    let (mut journal, mut blocks) = Journal::open(part, header(spec), existing)?;
    let responses = Tabulated::new(ratios(spec));
    let mut done: usize = blocks.iter().map(|block| block.numbers.len()).sum();
    let resumed = done;
    if !watch(done) {
        return Ok(None);
    }
    let mut size = FIRST_BLOCK;
    for gap in gaps(&blocks, rows) {
        let mut start = gap.start;
        while start < gap.end {
            let end = (start + size).min(gap.end);
            let began = Instant::now();
            let block = Block::compute(spec, &templates, &responses, (start, end), |row| row);
            size = next_size(end - start, began.elapsed().as_secs_f64(), BLOCK_S);
            journal.append(&block)?;
            done += block.numbers.len();
            blocks.push(block);
            if !watch(done) && done < rows {
                return Ok(None);
            }
            start = end;
        }
    }
    blocks.sort_by_key(|block| block.start);
    Ok(Some(Done {
        blocks,
        resumed,
        journal,
    }))
}

/// Some rows of a sweep: `count` of them from `start` on, every `step`-th.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rows {
    /// The first.
    pub start: usize,
    /// From one to the next.
    pub step: usize,
    /// How many.
    pub count: usize,
}

/// Time in s between two calls of the watch of [`compute_rows`], about.
const WATCH_S: f64 = 0.1;

/// Computes some rows without a journal: to the last bit what the whole sweep has there.
///
/// Rows of the block, and of its failures, count from the first that was asked for.
/// `watch` is told how many are done; where it says false, nothing is returned.
///
/// # Errors
/// [`SceneError`] of the sweep, and where it has no such rows.
pub fn compute_rows(
    spec: &Spec,
    rows: Rows,
    mut watch: impl FnMut(usize) -> bool,
) -> Result<Option<Block>, SceneError> {
    let Rows { start, step, count } = rows;
    let last = step.checked_mul(count.saturating_sub(1));
    let last = last.and_then(|way| way.checked_add(start));
    if count > 0 && last.is_none_or(|last| last >= spec.rows()) {
        return Err(SceneError::OutOfRange {
            key: "the last row".to_owned(),
            value: last.map_or(f64::INFINITY, |last| last as f64),
            range: "the rows of the sweep, which count from 0",
        });
    }
    let templates = Templates::new(spec)?;
    let responses = Tabulated::new(ratios(spec));
    let row_of = |index: usize| start + index * step;
    let (mut all, mut size) = (Block::default(), FIRST_BLOCK);
    while all.numbers.len() < count {
        let done = all.numbers.len();
        let end = (done + size).min(count);
        let began = Instant::now();
        let block = Block::compute(spec, &templates, &responses, (done, end), row_of);
        size = next_size(end - done, began.elapsed().as_secs_f64(), WATCH_S);
        all.append(block);
        if !watch(end) && end < count {
            return Ok(None);
        }
    }
    Ok(Some(all))
}

/// Whether the journal at `part` holds all rows of this sweep, so that a run may have begun to write its outputs.
#[must_use]
pub fn is_computed(spec: &Spec, part: &Path) -> bool {
    Journal::rows_in(part, &header(spec)).is_some_and(|rows| rows == spec.rows())
}

/// The rows that no block has, ascending; blocks ascend and do not overlap.
fn gaps(blocks: &[Block], rows: usize) -> Vec<std::ops::Range<usize>> {
    let mut found = Vec::new();
    let mut place = 0;
    for block in blocks {
        if place < block.start {
            found.push(place..block.start);
        }
        place = block.start + block.numbers.len();
    }
    if place < rows {
        found.push(place..rows);
    }
    found
}

/// Rows of the next block, after one of `count` that took this long: no more than eight times as many.
fn next_size(count: usize, took_s: f64, wanted_s: f64) -> usize {
    let factor = (wanted_s / took_s.max(1e-6)).min(8.0);
    ((count as f64 * factor) as usize).clamp(1, BLOCK)
}

/// What makes two sweeps the same: everything that is asked and was read, by the same program.
fn header(spec: &Spec) -> Header {
    let mut hash = Sha256::new();
    let parts = [
        env!("CARGO_PKG_VERSION"),
        schema::FORMAT_VERSION,
        &spec.resolved,
    ];
    let texts = spec.files.texts.iter().map(String::as_str);
    for part in parts.into_iter().chain(texts) {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    Header {
        fingerprint: hash.finalize().into(),
        rows: spec.rows(),
    }
}

fn ratios(spec: &Spec) -> Ratios {
    let many = spec.axes.iter().any(|axis| {
        axis.len > FEW
            && axis.columns.iter().any(|column| {
                column.section == "target"
                    && (column.key == "poisson_ratio" || column.key.ends_with("_speed_m_s"))
            })
    });
    if many { Ratios::Many } else { Ratios::Few }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_last_as_long_as_they_should() {
        // a row of 1 ms, after a first block of 64 of them
        let (mut size, mut longest) = (FIRST_BLOCK, 0.0_f64);
        for _ in 0..10 {
            let took_s = size as f64 * 1e-3;
            longest = longest.max(took_s);
            size = next_size(size, took_s, BLOCK_S);
        }
        assert_eq!((size, longest <= BLOCK_S), (2000, true));
        assert_eq!(next_size(64, 640.0, BLOCK_S), 1);
        assert_eq!(next_size(BLOCK, 1e-3, BLOCK_S), BLOCK);
    }

    #[test]
    fn gaps_lie_between_blocks() {
        let block = |start: usize, count: usize| Block {
            start,
            numbers: vec![[0.0; crate::quantities::QUANTITIES.len()]; count],
            ..Block::default()
        };
        assert_eq!(gaps(&[block(2, 3), block(5, 1)], 9), [0..2, 6..9]);
        assert_eq!(gaps(&[block(0, 1)], 3).first(), Some(&(1..3)));
        assert!(gaps(&[block(0, 3)], 3).is_empty());
    }
}
