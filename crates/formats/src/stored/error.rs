//! What a file of the program is, and why one cannot be read back.

use crate::{results, sweep};
use ::fault::{Class, Culprit, Fault};
use std::fmt;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A file that cannot be read back, told in one sentence.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{sentence}")]
pub struct ReadError {
    path: PathBuf,
    sentence: String,
}

impl ReadError {
    /// A sentence that names the file.
    pub(crate) fn told(path: &Path, sentence: String) -> Self {
        let path = path.to_owned();
        Self { path, sentence }
    }

    /// The file is not what it should be: a sentence that its name begins.
    pub(crate) fn is(path: &Path, what: impl fmt::Display) -> Self {
        Self::told(path, format!("{} {what}", path.display()))
    }

    /// Something that every such file has is missing or wrong.
    pub(crate) fn damaged(path: &Path, what: impl fmt::Display) -> Self {
        Self::told(path, format!("{}: {what}", path.display()))
    }

    /// The file is not there, or is no regular file, or may not be read.
    pub(crate) fn unreadable(path: &Path, reason: impl fmt::Display) -> Self {
        Self::told(path, format!("cannot read {}: {reason}", path.display()))
    }
}

impl Fault for ReadError {
    fn culprit(&self) -> Culprit<'_> {
        Culprit::of(Class::Scene).file(&self.path)
    }
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

    /// Value of the attribute `file_type`.
    #[must_use]
    pub fn file_type(self) -> &'static str {
        self.row().0
    }

    /// The value of the attribute `file_type`, what the file is, and the minor version of the format from which on its files
    /// have a seal.
    pub(super) fn row(self) -> (&'static str, &'static str, u32) {
        match self {
            Self::Impact => (results::schema::FILE_TYPE, "the results of an impact", 8),
            Self::Sweep => (sweep::schema::FILE_TYPE, "a sweep", 6),
            Self::SweepPart => (sweep::schema::part::FILE_TYPE, "a part of a sweep", 2),
            Self::Table => {
                let sealed_from = lookup::schema::SEALED_FROM;
                (
                    lookup::schema::FILE_TYPE_VALUE,
                    "a kernel table",
                    sealed_from,
                )
            }
            Self::Chart => ("hertzlamb chart", "a chart", u32::MAX),
        }
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.row().1)
    }
}
