//! Just below the surface, where the traction is a small difference of the two waves.
//!
//! At z = 0 the arguments of P and S are equal, xi0 = -+ i t/x, and the waves cancel. For the normal stress their
//! amplitudes add up to -i/x at every slowness in both senses, and the two senses cancel; for the shear stress the
//! amplitudes themselves cancel; at the Rayleigh pole they add up to -D(c) = 0. Therefore each potential Psi(xi) can be
//! replaced by Psi(xi) - Psi(xi0), and the integrand is then of the order of the depth.
//!
//! Computed directly, the difference would be lost to rounding. Away from the singularities of the potentials it is the
//! step in xi times the mean of the potentials of one order lower, by the Gauss rule with two points.
//!
//! Theory: `docs/theory.md` (T19).

use crate::field::Point;
use crate::potentials::closed_form::of_one;
use crate::potentials::compact::compact;
use crate::potentials::far_front::ROUNDING_DIGITS;
use crate::potentials::{IMPULSE, STEP};
use crate::profile::Profile;
use num_complex::Complex64;

/// Depth from which the stresses have enough digits without differences.
const DEEPEST: f64 = 1e-4;

/// Smallest radius for the compact parts of every order; nearer the axis sigma_rz vanishes as r.
const LEAST_RADIUS: f64 = 1e-6;

/// Largest ratio of the step to the distance from a singularity; the error of the rule is its fourth power over 4320.
const LONGEST_STEP: f64 = 1e-3;

/// Places of the two points of Gauss's rule on [0, 1].
const GAUSS_PLACES: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// Whether sigma_zz and sigma_rz are computed from differences.
pub(crate) fn applies<const N: i32>(profile: Profile, at: Point) -> bool {
    N == STEP && profile == Profile::Hertz && at.z > 0.0 && at.z < DEEPEST && at.r > LEAST_RADIUS
}

/// Distance of an imaginary number from the singularities, which lie at +-i (1 +- r).
pub(crate) fn gap(xi: Complex64, r: f64) -> f64 {
    let height = xi.im.abs();
    (height - (1.0 + r))
        .abs()
        .min((height - (1.0 - r).abs()).abs())
}

/// Whether a step from imaginary xi is short enough for the mean of derivatives.
pub(crate) fn is_short(xi: Complex64, step: f64, r: f64) -> bool {
    step < LONGEST_STEP * gap(xi, r)
}

/// A_2 and B_2/r at xi + step minus those at xi.
pub(crate) fn difference(xi: Complex64, step: Complex64, r: f64) -> (Complex64, Complex64) {
    if is_short(xi, step.norm(), r) {
        let [first, second] =
            GAUSS_PLACES.map(|place| of_one::<IMPULSE>(Profile::Hertz, xi + place * step, r));
        (
            -0.5 * step * (first.a_lower + second.a_lower),
            -0.5 * step * (first.g_lower + second.g_lower),
        )
    } else {
        let from = of_one::<STEP>(Profile::Hertz, xi, r);
        let to = of_one::<STEP>(Profile::Hertz, xi + step, r);
        (to.a_lower - from.a_lower, to.g_lower - from.g_lower)
    }
}

/// Differences of the compact parts between eta = surface + step and the surface.
///
/// Just after the plane front both are large and eta is not, so eta is passed separately instead of their sum.
pub(crate) fn compact_difference(surface: f64, step: f64, eta: f64, r: f64) -> (f64, f64) {
    if is_short(Complex64::new(0.0, surface), step.abs(), r) {
        let [first, second] = GAUSS_PLACES.map(|place| {
            compact::<IMPULSE, f64>(Profile::Hertz, surface + place * step, (r, ROUNDING_DIGITS))
        });
        (
            0.5 * step * (first.a_lower + second.a_lower),
            0.5 * step * (first.g_lower + second.g_lower),
        )
    } else {
        let from = compact::<STEP, f64>(Profile::Hertz, surface, (r, ROUNDING_DIGITS));
        let to = compact::<STEP, f64>(Profile::Hertz, eta, (r, ROUNDING_DIGITS));
        (to.a_lower - from.a_lower, to.g_lower - from.g_lower)
    }
}
