//! Why fields could not be computed.

use crate::grid::TooManySamples;
use crate::kernels::place::FieldError;
use halfspace::DomainError;
use thiserror::Error;

/// Fields that could not be computed.
#[derive(Debug, Error)]
pub enum FieldsError {
    /// More samples than memory should hold.
    #[error(transparent)]
    TooManySamples(#[from] TooManySamples),
    /// A point without fields.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A number outside the physics.
    #[error(transparent)]
    Domain(#[from] DomainError),
}
