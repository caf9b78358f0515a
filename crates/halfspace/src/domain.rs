//! Ranges of the arguments.

use crate::error::DomainError;
use crate::profile::Profile;

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
