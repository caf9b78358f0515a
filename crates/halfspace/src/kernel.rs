//! The step response of the half-space: static part, remainder, impulse response and time integrals at a point.
//!
//! ```text
//! H(r,z,t) = static(r,z) + R(r,z,t)
//! ```
//!
//! The static part has a closed form; the remainder R is one integral over slowness, see [`integral`](crate::integral).
//!
//! Theory: `docs/theory.md` (T9, T10, T16, T21).

use crate::domain::{DomainError, check, check_hertz, check_place_under, check_time};
use crate::field::{Estimate, Point, Six};
use crate::integral::setting::Setting;
use crate::medium::Medium;
use crate::potentials::{IMPULSE, STEP, STEP_INTEGRAL};
use crate::profile::Profile;

/// The exact kernels of one half-space under one load profile.
///
/// Reduced units: length r0, time r0/c1, displacement P/(mu r0), stress P/r0^2; z points into the half-space, and
/// tension is positive. r, z and t are in [0, 1e20]; times between 0 and 1e-20 are replaced by 1e-20.
///
/// # Accuracy
///
/// For nu in [-0.5, 0.4999], r and z to 20, t to 200 and the Hertz profile at tolerance 1e-10, the error is at most
/// 1e-10 of the peak over time of the same field's step response at the same point. This was tested against values of
/// 20 digits on the axis, on the surface, at the edge of the disc, from 1e-9 below the surface, and at arrivals to the
/// last bit. Exceptions:
///
/// - For 0 < z < 1e-4 sigma_zz and sigma_rz are integrated as differences from the surface, where they vanish: the accuracy
///   holds for their peaks, which are of order sqrt(z). Time integrals and cell averages keep an absolute 1e-15 P/r0^2.
/// - There the Rayleigh wave passes in a time of order z, so at its arrival half a unit in the last place of t changes
///   a value by epsilon t/z of the peak. The value returned is that of exactly the t given.
/// - For 1e-4 < z < 1e-2 near the edge of the disc the errors of sigma_zz and sigma_rz are up to 1.3e-9 of their peaks.
/// - For r < 0.002 the error of sigma_rz, itself of order r, is larger: 5e-8 of its peak at r = 1e-3, z = 1e-9.
/// - Farther out, to r = z = 1e4, responses to pulses hold the tolerance, see [`Trace`](crate::Trace) and `tests/pulse.rs`.
/// - At tolerances of 1e-4, 1e-6 and 1e-8 the 99th percentile of the errors at random points is below the tolerance,
///   and typically a hundred times below it.
/// - Punch: displacements as above; stresses are infinite at fronts, and their accuracy decreases toward the fronts.
/// - Point: displacements 1e-12 of the static field in the median, 1e-6 at the 99th percentile; stresses 1e-11 in the
///   median, 1e-6 at the 90th percentile. For 0 < z < r/100, where fronts of both senses of travel nearly coincide,
///   1e-9 in the median, and no correct digit at the 90th percentile.
/// - [`Estimate::error`] includes these exceptions: less than one error in a thousand exceeds it, at tolerances from 1e-4 to
///   1e-10, also near the edge, the axis, the surface and arrivals; the median is 70 to 110 times the error for Hertz
///   (`tests/estimate_by_region.rs`) and thousands of times for Punch and Point (`tests/estimate.rs`). The exceptions,
///   up to 50 times the estimate, are far fronts of head waves at Poisson's ratios near 0, where one error in 200
///   exceeds it.
///
/// # Singular places
///
/// - The edge of the disc on the surface, r = 1, z = 0: the static normal stresses of the Hertz load have a square root
///   there and are continuous; sigma_zz is the load, 0. A punch has an infinite pressure there: an error.
/// - The plane P front under the disc, t = z, r < 1: stress jumps to sigma_zz = -Z(r). The value at t = z is the one
///   before the front, zero; one unit in the last place later it is the whole jump.
/// - Displacements are continuous everywhere for the Hertz and punch profiles.
///
/// # Sources
///
/// (22) to (29) of the paper, integrated over wave number in closed form; the coefficient of (24) is 4.
#[derive(Debug, Clone)]
pub struct Kernel {
    setting: Setting,
}

impl Kernel {
    /// Kernels of `medium` under `profile`, to about `tolerance` in [1e-14, 0.1] of each field's peak over time.
    ///
    /// Below 1e-12 rounding limits the accuracy. The preparation takes some microseconds.
    ///
    /// # Errors
    /// [`DomainError`] if the tolerance is outside its range.
    pub fn new(medium: &Medium, profile: Profile, tolerance: f64) -> Result<Self, DomainError> {
        check(
            (1e-14..=0.1).contains(&tolerance),
            "tolerance",
            tolerance,
            "[1e-14, 0.1]",
        )?;
        Ok(Self {
            setting: Setting::new(medium, profile, tolerance),
        })
    }

    /// The half-space.
    pub fn medium(&self) -> &Medium {
        &self.setting.medium
    }

    /// The load profile.
    pub fn profile(&self) -> Profile {
        self.setting.profile
    }

    /// Requested accuracy, as a fraction of each field's peak over time.
    pub fn tolerance(&self) -> f64 {
        self.setting.tolerance
    }

    /// The static fields under a unit force, in the order of [`FIELDS`](crate::FIELDS), in closed form.
    ///
    /// ```text
    /// w = (1 - nu) A3 + z A2/2         u = [-(1 - 2 nu) B3 + z B2]/2      szz = -(A2 + z A1)     srz = -z B1
    /// srr = -A2 + z A1 - 2 u/r         stt = -2 nu A2 + 2 u/r             potentials at xi = z
    /// ```
    ///
    /// For the Hertz profile this is Huber's solution (1904): w = 3 (1 - nu)/8 at the origin. On the surface szz is
    /// exactly minus the pressure and srz zero.
    ///
    /// Accuracy under the Hertz profile: 2e-15 of the largest field of the same unit, to r = z = 1e4. To r = z = 6
    /// under a punch 1e-12 at depths from 0.3, under a point force 1e-13 at depths from 0.01.
    ///
    /// # Errors
    /// [`DomainError`] for r or z outside [0, 1e20], at a point force itself and at the edge of a punch.
    pub fn static_field(&self, r: f64, z: f64) -> Result<Six, DomainError> {
        self.medium().static_field(self.profile(), r, z)
    }

    /// R(r,z,t): the step response minus the static field.
    ///
    /// Until the first arrival it is exactly minus the static field (on the surface, szz and srz are 0). After the last
    /// Rayleigh wave w on the surface is 0 up to rounding, szz and srz decay as t^-4, and all other fields as t^-2.
    /// [`Estimate::error`] estimates the errors of quadrature and rounding. Accuracy: see [`Kernel`].
    ///
    /// # Errors
    /// [`DomainError`] for r, z or t outside [0, 1e20], at a point force itself and at the edge of a punch.
    pub fn remainder(&self, r: f64, z: f64, t: f64) -> Result<Estimate, DomainError> {
        check_place_under(self.profile(), r, z)?;
        check_time(t)?;
        if t <= self.first_arrival(r, z) {
            let rest = self.static_field(r, z)?;
            return Ok(Estimate {
                value: rest.map(|s| -s),
                error: rest.map(|s| f64::EPSILON * s.abs()),
            });
        }
        Ok(self.setting.evaluate::<STEP>(Point { r, z, t }))
    }

    /// The impulse response dH/dt, the fields after a unit impulse, of the Hertz profile.
    ///
    /// Units: c1/(mu r0^2) for displacement, c1/r0^3 for stress.
    /// Between fronts it is a smooth function. At the fronts stresses have inverse square-root singularities, and the
    /// plane front under the disc, (33) of the paper, is a delta function, which is not part of the values.
    ///
    /// # Errors
    /// [`DomainError`] for r, z or t outside [0, 1e20], and for a profile other than Hertz: the
    /// impulse stresses of the others are not functions.
    pub fn impulse(&self, r: f64, z: f64, t: f64) -> Result<Estimate, DomainError> {
        check_place_under(self.profile(), r, z)?;
        check_time(t)?;
        check_hertz(self.profile(), "the impulse response")?;
        if t <= self.first_arrival(r, z) {
            return Ok(Estimate::default());
        }
        Ok(self.setting.evaluate::<IMPULSE>(Point { r, z, t }))
    }

    /// The impulse response of u and w only, which are the velocities of a step response, for any profile.
    ///
    /// Units: c1/(mu r0^2). At fronts they are as singular as the stresses of the step response, with the same loss of
    /// accuracy.
    ///
    /// # Errors
    /// [`DomainError`] for r, z or t outside [0, 1e20], at a point force itself and at the edge of a punch.
    pub fn displacement_impulse(&self, r: f64, z: f64, t: f64) -> Result<[f64; 2], DomainError> {
        check_place_under(self.profile(), r, z)?;
        check_time(t)?;
        if t <= self.first_arrival(r, z) {
            return Ok([0.0; 2]);
        }
        let [u, w, ..] = self.setting.evaluate::<IMPULSE>(Point { r, z, t }).value;
        Ok([u, w])
    }

    /// int R dt up to t, with a constant of integration that is the same for all t at one (r, z); use differences.
    ///
    /// # Errors
    /// [`DomainError`] for r, z or t outside [0, 1e20].
    pub fn step_integral(&self, r: f64, z: f64, t: f64) -> Result<Estimate, DomainError> {
        check_place_under(self.profile(), r, z)?;
        check_time(t)?;
        let arrival = self.first_arrival(r, z);
        if t < arrival && self.profile() == Profile::Point {
            // at the arrival itself the integral of a stress jumps
            let rest = self.static_field(r, z)?;
            return Ok(Estimate {
                value: rest.map(|s| -s * t),
                error: rest.map(|s| f64::EPSILON * s.abs() * t),
            });
        }
        let late = t.max(arrival);
        let mut estimate = (self.setting).evaluate::<STEP_INTEGRAL>(Point { r, z, t: late });
        if t < arrival {
            let rest = self.static_field(r, z)?;
            for (value, s) in estimate.value.iter_mut().zip(rest) {
                *value += s * (arrival - t);
            }
        }
        Ok(estimate)
    }

    /// Time of the first arrival at (r, z): the distance to the nearest point of the disc.
    pub(crate) fn first_arrival(&self, r: f64, z: f64) -> f64 {
        (r - self.profile().radius()).max(0.0).hypot(z)
    }
}
