//! The potentials on the imaginary axis, xi = i eta: the parts that obey causality.
//!
//! For slownesses below one the kernels use only the real part of A_3(i eta) and B_2(i eta) and the
//! imaginary part of A_2(i eta) and B_3(i eta). These vanish for |eta| > radius + r: nothing is felt
//! before the front from the nearest edge of the disc nor after the one from the farthest.
//!
//! ```text
//! a3 = Re A_3   b3 = Im B_3   a2 = Im A_2 = a3'   b2 = Re B_2 = -b3'   a4' = a3   b4' = b3   (' = d/d eta)
//! ```
//!
//! Each is an integral over the part of the chord that a circle of radius r covers; with s = eta - sigma,
//! phi = asin(s/r) and q = sqrt(r^2 - s^2), both held at their value on the circle outside it,
//!
//! ```text
//! a3 = [ (1 - eta^2) phi - 2 eta q - (r^2 phi - s q)/2 ] 3/(8 pi)   between s = eta - 1 and eta + 1
//! ```
//!
//! and so on. The antiderivatives a4, a5 and b5 are measured so that they vanish before the arrival.

use crate::potential::Potentials;
use crate::profile::Profile;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::{Add, Mul, Sub};

/// Radius below which a point is on the axis as far as rounding goes.
const AXIS: f64 = 1e-13;

/// The compact parts at eta: (a3, a2, b3/r, b2/r) for `ORDER` 0, (a4, a3, b4/r, b3/r) for 1.
///
/// Of the Hertz profile also (a5, a4, b5/r, b4/r) for 2, and for -1 the derivatives of those for 0.
#[inline]
pub(crate) fn compact<const ORDER: i32>(profile: Profile, eta: f64, r: f64) -> Potentials<f64> {
    match profile {
        Profile::Hertz if r < AXIS && ORDER >= 0 => hertz_on_axis::<ORDER>(eta),
        Profile::Hertz => hertz::<ORDER>(eta, r),
        Profile::Punch => punch::<ORDER>(eta, r),
        Profile::Point => point::<ORDER>(eta, r),
    }
}

/// phi and q at the end s = eta + shift of the chord.
///
/// r - s and r + s are taken from r -+ shift, which is exact at the edge of the disc.
#[inline]
fn circle(eta: f64, shift: f64, r: f64) -> (f64, f64) {
    let (below, above) = ((r - shift) - eta, (r + shift) + eta);
    if below <= 0.0 {
        (FRAC_PI_2, 0.0)
    } else if above <= 0.0 {
        (-FRAC_PI_2, 0.0)
    } else {
        let sine = ((eta + shift) / r).clamp(-1.0, 1.0);
        (sine.asin(), (below * above).sqrt())
    }
}

#[inline]
fn hertz<const ORDER: i32>(eta: f64, r: f64) -> Potentials<f64> {
    let ((phi1, q1), (phi2, q2)) = (circle(eta, -1.0, r), circle(eta, 1.0, r));
    if ORDER < 0 {
        return hertz_slopes(eta, r, [phi1, phi2], [q1, q2]);
    }
    let mut psi = chord_primitives::<ORDER, f64>(eta, r, [phi1, phi2], [q1, q2]);
    // measured from their values before the arrival
    if ORDER == 1 {
        psi.a_upper -= 0.25;
    } else if ORDER == 2 {
        psi.a_upper -= 0.25 * eta;
        psi.a_lower -= 0.25;
        psi.g_upper -= 0.125;
    }
    psi
}

/// The compact parts after the wave has passed, eta below minus the reach of the disc.
#[inline]
pub(crate) fn passed<const ORDER: i32>(eta: f64) -> Potentials<f64> {
    match ORDER {
        1 => Potentials {
            a_upper: -0.5,
            ..Potentials::default()
        },
        2 => Potentials {
            a_upper: -0.5 * eta,
            a_lower: -0.5,
            g_upper: -0.25,
            g_lower: 0.0,
        },
        _ => Potentials::default(),
    }
}

/// d/d eta of (a3, a2, b3/r, b2/r); the inverse roots are those of the fronts.
#[inline]
fn hertz_slopes(eta: f64, r: f64, phi: [f64; 2], q: [f64; 2]) -> Potentials<f64> {
    let scale = 0.75 / PI;
    let ring = scale / (r * r);
    let inverse = q.map(|q| if q > 0.0 { 1.0 / q } else { 0.0 });
    let (m0, m1) = (phi[1] - phi[0], q[0] - q[1]);
    let m2 = 0.5 * (r * r * m0 - (eta + 1.0) * q[1] + (eta - 1.0) * q[0]);
    Potentials {
        a_upper: scale * (m1 - eta * m0),
        a_lower: scale * (inverse[0] + inverse[1] - m0),
        g_upper: ring * (eta * m1 - m2),
        g_lower: ring * ((eta + 1.0) * inverse[1] + (eta - 1.0) * inverse[0] - m1),
    }
}

/// The chord integrals of a Hertz disc between s = eta - 1 and eta + 1, from phi and q at both ends.
///
/// Any pair of functions with phi' = 1/q, q' = -s/q, q^2 = r^2 - s^2 may stand for phi and q: the result is
/// linear in them. With real eta and the held values it is the compact part, with complex eta,
/// phi = -i log(zeta + rho) and q = rho it is the whole potential up to a polynomial.
#[inline]
pub(crate) fn chord_primitives<const ORDER: i32, T: Scalar>(
    eta: T,
    r: f64,
    phi: [T; 2],
    q: [T; 2],
) -> Potentials<T> {
    let r2 = r * r;
    let scale = 0.375 / PI;
    let ring = scale / r2;
    let one = T::from(1.0);
    let s = [eta - one, eta + one];
    let inside = (one - eta) * (one + eta);
    let sq = [s[0] * q[0], s[1] * q[1]];
    // int ds {1, s, s^2, s^3}/q
    let m0 = phi[1] - phi[0];
    let m1 = q[0] - q[1];
    let m2 = (m0 * r2 - sq[1] + sq[0]) * 0.5;
    // q^3 = q (r^2 - s^2)
    let cube = [q[0] * r2 - s[0] * sq[0], q[1] * r2 - s[1] * sq[1]];
    let cubes = (cube[1] - cube[0]) * (1.0 / 3.0);
    let m3 = m1 * r2 + cubes;
    let twice = eta + eta;
    let a3 = (inside * m0 + twice * m1 - m2) * scale;
    let b3 = (m3 - inside * m1 - twice * m2) * ring;
    if ORDER == 0 {
        return Potentials {
            a_upper: a3,
            a_lower: (m1 - eta * m0) * (2.0 * scale),
            g_upper: b3,
            g_lower: (m2 - eta * m1) * (2.0 * ring),
        };
    }
    // int ds {1, s, s^2} phi, and int ds {1, s, s^2} q
    let sphi = [s[0] * phi[0], s[1] * phi[1]];
    let ssphi = [s[0] * sphi[0], s[1] * sphi[1]];
    let p0 = sphi[1] - sphi[0] - m1;
    let p1 = (ssphi[1] - ssphi[0] - m2) * 0.5;
    let cubic_phi = [s[0] * ssphi[0], s[1] * ssphi[1]];
    let p2 = (cubic_phi[1] - cubic_phi[0] - m3) * (1.0 / 3.0);
    let c0 = (sq[1] - sq[0] + m0 * r2) * 0.5;
    let scube = [s[0] * cube[0], s[1] * cube[1]];
    let c2 = (c0 * r2 - scube[1] + scube[0]) * 0.25;
    let a4 = (inside * p0 + twice * p1 - p2) * scale;
    let b4 = (inside * c0 - twice * cubes - c2) * ring;
    if ORDER == 1 {
        return Potentials {
            a_upper: a4,
            a_lower: a3,
            g_upper: b4,
            g_lower: b3,
        };
    }
    // int phi = s phi + q and int q = (s q + r^2 phi)/2, once more
    let s2q = [s[0] * sq[0], s[1] * sq[1]];
    let m4 = (m2 * (3.0 * r2) - s[1] * s2q[1] + s[0] * s2q[0]) * 0.25;
    let p3 = (s[1] * cubic_phi[1] - s[0] * cubic_phi[0] - m4) * 0.25;
    let c1 = (cube[0] - cube[1]) * (1.0 / 3.0);
    // q^5 = q^3 (r^2 - s^2)
    let fifth = [0, 1].map(|i| cube[i] * r2 - s[i] * scube[i]);
    let c3 = ((fifth[0] - fifth[1]) * 0.4 - s[1] * scube[1] + s[0] * scube[0]) * (1.0 / 3.0);
    let (d0, d1, d2) = (c1 + p0 * r2, c2 + p1 * r2, c3 + p2 * r2);
    Potentials {
        a_upper: (inside * (p1 + c0) + twice * (p2 + c1) - (p3 + c2)) * scale,
        a_lower: a4,
        g_upper: (inside * d0 + twice * d1 - d2) * (0.5 * ring),
        g_lower: b4,
    }
}

/// Real or complex numbers.
pub(crate) trait Scalar:
    Copy
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
{
}

impl Scalar for f64 {}
impl Scalar for Complex64 {}

/// The limit r = 0, where the circle shrinks to a point of the chord.
#[inline]
fn hertz_on_axis<const ORDER: i32>(eta: f64) -> Potentials<f64> {
    if eta >= 1.0 {
        return Potentials::default();
    }
    if eta <= -1.0 {
        return passed::<ORDER>(eta);
    }
    let square = eta * eta;
    let inside = 1.0 - square;
    let a3 = 0.375 * inside;
    let b3 = -0.375 * eta;
    let a4 = 0.375 * eta * (1.0 - square / 3.0) - 0.25;
    let b4 = 0.1875 * inside;
    match ORDER {
        0 => Potentials {
            a_upper: a3,
            a_lower: -0.75 * eta,
            g_upper: b3,
            g_lower: 0.375,
        },
        1 => Potentials {
            a_upper: a4,
            a_lower: a3,
            g_upper: b4,
            g_lower: b3,
        },
        _ => Potentials {
            a_upper: 0.1875 * square * (1.0 - square / 6.0) - 0.25 * eta + 0.09375,
            a_lower: a4,
            g_upper: 0.1875 * eta * (1.0 - square / 3.0) - 0.125,
            g_lower: b4,
        },
    }
}

#[inline]
fn punch<const ORDER: i32>(eta: f64, r: f64) -> Potentials<f64> {
    let (s1, s2) = (eta - 1.0, eta + 1.0);
    let ((phi1, q1), (phi2, q2)) = (circle(eta, -1.0, r), circle(eta, 1.0, r));
    let scale = 0.25 / PI;
    let ring = scale / (r * r);
    let a3 = scale * (phi2 - phi1);
    let b3 = ring * (q2 - q1);
    if ORDER == 0 {
        let inverse = |q: f64| if q > 0.0 { 1.0 / q } else { 0.0 };
        let (v1, v2) = (inverse(q1), inverse(q2));
        Potentials {
            a_upper: a3,
            a_lower: scale * (v2 - v1),
            g_upper: b3,
            g_lower: ring * (s2 * v2 - s1 * v1),
        }
    } else {
        let sq = s2 * q2 - s1 * q1;
        Potentials {
            a_upper: scale * (s2 * phi2 - s1 * phi1 + q2 - q1) - 0.25,
            a_lower: a3,
            g_upper: ring * 0.5 * (sq + r * r * (phi2 - phi1)),
            g_lower: b3,
        }
    }
}

#[inline]
fn point<const ORDER: i32>(eta: f64, r: f64) -> Potentials<f64> {
    let (phi, q) = circle(eta, 0.0, r);
    let scale = 0.5 / PI;
    let ring = scale / (r * r);
    let inverse = if q > 0.0 { 1.0 / q } else { 0.0 };
    let a3 = scale * inverse;
    let b3 = -ring * eta * inverse;
    if ORDER == 0 {
        let cube = inverse * inverse * inverse;
        Potentials {
            a_upper: a3,
            a_lower: scale * eta * cube,
            g_upper: b3,
            g_lower: ring * r * r * cube,
        }
    } else {
        Potentials {
            a_upper: scale * phi - 0.25,
            a_lower: a3,
            g_upper: ring * q,
            g_lower: b3,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::potential::potentials;

    /// The parts named in the module text, taken from the complex potentials.
    #[test]
    fn agrees_with_the_complex_potentials() {
        for profile in [Profile::Hertz, Profile::Punch] {
            for r in [1e-6, 0.2, 0.9, 1.001, 1.7, 4.0] {
                for i in -60..=60 {
                    let eta = 0.097 * f64::from(i);
                    let xi = Complex64::new(0.0, eta);
                    let (full0, full1) = (
                        potentials::<0>(profile, xi, r),
                        potentials::<1>(profile, xi, r),
                    );
                    let (c0, c1) = (compact::<0>(profile, eta, r), compact::<1>(profile, eta, r));
                    let pairs = [
                        (c0.a_upper, full0.a_upper.re),
                        (c0.a_lower, full0.a_lower.im),
                        (c0.g_upper, full0.g_upper.im),
                        (c0.g_lower, full0.g_lower.re),
                        (c1.a_upper + 0.25, -full1.a_upper.im),
                        (c1.a_lower, full1.a_lower.re),
                        (c1.g_upper, full1.g_upper.re),
                        (c1.g_lower, full1.g_lower.im),
                    ];
                    for (j, (a, b)) in pairs.into_iter().enumerate() {
                        let noise = 1e-13 * (1.0 + 1e-2 / r + b.abs());
                        assert!(
                            (a - b).abs() < noise,
                            "{profile:?} r {r} eta {eta} #{j}: {a} {b}"
                        );
                    }
                }
            }
        }
    }
}
