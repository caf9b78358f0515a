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
    /// The file is not what it should be: a sentence that its name begins.
    pub(super) fn is(path: &Path, what: impl fmt::Display) -> Self {
        Self {
            path: path.to_owned(),
            sentence: format!("{} {what}", path.display()),
        }
    }

    /// Something that every such file has is missing or wrong.
    pub(crate) fn damaged(path: &Path, what: impl fmt::Display) -> Self {
        Self {
            path: path.to_owned(),
            sentence: format!("{}: {what}", path.display()),
        }
    }

    /// The file is not there, or is no regular file, or may not be read.
    pub(super) fn unreadable(path: &Path, reason: impl fmt::Display) -> Self {
        Self {
            path: path.to_owned(),
            sentence: format!("cannot read {}: {reason}", path.display()),
        }
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
