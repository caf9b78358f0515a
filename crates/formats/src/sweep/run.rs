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
            let block = Block::compute(spec, &templates, &responses, start, end);
            size = next_size(end - start, began.elapsed().as_secs_f64());
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
fn next_size(count: usize, took_s: f64) -> usize {
    let factor = (BLOCK_S / took_s.max(1e-6)).min(8.0);
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
            size = next_size(size, took_s);
        }
        assert_eq!((size, longest <= BLOCK_S), (2000, true));
        assert_eq!(next_size(64, 640.0), 1);
        assert_eq!(next_size(BLOCK, 1e-3), BLOCK);
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
