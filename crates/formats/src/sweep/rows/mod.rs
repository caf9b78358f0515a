//! Files with the rows of a sweep, in the format of the file extension.
//!
//! `block` is a run of rows in memory, `held` has all rows by result, and `columns` describes the columns of a file.
//! `csv`, [`hdf5`] and `parquet` write files a few blocks at a time, and `footer` describes a Parquet file.

mod block;
mod columns;
mod csv;
mod footer;
mod hdf5;
mod held;
#[cfg(feature = "parquet")]
mod parquet;

pub use self::hdf5::row_bytes;
pub(crate) use self::hdf5::stage_hdf5;
#[cfg(feature = "parquet")]
use self::parquet::stage_parquet;
pub(crate) use block::NOT_HELD;
pub use block::{Block, Blocks, NO_MODEL};
pub(crate) use columns::{Cells, What, columns};
pub use columns::{column_names, described_keys, key_unit};
pub use csv::{print_csv, stage_csv};
pub use footer::FORMAT_VERSION as PARQUET_VERSION;
pub(crate) use footer::{Footer, MAGIC};
pub use held::Held;

use super::spec::Spec;
use output::{Output, OutputError, PARQUET, ROWS, Staged};
use std::path::Path;

/// Checks the name of a file of rows: HDF5, or Parquet if the program was built with it.
///
/// # Errors
/// [`OutputError::Refused`], [`OutputError::Unbuilt`].
pub fn check_rows(path: &Path) -> Result<(), OutputError> {
    ROWS.check(path)?;
    if PARQUET.is_of(path) && !cfg!(feature = "parquet") {
        return Err(OutputError::Unbuilt(path.to_owned(), PARQUET.0));
    }
    Ok(())
}

/// Writes all rows of a sweep, or its selected rows as a part, into an output that was claimed before the work.
///
/// Only a few blocks are in memory, and the bytes do not depend on the division into blocks.
///
/// # Errors
/// [`OutputError`].
pub fn stage_rows<'a>(
    output: &'a Output,
    spec: &Spec,
    blocks: &(impl Blocks + ?Sized),
) -> Result<Staged<'a>, OutputError> {
    check_rows(&output.path)?;
    #[cfg(feature = "parquet")]
    if PARQUET.is_of(&output.path) {
        return stage_parquet(output, spec, blocks);
    }
    stage_hdf5(output, spec, None, blocks)
}
