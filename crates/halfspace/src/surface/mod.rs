//! Deflection of the surface under its own load: closed spectral form, finite memory.
//!
//! The impact equation needs only the deflection of the half-space under the striker.
//! At z = 0 the single integral of the kernels reduces to a positive measure over slowness,
//!
//! ```text
//! 1 - W(t) = int phi(t/x) dmu(x),   dmu = 2 K/(pi (1 - nu)) Re[p/R] dx  on 0 < x < 1/kappa,
//!                                       + m_R delta(x - 1/c),   m_R = 2 a c K/((1 - nu) D'(c))
//! p = sqrt(1 - x^2),  y = sqrt(K - x^2),  K = 1/kappa^2,  R = (2 x^2 - K)^2 + 4 x^2 p y,  a = sqrt(1 - c^2)
//! ```
//!
//! of total mass one.
//! phi is the chord function of the load: 1 - eta^2 on [0, 1] for the centre of a Hertz disc
//! and (2 - eta)^3 (eta^2 + 6 eta + 4)/32 on [0, 2] for its pressure-weighted mean.
//! Since phi has bounded support the response is exactly static after the last Rayleigh wave.
//!
//! Theory: `docs/theory.md` (T25 to T28, T32, T34).

mod chord;
mod curve;
mod measure;

use crate::medium::Medium;
use chord::{Chord, Moments};
use curve::Curve;
pub use measure::surface_measure;
use measure::{SurfaceMeasure, ZONES, Zone};

/// Kind of deflection of the loaded disc.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Deflection {
    /// w(0, 0, t), the centre of the disc: the paper's choice.
    Centre,
    /// The pressure-weighted mean of w(r, 0, t) over the disc: work-conjugate to the force.
    Mean,
}

/// Properties of a disc's deflection for any force: its static value, and the times until it is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedDisc {
    /// Kind of deflection.
    pub deflection: Deflection,
    /// Static deflection under unit force, in 1/(mu r0): 3 (1 - nu)/8 at the centre, 4/5 of it in the mean.
    pub static_compliance: f64,
    /// int_0^inf (1 - W) dt in r0/c1: the first-order memory of the half-space.
    ///
    /// The J of the radiation law is kappa times [`Self::static_compliance`] times this.
    pub relaxation_time: f64,
    /// Time after which the response is exactly static, in r0/c1: c1/c_R at the centre, twice that in the mean.
    pub memory: f64,
}

/// Index of a fitted function.
const STEP: usize = 0;
const INTEGRAL: usize = 1;
const SLOPE: usize = 2;

/// Step response of the deflection of a Hertz-loaded disc on the surface of a half-space.
///
/// Time is reduced by r0/c1, deflection by P/(mu r0).
/// The deflection under a suddenly applied unit force is
/// [`static_compliance`](LoadedDisc::static_compliance) times [`step`](Self::step).
///
/// Accuracy: 1e-13 for nu in [-0.5, 0.4999], tested against the closed form of Kausel (2012).
///
/// ```
/// use halfspace::{Deflection, Medium, SurfaceResponse};
/// let medium = Medium::new(0.25)?;
/// let centre = SurfaceResponse::new(&medium, Deflection::Centre);
/// // W(T = 1) = 0.924305551263 with T = c2 t/r0, from the closed form of Kausel (2012)
/// assert!((centre.step(1.0 / medium.kappa()) - 0.924305551263).abs() < 1e-11);
/// # Ok::<(), halfspace::DomainError>(())
/// ```
#[derive(Debug, Clone)]
pub struct SurfaceResponse {
    /// Static value and times of the deflection.
    pub disc: LoadedDisc,
    chord: Chord,
    shear_slowness: f64,
    measure: SurfaceMeasure,
    total: Moments,
    /// Fitted functions of each zone.
    curves: [Curve; 2],
}

impl SurfaceResponse {
    /// Prepares the response of `medium`; reuse it for many values.
    pub fn new(medium: &Medium, deflection: Deflection) -> Self {
        let measure = SurfaceMeasure::new(medium);
        let chord = Chord::new(deflection);
        let total = measure.total();
        Self {
            disc: LoadedDisc {
                deflection,
                static_compliance: chord.static_factor * (1.0 - medium.poisson_ratio()),
                relaxation_time: chord.integral(chord.support) * total[0],
                memory: chord.support * measure.rayleigh_slowness,
            },
            chord,
            shear_slowness: medium.shear_slowness_squared().sqrt(),
            curves: ZONES.map(Curve::new),
            measure,
            total,
        }
    }

    /// W(t): step response over its static value; 0 for t <= 0, 1 for t >= [`LoadedDisc::memory`], NaN for NaN.
    pub fn step(&self, t: f64) -> f64 {
        self.value(t, STEP, |chord, eta| {
            1.0 - self.measure.rayleigh_mass * chord.value(eta)
        })
    }

    /// int_0^t W dt in r0/c1; t - [`LoadedDisc::relaxation_time`] once the response is static, 0 for t <= 0, NaN for NaN.
    pub fn step_integral(&self, t: f64) -> f64 {
        self.value(t, INTEGRAL, |chord, eta| {
            let late = chord.integral(chord.support) - chord.integral(eta);
            t - self.disc.relaxation_time
                + self.measure.rayleigh_mass * self.measure.rayleigh_slowness * late
        })
    }

    /// W'(t), in c1/r0: the impulse response over its integral, the static value.
    ///
    /// ```text
    /// W'(t) = -int phi'(t/x) dmu(x)/x = -sum_k k a_k t^(k-1) M_k(t),   M_k(t) = int_{x > t/support} x^(-k) dmu
    /// ```
    ///
    /// At t = 0 the value is the limit from above; for the centre, [`LoadedDisc::static_compliance`] times it is
    /// kappa^2 Z(0), (32). It is 0 for t < 0 and for t >= [`LoadedDisc::memory`], where the response of the centre
    /// jumps.
    /// It is the sampled kernel of the paper's scheme (41).
    /// Accuracy: 1e-11 of the value at t = 0.
    pub fn impulse(&self, t: f64) -> f64 {
        self.value(t, SLOPE, |chord, eta| {
            if eta >= chord.support {
                return 0.0;
            }
            let terms = chord.terms(eta).filter(|&(k, _)| k > 0);
            let slope: f64 = terms.map(|(k, term)| f64::from(k) * term / eta).sum();
            -self.measure.rayleigh_mass * slope / self.measure.rayleigh_slowness
        })
    }

    /// Value of a fitted function; `late` returns it at times when only the Rayleigh wave remains, from the place eta
    /// on its chord.
    fn value(&self, t: f64, which: usize, late: impl Fn(&Chord, f64) -> f64) -> f64 {
        if t.is_nan() {
            return t;
        }
        if t < 0.0 || t == 0.0 && which != SLOPE {
            return 0.0;
        }
        let chord = &self.chord;
        let x = t / chord.support;
        let Some(zone) = Zone::of(x, self.shear_slowness) else {
            return late(chord, t / self.measure.rayleigh_slowness);
        };
        let angle = zone.angle(self.shear_slowness, x);
        self.curves[zone as usize].value(which, angle, |panel, angles| {
            let above = self.measure.above(zone, panel, angles);
            std::array::from_fn(|i| {
                let slowness = zone.slowness(self.shear_slowness.powi(2), angles[i].sin());
                let (t, above) = (chord.support * slowness, &above[i]);
                let integral = t - chord.overlap_integral(t, &self.total, above);
                let terms = chord.terms(t).zip(&above[1..]);
                let slopes = terms.map(|((k, term), moment)| f64::from(k) * term * moment);
                let slope = -slopes.sum::<f64>() / t;
                [1.0 - chord.overlap(t, above), integral, slope]
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn the_impulse_is_the_slope_of_the_step() {
        for nu in [-0.5, 0.0, 0.25, 0.3, 0.45, 0.499] {
            let medium = Medium::new(nu).unwrap();
            for deflection in [Deflection::Centre, Deflection::Mean] {
                let response = SurfaceResponse::new(&medium, deflection);
                let size = response.impulse(0.0);
                let memory = response.disc.memory;
                for part in [0.003, 0.07, 0.2, 0.33, 0.57, 0.81, 0.93, 0.999] {
                    let (t, h) = (part * memory, 1e-5 * memory);
                    let slope = (response.step(t + h) - response.step(t - h)) / (2.0 * h);
                    let error = (response.impulse(t) - slope).abs();
                    assert!(error < 3e-6 * size, "nu = {nu}, t = {t}: {error}");
                }
                assert_eq!(response.impulse(-1e-9), 0.0);
                assert_eq!(response.impulse(memory), 0.0);
            }
            // (32): G(0+) = kappa^2 Z(0), Z(0) = 3/(2 pi)
            let centre = SurfaceResponse::new(&medium, Deflection::Centre);
            let start = centre.disc.static_compliance * centre.impulse(0.0);
            let expected = medium.kappa().powi(2) * 1.5 / PI;
            assert!((start / expected - 1.0).abs() < 1e-9, "nu = {nu}: {start}");
        }
    }
}
