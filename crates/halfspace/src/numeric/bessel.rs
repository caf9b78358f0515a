//! Bessel functions of the orders 0 and 1 of a complex argument in the right half-plane.
//!
//! Accuracy: 2e-15 of the larger of both orders, relative to e^|Im z| for J (`values_are_those_of_tables` and
//! `wronskians_hold`).
//!
//! Source: NIST Digital Library of Mathematical Functions, 10.17 (large arguments) and 10.74 (recurrence, fractions).

use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_4, PI};

/// Modulus from which Hankel's expansion for large arguments has all digits: its smallest term is e^(-2|z|).
pub(crate) const LARGE: f64 = 18.0;

/// Number of terms beyond |z| at which the backward recurrence starts; with fewer, `wronskians_hold` fails below LARGE.
const START: f64 = 30.0;

/// Smallest modulus at which the continued fraction of the Hankel function converges in at most a hundred steps.
pub(crate) const LEAST_HANKEL: f64 = 2.0;

/// J_0 and J_1 over e^x, and x, which is -iz or iz so that neither is large; with Re z >= 0.
pub(crate) fn scaled_bessel(z: Complex64) -> ([Complex64; 2], Complex64) {
    let turn = Complex64::new(0.0, if z.im > 0.0 { -1.0 } else { 1.0 });
    if z.norm() < 1.0 {
        return (series(z), Complex64::default());
    }
    if z.norm() < LARGE {
        return (recurred(z, turn), turn * z);
    }
    // of the waves e^(iz) and e^(-iz) one is the larger; the second Hankel function is the conjugate at the conjugate
    let smaller = (-2.0 * turn * z).exp();
    let [upper, lower] = [expanded(z), expanded(z.conj()).map(|h| h.conj())];
    let of = |n: usize| match z.im > 0.0 {
        true => 0.5 * (upper[n] * smaller + lower[n]),
        false => 0.5 * (lower[n] * smaller + upper[n]),
    };
    ([of(0), of(1)], turn * z)
}

/// Hankel functions H^(1) of orders 0 and 1 times e^(-iz), with Re z >= 0 and |z| >= [`LARGE`], or [`LEAST_HANKEL`] with Im z >= 0.
pub(crate) fn scaled_hankel(z: Complex64) -> [Complex64; 2] {
    if z.norm() >= LARGE {
        return expanded(z);
    }
    // H_0 = 2/(i pi) K_0(x) and H_1 = -2/pi K_1(x) with x = -iz
    let [k0, k1] = scaled_modified(-Complex64::i() * z);
    [Complex64::new(0.0, -2.0 / PI) * k0, -2.0 / PI * k1]
}

/// Power series.
fn series(z: Complex64) -> [Complex64; 2] {
    let square = -0.25 * z * z;
    let (mut term, mut sums) = (Complex64::new(1.0, 0.0), [Complex64::default(); 2]);
    for n in 1..12 {
        let n = f64::from(n);
        sums[0] += term;
        sums[1] += term / n;
        term *= square / (n * n);
    }
    [sums[0], 0.5 * z * sums[1]]
}

/// Over e^(turn z) = J_0 + 2 sum turn^n J_n, by the recurrence from a large order down.
fn recurred(z: Complex64, turn: Complex64) -> [Complex64; 2] {
    let count = (z.norm() + START) as i32;
    let over = z.inv();
    let (mut above, mut here) = (Complex64::default(), Complex64::new(1e-60, 0.0));
    let mut sum = Complex64::default();
    let mut power = turn.powi(count);
    for n in (1..=count).rev() {
        sum += 2.0 * power * here;
        let below = 2.0 * f64::from(n) * over * here - above;
        (above, here) = (here, below);
        power *= turn.conj();
    }
    let scale = (sum + here).inv();
    [here * scale, above * scale]
}

/// Hankel's expansion of H^(1)_n(z) e^(-iz) for large z.
fn expanded(z: Complex64) -> [Complex64; 2] {
    let front = (2.0 / (PI * z)).sqrt();
    let over = Complex64::i() / (8.0 * z);
    [0.0, 1.0].map(|order: f64| {
        let (mut term, mut sum) = (Complex64::new(1.0, 0.0), Complex64::new(1.0, 0.0));
        for k in 1..40 {
            let odd = f64::from(2 * k - 1);
            let next = term * over * ((4.0 * order * order - odd * odd) / f64::from(k));
            if next.norm_sqr() >= term.norm_sqr() || next.norm_sqr() < 1e-36 {
                break;
            }
            term = next;
            sum += term;
        }
        front * sum * Complex64::from_polar(1.0, -(0.5 * PI * order + FRAC_PI_4))
    })
}

/// Modified Bessel functions K_0 and K_1 times e^x, by Steed's method on Temme's continued fraction.
fn scaled_modified(x: Complex64) -> [Complex64; 2] {
    const MOST_STEPS: u32 = 300;
    let one = Complex64::new(1.0, 0.0);
    let mut b = 2.0 * (one + x);
    let mut d = b.inv();
    let (mut h, mut step) = (d, d);
    let (mut q1, mut q2) = (Complex64::default(), one);
    let (mut a, mut c) = (-0.25, 0.25);
    let mut q = Complex64::new(c, 0.0);
    let mut s = one + q * step;
    for i in 2..MOST_STEPS {
        let i = f64::from(i);
        a -= 2.0 * (i - 1.0);
        c = -a * c / i;
        let next = (q1 - b * q2) / a;
        (q1, q2) = (q2, next);
        q += c * next;
        b += 2.0;
        d = (b + a * d).inv();
        step *= b * d - one;
        h += step;
        let more = q * step;
        s += more;
        if more.norm_sqr() < 1e-34 * s.norm_sqr() {
            break;
        }
    }
    let k0 = (PI / (2.0 * x)).sqrt() / s;
    [k0, k0 * (x + 0.5 - 0.25 * h) / x]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bessel(z: Complex64) -> [Complex64; 2] {
        let (scaled, exponent) = scaled_bessel(z);
        scaled.map(|j| j * exponent.exp())
    }

    /// Abramowitz and Stegun, table 9.1: J_0 and J_1 on the real axis.
    #[test]
    fn values_are_those_of_tables() {
        for (x, j0, j1) in [
            (0.5, 0.938_469_807_240_813, 0.242_268_457_674_873_9),
            (1.0, 0.765_197_686_557_966_6, 0.440_050_585_744_933_5),
            (5.0, -0.177_596_771_314_338_3, -0.327_579_137_591_465_2),
            (10.0, -0.245_935_764_451_348_3, 0.043_472_746_168_861_5),
            (15.0, -0.014_224_472_826_780_77, 0.205_104_038_613_522_8),
            (50.0, 0.055_812_327_669_252, -0.097_511_828_125_174_8),
        ] {
            let [found0, found1] = bessel(Complex64::new(x, 0.0));
            assert!((found0 - j0).norm() < 4e-15, "{x}: {found0}");
            assert!((found1 - j1).norm() < 4e-15, "{x}: {found1}");
        }
    }

    /// J_1 H_0 - J_0 H_1 = 2i/(pi z), on rays across the quadrant, on both sides of each change of method.
    #[test]
    fn wronskians_hold() {
        for modulus in [2.0, 2.5, 4.0, 9.0, 17.9, 18.1, 30.0] {
            for degrees in [0.0, 10.0, 45.0, 80.0, 90.0_f64] {
                let z = Complex64::from_polar(modulus, degrees.to_radians());
                let [j0, j1] = bessel(z);
                let [h0, h1] = scaled_hankel(z).map(|h| h * (Complex64::i() * z).exp());
                let found = j1 * h0 - j0 * h1;
                let wanted = Complex64::new(0.0, 2.0 / PI) / z;
                assert!(
                    (found / wanted - 1.0).norm() < 2e-14,
                    "{modulus} at {degrees}: {found} {wanted}"
                );
            }
        }
    }
}
