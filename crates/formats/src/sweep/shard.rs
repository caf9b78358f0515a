//! Some rows of a sweep.

use super::fields::Fields;
use crate::error::SceneError;
use ledger::Shard;
use std::ops::Range;
use std::path::PathBuf;

/// Rows of a block at most: no more of a sweep are in memory together.
pub const BLOCK: usize = 32_768;

/// Rows that shards do not divide: with probes one may take seconds.
#[must_use]
pub fn grain(fields: &Fields) -> usize {
    if fields.has_probes() { 1 } else { BLOCK }
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
    pub fields: Fields,
    /// Whether damage to it is seen: those of older versions have no seal.
    pub sealed: bool,
}

impl Selection {
    /// The rows of a shard, of a sweep of `rows` with these results.
    #[must_use]
    pub fn of_shard(shard: Shard, rows: usize, fields: &Fields) -> Self {
        Self {
            rows: shard.range(rows, grain(fields)),
            shard: Some(shard),
        }
    }

    /// Rows from one on up to another, which is not among them, of a sweep of `rows`.
    ///
    /// # Errors
    /// [`SceneError`] beyond the end.
    pub fn of_rows(asked: Range<usize>, rows: usize) -> Result<Self, SceneError> {
        if asked.end > rows {
            return Err(SceneError::out_of_range(
                format!("the end of the rows, of a sweep of {rows},"),
                asked.end as f64,
                "the rows of the sweep, which count from 0",
            ));
        }
        let (rows, shard) = (asked, None);
        Ok(Self { rows, shard })
    }
}
