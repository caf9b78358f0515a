//! A force record from an HDF5 file, such as the results of another impact.

use crate::error::SceneError;
use impact::{ForceRecord, RecordError};
use std::path::Path;

/// Endings of names that are read as HDF5.
const ENDINGS: [&str; 4] = ["h5", "hdf5", "hdf", "vtkhdf"];

/// Whether a file's name says that it is HDF5.
pub(super) fn is_hdf5(path: &Path) -> bool {
    path.extension()
        .and_then(|ending| ending.to_str())
        .is_some_and(|ending| ENDINGS.contains(&ending.to_lowercase().as_str()))
}

/// Reads the datasets `/time` (s) and `/force` (N).
pub(super) fn from_hdf5(path: &Path) -> Result<ForceRecord, SceneError> {
    let fault = |reason: String| SceneError::Unreadable {
        path: path.to_owned(),
        reason,
    };
    if !path.is_file() {
        return Err(fault("there is no such file".to_owned()));
    }
    let read = |file: &hdf5::File, name: &str| -> Result<Vec<f64>, SceneError> {
        file.dataset(name)
            .and_then(|dataset| dataset.read_raw::<f64>())
            .map_err(|_| fault(format!("it has no dataset /{name} of numbers")))
    };
    let file = hdf5::File::open(path).map_err(|_| fault("it is not an HDF5 file".to_owned()))?;
    let (time_s, force_n) = (read(&file, "time")?, read(&file, "force")?);
    ForceRecord::new(time_s, force_n).map_err(|error| {
        fault(match error {
            RecordError::Count { times, forces } => format!(
                "/time has {times} samples and /force {forces}; at least 2 and as many of each are needed"
            ),
            RecordError::Negative { time_s } => {
                format!("/time begins at {time_s}, outside [0, inf)")
            }
            RecordError::NotAscending {
                time_s, before_s, ..
            } => format!("/time = {time_s} does not follow {before_s}; times must ascend"),
            RecordError::NotFinite { .. } => error.to_string(),
        })
    })
}
