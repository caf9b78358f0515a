//! Some rows of a sweep.

use super::fields::WrittenResults;
use crate::quantities::QUANTITIES;
use ledger::Shard;
use std::ops::Range;
use std::path::PathBuf;

/// Largest block: no more rows of a sweep are in memory together.
pub const BLOCK: usize = 32_768;

/// Number of rows that a shard never splits; small with probes, where a row may take seconds.
pub fn grain(fields: &WrittenResults) -> usize {
    let has_probes = fields.width() > QUANTITIES.len();
    if has_probes { 1 } else { BLOCK }
}

/// Rows that are computed into one file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Selection {
    /// The rows.
    pub rows: Range<usize>,
    /// The shard, if the rows are a shard.
    pub shard: Option<Shard>,
}

/// Description of a file with some rows of a sweep.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// Path of the file.
    pub path: PathBuf,
    /// SHA-256 that identifies the sweep.
    pub sha256: String,
    /// Rows in the file.
    pub selection: Selection,
    /// Rows of the whole sweep.
    pub sweep_rows: usize,
    /// Failed rows.
    pub failed: usize,
    /// Results in the file.
    pub fields: WrittenResults,
    /// Whether damage is detected: files of older versions have no checksum trailer.
    pub sealed: bool,
}
