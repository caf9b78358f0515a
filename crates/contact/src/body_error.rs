//! What can be wrong with a body.

use thiserror::Error;

/// A body that cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum BodyError {
    /// A material without a density where waves or a mass need one.
    #[error("the material {material} has no density, which {purpose} needs")]
    NoDensity {
        /// Name of the material.
        material: String,
        /// What needs it.
        purpose: &'static str,
    },
    /// A number outside its range.
    #[error("{quantity} = {value} is outside {range}")]
    OutOfRange {
        /// The quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// The allowed range in interval notation.
        range: &'static str,
    },
}

/// A positive finite number, or the error that names it.
pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<f64, BodyError> {
    if value > 0.0 && value < f64::INFINITY {
        Ok(value)
    } else {
        Err(BodyError::OutOfRange {
            quantity,
            value,
            range: "(0, inf)",
        })
    }
}
