//! Errors of a sweep and of its parts; a scene that fails is a row, not an error.

use crate::error::SceneError;
use fault::{Class, Culprit, Fault};
use lookup::TableError;
use output::OutputError;
use std::ops::Range;
use thiserror::Error;

/// A sweep that could not be run, or parts that cannot be joined.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The sweep or its base scene is invalid, or a part or a folder of parts cannot be read or has the wrong content.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The kernel table for its fields cannot be used.
    #[error(transparent)]
    Table(#[from] TableError),
    /// Its file or journal cannot be written or read back.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Missing rows: the first range, and the number of further ranges.
    #[error("rows {} to {} of the sweep are in no part{}", .0.start, .0.end - 1, others(*.1))]
    Missing(Range<usize>, usize),
}

impl Fault for SweepError {
    fn culprit(&self) -> Culprit<'_> {
        match self {
            Self::Scene(error) => error.culprit(),
            Self::Table(error) => Culprit::of(Class::Table).file(&error.path),
            Self::Output(error) => error.culprit(),
            Self::Missing(..) => Culprit::of(Class::Scene),
        }
    }
}

fn others(more: usize) -> String {
    match more {
        0 => String::new(),
        1 => ", and one more range is missing".to_owned(),
        more => format!(", and {more} more ranges are missing"),
    }
}
