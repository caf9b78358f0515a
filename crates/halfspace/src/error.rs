//! The one error of this crate: a question outside the domain of the physics.

use crate::profile::Profile;
use fault::{Class, Culprit, Fault};
use thiserror::Error;

/// An argument lies outside the domain on which the kernels are defined.
///
/// The message names the argument or the function, the value received and what is allowed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DomainError {
    /// A number outside its range; NaN is outside every range.
    #[error("{argument} = {} is outside {range}", fault::number(*value))]
    Range {
        /// Name of the argument.
        argument: &'static str,
        /// The value received.
        value: f64,
        /// The allowed range in interval notation.
        range: &'static str,
    },
    /// A function that exists for the Hertz profile only: under the others it is infinite at the fronts.
    #[error("{function} is defined for the Hertz profile only, not for {profile:?}")]
    HertzOnly {
        /// The function called.
        function: &'static str,
        /// The profile of the kernel.
        profile: Profile,
    },
}

impl Fault for DomainError {
    fn culprit(&self) -> Culprit<'_> {
        let culprit = Culprit::of(Class::Domain);
        match self {
            Self::Range {
                argument,
                value,
                range,
            } => culprit.key(argument).number(*value).range(range),
            Self::HertzOnly { function, .. } => culprit.key(function),
        }
    }
}
