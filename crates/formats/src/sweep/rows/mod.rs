//! Rows of a sweep and their files, in the format that a name ends with.
//!
//! `block` is a run of rows in memory, `held` is all rows a result at a time, and `columns` is what a file has of each; `csv`, [`hdf5`] and `parquet` write
//! them, a few blocks at a time, and `footer` is what a Parquet file says of itself.

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

/// Checks that a file of rows can have a name: HDF5 or, where it is built in, Parquet.
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

/// Writes all rows of a sweep, or those that it selects as a part, into an output that was claimed before the work.
///
/// No more than a few blocks are in memory, and the bytes do not depend on how rows are divided into blocks.
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
