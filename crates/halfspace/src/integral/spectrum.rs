//! Amplitudes of the single integral: the excitation of each wave by the surface load.
//!
//! With slowness x = 1/w, p = sqrt(1 - x^2), y = sqrt(K - x^2), K = 1/kappa^2 and the Rayleigh function
//! R = (2 x^2 - K)^2 + 4 x^2 p y, the integrand N dw/(i w D) of a wave is amplitude times potential, dx.
//! Below x = 1 every amplitude is real or imaginary; above it p = -i sqrt(x^2 - 1), R is complex, and every
//! amplitude is a real number over R or over i R.
//!
//! Theory: `docs/theory.md` (T7, T16).

use crate::field::{Field, Six};
use crate::medium::Medium;
use crate::numeric::scalar::Real;
use crate::potentials::Potentials;

/// The two body waves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wave {
    /// Longitudinal, speed 1.
    P,
    /// Shear, speed kappa.
    S,
}

/// Amplitudes of one wave at one slowness.
///
/// ```text
/// w = w A3     u = u B3     szz = zz A2     srz = rz B2     srr = rr A2 - 2 u B3/r     stt = tt A2 + 2 u B3/r
/// ```
///
/// For real slowness below one, `w` and `rz` are real, and the other amplitudes are -i times the stored number.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Amplitudes<T> {
    pub(crate) w: T,
    pub(crate) u: T,
    pub(crate) zz: T,
    pub(crate) rz: T,
    pub(crate) rr: T,
    pub(crate) tt: T,
}

impl<T: Real> Amplitudes<T> {
    /// The six fields from real amplitudes and potentials.
    #[inline(always)]
    pub(crate) fn fields(&self, psi: &Potentials<T>, r: f64) -> [T; 6] {
        let hoop = self.u * psi.g_upper * 2.0;
        [
            self.u * psi.g_upper * r,
            self.w * psi.a_upper,
            self.rr * psi.a_lower - hoop,
            self.tt * psi.a_lower + hoop,
            self.zz * psi.a_lower,
            self.rz * psi.g_lower * r,
        ]
    }
}

impl Amplitudes<f64> {
    /// Replaces sigma_zz and sigma_rz by those of the differences `a` and `g` of A_2 and B_2/r from their values at the
    /// surface.
    pub(crate) fn set_traction(&self, term: &mut Six, a: f64, g: f64, r: f64) {
        term[Field::StressZz.index()] = self.zz * a;
        term[Field::StressRz.index()] = self.rz * g * r;
    }
}

/// x, p and dx/du at the half-angle u.
#[inline(always)]
pub(crate) fn half_angle<T: Real>(u: T) -> (T, T, T) {
    let one = u.constant(1.0);
    let inverse = one / (u * u + 1.0);
    let p = (one - u) * (one + u) * inverse;
    (u * inverse * 2.0, p, p * inverse * 2.0)
}

/// Smallest value of the Rayleigh function, which vanishes together with the numerators at slowness one for nu = 0.
const LEAST_RAYLEIGH: f64 = 1e-280;

/// Amplitudes at slowness x = sin(theta) < 1, p = cos(theta).
#[inline(always)]
pub(crate) fn fast<T: Real>(wave: Wave, k: f64, x: T, p: T) -> Amplitudes<T> {
    let x2 = x * x;
    let y = (-x2 + k).sqrt();
    let g = x2 * 2.0 - k;
    let both = x2 * p * y * 4.0;
    let inverse = x.constant(1.0) / (g * g + both).at_least(LEAST_RAYLEIGH);
    amplitudes(wave, k, (x, p, y), inverse, 4.0)
}

/// 1/R = re + i im at slowness 1 < x < 1/kappa, where p = -i `p_abs`.
#[inline(always)]
pub(crate) fn inverse_rayleigh<T: Real>(k: f64, x: T, p_abs: T, y: T) -> (T, T) {
    let x2 = x * x;
    let g = x2 * 2.0 - k;
    let square = g * g;
    let both = x2 * p_abs * y * 4.0;
    let scale = x.constant(1.0) / (square * square + both * both).at_least(LEAST_RAYLEIGH);
    (square * scale, both * scale)
}

/// Amplitudes at slowness 1 < x < 1/kappa over 1/R or -i/R: every one is real up to that factor.
///
/// For P the factor is always -i/R; for S it is -i/R for `w` and `rz`, and 1/R for the others.
#[inline(always)]
pub(crate) fn slow<T: Real>(wave: Wave, k: f64, x: T, p_abs: T, y: T) -> Amplitudes<T> {
    amplitudes(wave, k, (x, p_abs, y), x.constant(1.0), -4.0)
}

/// Amplitudes from x, p or its modulus, y and 1/R; those of S except `w` and `rz` contain the product `cross` of both
/// roots.
#[inline(always)]
fn amplitudes<T: Real>(
    wave: Wave,
    k: f64,
    (x, p, y): (T, T, T),
    inverse: T,
    cross: f64,
) -> Amplitudes<T> {
    let x2 = x * x;
    let g = x2 * 2.0 - k;
    match wave {
        Wave::P => {
            let over_x = g * inverse / x;
            Amplitudes {
                w: p * g * inverse,
                u: x2 * over_x,
                zz: -g * over_x,
                rz: p * g * inverse * -2.0,
                rr: (x2 * 2.0 + (k - 2.0)) * over_x,
                tt: over_x * (k - 2.0),
            }
        }
        Wave::S => {
            let cross = x * p * y * inverse * cross;
            Amplitudes {
                w: p * x2 * inverse * -2.0,
                u: cross * 0.5,
                zz: -cross,
                rz: p * g * inverse * 2.0,
                rr: cross,
                tt: x.constant(0.0),
            }
        }
    }
}

/// Residue of the Rayleigh pole: 2 N/(c D'(c)), real, with the decay a or b of the wave into depth.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pole {
    pub(crate) decay: f64,
    pub(crate) amplitudes: Amplitudes<f64>,
}

/// The Rayleigh pole of one wave.
pub(crate) fn pole(wave: Wave, medium: &Medium) -> Pole {
    let c2 = medium.rayleigh_speed().powi(2);
    let k = medium.shear_slowness_squared();
    let (a, b) = ((1.0 - c2).sqrt(), (1.0 - c2 * k).sqrt());
    let g = 2.0 - c2 * k;
    let scale = 2.0 / (medium.rayleigh_speed() * medium.rayleigh_slope());
    match wave {
        Wave::P => Pole {
            decay: a,
            amplitudes: Amplitudes {
                w: scale * (a * g),
                u: scale * g,
                zz: scale * (-g * g),
                rz: scale * (-2.0 * a * g),
                rr: scale * (g * (2.0 + (k - 2.0) * c2)),
                tt: scale * (g * (k - 2.0) * c2),
            },
        },
        Wave::S => Pole {
            decay: b,
            amplitudes: Amplitudes {
                w: scale * (-2.0 * a),
                u: scale * (-2.0 * a * b),
                zz: scale * (4.0 * a * b),
                rz: scale * (2.0 * a * g),
                rr: scale * (-4.0 * a * b),
                tt: 0.0,
            },
        },
    }
}
