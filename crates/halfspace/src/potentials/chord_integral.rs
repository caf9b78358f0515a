//! The potentials of a Hertz disc as integrals over its chord, in closed form.
//!
//! With eta = -i xi, s = eta - sigma and q = sqrt(r^2 - s^2), phi = asin(s/r), the kernels E_n and F_n of the chord
//! integral are 1/q, phi and their antiderivatives, and the chord function is a parabola. The result consists of
//! integrals of powers of s times 1/q, phi and q between the ends s = eta -+ 1 of the chord.

use crate::numeric::scalar::{Complex, Real, Scalar};
use crate::potentials::{Order, Potentials, STEP};
use std::f64::consts::PI;

/// The chord integrals of a Hertz disc between s = eta - 1 and eta + 1, from phi and q at both ends.
///
/// Any pair of functions with phi' = 1/q, q' = -s/q, q^2 = r^2 - s^2 can be used as phi and q, since the result is
/// linear in them. With real eta and values held beyond the circle it is the compact part; with complex eta, phi = -i
/// log(zeta + rho) and q = rho it is the whole potential up to a polynomial.
#[inline(always)]
pub(crate) fn chord_primitives<const N: i32, T: Scalar>(
    eta: T,
    r: f64,
    phi: [T; 2],
    q: [T; 2],
) -> Potentials<T> {
    let r2 = r * r;
    let scale = 0.375 / PI;
    let ring = scale / r2;
    let s = [eta - 1.0, eta + 1.0];
    let inside = s[0] * s[1] * -1.0;
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
    match Order::of(N) {
        Order::Impulse => unreachable!("the derivatives are those of `compact::impulse`"),
        Order::Step => {
            return Potentials {
                a_upper: a3,
                a_lower: (m1 - eta * m0) * (2.0 * scale),
                g_upper: b3,
                g_lower: (m2 - eta * m1) * (2.0 * ring),
            };
        }
        Order::StepIntegral => {}
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
    Potentials {
        a_upper: a4,
        a_lower: a3,
        g_upper: b4,
        g_lower: b3,
    }
}

/// The chord primitives with phi and q held beyond the circle.
#[inline(always)]
pub(crate) fn held_primitives<const N: i32, T: Real>(
    eta: T,
    r: f64,
    inside: [T; 2],
) -> Potentials<T> {
    let s = [eta - 1.0, eta + 1.0];
    let q = [inside[0].held_root(), inside[1].held_root()];
    let phi = if N == STEP {
        [eta.constant(0.0), angle_between(s, q)]
    } else {
        [s[0].angle_over(q[0]), s[1].angle_over(q[1])]
    };
    chord_primitives::<N, T>(eta, r, phi, q)
}

/// The difference of the angles of the vectors (q, s).
#[inline(always)]
pub(crate) fn angle_between<T: Real>(s: [T; 2], q: [T; 2]) -> T {
    (s[1] * q[0] - s[0] * q[1]).angle_over(q[0] * q[1] + s[0] * s[1])
}

/// Potentials from chord primitives: powers of i from the change of variable, and the part of
/// F_0 = (1 - zeta/rho)/r and F_1 = (rho - zeta)/r that is free of roots.
#[inline(always)]
pub(crate) fn from_primitives<const N: i32, C: Complex>(
    psi: Potentials<C>,
    eta: C,
    r: f64,
) -> Potentials<C> {
    let force = 0.5 / (PI * r * r);
    match Order::of(N) {
        Order::Impulse => {
            unreachable!("potentials of the impulse response are integrated by parts")
        }
        Order::Step => Potentials {
            a_upper: psi.a_upper,
            a_lower: psi.a_lower.times_i(),
            g_upper: psi.g_upper.times_i() + force,
            g_lower: psi.g_lower,
        },
        Order::StepIntegral => Potentials {
            a_upper: psi.a_upper.times_minus_i(),
            a_lower: psi.a_lower,
            g_upper: psi.g_upper - eta.times_i() * force,
            g_lower: psi.g_lower.times_i() + force,
        },
    }
}
