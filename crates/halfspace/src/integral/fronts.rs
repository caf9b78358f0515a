//! Singularities of the integrands of the kernels, in closed form.
//!
//! A wave of slowness x arrives when its plane front from an edge of the disc passes:
//!
//! ```text
//! z gamma^ + sense t = e x,     e = +-1 +- r
//! ```
//!
//! With x = 2u/(1 + u^2) and gamma^ = (1 - u^2)/(1 + u^2), scaled by the slowness of the wave, this is a quadratic
//! equation in u. The integrals are over such half-angle variables, in which every square root is rational or analytic:
//!
//! ```text
//! fast  0 < x < 1           x = 2u/(1 + u^2)      p = (1 - u^2)/(1 + u^2)
//! slow  1 < x < sqrt(K)     sqrt(x^2 - 1) = sqrt(K - 1) 2q/(1 + q^2)     y = sqrt(K - 1) (1 - q^2)/(1 + q^2)
//! ```
//!
//! [`branch_points`](crate::integral::branch_points) contains the singularities that do not depend on the place.
//!
//! Theory: `docs/theory.md` (T18).

use crate::field::{Point, Sense};
use crate::integral::panels::SingularityStrength;
use crate::integral::setting::Setting;
use crate::integral::singularities::Singularities;
use crate::integral::spectrum::Wave;
use crate::numeric::lanes::Points;
use crate::numeric::scalar::Complex;
use crate::potentials::shallow;
use num_complex::Complex64;

/// The singularities of one wave: in one sense on the fast interval, in both on the slow one.
#[inline(always)]
pub(crate) fn singular<const N: i32>(
    setting: &Setting,
    at: Point,
    wave: Wave,
    sense: Option<Sense>,
    singularities: &mut Singularities,
) {
    let (fixed, profile) = (&setting.fixed, setting.profile);
    let own = if sense.is_some() {
        &fixed.fast
    } else {
        &fixed.slow
    };
    singularities.take(
        own,
        SingularityStrength::of::<N>(profile),
        setting.front_rounding(at),
    );
    let shallow = shallow::applies::<N>(profile, at);
    for at in [at]
        .into_iter()
        .chain(shallow.then_some(Point { z: 0.0, ..at }))
    {
        match sense {
            Some(sense) => add_fast(singularities, setting, at, wave, sense),
            None => add_slow(singularities, setting, at, wave),
        }
    }
}

/// Adds the fronts of one wave in one sense to the singularities of the fast interval.
fn add_fast(
    singularities: &mut Singularities,
    setting: &Setting,
    at: Point,
    wave: Wave,
    sense: Sense,
) {
    for_each_front(setting, at, wave, sense, |v| match wave {
        Wave::P => with_mirror(v, |u| singularities.add(u)),
        Wave::S => {
            let sine = 2.0 * v / (1.0 + v * v);
            let (x, y) = (setting.root_k * sine, cosine(v));
            if y.re > 0.0 {
                let u = x / (1.0 + (1.0 - x * x).root());
                with_mirror(u, |u| singularities.add(u));
                with_reciprocal(u, |u| singularities.add(u));
            }
        }
    });
}

/// Adds the fronts of one wave in both senses to the singularities of the slow interval.
///
/// Time reversal turns q into its reciprocal, and the other sheet of the root that does not belong to the wave into its
/// negative.
fn add_slow(singularities: &mut Singularities, setting: &Setting, at: Point, wave: Wave) {
    let span = setting.span;
    let mut points = Points::default();
    let mut add = |q: Complex64| {
        with_mirror(q, |q| points.push(q));
        with_reciprocal(q, |q| points.push(q));
    };
    // on the surface the roots of a pair are reciprocal and represent the same two fronts
    let is_reciprocal = |v: Complex64| at.z == 0.0 && v.norm_sqr() > 1.0 && v.im == 0.0;
    for_each_front(setting, at, wave, Sense::Outgoing, |v| match wave {
        Wave::P | Wave::S if is_reciprocal(v) => {}
        Wave::P => {
            let s = Complex64::i() * cosine(v) / span;
            add(s / (1.0 + (1.0 - s * s).root()));
        }
        Wave::S => {
            let c = cosine(v) * (setting.root_k / span);
            add((1.0 - c * c).root() / (1.0 + c));
        }
    });
    points.map(&setting.fixed.stretch);
    for point in points.iter() {
        singularities.add(point);
    }
}

/// Passes on a point and its negative: the one on the right, and the other if it is near enough to matter.
fn with_mirror(point: Complex64, mut add: impl FnMut(Complex64)) {
    const NEAR_ZERO: f64 = 0.3;
    /// Half-angle beyond which a singularity needs no additional node.
    const COSTLESS_ANGLE: f64 = 2.5;
    let right = if point.re < 0.0 { -point } else { point };
    if right.norm_sqr() > COSTLESS_ANGLE * COSTLESS_ANGLE {
        return;
    }
    add(right);
    if right.norm_sqr() < NEAR_ZERO * NEAR_ZERO {
        add(-right);
    }
}

/// Passes on the reciprocal of a point, or its negative, if it is near enough to matter.
fn with_reciprocal(point: Complex64, mut add: impl FnMut(Complex64)) {
    const NEAR_ONE: f64 = 0.4;
    if point.norm_sqr() > NEAR_ONE * NEAR_ONE {
        let point = 1.0 / point;
        add(if point.re < 0.0 { -point } else { point });
    }
}

fn cosine(u: Complex64) -> Complex64 {
    let square = u * u;
    (1.0 - square) / (1.0 + square)
}

/// Roots u of (sense t - z) u^2 - 2 e u + (z + sense t) = 0, t in units of the slowness of the wave, for both e > 0, or
/// the single e of a point force; the roots for -e are their negatives. Of a conjugate pair only one is passed on.
fn for_each_front(
    setting: &Setting,
    at: Point,
    wave: Wave,
    sense: Sense,
    mut f: impl FnMut(Complex64),
) {
    let (z, t) = (at.z, sense.sign() * at.t / setting.slowness(wave));
    let mut emit = |u: Complex64| {
        if u.is_finite() {
            f(u);
        }
    };
    let radius = setting.profile.radius();
    let nearest = (radius > 0.0).then_some((radius - at.r).abs());
    for e in [radius + at.r].into_iter().chain(nearest) {
        let reach = (z * z + e * e).sqrt();
        let discriminant = (reach - t) * (reach + t);
        if discriminant >= 0.0 {
            let w = e + discriminant.sqrt();
            emit((w / (t - z)).into());
            emit(((z + t) / w).into());
        } else {
            emit(Complex64::new(e, (-discriminant).sqrt()) / (t - z));
        }
    }
}
