//! Why a figure cannot be drawn.

use thiserror::Error;

/// What a figure says that cannot be drawn, in a sentence; panels are counted from 0.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct FigureError(pub(crate) String);
