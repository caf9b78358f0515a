//! A force record from an HDF5 file, such as the results of another impact.

use super::size::MOST_SAMPLES;
use crate::error::SceneError;
use hdfread::{Group, HdfError};
use impact::{ForceRecord, RecordError};
use std::io::ErrorKind;
use std::path::Path;

/// Endings of names that are read as HDF5.
const ENDINGS: [&str; 4] = ["h5", "hdf5", "hdf", "vtkhdf"];

/// Whether a file's name says that it is HDF5.
pub(super) fn is_hdf5(path: &Path) -> bool {
    path.extension()
        .and_then(|ending| ending.to_str())
        .is_some_and(|ending| ENDINGS.contains(&ending.to_lowercase().as_str()))
}

/// Reads the datasets `/time` (s) and `/force` (N) without the HDF5 library, which trusts what it reads.
pub(super) fn from_hdf5(path: &Path) -> Result<ForceRecord, SceneError> {
    let fault = |reason: String| SceneError::Unreadable {
        path: path.to_owned(),
        reason,
    };
    let root = hdfread::File::open(path).and_then(|file| file.root());
    let root = root.map_err(|error| {
        fault(match &error {
            HdfError::Io(source) if source.kind() == ErrorKind::NotFound => {
                "there is no such file".to_owned()
            }
            other => other.to_string(),
        })
    })?;
    let time_s = samples(&root, "time").map_err(fault)?;
    let force_n = samples(&root, "force").map_err(fault)?;
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

/// The numbers of a dataset of one dimension.
fn samples(root: &Group, name: &str) -> Result<Vec<f64>, String> {
    let failed = |error: HdfError| match error {
        HdfError::Absent { .. } => format!("it has no dataset /{name} of numbers"),
        other => format!("/{name}: {other}"),
    };
    let data = root.dataset(name).map_err(failed)?;
    if !data.kind().is_number() {
        return Err(format!(
            "/{name} holds values of the type {}, no numbers",
            data.kind()
        ));
    }
    if data.shape().len() != 1 {
        return Err(format!(
            "/{name} has {} dimensions, needed 1",
            data.shape().len()
        ));
    }
    if data.count() > MOST_SAMPLES {
        return Err(format!(
            "/{name} has {} samples, more than {MOST_SAMPLES}: cut or thin the record",
            data.count()
        ));
    }
    data.as_f64(8 * MOST_SAMPLES as u64).map_err(failed)
}
