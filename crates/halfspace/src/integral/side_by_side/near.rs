//! The potentials near the chord, in closed form.

use crate::numeric::complex::inside;
use crate::numeric::lanes::{Lanes, Pair};
use crate::numeric::scalar::{Real, Scalar};
use crate::potentials::Potentials;
use crate::potentials::chord_integral::{chord_primitives, from_primitives};
use crate::potentials::order::STEP;
use pulp::Simd;
use std::f64::consts::PI;

/// The chord primitives with phi and q held beyond the circle.
#[inline(always)]
pub(super) fn held_primitives<S: Simd>(
    eta: Lanes<S>,
    r: f64,
    inside: [Lanes<S>; 2],
) -> Potentials<Lanes<S>> {
    let zero = eta.constant(0.0);
    let s = [eta - 1.0, eta + 1.0];
    let q = [inside[0].max(zero).sqrt(), inside[1].max(zero).sqrt()];
    chord_primitives::<STEP, Lanes<S>>(eta, r, [zero, angle_between(s, q)], q)
}

/// The difference of the angles of the vectors (q, s).
#[inline(always)]
fn angle_between<S: Simd>(s: [Lanes<S>; 2], q: [Lanes<S>; 2]) -> Lanes<S> {
    (s[1] * q[0] - s[0] * q[1]).angle_over(q[0] * q[1] + s[0] * s[1])
}

/// The limit r = 0, where the circle shrinks to a point of the chord.
#[inline(always)]
pub(super) fn compact_on_axis<S: Simd>(eta: Lanes<S>) -> Potentials<Lanes<S>> {
    let (zero, one) = (eta.constant(0.0), eta.constant(1.0));
    let within = eta.abs();
    let eta = within.where_below(one, eta, zero);
    Potentials {
        a_upper: within.where_below(one, (one - eta * eta) * 0.375, zero),
        a_lower: eta * -0.75,
        g_upper: eta * -0.375,
        g_lower: within.where_below(one, one * 0.375, zero),
    }
}

/// The potentials near the axis, of both ends of the chord, E_1 to E_3 and F_1 to F_3.
#[inline(always)]
pub(super) fn by_parts<S: Simd>(xi: Pair<S>, r: f64) -> Potentials<Pair<S>> {
    let Ends { zeta, rho, sum, .. } = Ends::new(xi, r);
    let [upper_e, upper_f] = end(zeta[0], rho[0], sum[0], r);
    let [lower_e, lower_f] = end(zeta[1], rho[1], sum[1], r);
    Potentials {
        a_upper: chord_of_ends([upper_e[2], lower_e[2]], [upper_e[1], lower_e[1]]),
        a_lower: chord_of_ends([upper_e[1], lower_e[1]], [upper_e[0], lower_e[0]]),
        g_upper: chord_of_ends([upper_f[2], lower_f[2]], [upper_f[1], lower_f[1]]),
        g_lower: chord_of_ends([upper_f[1], lower_f[1]], [upper_f[0], lower_f[0]]),
    }
}

/// The chord function of the Hertz load times a potential of a point force, of the antiderivatives at both ends.
#[inline(always)]
fn chord_of_ends<S: Simd>(outer: [Pair<S>; 2], inner: [Pair<S>; 2]) -> Pair<S> {
    ((outer[0] - outer[1]).times_minus_i() - (inner[0] + inner[1])) * (0.75 / PI)
}

/// E_1 to E_3 and F_1/r to F_3/r at one end of the chord.
#[inline(always)]
fn end<S: Simd>(zeta: Pair<S>, rho: Pair<S>, sum: Pair<S>, r: f64) -> [[Pair<S>; 3]; 2] {
    let log = sum.logarithm();
    let least = sum.re.constant(f64::MIN_POSITIVE);
    // at the very singularity on the axis any finite value will do
    let held = Pair::where_below(sum.norm_sqr(), least, sum.constant(1e-100), sum);
    let over = held.reciprocal();
    let square = zeta * zeta;
    [
        [
            log * -1.0,
            zeta * log - rho,
            zeta * rho * 0.75 + (square * -0.5 + 0.25 * r * r) * log,
        ],
        [
            over,
            (zeta * over + log) * -0.5,
            ((rho * sum + square) * over * (1.0 / 3.0) + zeta * log - rho) * 0.5,
        ],
    ]
}

/// The compact parts of a punch.
#[inline(always)]
pub(super) fn compact_punch<S: Simd>(eta: Lanes<S>, r: f64) -> Potentials<Lanes<S>> {
    let scale = 0.25 / PI;
    let ring = scale / (r * r);
    let (zero, one) = (eta.constant(0.0), eta.constant(1.0));
    let s = [eta - 1.0, eta + 1.0];
    let inside = inside(eta, r);
    let q = [inside[0].max(zero).sqrt(), inside[1].max(zero).sqrt()];
    let inverse = [
        zero.where_below(q[0], one / q[0], zero),
        zero.where_below(q[1], one / q[1], zero),
    ];
    Potentials {
        a_upper: angle_between(s, q) * scale,
        a_lower: (inverse[1] - inverse[0]) * scale,
        g_upper: (q[1] - q[0]) * ring,
        g_lower: (s[1] * inverse[1] - s[0] * inverse[0]) * ring,
    }
}

/// The potentials of a punch.
#[inline(always)]
pub(super) fn punch<S: Simd>(xi: Pair<S>, r: f64) -> Potentials<Pair<S>> {
    let Ends { rho, sum, log, .. } = Ends::new(xi, r);
    // a node that rounds to the very front: as near as rounding lets it be
    let least = xi.re.constant(f64::MIN_POSITIVE);
    let held = xi.constant(f64::EPSILON.sqrt() * r);
    let rho = [
        Pair::where_below(rho[0].norm_sqr(), least, held, rho[0]),
        Pair::where_below(rho[1].norm_sqr(), least, held, rho[1]),
    ];
    let inverse = [rho[0].reciprocal(), rho[1].reciprocal()];
    let over = [sum[0].reciprocal(), sum[1].reciprocal()];
    let scale = 0.25 / PI;
    Potentials {
        a_upper: log.times_minus_i() * scale,
        a_lower: (inverse[0] - inverse[1]).times_minus_i() * scale,
        g_upper: (over[0] - over[1]).times_minus_i() * scale,
        g_lower: (inverse[0] * over[0] - inverse[1] * over[1]).times_minus_i() * scale,
    }
}

/// The ends of the chord: rho, zeta + rho, and the logarithm of the ratio of the sums.
struct Ends<S: Simd> {
    zeta: [Pair<S>; 2],
    rho: [Pair<S>; 2],
    sum: [Pair<S>; 2],
    log: Pair<S>,
}

impl<S: Simd> Ends<S> {
    #[inline(always)]
    fn new(xi: Pair<S>, r: f64) -> Self {
        let zeta = [Pair::new(xi.re, xi.im - 1.0), Pair::new(xi.re, xi.im + 1.0)];
        let inside = inside(xi.im, r);
        let rho = [
            root_inside(zeta[0], inside[0]),
            root_inside(zeta[1], inside[1]),
        ];
        let sum = [zeta[0] + rho[0], zeta[1] + rho[1]];
        let ratio = sum[1] * sum[0].conj();
        let log = Pair::new(
            (sum[1].norm_sqr() / sum[0].norm_sqr()).ln() * 0.5,
            ratio.im.angle_over(ratio.re),
        );
        Self {
            zeta,
            rho,
            sum,
            log,
        }
    }
}

/// sqrt(d^2 + inside + 2 i d s) for zeta = d + i s, d >= 0.
#[inline(always)]
pub(super) fn root_inside<S: Simd>(zeta: Pair<S>, inside: Lanes<S>) -> Pair<S> {
    let Pair { re: d, im: s } = zeta;
    let root = Pair::new(d * d + inside, d * s * 2.0).root();
    // on the axis the side is that of s
    Pair::new(root.re, root.im.abs().copysign(s))
}

/// The chord primitives at complex xi, phi = -i L and q = rho in the variable eta = -i xi.
#[inline(always)]
pub(super) fn by_primitives<S: Simd>(xi: Pair<S>, r: f64) -> Potentials<Pair<S>> {
    let Ends { rho, log, .. } = Ends::new(xi, r);
    let phi = [log.constant(0.0), log.times_minus_i()];
    let eta = xi.times_minus_i();
    let psi = chord_primitives::<STEP, Pair<S>>(eta, r, phi, rho);
    from_primitives::<STEP, Pair<S>>(psi, eta, r, Pair::times_i)
}

/// The same on the imaginary axis.
///
/// The real part vanishes outside the circle around the whole chord, the imaginary part inside the one that it lies in.
#[inline(always)]
pub(super) fn primitives_on_imaginary_axis<S: Simd>(eta: Lanes<S>, r: f64) -> Potentials<Pair<S>> {
    let zero = eta.constant(0.0);
    let size = eta.abs();
    let inside = inside(eta, r);
    let re = if size.smallest() >= r + 1.0 {
        Potentials::all(zero)
    } else {
        held_primitives(eta, r, inside)
    };
    let im = if size.largest() <= r - 1.0 {
        Potentials::all(zero)
    } else {
        let s = [eta - 1.0, eta + 1.0];
        let w = [(-inside[0]).max(zero).sqrt(), (-inside[1]).max(zero).sqrt()];
        let modulus = [s[0].abs().at_least(r) + w[0], s[1].abs().at_least(r) + w[1]];
        let log = [zero, (modulus[0] / modulus[1]).ln()];
        let w = [w[0].copysign(s[0]), w[1].copysign(s[1])];
        chord_primitives::<STEP, Lanes<S>>(eta, r, log, w)
    };
    let psi = re.zip(im, Pair::new);
    from_primitives::<STEP, Pair<S>>(psi, Pair::new(eta, zero), r, Pair::times_i)
}
