//! The integrals over wave number k in closed form.
//!
//! ```text
//! A_n(xi; r) = int_0^inf Z_H(k) k^{3-n} J0(kr) e^{-k xi} dk      (B_n: J1),   Re xi >= 0
//! ```
//!
//! With the chord function h of the profile, A_n = int h(sigma) E_{n-3}(xi - i sigma) dsigma, where
//! E_n(zeta) = int k^{-n} J0(kr) e^{-k zeta} dk is elementary (n > 0: the antiderivative chain
//! E_n' = -E_{n-1}). The chord integral is done in closed form by parts when xi is near the chord,
//! and by a series when it is far, where the closed form is a difference of large numbers.
//! B_n is stored as B_n/r, which is smooth at r = 0.
//!
//! All functions work for single numbers and for registers; each number of a register is computed with the form that is
//! valid for it.
//!
//! Theory: `docs/theory.md` (T12 to T14).

use crate::numeric::scalar::{Complex, Real, Scalar, inside};
use crate::potentials::chord_integral::{chord_primitives, from_primitives, held_primitives};
use crate::potentials::end::End;
use crate::potentials::far_front::{self, FAR_RADIUS, ROUNDING_DIGITS};
use crate::potentials::multipole::{self, Reach};
use crate::potentials::{IMPULSE, Potentials, STEP};
use crate::profile::Profile;
use num_complex::Complex64;
use std::f64::consts::PI;

/// Below this radius the primitives, which are divided by r^2, lose digits.
pub(crate) const SMALL_RADIUS: f64 = 0.15;

/// The potentials at xi (Re xi >= 0) and radius r, with errors of exp(-`digits`); on the imaginary axis real and
/// imaginary part are computed separately.
#[inline(always)]
pub(crate) fn potentials<const N: i32, C: Complex>(
    profile: Profile,
    xi: C,
    (r, digits): (f64, f64),
    on_axis: bool,
) -> Potentials<C> {
    if profile == Profile::Point {
        return by_parts::<N, C>(profile, xi, r);
    }
    let reach = Reach::new::<N>(xi, r);
    let near = match profile {
        _ if !reach.some_near => Potentials::all(xi.constant(0.0)),
        Profile::Hertz if N == STEP && r > FAR_RADIUS => {
            far_front::of_disc(xi, (r, digits), on_axis)
        }
        Profile::Hertz if N != IMPULSE && r > SMALL_RADIUS => {
            if on_axis {
                primitives_on_imaginary_axis::<N, _>(xi.im(), r)
            } else {
                by_primitives::<N, C>(xi, r)
            }
        }
        Profile::Hertz | Profile::Punch | Profile::Point => by_parts::<N, C>(profile, xi, r),
    };
    if !reach.some_far {
        return near;
    }
    let far = if on_axis && N == STEP {
        multipole::on_imaginary_axis(profile, xi.im(), (r, digits))
    } else {
        multipole::potentials::<N, C>(profile, xi, (r, digits))
    };
    reach.pick(near, far)
}

/// The potentials at one xi, to the last digit.
pub(crate) fn of_one<const N: i32>(
    profile: Profile,
    xi: Complex64,
    r: f64,
) -> Potentials<Complex64> {
    potentials::<N, Complex64>(profile, xi, (r, ROUNDING_DIGITS), xi.re == 0.0)
}

/// The ends of the chord: zeta, rho and zeta + rho.
struct Ends<C> {
    zeta: [C; 2],
    rho: [C; 2],
    sum: [C; 2],
}

impl<C: Complex> Ends<C> {
    #[inline(always)]
    fn new(xi: C, r: f64) -> Self {
        let zeta = [
            C::new(xi.re(), xi.im() - 1.0),
            C::new(xi.re(), xi.im() + 1.0),
        ];
        let inside = inside(xi.im(), r);
        let rho = [
            zeta[0].root_inside(inside[0]),
            zeta[1].root_inside(inside[1]),
        ];
        let sum = [zeta[0] + rho[0], zeta[1] + rho[1]];
        Self { zeta, rho, sum }
    }

    /// The logarithms of the sums; for the step response only their difference matters, and the first may be zero.
    #[inline(always)]
    fn logarithms(&self, difference: bool) -> [C; 2] {
        let [first, second] = self.sum;
        if !difference {
            return [first.logarithm(), second.logarithm()];
        }
        let ratio = second * first.conj();
        let modulus = (second.norm_sqr() / first.norm_sqr()).ln() * 0.5;
        let angle = ratio.im().angle_over(ratio.re());
        [first.constant(0.0), C::new(modulus, angle)]
    }
}

/// The Hertz disc from the chord primitives, phi = -i L and q = rho in the variable eta = -i xi.
#[inline(always)]
fn by_primitives<const N: i32, C: Complex>(xi: C, r: f64) -> Potentials<C> {
    let ends = Ends::new(xi, r);
    let [first, second] = ends.logarithms(N == STEP);
    let phi = [first.times_minus_i(), second.times_minus_i()];
    let eta = xi.times_minus_i();
    let psi = chord_primitives::<N, C>(eta, r, phi, ends.rho);
    from_primitives::<N, C>(psi, eta, r)
}

/// As [`by_primitives`] on the imaginary axis, where real and imaginary part separate into real functions.
///
/// For the step response the real part vanishes outside the circle around the whole chord, and the imaginary part
/// inside the circle that contains the chord.
#[inline(always)]
fn primitives_on_imaginary_axis<const N: i32, T: Real>(eta: T, r: f64) -> Potentials<T::Complex> {
    let zero = eta.constant(0.0);
    let size = eta.abs();
    let inside = inside(eta, r);
    let re = if N == STEP && size.smallest() >= r + 1.0 {
        Potentials::all(zero)
    } else {
        held_primitives::<N, T>(eta, r, inside)
    };
    // -log|zeta + rho| and Im rho, held inside the circle
    let im = if N == STEP && size.largest() <= r - 1.0 {
        Potentials::all(zero)
    } else {
        let s = [eta - 1.0, eta + 1.0];
        let w = [(-inside[0]).held_root(), (-inside[1]).held_root()];
        let modulus = [s[0].abs().at_least(r) + w[0], s[1].abs().at_least(r) + w[1]];
        let log = if N == STEP {
            [zero, (modulus[0] / modulus[1]).ln()]
        } else {
            [-modulus[0].ln(), -modulus[1].ln()]
        };
        let w = [w[0].copysign(s[0]), w[1].copysign(s[1])];
        chord_primitives::<N, T>(eta, r, log, w)
    };
    let psi = re.zip(im, T::Complex::new);
    from_primitives::<N, T::Complex>(psi, T::Complex::new(eta, zero), r)
}

/// The potentials of a point force, or from the antiderivatives at both ends of the chord.
#[inline(always)]
fn by_parts<const N: i32, C: Complex>(profile: Profile, xi: C, r: f64) -> Potentials<C> {
    if profile == Profile::Point {
        let rho = off_front(xi.root_with_circle(r), r);
        let sum = xi + rho;
        let end = End::new(xi, rho, sum, sum.logarithm(), r);
        return Potentials {
            a_upper: end.e(N) * (0.5 / PI),
            a_lower: end.e(N - 1) * (0.5 / PI),
            g_upper: end.f(N) * (0.5 / PI),
            g_lower: end.f(N - 1) * (0.5 / PI),
        };
    }
    let ends = Ends::new(xi, r);
    let Ends { zeta, mut rho, sum } = ends;
    let [log0, log1] = ends.logarithms(N == STEP && profile == Profile::Punch);
    if N == IMPULSE || profile == Profile::Punch {
        rho = [off_front(rho[0], r), off_front(rho[1], r)];
    }
    let upper = End::new(zeta[0], rho[0], sum[0], log0, r);
    let lower = End::new(zeta[1], rho[1], sum[1], log1, r);
    if profile == Profile::Punch {
        return Potentials {
            a_upper: constant(upper.e(1 + N), lower.e(1 + N)),
            a_lower: constant(upper.e(N), lower.e(N)),
            g_upper: constant(upper.f(1 + N), lower.f(1 + N)),
            g_lower: constant(upper.f(N), lower.f(N)),
        };
    }
    let [e1, f1] = [
        [upper.e(1 + N), lower.e(1 + N)],
        [upper.f(1 + N), lower.f(1 + N)],
    ];
    let [e2, f2] = [
        [upper.e(2 + N), lower.e(2 + N)],
        [upper.f(2 + N), lower.f(2 + N)],
    ];
    let [e3, f3] = [
        [upper.e(3 + N), lower.e(3 + N)],
        [upper.f(3 + N), lower.f(3 + N)],
    ];
    Potentials {
        a_upper: parabola(e3, e2),
        a_lower: parabola(e2, e1),
        g_upper: parabola(f3, f2),
        g_lower: parabola(f2, f1),
    }
}

/// The root at a node; a node that rounds to the front itself is moved by a rounding error.
#[inline(always)]
fn off_front<C: Complex>(rho: C, r: f64) -> C {
    let least = rho.re().constant(f64::MIN_POSITIVE);
    C::where_below(
        rho.norm_sqr(),
        least,
        rho.constant(f64::EPSILON.sqrt() * r),
        rho,
    )
}

/// The chord integral for the constant chord function of a punch, from the antiderivatives at both ends.
#[inline(always)]
fn constant<C: Complex>(upper: C, lower: C) -> C {
    (upper - lower).times_minus_i() * (0.25 / PI)
}

/// The chord integral for the parabolic chord function of the Hertz load, from the antiderivatives at both ends.
#[inline(always)]
fn parabola<C: Complex>(outer: [C; 2], inner: [C; 2]) -> C {
    ((outer[0] - outer[1]).times_minus_i() - (inner[0] + inner[1])) * (0.75 / PI)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::potentials::STEP_INTEGRAL;

    impl<T> Potentials<T> {
        /// The four potentials in the order of their declaration.
        fn into_array(self) -> [T; 4] {
            [self.a_upper, self.a_lower, self.g_upper, self.g_lower]
        }
    }

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
                    let here = of_one::<STEP>(profile, xi, r);
                    let ahead = of_one::<STEP_INTEGRAL>(profile, xi + h, r);
                    let behind = of_one::<STEP_INTEGRAL>(profile, xi - h, r);
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
                        of_one::<STEP>(Profile::Hertz, xi, r),
                        by_parts::<STEP, _>(Profile::Hertz, xi, r),
                    ),
                    (
                        of_one::<STEP_INTEGRAL>(Profile::Hertz, xi, r),
                        by_parts::<STEP_INTEGRAL, _>(Profile::Hertz, xi, r),
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

    /// The closed form and the multipole series agree where both are accurate.
    #[test]
    fn closed_form_agrees_with_the_multipole_series() {
        for profile in [Profile::Hertz, Profile::Punch] {
            for r in [0.0, 1e-9, 0.4, 1.0, 3.0] {
                for (x, y) in [(7.0, 0.4), (2.5, 12.0), (0.0, -11.0), (0.0, 13.5)] {
                    let xi = Complex64::new(x, y);
                    let pairs = [
                        (
                            by_parts::<STEP, _>(profile, xi, r),
                            multipole::potentials::<STEP, _>(profile, xi, (r, ROUNDING_DIGITS)),
                        ),
                        (
                            by_parts::<STEP_INTEGRAL, _>(profile, xi, r),
                            multipole::potentials::<STEP_INTEGRAL, _>(
                                profile,
                                xi,
                                (r, ROUNDING_DIGITS),
                            ),
                        ),
                        (
                            by_parts::<IMPULSE, _>(profile, xi, r),
                            multipole::potentials::<IMPULSE, _>(profile, xi, (r, ROUNDING_DIGITS)),
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

    /// The series at a distant front agrees with integration by parts where both are accurate.
    #[test]
    fn the_far_front_agrees_with_integration_by_parts() {
        for r in [26.0, 40.0, 90.0] {
            for d in [0.0, 1e-3, 0.4, 3.0] {
                for i in -40..=40 {
                    let eta = r + 0.217 * f64::from(i);
                    for xi in [Complex64::new(d, eta), Complex64::new(d, -eta)] {
                        let found =
                            far_front::of_disc(xi, (r, ROUNDING_DIGITS), d == 0.0).into_array();
                        let expected = by_parts::<STEP, _>(Profile::Hertz, xi, r).into_array();
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
