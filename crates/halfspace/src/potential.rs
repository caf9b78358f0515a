//! The k-integrals of every kernel in closed form.
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

use crate::gauss;
use crate::panels;
use crate::profile::Profile;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI};

/// Potentials of two neighbouring orders; `ORDER` 0 is the step response, 1 its time integral.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Potentials<T> {
    /// A_{3 + ORDER}, carries w.
    pub(crate) a_upper: T,
    /// A_{2 + ORDER}, carries the normal stresses.
    pub(crate) a_lower: T,
    /// B_{3 + ORDER}/r, carries u and the hoop terms.
    pub(crate) g_upper: T,
    /// B_{2 + ORDER}/r, carries the shear stress.
    pub(crate) g_lower: T,
}

impl<T> Potentials<T> {
    /// The same with every potential replaced.
    #[inline]
    pub(crate) fn map<U>(self, f: impl Fn(T) -> U) -> Potentials<U> {
        Potentials {
            a_upper: f(self.a_upper),
            a_lower: f(self.a_lower),
            g_upper: f(self.g_upper),
            g_lower: f(self.g_lower),
        }
    }
}

/// The potentials at xi (Re xi >= 0) and radius r.
#[inline]
pub(crate) fn potentials<const ORDER: i32>(
    profile: Profile,
    xi: Complex64,
    r: f64,
) -> Potentials<Complex64> {
    if profile == Profile::Point {
        let end = End::new(xi, r);
        return Potentials {
            a_upper: end.e(ORDER) / (2.0 * PI),
            a_lower: end.e(ORDER - 1) / (2.0 * PI),
            g_upper: end.f(ORDER) / (2.0 * PI),
            g_lower: end.f(ORDER - 1) / (2.0 * PI),
        };
    }
    match chord_nodes(xi, r) {
        Some(n) => by_chord::<ORDER>(profile, n, xi, r),
        None => by_parts::<ORDER>(profile, xi, r),
    }
}

/// Number of Gauss nodes that integrate over the chord to rounding, or nothing when xi is too near.
///
/// The integrand is singular at sigma = -i xi +- r; the sum of distances from the ends of the chord
/// gives the Bernstein ellipse.
fn chord_nodes(xi: Complex64, r: f64) -> Option<usize> {
    let singular = |shift: f64| {
        let (x, y) = (xi.im + shift, xi.re);
        ((x - 1.0).powi(2) + y * y).sqrt() + ((x + 1.0).powi(2) + y * y).sqrt()
    };
    let sum = singular(r).min(singular(-r));
    [(150.0, 3), (60.0, 4), (28.0, 5), (14.0, 6)]
        .into_iter()
        .find_map(|(least, n)| (sum >= least).then_some(n))
}

fn by_chord<const ORDER: i32>(
    profile: Profile,
    n: usize,
    xi: Complex64,
    r: f64,
) -> Potentials<Complex64> {
    let rule = gauss::rule(n);
    let mut sum = Potentials::<Complex64>::default();
    for (&sigma, &weight) in rule.nodes.iter().zip(&rule.weights) {
        let h = weight
            * match profile {
                Profile::Hertz => 0.375 / PI * (1.0 - sigma * sigma),
                Profile::Punch | Profile::Point => 0.25 / PI,
            };
        let zeta = Complex64::new(xi.re, xi.im - sigma);
        let end = if ORDER > 0 {
            End::new(zeta, r)
        } else {
            End::without_log(zeta, r)
        };
        sum.a_upper += h * end.e(ORDER);
        sum.a_lower += h * end.e(ORDER - 1);
        sum.g_upper += h * end.f(ORDER);
        sum.g_lower += h * end.f(ORDER - 1);
    }
    sum
}

fn by_parts<const ORDER: i32>(profile: Profile, xi: Complex64, r: f64) -> Potentials<Complex64> {
    let upper = End::new(Complex64::new(xi.re, xi.im - 1.0), r);
    let lower = End::new(Complex64::new(xi.re, xi.im + 1.0), r);
    // (X - Y)/(2 i)
    let half_difference = |x: Complex64, y: Complex64| Complex64::new(0.0, -0.5) * (x - y);
    match profile {
        Profile::Hertz => {
            let scale = 1.5 / PI;
            let (e3, e2, e1) = (3 + ORDER, 2 + ORDER, 1 + ORDER);
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
                a_upper: a(1 + ORDER),
                a_lower: a(ORDER),
                g_upper: g(1 + ORDER),
                g_lower: g(ORDER),
            }
        }
    }
}

/// One end of a chord: zeta, rho = sqrt(zeta^2 + r^2) with Re rho >= 0, L = log(zeta + rho).
pub(crate) struct End {
    zeta: Complex64,
    rho: Complex64,
    log: Complex64,
    r: f64,
}

impl End {
    /// Re zeta >= 0; on the imaginary axis the limit from the right is taken.
    #[inline]
    pub(crate) fn new(zeta: Complex64, r: f64) -> Self {
        let mut end = Self::without_log(zeta, r);
        let Self { rho, .. } = end;
        end.log = if zeta.re == 0.0 && rho.re != 0.0 {
            Complex64::new(r.ln(), (zeta.im / r).clamp(-1.0, 1.0).asin())
        } else {
            let sum = zeta + rho;
            let modulus = sum.norm_sqr().max(f64::MIN_POSITIVE);
            let angle = if sum.re == 0.0 {
                FRAC_PI_2.copysign(sum.im)
            } else {
                sum.im.atan2(sum.re)
            };
            Complex64::new(0.5 * modulus.ln(), angle)
        };
        end
    }

    /// An end of which only orders up to zero are used, which need no logarithm.
    #[inline]
    fn without_log(zeta: Complex64, r: f64) -> Self {
        Self {
            zeta,
            rho: root(zeta, r),
            log: Complex64::default(),
            r,
        }
    }

    /// E_n(zeta), -2 <= n <= 4.
    #[inline]
    pub(crate) fn e(&self, n: i32) -> Complex64 {
        let Self { zeta, rho, log, r } = *self;
        let r2 = r * r;
        match n {
            -2 => (2.0 * zeta * zeta - r2) / (rho * rho * rho * rho * rho),
            -1 => zeta / (rho * rho * rho),
            0 => 1.0 / rho,
            1 => -log,
            2 => zeta * log - rho,
            3 => 0.75 * zeta * rho + (0.25 * r2 - 0.5 * zeta * zeta) * log,
            4 => {
                let z2 = zeta * zeta;
                zeta * (z2 / 6.0 - 0.25 * r2) * log + (r2 / 9.0 - 11.0 / 36.0 * z2) * rho
            }
            _ => unreachable!("potentials use orders -2 to 4"),
        }
    }

    /// F_n(zeta)/r with F_n = int k^{-n} J1(kr) e^{-k zeta} dk, -2 <= n <= 4; smooth at r = 0.
    #[inline]
    pub(crate) fn f(&self, n: i32) -> Complex64 {
        let Self { zeta, rho, log, r } = *self;
        let sum = rho + zeta;
        match n {
            -2 => 3.0 * zeta / (rho * rho * rho * rho * rho),
            -1 => 1.0 / (rho * rho * rho),
            0 => 1.0 / (rho * sum),
            1 => 1.0 / sum,
            2 => -0.5 * (zeta / sum + log),
            3 => 0.5 * ((rho * sum + zeta * zeta) / (3.0 * sum) + zeta * log - rho),
            4 => {
                let cubic = zeta * (rho * sum + zeta * zeta) / (12.0 * sum);
                0.5 * (0.625 * zeta * rho - cubic + (0.125 * r * r - 0.5 * zeta * zeta) * log)
            }
            _ => unreachable!("potentials use orders -2 to 4"),
        }
    }
}

/// sqrt(zeta + ir) sqrt(zeta - ir), the branch that is zeta at r = 0, for Re zeta >= 0.
#[inline]
fn root(zeta: Complex64, r: f64) -> Complex64 {
    let (d, s) = (zeta.re, zeta.im);
    let inside = (r - s) * (r + s);
    if d == 0.0 {
        return if inside >= 0.0 {
            Complex64::new(inside.sqrt(), 0.0)
        } else {
            Complex64::new(0.0, (-inside).sqrt().copysign(s))
        };
    }
    let square = Complex64::new(d * d + inside, 2.0 * d * s);
    panels::root(square)
}

#[cfg(test)]
mod tests {
    use super::*;

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
                    let here = potentials::<0>(profile, xi, r);
                    let ahead = potentials::<1>(profile, xi + h, r);
                    let behind = potentials::<1>(profile, xi - h, r);
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

    /// Where both are good, the closed form and a long Gauss rule over the chord agree.
    #[test]
    fn closed_form_agrees_with_the_chord_rule() {
        for profile in [Profile::Hertz, Profile::Punch] {
            for r in [0.0, 1e-9, 0.4, 1.0, 3.0] {
                for (x, y) in [(3.0, 0.4), (2.5, 5.0), (4.0, -3.0)] {
                    let xi = Complex64::new(x, y);
                    let closed = by_parts::<1>(profile, xi, r);
                    let chord = by_chord::<1>(profile, 24, xi, r);
                    for (a, b) in [
                        (closed.a_upper, chord.a_upper),
                        (closed.a_lower, chord.a_lower),
                        (closed.g_upper, chord.g_upper),
                        (closed.g_lower, chord.g_lower),
                    ] {
                        assert!((a - b).norm() < 3e-14, "{profile:?} {r} {xi}: {a} {b}");
                    }
                }
            }
        }
    }
}
