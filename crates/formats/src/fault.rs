//! The face of errors that are made of others.

use crate::parts::PartsError;
use crate::sweep::{KernelsError, SweepError};
use ::fault::{Class, Culprit, Fault};

impl Fault for KernelsError {
    fn culprit(&self) -> Culprit<'_> {
        match self {
            Self::Scene(error) => error.culprit(),
            Self::Table(error) => Culprit::of(Class::Table).file(&error.path),
        }
    }
}

impl Fault for SweepError {
    fn culprit(&self) -> Culprit<'_> {
        match self {
            Self::Scene(error) => error.culprit(),
            Self::Journal(error) => error.culprit(),
            Self::Output(error) => error.culprit(),
        }
    }
}

impl Fault for PartsError {
    fn culprit(&self) -> Culprit<'_> {
        let parts = Culprit::of(Class::Scene);
        match self {
            Self::Scene(error) => error.culprit(),
            Self::Read(error) => error.culprit(),
            Self::Output(error) => error.culprit(),
            Self::Folder { path, .. } | Self::None { path } | Self::Unreferred { path, .. } => {
                parts.file(path)
            }
            Self::Foreign { foreign } => parts.file(&foreign.path),
            Self::Overlap { first, .. } | Self::Columns { first, .. } => parts.file(first),
            Self::Missing { .. } => parts,
        }
    }
}
