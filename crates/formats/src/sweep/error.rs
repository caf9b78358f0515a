//! What can be wrong with a sweep, or with its parts; scenes that fail are rows, not errors.

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
    /// The sweep or its base scene is wrong, or a part, or a folder of them, cannot be read or is not what is needed.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The table of its fields cannot be used.
    #[error(transparent)]
    Table(#[from] TableError),
    /// It or its journal cannot be written or read back.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Rows that no part has, the first of them, and how many ranges beside these.
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
        1 => ", and those of another range".to_owned(),
        more => format!(", and those of {more} other ranges"),
    }
}
