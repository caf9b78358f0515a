//! Errors of the file of a table.

use crate::schema::{FILE_TYPE_VALUE, MAJOR_READ};
use fault::{Class, Culprit, Fault};
use std::fmt;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Error of reading, validating or writing the file of a kernel table.
#[derive(Debug)]
pub struct TableError {
    /// Path of the file.
    pub path: PathBuf,
    /// Kind of error.
    pub what: BadTable,
}

/// Kind of error of the file of a table.
#[derive(Debug, Error)]
pub enum BadTable {
    /// The file does not exist, or may not be read.
    #[error("{0}")]
    Unreadable(std::io::Error),
    /// The file is not HDF5, or is truncated; with the reason.
    #[error("is not a complete HDF5 file: {0}")]
    NotHdf5(String),
    /// Bytes of the file differ from those that were written.
    #[error("is damaged: {0}")]
    Damaged(String),
    /// An HDF5 file of another kind; with its `file_type`, empty if it has none.
    #[error("is not a kernel table: file_type = {0:?}, needed \"{FILE_TYPE_VALUE}\"")]
    Foreign(String),
    /// A format version that this program does not read.
    #[error("has kernel-table format version {0:?}; this program reads version {MAJOR_READ}.x")]
    Version(String),
    /// A dataset or attribute that is missing, unreadable or does not conform to the format.
    #[error("cannot read {item}: {detail}")]
    Item {
        /// Path of the dataset or attribute inside the file.
        item: String,
        /// Reason.
        detail: String,
    },
    /// Numbers that are not a table: the dimensions do not fit the axes, there are more numbers than the size of the file
    /// allows, values are invalid, or the checksum differs from the stated one.
    #[error("{0}")]
    Wrong(String),
    /// The file could not be written; with the message of the system or of the HDF5 library.
    #[error("{0}")]
    Unwritable(String),
    /// The file was replaced by another table after it was opened.
    #[error("was replaced by another table after it was opened: open it again")]
    Changed,
}

impl BadTable {
    /// The error with the path of its file.
    pub fn of(self, path: &Path) -> TableError {
        TableError {
            path: path.to_owned(),
            what: self,
        }
    }
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use BadTable as B;
        let (path, what) = (self.path.display(), &self.what);
        match what {
            B::Unreadable(_) => write!(f, "cannot read the kernel table {path}: {what}"),
            B::Unwritable(_) => write!(f, "cannot write the kernel table {path}: {what}"),
            B::NotHdf5(_) | B::Foreign(_) | B::Version(_) | B::Changed => {
                write!(f, "{path} {what}")
            }
            B::Damaged(_) => write!(f, "kernel table {path} {what}"),
            B::Item { .. } | B::Wrong(_) => {
                write!(f, "kernel table {path}: {what}")
            }
        }
    }
}

impl std::error::Error for TableError {}

impl Fault for TableError {
    fn culprit(&self) -> Culprit<'_> {
        use BadTable as B;
        let culprit = Culprit::of(Class::Table).file(&self.path);
        match self.what {
            B::Unreadable(_) | B::NotHdf5(_) | B::Foreign(_) | B::Version(_) => culprit,
            _ => culprit.unmendable(),
        }
    }
}
