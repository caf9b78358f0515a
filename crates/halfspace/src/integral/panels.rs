//! Gauss rules on panels that keep clear of singularities.
//!
//! A panel is accepted when every singularity lies outside a Bernstein ellipse large enough for a Gauss rule to reach
//! the accuracy asked for, else it is halved. So the number of nodes follows from the geometry, and nothing is
//! evaluated twice.
//!
//! Theory: `docs/theory.md` (T18).

use crate::integral::strength::RelativeError;
use crate::numeric::gauss;
use crate::numeric::lanes::{Axes, Points, half_axes, major_axis, power};
use arrayvec::ArrayVec;
use num_complex::Complex64;

/// Panels are halved rather than given more nodes than this.
const MOST_NODES: usize = 24;

/// A panel narrower than this fraction of its piece is not halved.
const NARROWEST: f64 = 1e-9;

/// Axis of the ellipse through what is left out as too far to matter.
const FARTHEST: f64 = 7.0;

/// Singularities on ellipses so many times larger than the smallest leave nothing beside what that leaves.
const NEAR: f64 = 2.0;

/// The error at a pole of third order over that at a simple one.
const POLE: f64 = 30.0;

/// Relative rounding error of a term.
pub(crate) const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// What a rule has to keep away from, in its own variable.
#[derive(Debug, Clone)]
pub(crate) struct Images {
    pub(crate) all: Points,
    pub(crate) pole: Complex64,
}

/// How a piece is integrated.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rule {
    /// The finite part of an inverse square at zero.
    pub(crate) finite_part: bool,
    /// The error over the sum of what the singularities would leave one by one.
    pub(crate) caution: f64,
}

/// A node of a rule.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Node {
    pub(crate) place: f64,
    pub(crate) weight: f64,
    /// Of the integrand; squares add up.
    pub(crate) error: RelativeError,
}

/// Passes on the Gauss nodes of each panel, at least `least`; the panels of [0, 1] keep clear of the singularities, to
/// exp(-`digits`) of the integrand.
pub(crate) fn panels(
    images: &Images,
    digits: f64,
    least: f64,
    rule: Rule,
    f: &mut impl FnMut(&mut [Node]),
) {
    let mut stack: ArrayVec<(f64, f64), 64> = ArrayVec::new();
    stack.push((0.0, 1.0));
    let mut axes = Axes::new();
    while let Some((s0, s1)) = stack.pop() {
        let smallest = images.all.axes(s0, s1, &mut axes).min(FARTHEST);
        let pole = half_axes(major_axis(images.pole.re, images.pole.im, s0, s1));
        let (rate, pole_rate) = (half_axes(smallest).ln(), pole.ln());
        let at_cut = s0 == 0.0 && rule.finite_part;
        // Gauss's rule has twice the degree of one that only interpolates.
        let degree = if at_cut { 1.0 } else { 2.0 };
        let least_nodes = (digits / rate).max((digits + POLE.ln()) / pole_rate);
        let nodes = (least_nodes / degree).ceil() + 1.0;
        if nodes > MOST_NODES as f64 && s1 - s0 > NARROWEST {
            let middle = 0.5 * (s0 + s1);
            stack.push((middle, s1));
            stack.push((s0, middle));
            continue;
        }
        let n = (nodes.max(least) as usize).min(MOST_NODES);
        let exponent = degree as u32 * n as u32;
        let all = axes.sum_of_inverse_powers(NEAR * smallest, exponent);
        // of the whole panel, as if one node had it
        let of_rule =
            rule.caution * (all + POLE * power(pole, exponent).recip()) * (n as f64).sqrt();
        let error = (of_rule + ROUNDING).into();
        let (rule, middle, half) = if at_cut {
            (gauss::finite_part_rule(n), 0.0, s1)
        } else {
            (gauss::rule(n), 0.5 * (s0 + s1), 0.5 * (s1 - s0))
        };
        let nodes = rule.nodes.iter().zip(&rule.weights);
        let mut found: ArrayVec<Node, MOST_NODES> = nodes
            .map(|(x, weight)| Node {
                place: middle + half * x,
                weight: half * weight,
                error,
            })
            .collect();
        f(&mut found);
    }
}

/// Sum of half axes of the smallest ellipse with foci s0, s1 through a singularity, focal distance 2.
pub(crate) fn smallest_ellipse(images: &[Complex64], s0: f64, s1: f64) -> f64 {
    let axes = images.iter().map(|v| major_axis(v.re, v.im, s0, s1));
    half_axes(axes.fold(FARTHEST, f64::min))
}
