//! What the end of a name says about the format.

use crate::error::OutputError;
use std::path::Path;

/// A format in words, such as "an HDF5 file", and how the names of its files end: without the dot, the usual one first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ending(pub &'static str, pub &'static [&'static str]);

/// HDF5; sections open in ParaView under the last of its endings.
pub const HDF5: Ending = Ending("an HDF5 file", &["h5", "hdf5", "hdf", "vtkhdf"]);

/// A kernel table.
pub const TABLE: Ending = Ending("a kernel table (HDF5)", &["h5", "hdf5", "hdf"]);

/// A part of a kernel table.
pub const SHARD: Ending = Ending("a shard", &["shard", "part", "blocks"]);

/// Rows in columns that are compressed.
pub const PARQUET: Ending = Ending("a Parquet file", &["parquet"]);

/// Rows: HDF5, or Parquet.
pub const ROWS: Ending = Ending(
    "an HDF5 or a Parquet file",
    &["h5", "hdf5", "hdf", "vtkhdf", "parquet"],
);

/// Text in columns.
pub const CSV: Ending = Ending("text in columns", &["csv", "txt"]);

impl Ending {
    /// Whether a name ends so.
    #[must_use]
    pub fn is_of(self, path: &Path) -> bool {
        path.extension().is_some() && self.check(path).is_ok()
    }

    /// Refuses a name with the ending of another format; a name without one is accepted.
    ///
    /// # Errors
    /// [`OutputError::Ending`].
    pub fn check(self, path: &Path) -> Result<(), OutputError> {
        let Some(found) = path.extension() else {
            return Ok(());
        };
        let found = found.to_string_lossy();
        let is = |ending: &&str| found.eq_ignore_ascii_case(ending);
        if self.1.iter().any(is) {
            return Ok(());
        }
        Err(OutputError::Ending {
            path: path.to_owned(),
            format: self.0,
            allowed: self.1,
            found: found.into_owned(),
        })
    }
}
