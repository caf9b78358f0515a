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

use crate::compact::chord_primitives;
use crate::multipole;
use crate::panels;
use crate::profile::Profile;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI};

/// Potentials of two neighbouring orders; `ORDER` 0 is the step response, 1 and 2 its time integrals, -1 its derivative.
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
        return end_orders::<ORDER>(xi, r).map(|v| v / (2.0 * PI));
    }
    /// Below this radius the primitives, which are divided by r^2, lose digits.
    const SMALL_RADIUS: f64 = 0.15;
    // Farther out the closed forms lose digits, those of the time integral sooner.
    let nearest = if ORDER == 0 && r > 0.3 { 10.0 } else { 7.0 };
    match multipole::terms(xi, r, nearest) {
        Some(terms) => multipole::multipole::<ORDER>(profile, terms, xi, r),
        None if ORDER >= 0 && profile == Profile::Hertz && r > SMALL_RADIUS => {
            if xi.re == 0.0 {
                on_imaginary_axis::<ORDER>(xi.im, r)
            } else {
                by_primitives::<ORDER>(xi, r)
            }
        }
        None => by_parts::<ORDER>(profile, xi, r),
    }
}

/// The Hertz disc from the chord primitives, phi = -i L and q = rho in the variable eta = -i xi.
fn by_primitives<const ORDER: i32>(xi: Complex64, r: f64) -> Potentials<Complex64> {
    let zeta = [1.0, -1.0].map(|sigma| Complex64::new(xi.re, xi.im - sigma));
    let inside = inside(xi.im, r);
    let rho = [0, 1].map(|i| root_inside(zeta[i], inside[i]));
    let sum = [zeta[0] + rho[0], zeta[1] + rho[1]];
    let minus_i = |v: Complex64| Complex64::new(v.im, -v.re);
    let eta = minus_i(xi);
    // The step response needs only the difference of phi.
    let phi = if ORDER == 0 {
        [
            Complex64::default(),
            minus_i(logarithm(sum[1] * reciprocal(sum[0]))),
        ]
    } else {
        sum.map(|sum| minus_i(logarithm(sum)))
    };
    let psi = chord_primitives::<ORDER, Complex64>(eta, r, phi, rho);
    from_primitives::<ORDER>(psi, eta, r)
}

/// The ends zeta of the chord and their rho, for the Hertz disc at xi = d - i c t, d >= 0, from r +- 1 +- c t.
///
/// `factors` are r - s and r + s of the two ends, s = -c t -+ 1, where those that are small near a front are exact.
fn ends_at_front(xi: Complex64, factors: [[f64; 2]; 2]) -> ([Complex64; 2], [Complex64; 2]) {
    let zeta = [1.0, -1.0].map(|sigma| Complex64::new(xi.re, xi.im - sigma));
    let rho = [0, 1].map(|i| root_inside(zeta[i], factors[i][0] * factors[i][1]));
    (zeta, rho)
}

fn times_minus_i(v: Complex64) -> Complex64 {
    Complex64::new(v.im, -v.re)
}

/// The potentials there, for xi near the disc and r not small.
pub(crate) fn at_front(xi: Complex64, r: f64, factors: [[f64; 2]; 2]) -> Potentials<Complex64> {
    let (zeta, rho) = ends_at_front(xi, factors);
    let phi = [0, 1].map(|i| times_minus_i(logarithm(zeta[i] + rho[i])));
    let eta = times_minus_i(xi);
    let psi = chord_primitives::<0, Complex64>(eta, r, phi, rho);
    from_primitives::<0>(psi, eta, r)
}

/// A_2 and B_2/r there, the difference between xi + step and xi = -i c t for real step > 0, to its own last digits.
///
/// Differences of the primitives of `chord_primitives`, each from those of rho^2 and of zeta + rho.
pub(crate) fn step_at_front(
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
        step * (2.0 * zeta[i] + step) * reciprocal(sum)
    });
    let d_phi = [0, 1].map(|i| {
        let w = (d_rho[i] + step) * reciprocal(zeta[i] + from[i]);
        let modulus = 0.5 * (2.0 * w.re + w.norm_sqr()).ln_1p();
        times_minus_i(Complex64::new(modulus, w.im.atan2(1.0 + w.re)))
    });
    let phi = [0, 1].map(|i| times_minus_i(logarithm(zeta[i] + step + to[i])));
    let (eta, h) = (times_minus_i(xi), Complex64::new(0.0, -step));
    // s q changes by s dq + h q
    let d_sq = [0, 1].map(|i| times_minus_i(zeta[i]) * d_rho[i] + h * to[i]);
    let (m0, d_m0) = (phi[1] - phi[0], d_phi[1] - d_phi[0]);
    let (m1, d_m1) = (to[0] - to[1], d_rho[0] - d_rho[1]);
    let d_m2 = 0.5 * (r * r * d_m0 - d_sq[1] + d_sq[0]);
    let scale = 0.75 / PI;
    let a = scale * (d_m1 - eta * d_m0 - h * m0);
    let g = scale / (r * r) * (d_m2 - eta * d_m1 - h * m1);
    (Complex64::new(-a.im, a.re), g)
}

/// The same on the imaginary axis, where real and imaginary part separate into real functions.
fn on_imaginary_axis<const ORDER: i32>(eta: f64, r: f64) -> Potentials<Complex64> {
    let s = [eta - 1.0, eta + 1.0];
    let inside = inside(eta, r);
    // Re: phi and q held at their value on the circle outside it
    let re = if ORDER == 0 && eta.abs() >= 1.0 + r {
        Potentials::default()
    } else {
        let phi = s.map(|s| (s / r).clamp(-1.0, 1.0).asin());
        let q = inside.map(|square| square.max(0.0).sqrt());
        chord_primitives::<ORDER, f64>(eta, r, phi, q)
    };
    // Im: -log|zeta + rho| and Im rho, held inside the circle
    let w = [0, 1].map(|i| (-inside[i]).max(0.0).sqrt().copysign(s[i]));
    let modulus = [0, 1].map(|i| s[i].abs().max(r) + w[i].abs());
    let log = if ORDER == 0 {
        [0.0, (modulus[0] / modulus[1]).ln()]
    } else {
        modulus.map(|modulus| -modulus.ln())
    };
    let im = chord_primitives::<ORDER, f64>(eta, r, log, w);
    let join = Complex64::new;
    let psi = Potentials {
        a_upper: join(re.a_upper, im.a_upper),
        a_lower: join(re.a_lower, im.a_lower),
        g_upper: join(re.g_upper, im.g_upper),
        g_lower: join(re.g_lower, im.g_lower),
    };
    from_primitives::<ORDER>(psi, eta.into(), r)
}

/// Potentials from chord primitives: powers of i from the change of variable, and the part of
/// F_0 = (1 - zeta/rho)/r and F_1 = (rho - zeta)/r that is free of roots.
#[inline]
fn from_primitives<const ORDER: i32>(
    psi: Potentials<Complex64>,
    eta: Complex64,
    r: f64,
) -> Potentials<Complex64> {
    let force = 0.5 / (PI * r * r);
    let times_i = |v: Complex64| Complex64::new(-v.im, v.re);
    match ORDER {
        0 => Potentials {
            a_upper: psi.a_upper,
            a_lower: times_i(psi.a_lower),
            g_upper: times_i(psi.g_upper) + force,
            g_lower: psi.g_lower,
        },
        1 => Potentials {
            a_upper: -times_i(psi.a_upper),
            a_lower: psi.a_lower,
            g_upper: psi.g_upper - times_i(eta) * force,
            g_lower: times_i(psi.g_lower) + force,
        },
        _ => {
            // the second moment of the chord function over its integral
            const SPREAD: f64 = 0.2;
            Potentials {
                a_upper: -psi.a_upper,
                a_lower: -times_i(psi.a_lower),
                g_upper: -times_i(psi.g_upper) - (eta * eta + SPREAD) * (0.5 * force),
                g_lower: psi.g_lower - times_i(eta) * force,
            }
        }
    }
}

/// E and F/r of orders `ORDER` and `ORDER` - 1.
#[inline]
fn end_orders<const ORDER: i32>(zeta: Complex64, r: f64) -> Potentials<Complex64> {
    if ORDER < 0 {
        let end = End::without_log(zeta, r);
        return Potentials {
            a_upper: end.e(ORDER),
            a_lower: end.e(ORDER - 1),
            g_upper: end.f(ORDER),
            g_lower: end.f(ORDER - 1),
        };
    }
    let rho = End::without_log(zeta, r).rho;
    let inverse = reciprocal(rho);
    let sum = reciprocal(rho + zeta);
    if ORDER == 0 {
        let cube = inverse * inverse * inverse;
        Potentials {
            a_upper: inverse,
            a_lower: zeta * cube,
            g_upper: inverse * sum,
            g_lower: cube,
        }
    } else {
        Potentials {
            a_upper: -logarithm(rho + zeta),
            a_lower: inverse,
            g_upper: sum,
            g_lower: inverse * sum,
        }
    }
}

#[inline]
pub(crate) fn reciprocal(v: Complex64) -> Complex64 {
    let scale = 1.0 / v.norm_sqr();
    Complex64::new(v.re * scale, -v.im * scale)
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
            logarithm(zeta + rho)
        };
        end
    }

    /// An end of which only orders up to zero are used, which need no logarithm.
    #[inline]
    fn without_log(zeta: Complex64, r: f64) -> Self {
        let mut rho = root_with_circle(zeta, r);
        if rho.norm_sqr() == 0.0 {
            // a node that rounds to the very front: as near as rounding lets it be
            rho.re = f64::EPSILON.sqrt() * r;
        }
        Self {
            zeta,
            rho,
            log: Complex64::default(),
            r,
        }
    }

    /// E_n(zeta), -2 <= n <= 5.
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
            5 => {
                let z2 = zeta * zeta;
                (z2 * (0.125 * r2 - z2 / 24.0) - r2 * r2 / 64.0) * log
                    + zeta * (25.0 / 288.0 * z2 - 55.0 / 576.0 * r2) * rho
            }
            _ => unreachable!("potentials use orders -2 to 5"),
        }
    }

    /// F_n(zeta)/r with F_n = int k^{-n} J1(kr) e^{-k zeta} dk, -2 <= n <= 5; smooth at r = 0.
    #[inline]
    pub(crate) fn f(&self, n: i32) -> Complex64 {
        let Self { zeta, rho, log, r } = *self;
        let mut sum = rho + zeta;
        if sum.norm_sqr() == 0.0 {
            // the very singularity on the axis: any finite value will do
            sum.re = 1e-100;
        }
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
            5 => {
                let (z2, rho2, r2) = (zeta * zeta, rho * rho, r * r);
                // (rho^5 - zeta^5)/r^2
                let fifth = (rho2 * rho2 + rho * zeta * (rho2 + rho * zeta + z2) + z2 * z2) / sum;
                let cubic = (5.0 / 24.0 + 1.0 / 18.0) * rho2 * rho - zeta * z2 * log / 6.0;
                -0.5 * (cubic - fifth / 60.0 + 0.125 * r2 * (zeta * log - rho) - r2 * rho / 6.0)
            }
            _ => unreachable!("potentials use orders -2 to 5"),
        }
    }
}

/// Principal logarithm; of zero it is finite.
#[inline]
pub(crate) fn logarithm(v: Complex64) -> Complex64 {
    let modulus = v.norm_sqr().max(f64::MIN_POSITIVE);
    let angle = if v.re == 0.0 {
        FRAC_PI_2.copysign(v.im)
    } else {
        v.im.atan2(v.re)
    };
    Complex64::new(0.5 * modulus.ln(), angle)
}

/// sqrt(zeta + ir) sqrt(zeta - ir), the branch that is zeta at r = 0, for Re zeta >= 0.
#[inline]
pub(crate) fn root_with_circle(zeta: Complex64, r: f64) -> Complex64 {
    root_inside(zeta, (r - zeta.im) * (r + zeta.im))
}

/// (r - s)(r + s) at the ends s = eta -+ 1 of the chord, exact at the edge of the disc.
#[inline]
fn inside(eta: f64, r: f64) -> [f64; 2] {
    let (inner, outer) = (r - 1.0, r + 1.0);
    [(outer - eta) * (inner + eta), (inner - eta) * (outer + eta)]
}

/// sqrt(d^2 + inside + 2 i d s) for zeta = d + i s.
#[inline]
fn root_inside(zeta: Complex64, inside: f64) -> Complex64 {
    let (d, s) = (zeta.re, zeta.im);
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
                    if profile == Profile::Hertz {
                        let here = potentials::<1>(profile, xi, r);
                        let ahead = potentials::<2>(profile, xi + h, r);
                        let behind = potentials::<2>(profile, xi - h, r);
                        check(ahead.a_upper, behind.a_upper, here.a_upper);
                        check(ahead.a_lower, behind.a_lower, here.a_lower);
                        check(ahead.g_upper, behind.g_upper, here.g_upper);
                        check(ahead.g_lower, behind.g_lower, here.g_lower);
                    }
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
                        potentials::<0>(Profile::Hertz, xi, r),
                        by_parts::<0>(Profile::Hertz, xi, r),
                    ),
                    (
                        potentials::<1>(Profile::Hertz, xi, r),
                        by_parts::<1>(Profile::Hertz, xi, r),
                    ),
                    (
                        potentials::<2>(Profile::Hertz, xi, r),
                        by_parts::<2>(Profile::Hertz, xi, r),
                    ),
                ];
                for (a, b) in pairs {
                    let gap = [
                        a.a_upper - b.a_upper,
                        a.a_lower - b.a_lower,
                        a.g_upper - b.g_upper,
                        a.g_lower - b.g_lower,
                    ];
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
                            by_parts::<0>(profile, xi, r),
                            multipole::multipole::<0>(profile, 9, xi, r),
                        ),
                        (
                            by_parts::<1>(profile, xi, r),
                            multipole::multipole::<1>(profile, 9, xi, r),
                        ),
                        (
                            by_parts::<-1>(profile, xi, r),
                            multipole::multipole::<-1>(profile, 9, xi, r),
                        ),
                        (
                            by_parts::<2>(Profile::Hertz, xi, r),
                            multipole::multipole::<2>(Profile::Hertz, 9, xi, r),
                        ),
                    ];
                    for (order, (closed, series)) in pairs.into_iter().enumerate() {
                        for (a, b) in [
                            (closed.a_upper, series.a_upper),
                            (closed.a_lower, series.a_lower),
                            (closed.g_upper, series.g_upper),
                            (closed.g_lower, series.g_lower),
                        ] {
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
}
