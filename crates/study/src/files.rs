//! The folder of a chart, and its files: all of them or none.

use crate::StudyError;
use output::{Existing, Fault, Output, OutputError, Staged};
use std::path::{Path, PathBuf};

/// A folder that one run at a time writes a chart into.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// The name that stands for the whole folder.
    _claim: Output,
}

impl Folder {
    /// Makes sure, before any work, that a chart can be written into a folder.
    ///
    /// # Errors
    /// [`StudyError::Exists`] when the folder holds anything and that is to be kept, [`StudyError::Unwritable`]
    /// when it cannot be made, [`StudyError::Output`] when it cannot be written to or another run does.
    pub fn claim(path: &Path, existing: Existing) -> Result<Self, StudyError> {
        let unwritable = |reason: String| StudyError::Unwritable {
            path: path.to_owned(),
            reason,
        };
        if path.exists() && !path.is_dir() {
            return Err(unwritable("it is not a folder".to_owned()));
        }
        std::fs::create_dir_all(path).map_err(|error| unwritable(error.to_string()))?;
        // a folder that takes no files is found now, not after minutes
        let claim = Output::claim(&path.join("chart.lock"), Existing::Replace)?;
        let mut names: Vec<PathBuf> = std::fs::read_dir(path)
            .map_err(|error| unwritable(error.to_string()))?
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| !hidden(path))
            .collect();
        names.sort();
        match (existing, names.into_iter().next()) {
            (Existing::Keep | Existing::KeepUnlessSame, Some(path)) => {
                Err(StudyError::Exists { path })
            }
            (Existing::Keep | Existing::KeepUnlessSame, None) | (Existing::Replace, _) => {
                Ok(Self {
                    path: path.to_owned(),
                    _claim: claim,
                })
            }
        }
    }

    /// Writes files, each by its own closure: all of them, or none where one fails.
    pub(crate) fn write(&self, files: Vec<NewFile<'_>>) -> Result<(), StudyError> {
        let mut claimed = Vec::new();
        for file in files {
            let output = Output::claim(&self.path.join(file.name), Existing::Replace)?;
            claimed.push((output, file.fill));
        }
        let mut staged: Vec<Staged<'_>> = Vec::new();
        for (output, fill) in &claimed {
            staged.push(output.stage(fill)?);
        }
        for file in staged {
            file.commit()?;
        }
        Ok(())
    }
}

/// Writes a file under the name given.
type Fill<'a> = Box<dyn Fn(&Path) -> Result<(), Fault> + 'a>;

/// A file of a chart to be written.
pub(crate) struct NewFile<'a> {
    /// Its name in the folder.
    pub(crate) name: String,
    pub(crate) fill: Fill<'a>,
}

impl<'a> NewFile<'a> {
    pub(crate) fn new<E: Into<Fault>>(
        name: impl Into<String>,
        fill: impl Fn(&Path) -> Result<(), E> + 'a,
    ) -> Self {
        Self {
            name: name.into(),
            fill: Box::new(move |part| fill(part).map_err(Into::into)),
        }
    }
}

/// What a killed run has left is hidden, and nothing that somebody would miss.
fn hidden(path: &Path) -> bool {
    path.file_name()
        .is_some_and(|name| name.as_encoded_bytes().starts_with(b"."))
}

impl From<OutputError> for StudyError {
    fn from(error: OutputError) -> Self {
        match error {
            OutputError::Exists { path } => Self::Exists { path },
            other => Self::Output(other),
        }
    }
}
