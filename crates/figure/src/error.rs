//! Errors of figures.

use thiserror::Error;

/// A figure that cannot be drawn; the message is one sentence, with panels counted from 0.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct FigureError(pub(crate) String);
