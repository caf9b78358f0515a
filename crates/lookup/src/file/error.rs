//! What can be wrong with the file of a table.

use crate::schema::{FILE_TYPE_VALUE, MAJOR_READ};
use fault::{Class, Culprit, Fault};
use std::fmt;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// The file of a kernel table could not be read, accepted or written.
#[derive(Debug)]
pub struct TableError {
    /// File asked for.
    pub path: PathBuf,
    /// What is wrong with it.
    pub what: BadTable,
}

/// What is wrong with the file of a table.
#[derive(Debug, Error)]
pub enum BadTable {
    /// The file is not there or may not be read.
    #[error("{0}")]
    Unreadable(std::io::Error),
    /// The file is not HDF5, or is cut short: what is missing, or the first line of what the HDF5 library said.
    #[error("is not a complete HDF5 file: {0}")]
    NotHdf5(String),
    /// Bytes of the file are not those that were written.
    #[error("is damaged: {0}")]
    Damaged(String),
    /// An HDF5 file of another kind: its `file_type`, empty when there is none.
    #[error("is not a kernel table: file_type = {0:?}, needed \"{FILE_TYPE_VALUE}\"")]
    Foreign(String),
    /// A format that this program does not know.
    #[error("has kernel-table format version {0:?}; this program reads version {MAJOR_READ}.x")]
    Version(String),
    /// A dataset or an attribute is absent, unreadable or not as the format demands.
    #[error("cannot read {item}: {detail}")]
    Item {
        /// Path of the dataset or attribute inside the file.
        item: String,
        /// What is wrong, or the first line of what the HDF5 library said.
        detail: String,
    },
    /// The numbers are no table: other dimensions than the axes demand, more than the size of the file explains, values that
    /// may not be there, or another checksum than the file states.
    #[error("{0}")]
    Wrong(String),
    /// The file could not be written: what the system or the HDF5 library said.
    #[error("{0}")]
    Unwritable(String),
    /// Another table than when it was opened.
    #[error("is another table than when it was opened: open it again")]
    Changed,
}

impl BadTable {
    /// The error of a file.
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
