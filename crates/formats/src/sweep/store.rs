//! Rows into a file, in the format that its name ends with.

use super::blocks::Blocks;
use super::file::stage_sweep;
use super::part::stage_part;
use super::shard::Selection;
use super::spec::Spec;
use output::{Output, OutputError, PARQUET, ROWS, Staged};
use std::path::Path;

/// Checks that a file of rows can have a name: HDF5 or, where it is built in, Parquet.
///
/// # Errors
/// [`OutputError::Ending`], [`OutputError::Unbuilt`].
pub fn check_rows(path: &Path) -> Result<(), OutputError> {
    ROWS.check(path)?;
    if PARQUET.is_of(path) && !cfg!(feature = "parquet") {
        return Err(OutputError::Unbuilt {
            path: path.to_owned(),
            format: PARQUET.format,
        });
    }
    Ok(())
}

/// Writes all rows of a sweep, or some of them as a part, into an output that was claimed before the work.
///
/// No more than a few blocks are in memory, and the bytes do not depend on how rows are divided into blocks.
///
/// # Errors
/// [`OutputError`].
pub fn stage_rows<'a>(
    output: &'a Output,
    spec: &Spec,
    selection: Option<&Selection>,
    blocks: &(impl Blocks + ?Sized),
) -> Result<Staged<'a>, OutputError> {
    check_rows(output.path())?;
    #[cfg(feature = "parquet")]
    if PARQUET.is_of(output.path()) {
        return super::parquet::stage_parquet(output, spec, selection, blocks);
    }
    match selection {
        Some(selection) => stage_part(output, spec, selection, blocks),
        None => stage_sweep(output, spec, blocks),
    }
}
