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
//!
//! Theory: `docs/theory.md` (T17).

use crate::potentials::Potentials;
use crate::potentials::chord_integral::chord_primitives;
use crate::potentials::far_front;
use crate::potentials::multipole;
use crate::potentials::order::{Order, STEP, STEP_INTEGRAL};
use crate::profile::Profile;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI};

/// Radius below which a point is on the axis as far as rounding goes.
pub(crate) const AXIS: f64 = 1e-13;

/// Why an order is not met here.
const HERTZ_ONLY: &str = "impulse responses are refused for other profiles than Hertz";

/// The compact parts at eta: (a3, a2, b3/r, b2/r) of the step response, (a4, a3, b4/r, b3/r) of its integral.
///
/// Of the Hertz profile also the derivatives of those of the step response, for the impulse response.
#[inline]
pub(crate) fn compact<const N: i32>(profile: Profile, eta: f64, r: f64) -> Potentials<f64> {
    match profile {
        Profile::Hertz => match Order::of(N) {
            Order::Impulse => hertz_impulse(eta, r),
            Order::StepIntegral if r < AXIS => hertz_integral_on_axis(eta),
            Order::Step if r > far_front::FAR => hertz_far(eta, r),
            Order::Step | Order::StepIntegral => hertz::<N>(eta, r),
        },
        Profile::Punch => punch::<N>(eta, r),
        Profile::Point => point::<N>(eta, r),
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
fn hertz<const N: i32>(eta: f64, r: f64) -> Potentials<f64> {
    let ((phi1, q1), (phi2, q2)) = (circle(eta, -1.0, r), circle(eta, 1.0, r));
    let mut psi = chord_primitives::<N, f64>(eta, r, [phi1, phi2], [q1, q2]);
    // measured from their values before the arrival
    if N == STEP_INTEGRAL {
        psi.a_upper -= 0.25;
    }
    psi
}

/// The step response of a distant point.
fn hertz_far(eta: f64, r: f64) -> Potentials<f64> {
    let distance = eta.abs();
    if distance >= r + 1.0 {
        return Potentials::default();
    }
    let psi = match multipole::terms(Complex64::new(0.0, distance), r, 10.0) {
        Some(terms) => {
            let xi = Complex64::new(0.0, distance);
            let psi = multipole::multipole::<STEP>(Profile::Hertz, terms, xi, r);
            Potentials {
                a_upper: psi.a_upper.re,
                a_lower: psi.a_lower.im,
                g_upper: psi.g_upper.im,
                g_lower: psi.g_lower.re,
            }
        }
        None => far_front::compact(far_front::delta(eta, r), r),
    };
    // a2 and b3 are odd
    let sign = 1.0_f64.copysign(eta);
    Potentials {
        a_lower: sign * psi.a_lower,
        g_upper: sign * psi.g_upper,
        ..psi
    }
}

/// The compact parts of the integral of the step response after the wave has passed, below minus the reach of the disc.
pub(crate) const PASSED: Potentials<f64> = Potentials {
    a_upper: -0.5,
    a_lower: 0.0,
    g_upper: 0.0,
    g_lower: 0.0,
};

/// d/d eta of (a3, a2, b3/r, b2/r); the inverse roots are those of the fronts.
#[inline]
fn hertz_impulse(eta: f64, r: f64) -> Potentials<f64> {
    let ((phi1, q1), (phi2, q2)) = (circle(eta, -1.0, r), circle(eta, 1.0, r));
    let (phi, q) = ([phi1, phi2], [q1, q2]);
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

/// The limit r = 0 of the integral of the step response, where the circle shrinks to a point of the chord.
///
/// The step response itself is [`side_by_side`](crate::integral::side_by_side) there.
#[inline]
fn hertz_integral_on_axis(eta: f64) -> Potentials<f64> {
    if eta >= 1.0 {
        return Potentials::default();
    }
    if eta <= -1.0 {
        return PASSED;
    }
    let square = eta * eta;
    let inside = 1.0 - square;
    Potentials {
        a_upper: 0.375 * eta * (1.0 - square / 3.0) - 0.25,
        a_lower: 0.375 * inside,
        g_upper: 0.1875 * inside,
        g_lower: -0.375 * eta,
    }
}

#[inline]
fn punch<const N: i32>(eta: f64, r: f64) -> Potentials<f64> {
    let (s1, s2) = (eta - 1.0, eta + 1.0);
    let ((phi1, q1), (phi2, q2)) = (circle(eta, -1.0, r), circle(eta, 1.0, r));
    let scale = 0.25 / PI;
    let ring = scale / (r * r);
    let a3 = scale * (phi2 - phi1);
    let b3 = ring * (q2 - q1);
    match Order::of(N) {
        Order::Step => {
            let inverse = |q: f64| if q > 0.0 { 1.0 / q } else { 0.0 };
            let (v1, v2) = (inverse(q1), inverse(q2));
            Potentials {
                a_upper: a3,
                a_lower: scale * (v2 - v1),
                g_upper: b3,
                g_lower: ring * (s2 * v2 - s1 * v1),
            }
        }
        Order::StepIntegral => {
            let sq = s2 * q2 - s1 * q1;
            Potentials {
                a_upper: scale * (s2 * phi2 - s1 * phi1 + q2 - q1) - 0.25,
                a_lower: a3,
                g_upper: ring * 0.5 * (sq + r * r * (phi2 - phi1)),
                g_lower: b3,
            }
        }
        Order::Impulse => unreachable!("{HERTZ_ONLY}"),
    }
}

#[inline]
fn point<const N: i32>(eta: f64, r: f64) -> Potentials<f64> {
    let (phi, q) = circle(eta, 0.0, r);
    let scale = 0.5 / PI;
    let ring = scale / (r * r);
    let inverse = if q > 0.0 { 1.0 / q } else { 0.0 };
    let a3 = scale * inverse;
    let b3 = -ring * eta * inverse;
    match Order::of(N) {
        Order::Step => {
            let cube = inverse * inverse * inverse;
            Potentials {
                a_upper: a3,
                a_lower: scale * eta * cube,
                g_upper: b3,
                g_lower: ring * r * r * cube,
            }
        }
        Order::StepIntegral => Potentials {
            a_upper: scale * phi - 0.25,
            a_lower: a3,
            g_upper: ring * q,
            g_lower: b3,
        },
        Order::Impulse => unreachable!("{HERTZ_ONLY}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::potentials::closed_form::potentials;

    /// The parts named in the module text, taken from the complex potentials.
    #[test]
    fn agrees_with_the_complex_potentials() {
        for profile in [Profile::Hertz, Profile::Punch] {
            for r in [1e-6, 0.2, 0.9, 1.001, 1.7, 4.0, 30.0] {
                for i in -60..=60 {
                    // about the front, too
                    let eta = 0.097 * f64::from(i) + if r > 5.0 { r } else { 0.0 };
                    let xi = Complex64::new(0.0, eta);
                    let (full0, full1) = (
                        potentials::<STEP>(profile, xi, r),
                        potentials::<STEP_INTEGRAL>(profile, xi, r),
                    );
                    let (c0, c1) = (
                        compact::<STEP>(profile, eta, r),
                        compact::<STEP_INTEGRAL>(profile, eta, r),
                    );
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
