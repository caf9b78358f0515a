//! The potentials of a Hertz disc where a front passes a distant point.
//!
//! There the closed forms are differences of terms of the order of r^2. With the place on the chord s = eta - sigma, as
//! seen from the point, and the distance delta = r - s behind the front,
//!
//! ```text
//! 1/rho = delta^{-1/2} (2 r - delta)^{-1/2} = (2 r)^{-1/2} sum_k (1/2)_k/k! (2 r)^{-k} delta^{k - 1/2}
//! ```
//!
//! where delta is of order one and 2 r large, and the chord integrals are those of powers of delta:
//!
//! ```text
//! A_3 = C I_0     A_2 = -2 i C K_0     B_3/r = C/r^2 [4/3 - i (r I_0 - I_1)]     B_2/r = -2 C/r^2 (r K_0 - K_1)
//! I_j = int (1 - sigma^2) delta^j/rho dsigma     K_j = int sigma delta^j/rho dsigma     C = 3/(8 pi)
//! ```
//!
//! The distance enters only through its root, so no digits are lost at the front.

use crate::numeric::scalar::{Complex, Real, Scalar};
use crate::potentials::Potentials;
use std::f64::consts::PI;

/// Radius from which the series replaces the closed forms.
pub(crate) const FAR_RADIUS: f64 = 25.0;

const C: f64 = 0.375 / PI;

/// Largest number of terms of the series, enough at [`FAR_RADIUS`] for |delta| <= 11.
const MOST_TERMS: usize = 26;

/// The four chord integrals.
struct ChordIntegrals<T> {
    i: [T; 2],
    k: [T; 2],
}

/// Number of digits (natural logarithm) that reaches the rounding error.
pub(crate) const ROUNDING_DIGITS: f64 = 37.0;

/// Number of terms of the series for an error of exp(-`digits`).
#[inline(always)]
fn terms(r: f64, digits: f64) -> usize {
    /// Largest distance behind a front at which the multipole series is never used.
    const MULTIPOLE_LIMIT: f64 = 12.0;
    let ratio = MULTIPOLE_LIMIT / (2.0 * r);
    ((-digits.min(ROUNDING_DIGITS) / ratio.ln()) as usize + 1).clamp(4, MOST_TERMS)
}

/// The integrals from delta and its square root at both ends, sigma = -1 and 1.
///
/// Any branch of the root can be used, and a root of zero represents an end that the front has not reached. The
/// integrals are linear in the roots.
#[inline(always)]
fn chord<T: Scalar>(delta: [T; 2], root: [T; 2], (r, digits): (f64, f64)) -> ChordIntegrals<T> {
    let zero = root[0].constant(0.0);
    // sigma = e + delta
    let e = delta[1].constant(1.0) - delta[1];
    // D_m = [delta^{m + 1/2}]/(m + 1/2) over (2 r)^m, and sums of the series over D_m to D_{m + 3}
    let up = 2.0 * r;
    let scale = 1.0 / up;
    let steps = [delta[0] * scale, delta[1] * scale];
    let mut powers = root;
    let (mut d, mut sums) = ([zero; 4], [zero; 4]);
    let mut coefficient = 1.0;
    for m in 0..terms(r, digits) + 3 {
        let half = 1.0 / (m as f64 + 0.5);
        d = [d[1], d[2], d[3], (powers[1] - powers[0]) * half];
        powers = [powers[0] * steps[0], powers[1] * steps[1]];
        if m < 3 {
            continue;
        }
        for j in 0..4 {
            sums[j] = sums[j] + d[j] * coefficient;
        }
        let before = (m - 3) as f64;
        coefficient *= (before + 0.5) / (before + 1.0);
    }
    // delta^j raises the order by j, a factor (2 r)^j of the stored numbers
    let inside = (e.constant(1.0) - e) * (e + 1.0);
    let (mut i, mut k) = ([zero; 2], [zero; 2]);
    for (j, lift) in [1.0, up].into_iter().enumerate() {
        let bent = sums[j] * inside - (sums[j + 1] * (e + e) + sums[j + 2] * up) * up;
        (i[j], k[j]) = (bent * lift, (sums[j] * e + sums[j + 1] * up) * lift);
    }
    let front = scale.sqrt();
    ChordIntegrals {
        i: [i[0] * front, i[1] * front],
        k: [k[0] * front, k[1] * front],
    }
}

/// delta = r - |eta| -+ 1 of a distant point.
#[inline(always)]
fn delta<T: Real>(eta: T, r: f64) -> [T; 2] {
    let distance = eta.abs();
    [-distance + (r - 1.0), -distance + (r + 1.0)]
}

/// The compact parts (a3, a2, b3/r, b2/r) at eta > 0; they vanish before the front.
#[inline(always)]
pub(crate) fn compact<T: Real>(eta: T, (r, digits): (f64, f64)) -> Potentials<T> {
    let delta = delta(eta, r);
    let root = [delta[0].held_root(), delta[1].held_root()];
    let ChordIntegrals { i, k } = chord(delta, root, (r, digits));
    let ring = C / (r * r);
    Potentials {
        a_upper: i[0] * C,
        a_lower: k[0] * (-2.0 * C),
        g_upper: (i[0] * r - i[1]) * -ring,
        g_lower: (k[0] * r - k[1]) * (-2.0 * ring),
    }
}

/// The potentials of a distant point at xi = d + i eta, on the imaginary axis or off it.
#[inline(always)]
pub(crate) fn of_disc<T: Complex>(xi: T, (r, digits): (f64, f64), on_axis: bool) -> Potentials<T> {
    let delta = delta(xi.im(), r);
    let psi = if on_axis {
        // linear in the roots, which are real or imaginary
        let re = chord(
            delta,
            [delta[0].held_root(), delta[1].held_root()],
            (r, digits),
        );
        let im = chord(
            delta,
            [(-delta[0]).held_root(), (-delta[1]).held_root()],
            (r, digits),
        );
        let i = [T::new(re.i[0], im.i[0]), T::new(re.i[1], im.i[1])];
        let k = [T::new(re.k[0], im.k[0]), T::new(re.k[1], im.k[1])];
        of_chord(ChordIntegrals { i, k }, r)
    } else {
        let delta = [T::new(delta[0], xi.re()), T::new(delta[1], xi.re())];
        potentials(delta, (r, digits))
    };
    // the conjugate where xi is below the real axis
    let zero = xi.im().constant(0.0);
    psi.map(|v| T::where_below(xi.im(), zero, v.conj(), v))
}

/// The potentials at xi = d + i eta, eta > 0, from `delta` = r - eta -+ 1 + i d at sigma = -1 and 1.
#[inline(always)]
pub(crate) fn potentials<T: Complex>(delta: [T; 2], (r, digits): (f64, f64)) -> Potentials<T> {
    let root = [delta[0].root(), delta[1].root()];
    of_chord(chord(delta, root, (r, digits)), r)
}

/// The potentials from the chord integrals.
#[inline(always)]
fn of_chord<T: Complex>(ChordIntegrals { i, k }: ChordIntegrals<T>, r: f64) -> Potentials<T> {
    let ring = C / (r * r);
    Potentials {
        a_upper: i[0] * C,
        a_lower: k[0].times_minus_i() * (2.0 * C),
        g_upper: ((i[0] * r - i[1]).times_minus_i() + 4.0 / 3.0) * ring,
        g_lower: (k[0] * r - k[1]) * (-2.0 * ring),
    }
}
