//! Ranges of the arguments, and the one error of this crate: a question outside the domain of the physics.

use crate::profile::Profile;
use fault::{Class, Culprit, Fault};
use thiserror::Error;

/// Lengths and times up to here: their powers stay in the range of a double.
pub(crate) const FARTHEST: f64 = 1e20;

/// Least distance from a point force, least time after the load and least width of a cell, for the same reason.
pub(crate) const NEAREST: f64 = 1e-20;

/// The error that names a value and its range, unless it is `allowed`.
///
/// # Errors
/// [`DomainError::Range`].
pub fn check(
    allowed: bool,
    argument: &'static str,
    value: f64,
    range: &'static str,
) -> Result<(), DomainError> {
    if allowed {
        return Ok(());
    }
    Err(DomainError::Range {
        argument,
        value,
        range,
    })
}

/// r and z in [0, 1e20].
pub(crate) fn check_place(r: f64, z: f64) -> Result<(), DomainError> {
    check((0.0..=FARTHEST).contains(&r), "r", r, "[0, 1e20]")?;
    check((0.0..=FARTHEST).contains(&z), "z", z, "[0, 1e20]")
}

/// A place in range at which the fields of a profile are finite.
pub(crate) fn check_place_under(profile: Profile, r: f64, z: f64) -> Result<(), DomainError> {
    check_place(r, z)?;
    let (is_regular, range) = match profile {
        Profile::Hertz => return Ok(()),
        Profile::Punch => (
            z >= NEAREST || r != 1.0,
            "[0, 1) or (1, 1e20] where z < 1e-20, for a punch",
        ),
        Profile::Point => (
            z >= NEAREST || r >= NEAREST,
            "[1e-20, 1e20] where z < 1e-20, for a point force",
        ),
    };
    check(is_regular, "r", r, range)
}

/// t in [0, 1e20].
pub(crate) fn check_time(t: f64) -> Result<(), DomainError> {
    check((0.0..=FARTHEST).contains(&t), "t", t, "[0, 1e20]")
}

/// A function that only the Hertz profile has.
pub(crate) fn check_hertz(profile: Profile, function: &'static str) -> Result<(), DomainError> {
    match profile {
        Profile::Hertz => Ok(()),
        Profile::Punch | Profile::Point => Err(DomainError::HertzOnly { function, profile }),
    }
}

/// An argument lies outside the domain on which the kernels are defined.
///
/// The message names the argument or the function, the value received and what is allowed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
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
