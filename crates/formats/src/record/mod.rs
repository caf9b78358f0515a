//! Force records: text with the columns `time_s,force_n`, or HDF5 with `/time` and `/force`, which a results file has.

mod csv;
mod hdf;
mod size;

use crate::error::SceneError;
use crate::text::{MOST_OF_RECORD, read_text_up_to};
use csv::from_csv;
use hdf::{from_hdf5, is_hdf5};
use impact::ForceRecord;
use std::path::Path;

/// Reads a record; the ending of its name says which of both it is.
///
/// # Errors
/// [`SceneError::ForceFile`] with the line at fault, [`SceneError::Unreadable`].
pub fn read_record(path: &Path) -> Result<ForceRecord, SceneError> {
    let mut record = if is_hdf5(path) {
        from_hdf5(path)?
    } else {
        from_csv(&read_text_up_to(path, MOST_OF_RECORD)?, path)?
    };
    record.file = Some(path.to_owned());
    Ok(record)
}
