//! Runs a sweep block by block.

use super::block::Block;
use super::journal::{Journal, JournalError, fingerprint};
use super::schema;
use super::spec::Spec;
use super::template::Templates;
use crate::error::SceneError;
use contact::{Ratios, Tabulated};
use std::path::Path;
use thiserror::Error;

/// Rows of a block: the unit of progress and of resumption.
pub const BLOCK: usize = 32_768;

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
/// `watch` is told after each block how many rows are done; while it says true the sweep goes on,
/// otherwise nothing is returned and the journal keeps what is done.
///
/// # Errors
/// [`SweepError`].
pub fn run_sweep(
    spec: &Spec,
    part: &Path,
    mut watch: impl FnMut(usize) -> bool,
) -> Result<Option<Done>, SweepError> {
    let rows = spec.rows();
    let templates = Templates::new(spec)?;
    let responses = Tabulated::new(ratios(spec));
    let (mut journal, mut blocks) = Journal::open(part, identity(spec), rows)?;
    // a journal that was forged may hold others
    blocks.retain(|block| {
        let end = (block.start + BLOCK).min(rows);
        block.start % BLOCK == 0 && block.start + block.numbers.len() == end
    });
    blocks.sort_by_key(|block| block.start);
    blocks.dedup_by_key(|block| block.start);
    let mut done: usize = blocks.iter().map(|block| block.numbers.len()).sum();
    let resumed = done;
    if !watch(done) {
        return Ok(None);
    }
    for start in (0..rows).step_by(BLOCK) {
        if blocks.iter().any(|block| block.start == start) {
            continue;
        }
        let end = (start + BLOCK).min(rows);
        let block = Block::compute(spec, &templates, &responses, start, end);
        journal.append(&block)?;
        done += block.numbers.len();
        blocks.push(block);
        if !watch(done) && done < rows {
            return Ok(None);
        }
    }
    blocks.sort_by_key(|block| block.start);
    Ok(Some(Done {
        blocks,
        resumed,
        journal,
    }))
}

/// What makes two sweeps the same: everything that is asked, by the same program.
fn identity(spec: &Spec) -> u64 {
    let text = format!(
        "{}\n{}\n{}\n{}",
        env!("CARGO_PKG_VERSION"),
        schema::FORMAT_VERSION,
        spec.directory.display(),
        spec.resolved
    );
    fingerprint(text.as_bytes())
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
