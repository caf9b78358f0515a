//! The integrals over wave number k in closed form.
//!
//! ```text
//! A_n(xi; r) = int_0^inf Z_H(k) k^{3-n} J0(kr) e^{-k xi} dk      (B_n: J1),   Re xi >= 0
//! ```
//!
//! With the chord function h of the profile, A_n = int h(sigma) E_{n-3}(xi - i sigma) dsigma, where
//! E_n(zeta) = int k^{-n} J0(kr) e^{-k zeta} dk is elementary (n > 0: the antiderivative chain
//! E_n' = -E_{n-1}). The chord integral is done in closed form by parts when xi is near the chord,
//! and by a short Gauss rule when it is far, where the closed form is a difference of large numbers.
//! B_n is carried as B_n/r, which is smooth at r = 0.
//!
//! Theory: `docs/theory.md` (T12 to T14).

use crate::numeric::complex::{inside, logarithm, reciprocal, root_inside, times_i, times_minus_i};
use crate::potentials::Potentials;
use crate::potentials::chord_integral::{chord_primitives, from_primitives};
use crate::potentials::end::{End, end_orders};
use crate::potentials::far_front;
use crate::potentials::multipole;
use crate::potentials::order::{IMPULSE, STEP};
use crate::profile::Profile;
use num_complex::Complex64;
use std::f64::consts::PI;

/// Below this radius the primitives, which are divided by r^2, lose digits.
pub(crate) const SMALL_RADIUS: f64 = 0.15;

/// The potentials at xi (Re xi >= 0) and radius r.
#[inline]
pub(crate) fn potentials<const N: i32>(
    profile: Profile,
    xi: Complex64,
    r: f64,
) -> Potentials<Complex64> {
    if profile == Profile::Point {
        return end_orders::<N>(xi, r).map(|v| v / (2.0 * PI));
    }
    match multipole::terms(xi, r, multipole::nearest::<N>(r)) {
        Some(terms) => multipole::multipole::<N>(profile, terms, xi, r),
        None if N == STEP && profile == Profile::Hertz && r > far_front::FAR => at_far_front(xi, r),
        None if N != IMPULSE && profile == Profile::Hertz && r > SMALL_RADIUS => {
            if xi.re == 0.0 {
                on_imaginary_axis::<N>(xi.im, r)
            } else {
                by_primitives::<N>(xi, r)
            }
        }
        None => by_parts::<N>(profile, xi, r),
    }
}

/// The step response of a distant point, xi = d + i eta; the potentials of the conjugate are conjugate.
fn at_far_front(xi: Complex64, r: f64) -> Potentials<Complex64> {
    let delta = far_front::delta(xi.im, r);
    let psi = far_front::potentials(delta.map(|re| Complex64::new(re, xi.re)), r);
    if xi.im < 0.0 {
        psi.map(|v| v.conj())
    } else {
        psi
    }
}

/// The Hertz disc from the chord primitives, phi = -i L and q = rho in the variable eta = -i xi.
fn by_primitives<const N: i32>(xi: Complex64, r: f64) -> Potentials<Complex64> {
    let zeta = [1.0, -1.0].map(|sigma| Complex64::new(xi.re, xi.im - sigma));
    let inside = inside(xi.im, r);
    let rho = [0, 1].map(|i| root_inside(zeta[i], inside[i]));
    let sum = [zeta[0] + rho[0], zeta[1] + rho[1]];
    let eta = times_minus_i(xi);
    // The step response needs only the difference of phi.
    let phi = if N == STEP {
        [
            Complex64::default(),
            times_minus_i(logarithm(sum[1] * reciprocal(sum[0]))),
        ]
    } else {
        sum.map(|sum| times_minus_i(logarithm(sum)))
    };
    let psi = chord_primitives::<N, Complex64>(eta, r, phi, rho);
    from_primitives::<N, Complex64>(psi, eta, r, times_i)
}

/// The same on the imaginary axis, where real and imaginary part separate into real functions.
fn on_imaginary_axis<const N: i32>(eta: f64, r: f64) -> Potentials<Complex64> {
    let s = [eta - 1.0, eta + 1.0];
    let inside = inside(eta, r);
    // Re: phi and q held at their value on the circle outside it
    let re = if N == STEP && eta.abs() >= 1.0 + r {
        Potentials::default()
    } else {
        let phi = s.map(|s| (s / r).clamp(-1.0, 1.0).asin());
        let q = inside.map(|square| square.max(0.0).sqrt());
        chord_primitives::<N, f64>(eta, r, phi, q)
    };
    // Im: -log|zeta + rho| and Im rho, held inside the circle
    let w = [0, 1].map(|i| (-inside[i]).max(0.0).sqrt().copysign(s[i]));
    let modulus = [0, 1].map(|i| s[i].abs().max(r) + w[i].abs());
    let log = if N == STEP {
        [0.0, (modulus[0] / modulus[1]).ln()]
    } else {
        modulus.map(|modulus| -modulus.ln())
    };
    let im = chord_primitives::<N, f64>(eta, r, log, w);
    let psi = re.zip(im, Complex64::new);
    from_primitives::<N, Complex64>(psi, eta.into(), r, times_i)
}

fn by_parts<const N: i32>(profile: Profile, xi: Complex64, r: f64) -> Potentials<Complex64> {
    let upper = End::new(Complex64::new(xi.re, xi.im - 1.0), r);
    let lower = End::new(Complex64::new(xi.re, xi.im + 1.0), r);
    let m = N;
    // (X - Y)/(2 i)
    let half_difference = |x: Complex64, y: Complex64| Complex64::new(0.0, -0.5) * (x - y);
    match profile {
        Profile::Hertz => {
            let scale = 1.5 / PI;
            let (e3, e2, e1) = (3 + m, 2 + m, 1 + m);
            let combine = |outer: [Complex64; 2], inner: [Complex64; 2]| {
                scale * (half_difference(outer[0], outer[1]) - 0.5 * (inner[0] + inner[1]))
            };
            let e = |n| [upper.e(n), lower.e(n)];
            let f = |n| [upper.f(n), lower.f(n)];
            let (e_mid, f_mid) = (e(e2), f(e2));
            Potentials {
                a_upper: combine(e(e3), e_mid),
                a_lower: combine(e_mid, e(e1)),
                g_upper: combine(f(e3), f_mid),
                g_lower: combine(f_mid, f(e1)),
            }
        }
        Profile::Punch | Profile::Point => {
            let scale = 0.5 / PI;
            let a = |n| scale * half_difference(upper.e(n), lower.e(n));
            let g = |n| scale * half_difference(upper.f(n), lower.f(n));
            Potentials {
                a_upper: a(1 + m),
                a_lower: a(m),
                g_upper: g(1 + m),
                g_lower: g(m),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::potentials::order::{IMPULSE, STEP, STEP_INTEGRAL};

    /// d/dxi of order n + 1 is minus order n: A_{n+1}(xi + h) - A_{n+1}(xi - h) = -2 h A_n.
    #[test]
    fn orders_form_an_antiderivative_chain() {
        let h = 1e-4;
        for profile in [Profile::Hertz, Profile::Punch, Profile::Point] {
            for r in [0.0, 1e-7, 0.3, 1.0, 2.5, 17.0] {
                for (x, y) in [
                    (0.7, 0.2),
                    (0.05, 3.3),
                    (2.0, -1.5),
                    (9.0, 40.0),
                    (0.3, -70.0),
                ] {
                    let xi = Complex64::new(x, y);
                    let here = potentials::<STEP>(profile, xi, r);
                    let ahead = potentials::<STEP_INTEGRAL>(profile, xi + h, r);
                    let behind = potentials::<STEP_INTEGRAL>(profile, xi - h, r);
                    let check = |a: Complex64, b: Complex64, value: Complex64| {
                        let slope = -(a - b) / (2.0 * h);
                        let tolerance = 1e-4 * value.norm() + 1e-10;
                        assert!(
                            (slope - value).norm() < tolerance,
                            "{profile:?} {r} {xi}: {slope} {value}"
                        );
                    };
                    check(ahead.a_upper, behind.a_upper, here.a_upper);
                    check(ahead.a_lower, behind.a_lower, here.a_lower);
                    check(ahead.g_upper, behind.g_upper, here.g_upper);
                    check(ahead.g_lower, behind.g_lower, here.g_lower);
                }
            }
        }
    }

    /// The three closed forms agree where they overlap.
    #[test]
    fn primitives_agree_with_integration_by_parts() {
        for r in [0.06, 0.4, 1.0, 3.0] {
            for (x, y) in [
                (0.0, 0.4),
                (0.0, -2.5),
                (0.0, 3.9),
                (0.7, 0.2),
                (2.5, 3.0),
                (0.3, -3.0),
            ] {
                let xi = Complex64::new(x, y);
                let pairs = [
                    (
                        potentials::<STEP>(Profile::Hertz, xi, r),
                        by_parts::<STEP>(Profile::Hertz, xi, r),
                    ),
                    (
                        potentials::<STEP_INTEGRAL>(Profile::Hertz, xi, r),
                        by_parts::<STEP_INTEGRAL>(Profile::Hertz, xi, r),
                    ),
                ];
                for (a, b) in pairs {
                    let gap = a.zip(b, |a, b| a - b).into_array();
                    assert!(
                        gap.iter()
                            .all(|g| g.norm() < 1e-15 * (20.0 + 10.0 / (r * r))),
                        "{r} {xi}: {gap:?}"
                    );
                }
            }
        }
    }

    /// Where both are good, the closed form and the multipole series agree.
    #[test]
    fn closed_form_agrees_with_the_multipole_series() {
        for profile in [Profile::Hertz, Profile::Punch] {
            for r in [0.0, 1e-9, 0.4, 1.0, 3.0] {
                for (x, y) in [(7.0, 0.4), (2.5, 12.0), (0.0, -11.0), (0.0, 13.5)] {
                    let xi = Complex64::new(x, y);
                    let pairs = [
                        (
                            by_parts::<STEP>(profile, xi, r),
                            multipole::multipole::<STEP>(profile, 9, xi, r),
                        ),
                        (
                            by_parts::<STEP_INTEGRAL>(profile, xi, r),
                            multipole::multipole::<STEP_INTEGRAL>(profile, 9, xi, r),
                        ),
                        (
                            by_parts::<IMPULSE>(profile, xi, r),
                            multipole::multipole::<IMPULSE>(profile, 9, xi, r),
                        ),
                    ];
                    for (order, (closed, series)) in pairs.into_iter().enumerate() {
                        for (a, b) in closed.zip(series, |a, b| (a, b)).into_array() {
                            assert!(
                                (a - b).norm() < 2e-12,
                                "{profile:?} #{order} {r} {xi}: {a} {b}"
                            );
                        }
                    }
                }
            }
        }
    }

    /// Where both are good, the series at a distant front agrees with integration by parts.
    #[test]
    fn the_far_front_agrees_with_integration_by_parts() {
        for r in [26.0, 40.0, 90.0] {
            for d in [0.0, 1e-3, 0.4, 3.0] {
                for i in -40..=40 {
                    let eta = r + 0.217 * f64::from(i);
                    for xi in [Complex64::new(d, eta), Complex64::new(d, -eta)] {
                        let found = at_far_front(xi, r).into_array();
                        let expected = by_parts::<STEP>(Profile::Hertz, xi, r).into_array();
                        for (a, b) in found.into_iter().zip(expected) {
                            let gap = (a - b).norm();
                            assert!(gap < 1e-15 * r * r, "{r} {xi}: {a} {b}");
                        }
                    }
                }
            }
        }
    }
}
