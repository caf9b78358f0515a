//! What a file of the program is, and why one cannot be read back.

use crate::{results, sweep};
use std::fmt;
use std::path::PathBuf;
use thiserror::Error;

/// A file that cannot be read back, told in one sentence.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ReadError {
    /// The file is not there, or is no regular file, or may not be read.
    #[error("cannot read {}: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        reason: String,
    },
    /// It is no HDF5 file.
    #[error("{} is {found}, not a file of results in HDF5", path.display())]
    NotHdf5 {
        /// The file.
        path: PathBuf,
        /// What it seems to be.
        found: &'static str,
    },
    /// Another program's file.
    #[error("{} is an HDF5 file, but none of hertzlamb's", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
    },
    /// Another program's file.
    #[error("{} is a Parquet file, but none of hertzlamb's", path.display())]
    ForeignParquet {
        /// The file.
        path: PathBuf,
    },
    /// A file of another kind.
    #[error("{} is {found}, not {wanted}", path.display())]
    Kind {
        /// The file.
        path: PathBuf,
        /// What it is.
        found: FileKind,
        /// What was wanted.
        wanted: FileKind,
    },
    /// A sweep whose results lie elsewhere.
    #[error("{} has the places of its parts, not their results: read the parts, or a copy of them in one file", path.display())]
    Virtual {
        /// The file.
        path: PathBuf,
    },
    /// A version that is not known.
    #[error("{} has the format version {found}; versions {major}.x can be read", path.display())]
    Version {
        /// The file.
        path: PathBuf,
        /// Its version.
        found: String,
        /// The major version that can be read.
        major: &'static str,
    },
    /// Something that every such file has is missing or wrong.
    #[error("{}: {what}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is missing or wrong.
        what: String,
    },
}

/// What a file of the program is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// Results of a scene.
    Impact,
    /// Results of a sweep.
    Sweep,
    /// Some rows of a sweep.
    SweepPart,
    /// A kernel table.
    Table,
    /// A chart.
    Chart,
}

impl FileKind {
    /// All of them.
    pub(super) const ALL: [Self; 5] = [
        Self::Impact,
        Self::Sweep,
        Self::SweepPart,
        Self::Table,
        Self::Chart,
    ];

    /// Minor version of the format from which on its files have a seal.
    pub(super) fn sealed_from(self) -> u32 {
        match self {
            Self::Impact => 8,
            Self::Sweep => 6,
            Self::SweepPart => 2,
            Self::Table => lookup::schema::SEALED_FROM,
            Self::Chart => u32::MAX,
        }
    }

    /// Value of the attribute `file_type`.
    #[must_use]
    pub fn file_type(self) -> &'static str {
        match self {
            Self::Impact => results::schema::FILE_TYPE,
            Self::Sweep => sweep::schema::FILE_TYPE,
            Self::SweepPart => sweep::schema::part::FILE_TYPE,
            Self::Table => lookup::schema::FILE_TYPE_VALUE,
            Self::Chart => "hertzlamb chart",
        }
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Impact => "the results of an impact",
            Self::Sweep => "a sweep",
            Self::SweepPart => "a part of a sweep",
            Self::Table => "a kernel table",
            Self::Chart => "a chart",
        })
    }
}
