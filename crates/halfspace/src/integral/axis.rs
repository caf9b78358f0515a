//! The axis under a point force or a punch, and under the impulse of any load.
//!
//! On the axis the fronts of opposite edges meet and the compact potentials become delta functions. Near the axis each
//! field is, between fronts, r to the power of its parity times a smooth function of r^2, so its values at a few small
//! radii determine those on the axis.

use crate::arrivals::Arrivals;
use crate::field::{Estimate, FIELDS, Point, Six};
use crate::medium::Medium;
use crate::numeric::polynomial::lagrange;
use crate::potentials::IMPULSE;
use crate::profile::Profile;

/// Fraction of the distance from the edge of the disc below which fields are extrapolated to a radius.
const NEAR_AXIS: f64 = 0.03;

/// Error over the size of the combined fields if they lie on both sides of a front.
const ACROSS: f64 = 30.0;

/// Number of radii used.
const RADII: usize = 6;

/// Whether the fields at a point are extrapolated from larger radii.
pub(crate) fn is_near<const N: i32>(profile: Profile, at: Point) -> bool {
    (profile != Profile::Hertz || N == IMPULSE) && at.r < NEAR_AXIS * at.z.hypot(profile.radius())
}

/// The value at `at` from `evaluate` at radii h, 2h, ..., by interpolation in r^2.
pub(crate) fn continued(
    medium: &Medium,
    profile: Profile,
    at: Point,
    evaluate: impl Fn(Point) -> Estimate,
) -> Estimate {
    let (step, is_clear) = step(medium, profile, at);
    let radii: [f64; RADII] = std::array::from_fn(|i| step * (i + 1) as f64);
    let values = radii.map(|r| evaluate(Point { r, ..at }));
    let (value, error) = combine(at.r, &radii, &values);
    let (coarse, _) = combine(at.r, &radii[..RADII - 1], &values[..RADII - 1]);
    let sizes = values.map(|estimate| Estimate {
        error: estimate.value.map(f64::abs),
        ..estimate
    });
    let (_, size) = combine(at.r, &radii, &sizes);
    Estimate {
        value,
        error: std::array::from_fn(|f| {
            let left = (value[f] - coarse[f]).abs();
            let across = if is_clear { 0.0 } else { ACROSS * size[f] };
            error[f] + left + across
        }),
    }
}

/// A spacing for which all radii are on the same side of every front, and whether there is one.
///
/// At radius r a front from the edge of a disc arrives at most r earlier or later than on the axis, one from a point
/// r^2/(2 z).
fn step(medium: &Medium, profile: Profile, at: Point) -> (f64, bool) {
    /// Largest and smallest spacing over the distance from the edge of the disc.
    const WIDEST_SPACING: f64 = 0.05;
    const LEAST_SPACING: f64 = 1e-4;
    let radius = profile.radius();
    let distance = at.z.hypot(radius);
    let arrivals = Arrivals::new(medium, profile, 0.0, at.z);
    let times = arrivals.map_or(vec![], |arrivals| arrivals.sorted());
    let gap = times.iter().map(|a| (at.t - a).abs()).fold(at.t, f64::min);
    let reach = medium.kappa() * gap;
    let widest = if radius > 0.0 {
        reach
    } else {
        (reach * at.z).sqrt()
    };
    let step = widest / (RADII + 1) as f64;
    let least = LEAST_SPACING * distance;
    (step.clamp(least, WIDEST_SPACING * distance), step >= least)
}

/// Weights of the fields at the i-th of some radii in those at r, by Lagrange interpolation in r^2; odd fields are
/// divided by r first.
pub fn weights_off_axis(r: f64, radii: &[f64], i: usize) -> Six {
    let weight = lagrange(|j| radii[j] * radii[j], radii.len(), i, r * r);
    FIELDS.map(|field| match field.is_odd_in_r() {
        true => weight * (r / radii[i]),
        false => weight,
    })
}

fn combine(r: f64, radii: &[f64], values: &[Estimate]) -> (Six, Six) {
    let (mut sum, mut error) = (Six::default(), Six::default());
    for (i, estimate) in values.iter().enumerate() {
        for (f, weight) in weights_off_axis(r, radii, i).into_iter().enumerate() {
            sum[f] += weight * estimate.value[f];
            error[f] += weight.abs() * estimate.error[f];
        }
    }
    (sum, error)
}
