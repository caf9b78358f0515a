//! The step response of the half-space: static part and remainder, by one integral over slowness.
//!
//! ```text
//! H(r,z,t) = static(r,z) + R(r,z,t)
//! R = 2/(c D'(c)) Re sum_{P,S} N Psi(gamma z - i c t)
//!     + (1/pi) Re int_0^{1/kappa} dx sum_{P,S} amplitude(x) [ Psi(xi-) + Psi(xi+) ],   xi-+ = i (z gamma^ -+ t)/x
//! ```
//!
//! with gamma^ = sqrt(1 - x^2) for P and sqrt(1/kappa^2 - x^2) for S. Below x = 1 only the compact parts of
//! the potentials enter, so each wave and each direction of travel has an interval of its own; above it the
//! potentials are taken whole.

use crate::axis;
use crate::error::DomainError;
use crate::field::{Estimate, Field, Six};
use crate::fronts::{FixedSingularities, Point, Sense};
use crate::landscape::{Share, Strength};
use crate::medium::Medium;
use crate::panels::ROUNDING;
use crate::potential::{Potentials, potentials};
use crate::profile::Profile;
use crate::rayleigh_front::Front;
use crate::shallow::{self, Difference};
use crate::spectrum::{self, Amplitudes, Pole, Wave};
use crate::statics;
use num_complex::Complex64;
use std::f64::consts::PI;

/// The exact kernels of one half-space under one load profile.
///
/// Reduced units: length r0, time r0/c1, displacement P/(mu r0), stress P/r0^2; z into the half-space,
/// tension positive. r, z and t may be any numbers from 0 to 1e20.
///
/// # Accuracy
///
/// For nu in [-0.5, 0.4999], r and z to 20, t to 200 and the Hertz profile at tolerance 1e-10, against values of
/// 20 digits: 1e-10 of the peak over time of the same field's step response at the same point, on the axis, on the
/// surface, at the edge of the disc, 1e-9 and more below the surface and at arrivals to the last bit.
///
/// - For 0 < z < 1e-4 sigma_zz and sigma_rz are integrated as differences to the surface, where they vanish: their errors
///   are shares of peaks that are of order sqrt(z). Time integrals and cell averages keep an absolute 1e-15 P/r0^2.
/// - There the Rayleigh wave passes in a time of order z, so at its arrival half a unit in the last place of t counts
///   epsilon t/z of the peak: the value is that of the t given, but t is seldom known so well.
///   For r < 0.002 sigma_rz, which vanishes as r, does not follow it: 5e-8 of its peak at r = 1e-3, z = 1e-9.
/// - At tolerances of 1e-4, 1e-6 and 1e-8 the largest errors at random points are below the tolerance, the 99th
///   percentiles a hundred times below it.
/// - Punch: displacements as above; stresses are infinite at fronts and lose digits toward them.
/// - Point: displacements 1e-12 of the static field in the median, 1e-6 at the 99th percentile; stresses 1e-11 in the
///   median, 1e-6 at nine places of ten. For 0 < z < r/100, where fronts of both senses of travel all but coincide,
///   1e-9 in the median and nothing to be relied on at one place of ten.
/// - [`Estimate::error`] covers all this: for Punch and Point less than one error in a thousand exceeds it, near the
///   edge, the axis and the surface too; it is typically a thousand times the error there.
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
    medium: Medium,
    profile: Profile,
    tolerance: f64,
    /// 1/kappa^2.
    pub(crate) k: f64,
    poles: [Pole; 2],
    pub(crate) fixed: FixedSingularities,
    /// int of the amplitude of w over the fast interval, times x/2, for P and S: a wave that has passed.
    pub(crate) passed: [f64; 2],
}

/// Running sum of six fields and of their likely errors.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Sum {
    pub(crate) value: Six,
    pub(crate) error: Six,
}

impl Sum {
    /// Adds a term whose error is a share of its size.
    #[inline]
    pub(crate) fn add(&mut self, weight: f64, share: impl Into<Share>, term: Six) {
        let Share {
            displacement: d,
            stress: s,
        } = share.into();
        let shares = [d, d, s, s, s, s];
        for (f, share) in shares.into_iter().enumerate() {
            let x = weight * term[f];
            self.value[f] += x;
            self.error[f] += share * x.abs();
        }
    }
}

impl Kernel {
    /// Kernels of `medium` under `profile`, to about `tolerance` in [1e-14, 0.1] of each field's peak over time.
    ///
    /// From 1e-12 down rounding decides. Preparation takes some microseconds.
    ///
    /// # Errors
    /// [`DomainError`] when the tolerance is outside its range.
    pub fn new(medium: &Medium, profile: Profile, tolerance: f64) -> Result<Self, DomainError> {
        DomainError::unless(
            (1e-14..=0.1).contains(&tolerance),
            "tolerance",
            tolerance,
            "[1e-14, 0.1]",
        )?;
        let k = medium.shear_slowness_squared();
        let mut kernel = Self {
            medium: medium.clone(),
            profile,
            tolerance,
            k,
            poles: [
                spectrum::pole(Wave::P, medium),
                spectrum::pole(Wave::S, medium),
            ],
            fixed: FixedSingularities::new(medium),
            passed: [0.0; 2],
        };
        kernel.passed = [Wave::P, Wave::S].map(|wave| kernel.passed_whole(wave));
        Ok(kernel)
    }

    /// The half-space.
    #[must_use]
    pub fn medium(&self) -> &Medium {
        &self.medium
    }

    /// The load profile.
    #[must_use]
    pub fn profile(&self) -> Profile {
        self.profile
    }

    /// The static fields under a unit force, in the order of [`FIELDS`](crate::FIELDS), in closed form.
    ///
    /// ```text
    /// w = (1 - nu) A3 + z A2/2         u = [-(1 - 2 nu) B3 + z B2]/2      szz = -(A2 + z A1)     srz = -z B1
    /// srr = -A2 + z A1 - 2 u/r         stt = -2 nu A2 + 2 u/r             potentials at xi = z
    /// ```
    ///
    /// For the Hertz profile this is Huber's solution (1904): w = 3 (1 - nu)/8 at the origin. On the surface szz is
    /// exactly minus the pressure and srz zero. Accuracy 1e-14 of the largest field.
    ///
    /// # Errors
    /// [`DomainError`] for r or z outside [0, 1e20], at a point force itself and at the edge of a punch.
    pub fn static_field(&self, r: f64, z: f64) -> Result<Six, DomainError> {
        self.check_place(r, z)?;
        Ok(statics::static_field(&self.medium, self.profile, r, z))
    }

    /// R(r,z,t): the step response less the static field.
    ///
    /// Minus the static field exactly up to the first arrival (on the surface szz and srz: 0); on the surface
    /// w is 0 to rounding after the last Rayleigh wave, everything else dies as t^-2, szz and srz as t^-4.
    /// [`Estimate::error`] says what the quadrature and rounding may have left. Accuracy: see [`Kernel`].
    ///
    /// # Errors
    /// [`DomainError`] for r, z or t outside [0, 1e20], at a point force itself and at the edge of a punch.
    pub fn remainder(&self, r: f64, z: f64, t: f64) -> Result<Estimate, DomainError> {
        self.check_place(r, z)?;
        check_time(t)?;
        if t <= self.first_arrival(r, z) {
            let rest = statics::static_field(&self.medium, self.profile, r, z);
            return Ok(Estimate {
                value: rest.map(|s| -s),
                error: rest.map(|s| f64::EPSILON * s.abs()),
            });
        }
        let mut estimate = self.evaluate::<0>(Point { r, z, t });
        self.impose_surface(z, &mut estimate);
        Ok(estimate)
    }

    /// The impulse response dH/dt, the fields after a unit impulse, of the Hertz profile.
    ///
    /// Units: c1/(mu r0^2) for displacement, c1/r0^3 for stress.
    /// Between fronts it is a smooth function; at the fronts stress has roots in the denominator, and the
    /// plane front under the disc, (33) of the paper, is a delta function that no value shows.
    ///
    /// # Errors
    /// [`DomainError`] for r, z or t outside [0, 1e20], and for a profile other than Hertz: the
    /// impulse stresses of the others are not functions.
    pub fn impulse(&self, r: f64, z: f64, t: f64) -> Result<Estimate, DomainError> {
        self.check_place(r, z)?;
        check_time(t)?;
        self.check_hertz()?;
        if t <= self.first_arrival(r, z) {
            return Ok(Estimate {
                value: [0.0; 6],
                error: [0.0; 6],
            });
        }
        let mut estimate = self.evaluate::<-1>(Point { r, z, t });
        self.impose_surface(z, &mut estimate);
        Ok(estimate)
    }

    /// The integral, continued to the axis where the fronts of a point force or a punch meet there.
    pub(crate) fn evaluate<const ORDER: i32>(&self, at: Point) -> Estimate {
        if axis::is_near::<ORDER>(self.profile, at) {
            axis::continued(self, at, |at| self.integrate::<ORDER>(at))
        } else {
            self.integrate::<ORDER>(at)
        }
    }

    /// r and z in range, and the fields finite there.
    pub(crate) fn check_place(&self, r: f64, z: f64) -> Result<(), DomainError> {
        check_place(r, z)?;
        let singular = match self.profile {
            Profile::Hertz => false,
            Profile::Punch => z < NEAREST && r == 1.0,
            Profile::Point => z < NEAREST && r < NEAREST,
        };
        let range = match self.profile {
            Profile::Point => "[1e-20, 1e20] where z < 1e-20, for a point force",
            Profile::Hertz | Profile::Punch => "[0, 1) or (1, 1e20] where z < 1e-20, for a punch",
        };
        DomainError::unless(!singular, "r", r, range)?;
        Ok(())
    }

    /// What only the Hertz profile has: an impulse response that is a function, and moments.
    pub(crate) fn check_hertz(&self) -> Result<(), DomainError> {
        let power = match self.profile {
            Profile::Hertz => -0.5,
            Profile::Punch => -1.5,
            Profile::Point => -2.5,
        };
        DomainError::unless(
            power > -1.0,
            "power of the impulse at the fronts",
            power,
            "(-1, inf), which only the Hertz profile has",
        )?;
        Ok(())
    }

    /// Time of the first arrival at (r, z): the distance to the nearest point of the disc.
    pub(crate) fn first_arrival(&self, r: f64, z: f64) -> f64 {
        (r - self.profile.radius()).max(0.0).hypot(z)
    }

    /// On the surface sigma_zz is the load and sigma_rz is zero from the start.
    pub(crate) fn impose_surface(&self, z: f64, estimate: &mut Estimate) {
        if z == 0.0 {
            for field in [Field::StressZz, Field::StressRz] {
                estimate.value[field.index()] = 0.0;
                estimate.error[field.index()] = 0.0;
            }
        }
    }

    fn integrate<const ORDER: i32>(&self, at: Point) -> Estimate {
        /// Outside the disc the pressure is zero, and at a distance from the edge so are its rounding errors.
        const CLEAR_OF_EDGE: f64 = 1.01;
        let mut total = self.pole_terms::<ORDER>(at);
        let mut spectrum = Sum::default();
        for wave in [Wave::P, Wave::S] {
            for sense in [Sense::Outgoing, Sense::Image] {
                self.fast::<ORDER>(at, wave, sense, &mut spectrum);
            }
            self.slow::<ORDER>(at, wave, &mut spectrum);
        }
        total.add(1.0 / PI, 0.0, spectrum.value);
        let mut floor = rounding_floor(at.r);
        if at.r > CLEAR_OF_EDGE && shallow::applies::<ORDER>(self.profile, at) {
            for field in [Field::StressZz, Field::StressRz] {
                floor[field.index()] *= 8.0 * at.z.sqrt();
            }
        }
        Estimate {
            value: total.value,
            error: std::array::from_fn(|f| total.error[f] + spectrum.error[f] / PI + floor[f]),
        }
    }

    /// The Rayleigh wave.
    fn pole_terms<const ORDER: i32>(&self, at: Point) -> Sum {
        let c = self.medium.rayleigh_speed();
        let mut sum = Sum::default();
        let shallow = shallow::applies::<ORDER>(self.profile, at);
        let front = Front::near::<ORDER>(&self.medium, self.profile, at);
        for pole in &self.poles {
            let xi = Complex64::new(pole.decay * at.z, -c * at.t);
            let mut psi = match &front {
                Some(front) => front.potentials(xi),
                None => potentials::<ORDER>(self.profile, xi, at.r),
            };
            // d/dt of order n + 1 is i c times order n
            if ORDER == 1 {
                psi = psi.map(|v| v * Complex64::new(0.0, -1.0 / c));
            } else if ORDER == 2 {
                psi = psi.map(|v| v * (-1.0 / (c * c)));
            } else if ORDER < 0 {
                psi = psi.map(|v| v * Complex64::new(0.0, c));
            }
            let mut term = fields(&pole.amplitudes, &psi.map(|v| v.re), at.r);
            if shallow {
                let surface = Complex64::new(0.0, xi.im);
                let Difference { a, g } = match &front {
                    Some(front) => front.difference(surface, xi.re),
                    None => shallow::difference(surface, xi.re.into(), at.r),
                };
                set_traction(
                    &mut term,
                    &pole.amplitudes,
                    Difference { a: a.re, g: g.re },
                    at.r,
                );
            }
            sum.add(1.0, self.share_at_front::<ORDER>(at, xi, shallow), term);
        }
        sum
    }

    /// Rounding of the distance to the nearest edge, in units of that of the distance itself.
    pub(crate) fn front_rounding(&self, at: Point) -> f64 {
        let radius = self.profile.radius();
        match self.profile {
            Profile::Hertz | Profile::Punch => {
                3.0 * (at.r + radius) / (at.r - radius).hypot(at.z).max(f64::EPSILON)
            }
            Profile::Point => 30.0,
        }
    }

    /// The share of the Rayleigh wave that rounding of its distance from the edges of the disc may take.
    fn share_at_front<const ORDER: i32>(&self, at: Point, xi: Complex64, shallow: bool) -> Share {
        let radius = self.profile.radius();
        let height = xi.im.abs();
        let gap = [at.r + radius, (at.r - radius).abs()]
            .map(|edge| (height - edge).hypot(xi.re))
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        let size = height + at.r + radius;
        let front = ROUNDING * size / gap.max(f64::EPSILON * size);
        match self.strength::<ORDER>() {
            Strength::Bounded if shallow => (ROUNDING + front).into(),
            Strength::Bounded => ROUNDING.into(),
            Strength::InverseRoot => Share {
                displacement: ROUNDING + ROUNDING.sqrt() * front.sqrt(),
                stress: ROUNDING + front,
            },
            Strength::FinitePart => Share {
                displacement: ROUNDING + front,
                stress: ROUNDING + 3.0 * front,
            },
        }
    }

    /// The step response of stress to a point force has fronts of power -3/2, to a punch of power -1/2, and each
    /// derivative takes one off.
    pub(crate) fn strength<const ORDER: i32>(&self) -> Strength {
        match self.profile {
            Profile::Point if ORDER <= 0 => Strength::FinitePart,
            Profile::Hertz if ORDER >= 0 => Strength::Bounded,
            Profile::Punch if ORDER >= 1 => Strength::Bounded,
            Profile::Hertz | Profile::Punch | Profile::Point => Strength::InverseRoot,
        }
    }

    /// Accuracy asked of each rule, as minus its natural logarithm.
    ///
    /// The rules are a little better than the tolerance because the waves cancel in the sum.
    ///
    /// Just below the surface the terms are of order z/t and the peak of the field is of order sqrt(z).
    pub(crate) fn digits(&self, at: Point, shallow: bool) -> f64 {
        const MARGIN: f64 = 0.1;
        // beyond the last digit of a double, and what 24 nodes reach beside a finite part
        const MOST: f64 = 40.0;
        let peak = if shallow {
            (at.t / at.z.sqrt()).min(1.0)
        } else {
            1.0
        };
        (-(MARGIN * self.tolerance * peak).ln()).min(MOST)
    }
}

/// Rounding errors of what cancels within the potentials, whose terms grow with the radius.
fn rounding_floor(r: f64) -> Six {
    let displacement = 0.25 * f64::EPSILON * (8.0 + r * r);
    let stress = 0.25 * f64::EPSILON * (8.0 + r);
    [displacement, displacement, stress, stress, stress, stress]
}

/// Lengths and times up to here: their powers stay in the range of a double.
pub(crate) const FARTHEST: f64 = 1e20;

/// Least distance from a point force and least width of a cell, for the same reason.
pub(crate) const NEAREST: f64 = 1e-20;

pub(crate) fn check_place(r: f64, z: f64) -> Result<(), DomainError> {
    DomainError::unless((0.0..=FARTHEST).contains(&r), "r", r, "[0, 1e20]")?;
    DomainError::unless((0.0..=FARTHEST).contains(&z), "z", z, "[0, 1e20]")?;
    Ok(())
}

pub(crate) fn check_time(t: f64) -> Result<(), DomainError> {
    DomainError::unless((0.0..=FARTHEST).contains(&t), "t", t, "[0, 1e20]")?;
    Ok(())
}

/// The six fields from real amplitudes and potentials.
#[inline]
pub(crate) fn fields(m: &Amplitudes<f64>, psi: &Potentials<f64>, r: f64) -> Six {
    let hoop = 2.0 * m.u * psi.g_upper;
    [
        m.u * psi.g_upper * r,
        m.w * psi.a_upper,
        m.rr * psi.a_lower - hoop,
        m.tt * psi.a_lower + hoop,
        m.zz * psi.a_lower,
        m.rz * psi.g_lower * r,
    ]
}

/// Replaces sigma_zz and sigma_rz by those of potentials less their values at the surface.
pub(crate) fn set_traction(
    term: &mut Six,
    m: &Amplitudes<f64>,
    difference: Difference<f64>,
    r: f64,
) {
    term[Field::StressZz.index()] = m.zz * difference.a;
    term[Field::StressRz.index()] = m.rz * difference.g * r;
}
