//! Files of a chart, each written as a whole or not at all.

use crate::StudyError;
use formats::{Existing, OutputError, check, write_whole};
use std::path::{Path, PathBuf};

/// Makes sure, before any work, that a chart can be written into a folder.
///
/// # Errors
/// [`StudyError::Exists`] when the folder holds anything and that is to be kept, [`StudyError::Unwritable`]
/// when it cannot be made.
pub fn prepare_folder(folder: &Path, existing: Existing) -> Result<(), StudyError> {
    let unwritable = |error: std::io::Error| StudyError::Unwritable {
        path: folder.to_owned(),
        reason: error.to_string(),
    };
    if folder.exists() && !folder.is_dir() {
        return Err(StudyError::Unwritable {
            path: folder.to_owned(),
            reason: "it is not a folder".to_owned(),
        });
    }
    std::fs::create_dir_all(folder).map_err(unwritable)?;
    let mut names: Vec<PathBuf> = std::fs::read_dir(folder)
        .map_err(unwritable)?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .collect();
    names.sort();
    match (existing, names.first()) {
        (Existing::Keep, Some(path)) => Err(StudyError::Exists { path: path.clone() }),
        (Existing::Keep, None) | (Existing::Replace, _) => {
            // a folder that takes no files is found now, not after minutes
            let probe = folder.join("chart.csv");
            check(&probe, Existing::Replace).map_err(|error| output(&probe, error))
        }
    }
}

/// Writes a file as a whole or not at all.
pub(crate) fn whole(
    path: &Path,
    write: impl FnOnce(&Path) -> Result<(), String>,
) -> Result<(), StudyError> {
    write_whole(path, Existing::Replace, write).map_err(|error| output(path, error))
}

fn output(path: &Path, error: OutputError) -> StudyError {
    match error {
        OutputError::Exists { path } => StudyError::Exists { path },
        OutputError::Unwritable { reason, .. } => StudyError::Unwritable {
            path: path.to_owned(),
            reason,
        },
    }
}
