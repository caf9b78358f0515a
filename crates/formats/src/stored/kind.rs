//! What a file of the program is.

use crate::{results, sweep};
use std::fmt;

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
