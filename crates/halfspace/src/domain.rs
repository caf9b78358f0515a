//! Ranges of the arguments, and the error of this crate: an argument outside its range.

use crate::profile::Profile;
use fault::{Class, Culprit, Fault};
use thiserror::Error;

/// Largest length and time; their powers do not overflow.
pub(crate) const FARTHEST: f64 = 1e20;

/// Smallest distance from a point force, time after the load and width of a cell; their inverse powers do not overflow.
pub(crate) const NEAREST: f64 = 1e-20;

/// Checks a condition; the error contains the argument, its value and the range.
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

/// Checks that r and z are in [0, 1e20].
pub(crate) fn check_place(r: f64, z: f64) -> Result<(), DomainError> {
    check((0.0..=FARTHEST).contains(&r), "r", r, "[0, 1e20]")?;
    check((0.0..=FARTHEST).contains(&z), "z", z, "[0, 1e20]")
}

/// Checks that a place is in range, and that the fields of the profile are finite there.
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

/// Checks that t is in [0, 1e20].
pub(crate) fn check_time(t: f64) -> Result<(), DomainError> {
    check((0.0..=FARTHEST).contains(&t), "t", t, "[0, 1e20]")
}

/// Checks that the profile is the Hertz profile, for a function that is not defined for the others.
pub(crate) fn check_hertz(profile: Profile, function: &'static str) -> Result<(), DomainError> {
    match profile {
        Profile::Hertz => Ok(()),
        Profile::Punch | Profile::Point => Err(DomainError::HertzOnly { function, profile }),
    }
}

/// An argument outside the domain of the kernels.
///
/// The message contains the argument or function, the value, and the allowed range.
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
    /// A function that is defined for the Hertz profile only; for the others it is infinite at the fronts.
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
