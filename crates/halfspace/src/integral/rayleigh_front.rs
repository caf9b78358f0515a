//! The Rayleigh wave near its arrival, below the surface.
//!
//! Theory: `docs/theory.md` (T19).

use crate::field::Point;
use crate::medium::Medium;
use crate::numeric::double::Double;
use crate::numeric::scalar::Complex;
use crate::potentials::chord_integral::{chord_primitives, from_primitives};
use crate::potentials::shallow::{difference, gap, is_short};
use crate::potentials::{Potentials, STEP, far_front};
use crate::profile::Profile;
use num_complex::Complex64;
use std::f64::consts::PI;

/// Smallest radius for the closed forms at the fronts.
const LEAST_RADIUS: f64 = 0.002;

/// The Rayleigh wave near its arrival from an edge, c t = |r -+ 1|.
///
/// It passes in a time of the order of the depth, so the rounding errors of c, of c t and of r -+ 1 would all be
/// visible.
pub(crate) struct Front {
    r: f64,
    factors: [[f64; 2]; 2],
}

impl Front {
    /// The front; none away from the arrivals, where rounding is harmless.
    pub(crate) fn near<const N: i32>(medium: &Medium, profile: Profile, at: Point) -> Option<Self> {
        /// Largest depth, and distance from the arrival, at which rounding matters.
        const NEAR_ARRIVAL: f64 = 1e-2;
        let Point { r, z, t } = at;
        let xi = Complex64::new(0.0, medium.rayleigh_speed() * t);
        if N != STEP
            || profile != Profile::Hertz
            || z >= NEAR_ARRIVAL
            || r <= LEAST_RADIUS
            || gap(xi, r) > NEAR_ARRIVAL
        {
            return None;
        }
        let path = medium.exact_rayleigh_speed * t.into();
        let (inner, outer) = (Double::sum(r, -1.0), Double::sum(r, 1.0));
        Some(Self {
            r,
            factors: [
                [(outer + path).value(), (inner - path).value()],
                [(inner + path).value(), (outer - path).value()],
            ],
        })
    }

    /// The potentials at xi = d - i c t.
    pub(crate) fn potentials(&self, xi: Complex64) -> Potentials<Complex64> {
        if self.r > far_front::FAR_RADIUS {
            // r - 1 - c t and r + 1 - c t; xi is the conjugate of d + i c t
            let delta = self.factors.map(|[_, edge]| Complex64::new(edge, xi.re));
            far_front::potentials(delta, (self.r, far_front::ROUNDING_DIGITS)).map(Complex::conj)
        } else {
            at_front(xi, self.r, self.factors)
        }
    }

    /// [`difference`] for xi = -i c t and a real step.
    pub(crate) fn difference(&self, xi: Complex64, step: f64) -> (Complex64, Complex64) {
        if is_short(xi, step, self.r) {
            return difference(xi, step.into(), self.r);
        }
        step_at_front(xi, step, self.r, self.factors)
    }
}

/// The ends zeta of the chord and their rho, for the Hertz disc at xi = d - i c t, d >= 0, from r +- 1 +- c t.
///
/// `factors` are r - s and r + s of the two ends, s = -c t -+ 1, where those that are small near a front are exact.
fn ends_at_front(xi: Complex64, factors: [[f64; 2]; 2]) -> ([Complex64; 2], [Complex64; 2]) {
    let zeta = [1.0, -1.0].map(|sigma| Complex64::new(xi.re, xi.im - sigma));
    let rho = [0, 1].map(|i| zeta[i].root_inside(factors[i][0] * factors[i][1]));
    (zeta, rho)
}

/// The potentials at the front, for xi near the disc and r not small.
fn at_front(xi: Complex64, r: f64, factors: [[f64; 2]; 2]) -> Potentials<Complex64> {
    let (zeta, rho) = ends_at_front(xi, factors);
    let phi = [0, 1].map(|i| (zeta[i] + rho[i]).logarithm().times_minus_i());
    let eta = xi.times_minus_i();
    let psi = chord_primitives::<STEP, Complex64>(eta, r, phi, rho);
    from_primitives::<STEP, Complex64>(psi, eta, r)
}

/// Differences of A_2 and B_2/r at the front between xi + step and xi = -i c t for real step > 0, to full relative
/// accuracy.
///
/// They follow from differences of the primitives of `chord_primitives`, each from those of rho^2 and of zeta + rho.
fn step_at_front(
    xi: Complex64,
    step: f64,
    r: f64,
    factors: [[f64; 2]; 2],
) -> (Complex64, Complex64) {
    const TINY: f64 = 1e-300;
    let (zeta, from) = ends_at_front(xi, factors);
    let (_, to) = ends_at_front(xi + step, factors);
    let d_rho = [0, 1].map(|i| {
        let sum = from[i] + to[i];
        if sum.norm_sqr() < TINY {
            return Complex64::default();
        }
        step * (2.0 * zeta[i] + step) * sum.reciprocal()
    });
    let d_phi = [0, 1].map(|i| {
        let w = (d_rho[i] + step) * (zeta[i] + from[i]).reciprocal();
        let modulus = 0.5 * (2.0 * w.re + w.norm_sqr()).ln_1p();
        Complex64::new(modulus, w.im.atan2(1.0 + w.re)).times_minus_i()
    });
    let phi = [0, 1].map(|i| (zeta[i] + step + to[i]).logarithm().times_minus_i());
    let (eta, h) = (xi.times_minus_i(), Complex64::new(0.0, -step));
    // s q changes by s dq + h q
    let d_sq = [0, 1].map(|i| zeta[i].times_minus_i() * d_rho[i] + h * to[i]);
    let (m0, d_m0) = (phi[1] - phi[0], d_phi[1] - d_phi[0]);
    let (m1, d_m1) = (to[0] - to[1], d_rho[0] - d_rho[1]);
    let d_m2 = 0.5 * (r * r * d_m0 - d_sq[1] + d_sq[0]);
    let scale = 0.75 / PI;
    let a = scale * (d_m1 - eta * d_m0 - h * m0);
    let g = scale / (r * r) * (d_m2 - eta * d_m1 - h * m1);
    (a.times_i(), g)
}
