//! The potentials on the imaginary axis, xi = i eta: the parts that obey causality.
//!
//! For slownesses below one the kernels use only the real part of A_3(i eta) and B_2(i eta) and the
//! imaginary part of A_2(i eta) and B_3(i eta). These vanish for |eta| > radius + r: there is no effect before the
//! front from the nearest edge of the disc, nor after the front from the farthest edge.
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
//! and so on. The constants of the antiderivatives a4, a5 and b5 are chosen so that they vanish before the arrival.
//!
//! Theory: `docs/theory.md` (T17).

use crate::numeric::scalar::{Complex, Real, inside};
use crate::potentials::chord_integral::{angle_between, held_primitives};
use crate::potentials::far_front::{self, FAR_RADIUS};
use crate::potentials::multipole::{self, Reach};
use crate::potentials::{IMPULSE, Order, Potentials, STEP, STEP_INTEGRAL};
use crate::profile::Profile;
use std::f64::consts::PI;

/// Radius below which a point counts as on the axis.
const AXIS: f64 = 1e-13;

/// The compact parts at eta: (a3, a2, b3/r, b2/r) of the step response, (a4, a3, b4/r, b3/r) of its integral.
///
/// For the impulse response they are the derivatives of those of the step response; for profiles other than Hertz only
/// the upper ones, for displacements.
#[inline(always)]
pub(crate) fn compact<const N: i32, T: Real>(
    profile: Profile,
    eta: T,
    (r, digits): (f64, f64),
) -> Potentials<T> {
    match profile {
        Profile::Hertz if N == IMPULSE => hertz_impulse(eta, r),
        Profile::Punch | Profile::Point if N == IMPULSE => {
            displacement_impulse(compact::<STEP, T>(profile, eta, (r, digits)))
        }
        Profile::Hertz if r < AXIS => hertz_on_axis::<N, T>(eta),
        Profile::Hertz if N == STEP && r > FAR_RADIUS => hertz_far(eta, (r, digits)),
        Profile::Hertz => {
            let mut psi = held_primitives::<N, T>(eta, r, inside(eta, r));
            if N == STEP_INTEGRAL {
                psi.a_upper = psi.a_upper + BEFORE;
            }
            psi
        }
        Profile::Punch => punch::<N, T>(eta, r),
        Profile::Point => point::<N, T>(eta, r),
    }
}

/// The compact parts of the integral of the step response after the wave has passed, below minus the reach of the disc.
pub(crate) const PASSED: Potentials<f64> = Potentials {
    a_upper: -0.5,
    a_lower: 0.0,
    g_upper: 0.0,
    g_lower: 0.0,
};

/// Constant that makes a potential of the integral vanish before the arrival.
const BEFORE: f64 = -0.25;

/// 1/q, and zero where the circle is not reached.
#[inline(always)]
fn inverse<T: Real>(q: T) -> T {
    let zero = q.constant(0.0);
    zero.where_below(q, q.constant(1.0) / q, zero)
}

/// The limit r = 0, where the circle shrinks to a point of the chord.
#[inline(always)]
fn hertz_on_axis<const N: i32, T: Real>(eta: T) -> Potentials<T> {
    let (zero, one) = (eta.constant(0.0), eta.constant(1.0));
    let size = eta.abs();
    let within = size.where_below(one, eta, zero);
    let a3 = size.where_below(one, (one - within * within) * 0.375, zero);
    match Order::of(N) {
        Order::Step => Potentials {
            a_upper: a3,
            a_lower: within * -0.75,
            g_upper: within * -0.375,
            g_lower: size.where_below(one, one * 0.375, zero),
        },
        Order::StepIntegral => {
            let held = size.where_below(one, eta, one.copysign(eta));
            Potentials {
                a_upper: (one - held * held * (1.0 / 3.0)) * held * 0.375 + BEFORE,
                a_lower: a3,
                g_upper: a3 * 0.5,
                g_lower: within * -0.375,
            }
        }
        Order::Impulse => unreachable!("impulses on the axis are extrapolated from points near it"),
    }
}

/// The step response at a distant point.
#[inline(always)]
fn hertz_far<T: Real>(eta: T, (r, digits): (f64, f64)) -> Potentials<T> {
    let zero = eta.constant(0.0);
    let distance = eta.abs();
    let reach = Reach::new::<STEP>(T::Complex::new(zero, distance), r);
    let mut psi = Potentials::all(T::Complex::new(zero, zero));
    if reach.some_near {
        let near = far_front::compact(eta, (r, digits));
        psi = Potentials {
            a_upper: T::Complex::new(near.a_upper, zero),
            a_lower: T::Complex::new(zero, near.a_lower),
            g_upper: T::Complex::new(zero, near.g_upper),
            g_lower: T::Complex::new(near.g_lower, zero),
        };
    }
    if reach.some_far {
        let far = multipole::on_imaginary_axis(Profile::Hertz, distance, (r, digits));
        psi = reach.pick(psi, far);
    }
    let (a2, b3) = (psi.a_lower.im(), psi.g_upper.im());
    // both are odd
    Potentials {
        a_upper: psi.a_upper.re(),
        a_lower: eta.where_below(zero, -a2, a2),
        g_upper: eta.where_below(zero, -b3, b3),
        g_lower: psi.g_lower.re(),
    }
}

/// d/d eta of (a3, a2, b3/r, b2/r); the inverse roots are those of the fronts.
#[inline(always)]
fn hertz_impulse<T: Real>(eta: T, r: f64) -> Potentials<T> {
    let scale = 0.75 / PI;
    let ring = scale / (r * r);
    let s = [eta - 1.0, eta + 1.0];
    let inside = inside(eta, r);
    let q = [inside[0].held_root(), inside[1].held_root()];
    let over = [inverse(q[0]), inverse(q[1])];
    let (m0, m1) = (angle_between(s, q), q[0] - q[1]);
    let m2 = (m0 * (r * r) - s[1] * q[1] + s[0] * q[0]) * 0.5;
    Potentials {
        a_upper: (m1 - eta * m0) * scale,
        a_lower: (over[0] + over[1] - m0) * scale,
        g_upper: (eta * m1 - m2) * ring,
        g_lower: (s[1] * over[1] + s[0] * over[0] - m1) * ring,
    }
}

/// a3' = a2 and b3' = -b2.
#[inline(always)]
fn displacement_impulse<T: Real>(step: Potentials<T>) -> Potentials<T> {
    let zero = step.a_lower.constant(0.0);
    Potentials {
        a_upper: step.a_lower,
        a_lower: zero,
        g_upper: -step.g_lower,
        g_lower: zero,
    }
}

#[inline(always)]
fn punch<const N: i32, T: Real>(eta: T, r: f64) -> Potentials<T> {
    let scale = 0.25 / PI;
    let ring = scale / (r * r);
    let s = [eta - 1.0, eta + 1.0];
    let inside = inside(eta, r);
    let q = [inside[0].held_root(), inside[1].held_root()];
    let angle = angle_between(s, q);
    let (a3, b3) = (angle * scale, (q[1] - q[0]) * ring);
    match Order::of(N) {
        Order::Step => {
            let over = [inverse(q[0]), inverse(q[1])];
            Potentials {
                a_upper: a3,
                a_lower: (over[1] - over[0]) * scale,
                g_upper: b3,
                g_lower: (s[1] * over[1] - s[0] * over[0]) * ring,
            }
        }
        Order::StepIntegral => {
            let phi = [s[0].angle_over(q[0]), s[1].angle_over(q[1])];
            let sphi = s[1] * phi[1] - s[0] * phi[0];
            let sq = s[1] * q[1] - s[0] * q[0];
            Potentials {
                a_upper: (sphi + q[1] - q[0]) * scale + BEFORE,
                a_lower: a3,
                g_upper: (sq + angle * (r * r)) * (ring * 0.5),
                g_lower: b3,
            }
        }
        Order::Impulse => unreachable!("{BY_STEP}"),
    }
}

#[inline(always)]
fn point<const N: i32, T: Real>(eta: T, r: f64) -> Potentials<T> {
    let scale = 0.5 / PI;
    let ring = scale / (r * r);
    let q = ((-eta + r) * (eta + r)).held_root();
    let over = inverse(q);
    let (a3, b3) = (over * scale, eta * over * -ring);
    match Order::of(N) {
        Order::Step => {
            let cube = over * over * over;
            Potentials {
                a_upper: a3,
                a_lower: eta * cube * scale,
                g_upper: b3,
                g_lower: cube * (ring * r * r),
            }
        }
        Order::StepIntegral => Potentials {
            a_upper: eta.angle_over(q) * scale + BEFORE,
            a_lower: a3,
            g_upper: q * ring,
            g_lower: b3,
        },
        Order::Impulse => unreachable!("{BY_STEP}"),
    }
}

/// Reason why an order does not occur here.
const BY_STEP: &str = "impulses of other profiles than Hertz follow from their steps";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::potentials::closed_form::of_one;
    use crate::potentials::far_front::ROUNDING_DIGITS;
    use num_complex::Complex64;

    /// The parts named in the module text, taken from the complex potentials.
    #[test]
    fn agrees_with_the_complex_potentials() {
        for profile in [Profile::Hertz, Profile::Punch] {
            for r in [1e-6, 0.2, 0.9, 1.001, 1.7, 4.0, 30.0] {
                for i in -60..=60 {
                    // also around the front
                    let eta = 0.097 * f64::from(i) + if r > 5.0 { r } else { 0.0 };
                    let xi = Complex64::new(0.0, eta);
                    let (full0, full1) = (
                        of_one::<STEP>(profile, xi, r),
                        of_one::<STEP_INTEGRAL>(profile, xi, r),
                    );
                    let (c0, c1) = (
                        compact::<STEP, _>(profile, eta, (r, ROUNDING_DIGITS)),
                        compact::<STEP_INTEGRAL, _>(profile, eta, (r, ROUNDING_DIGITS)),
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
