//! A prescribed force history from an HDF5 file, such as the results of another impact.

use super::error::SceneError;
use super::force_file::PrescribedForce;
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
pub(super) fn from_hdf5(path: &Path) -> Result<PrescribedForce, SceneError> {
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
    if time_s.len() != force_n.len() || time_s.len() < 2 {
        return Err(fault(format!(
            "/time has {} samples and /force {}; at least 2 and as many of each are needed",
            time_s.len(),
            force_n.len()
        )));
    }
    if let Some(i) = (0..time_s.len()).find(|&i| !time_s[i].is_finite() || !force_n[i].is_finite())
    {
        return Err(fault(format!("sample {i} is not finite")));
    }
    if time_s[0] < 0.0 {
        return Err(fault(format!(
            "/time begins at {}, outside [0, inf)",
            time_s[0]
        )));
    }
    if let Some(pair) = time_s.windows(2).find(|pair| pair[1] <= pair[0]) {
        return Err(fault(format!(
            "/time = {} does not follow {}; times must ascend",
            pair[1], pair[0]
        )));
    }
    Ok(PrescribedForce {
        path: path.to_owned(),
        time_s,
        force_n,
    })
}
