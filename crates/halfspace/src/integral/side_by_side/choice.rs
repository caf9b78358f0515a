//! The potentials, each number by the forms that hold for them.

use super::far::{LARGEST, at_far_front, by_series, series_on_imaginary_axis};
use super::near::{
    by_parts, by_primitives, compact_on_axis, compact_punch, held_primitives,
    primitives_on_imaginary_axis, punch,
};
use crate::numeric::complex::inside;
use crate::numeric::lanes::{Lanes, Pair};
use crate::numeric::scalar::{Real, Scalar};
use crate::potentials::Potentials;
use crate::potentials::closed_form::SMALL_RADIUS;
use crate::potentials::compact::AXIS;
use crate::potentials::far_front::{self, FAR};
use crate::potentials::multipole;
use crate::potentials::order::STEP;
use crate::profile::Profile;
use pulp::Simd;

/// Where the closed forms hold and where the multipole series takes over.
struct Reach<S: Simd> {
    distance: Lanes<S>,
    some_near: bool,
    some_far: bool,
}

impl<S: Simd> Reach<S> {
    #[inline(always)]
    fn new(xi: Pair<S>, r: f64) -> Self {
        let nearest = multipole::nearest::<STEP>(r);
        let gap = (xi.im.abs() - r).abs();
        if (gap + xi.re).largest() + 1.0 < nearest {
            return Self {
                distance: gap,
                some_near: true,
                some_far: false,
            };
        }
        let square = xi.re * xi.re;
        let (inner, outer) = (gap - 1.0, gap + 1.0);
        let distance = ((inner * inner + square).sqrt() + (outer * outer + square).sqrt()) * 0.5;
        Self {
            distance,
            some_near: distance.smallest() < nearest,
            some_far: distance.largest() >= nearest,
        }
    }

    #[inline(always)]
    fn pick(
        &self,
        near: Potentials<Pair<S>>,
        far: Potentials<Pair<S>>,
        r: f64,
    ) -> Potentials<Pair<S>> {
        let limit = self.distance.constant(multipole::nearest::<STEP>(r));
        near.zip(far, |near, far| {
            Pair::where_below(self.distance, limit, near, far)
        })
    }
}

/// The potentials at xi; on the imaginary axis real and imaginary part are apart.
#[inline(always)]
pub(super) fn potentials<S: Simd>(
    profile: Profile,
    xi: Pair<S>,
    (r, digits): (f64, f64),
    on_axis: bool,
) -> Potentials<Pair<S>> {
    let reach = Reach::new(xi, r);
    let near = match profile {
        _ if !reach.some_near => Potentials::all(xi.constant(0.0)),
        Profile::Hertz if r > FAR => at_far_front(xi, (r, digits), on_axis),
        Profile::Hertz if r <= SMALL_RADIUS => by_parts(xi, r),
        Profile::Hertz if on_axis => primitives_on_imaginary_axis(xi.im, r),
        Profile::Hertz => by_primitives(xi, r),
        Profile::Punch | Profile::Point => punch(xi, r),
    };
    if !reach.some_far {
        return near;
    }
    let far = if on_axis {
        series_on_imaginary_axis(profile, xi.im, (r, digits))
    } else {
        by_series(profile, xi, (r, digits))
    };
    reach.pick(near, far, r)
}

/// The compact parts.
#[inline(always)]
pub(super) fn compact<S: Simd>(
    profile: Profile,
    eta: Lanes<S>,
    (r, digits): (f64, f64),
) -> Potentials<Lanes<S>> {
    if profile != Profile::Hertz {
        return compact_punch(eta, r);
    }
    if r < AXIS {
        return compact_on_axis(eta);
    }
    if r <= FAR {
        return held_primitives(eta, r, inside(eta, r));
    }
    let zero = eta.constant(0.0);
    let distance = eta.abs();
    let reach = Reach::new(Pair::new(zero, distance), r);
    let mut psi = Potentials::all(Pair::new(zero, zero));
    if reach.some_near {
        let delta = far_front::delta(eta, r);
        let root = [delta[0].max(zero).sqrt(), delta[1].max(zero).sqrt()];
        let near = far_front::compact_of(
            far_front::chord(delta, root, far_front::terms(LARGEST, r, digits), r),
            r,
        );
        psi = Potentials {
            a_upper: Pair::new(near.a_upper, zero),
            a_lower: Pair::new(zero, near.a_lower),
            g_upper: Pair::new(zero, near.g_upper),
            g_lower: Pair::new(near.g_lower, zero),
        };
    }
    if reach.some_far {
        psi = reach.pick(
            psi,
            series_on_imaginary_axis(Profile::Hertz, distance, (r, digits)),
            r,
        );
    }
    // a2 and b3 are odd
    Potentials {
        a_upper: psi.a_upper.re,
        a_lower: eta.where_below(zero, -psi.a_lower.im, psi.a_lower.im),
        g_upper: eta.where_below(zero, -psi.g_upper.im, psi.g_upper.im),
        g_lower: psi.g_lower.re,
    }
}
