//! Why a contact could not be computed.

use crate::march::error::MarchError;
use halfspace::DomainError;
use thiserror::Error;

/// A contact that has no results.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ContactError {
    /// The march failed.
    #[error(transparent)]
    March(#[from] MarchError),
    /// A material is outside the physics.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// The radiated loss is not small.
    #[error(
        "model \"radiation\" is a first-order law: it gives a loss of {loss:.3} of the kinetic energy, outside [0, 0.5]; use model \"growing\" or \"wave\""
    )]
    LossTooLarge {
        /// The loss 1 - e^2 of the law.
        loss: f64,
    },
}
