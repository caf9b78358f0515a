//! The one error of this crate: an argument outside the domain of the physics.

use thiserror::Error;

/// An argument lies outside the domain on which the kernels are defined.
///
/// The message names the argument, the value received and the allowed range.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{argument} = {value} is outside {range}")]
pub struct DomainError {
    /// Name of the argument, with its unit where it has one.
    pub argument: &'static str,
    /// The value received.
    pub value: f64,
    /// The allowed range in interval notation.
    pub range: &'static str,
}

impl DomainError {
    /// Passes `value` on if `allowed`, else reports it against `range`.
    pub(crate) fn unless(
        allowed: bool,
        argument: &'static str,
        value: f64,
        range: &'static str,
    ) -> Result<f64, Self> {
        if allowed {
            Ok(value)
        } else {
            Err(Self {
                argument,
                value,
                range,
            })
        }
    }
}
