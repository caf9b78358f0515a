//! Some rows of a sweep.

use super::fields::WrittenResults;
use crate::quantities::QUANTITIES;
use ledger::Shard;
use std::ops::Range;
use std::path::PathBuf;

/// Rows of a block at most: no more of a sweep are in memory together.
pub const BLOCK: usize = 32_768;

/// Rows that shards do not divide: with probes one may take seconds.
pub fn grain(fields: &WrittenResults) -> usize {
    let has_probes = fields.width() > QUANTITIES.len();
    if has_probes { 1 } else { BLOCK }
}

/// Rows that are computed into one file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Selection {
    /// The rows.
    pub rows: Range<usize>,
    /// The shard that they are.
    pub shard: Option<Shard>,
}

/// What a file of some rows of a sweep says of itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// Where it lies.
    pub path: PathBuf,
    /// Which sweep it is of.
    pub sha256: String,
    /// Which rows it has.
    pub selection: Selection,
    /// Rows of the whole sweep.
    pub sweep_rows: usize,
    /// Failed rows.
    pub failed: usize,
    /// Which results it has.
    pub fields: WrittenResults,
    /// Whether damage to it is seen: those of older versions have no seal.
    pub sealed: bool,
}
