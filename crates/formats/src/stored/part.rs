//! What a file of some rows of a sweep says of itself.

use crate::sweep::{Fields, Selection};
use std::path::PathBuf;

/// What a part says of itself.
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
}
