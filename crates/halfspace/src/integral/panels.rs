//! Gauss rules on panels that keep clear of singularities.
//!
//! A panel is accepted when every singularity lies outside a Bernstein ellipse large enough for a Gauss rule to reach
//! the accuracy asked for, else it is halved. So the number of nodes follows from the geometry, and nothing is
//! evaluated twice.
//!
//! Theory: `docs/theory.md` (T18).

use crate::numeric::gauss;
use crate::numeric::lanes::{Points, WIDTH, half_axes, major_axis, power};
use arrayvec::ArrayVec;
use num_complex::Complex64;

/// Panels are halved rather than given more nodes than this, a whole number of blocks.
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

/// Nodes of a rule, side by side: in whole blocks, the last filled with the last node at no weight.
#[derive(Debug)]
pub(crate) struct Nodes {
    count: usize,
    pub(crate) places: [f64; MOST_NODES],
    pub(crate) weights: [f64; MOST_NODES],
    /// Relative errors of the integrand for displacements and stresses; squares add up.
    pub(crate) errors: [[f64; MOST_NODES]; 2],
}

impl Nodes {
    pub(crate) fn new() -> Self {
        Self {
            count: 0,
            places: [0.0; MOST_NODES],
            weights: [0.0; MOST_NODES],
            errors: [[0.0; MOST_NODES]; 2],
        }
    }

    /// Takes a rule on [-1, 1] at `middle + half x`, of which `map` gives place and slope; leaves out nodes at `from`.
    #[inline(always)]
    pub(crate) fn take(
        &mut self,
        rule: &gauss::Rule,
        (middle, half): (f64, f64),
        from: f64,
        map: impl Fn(f64) -> (f64, f64),
    ) {
        self.count = rule.nodes.len();
        let nodes = rule.nodes.iter().zip(&rule.weights);
        let own = self.places.iter_mut().zip(&mut self.weights);
        for ((x, rule_weight), (place, weight)) in nodes.zip(own) {
            let (v, slope) = map(middle + half * x);
            (*place, *weight) = (v, half * rule_weight * slope);
        }
        let lost = self.places[..self.count]
            .iter()
            .take_while(|place| **place == from);
        let lost = lost.count();
        if lost > 0 {
            self.places.copy_within(lost..self.count, 0);
            self.weights.copy_within(lost..self.count, 0);
            self.count -= lost;
        }
        for i in self.count..self.count.next_multiple_of(WIDTH) {
            (self.places[i], self.weights[i]) = (self.places[self.count - 1], 0.0);
        }
    }

    pub(crate) fn set_errors(&mut self, error: f64) {
        self.errors = [[error; MOST_NODES]; 2];
    }

    /// Errors that depend on the place.
    pub(crate) fn map_errors(&mut self, map: impl Fn([f64; 2], f64) -> [f64; 2]) {
        for i in self.in_registers(WIDTH) {
            let (place, _, error) = self.get(i);
            [self.errors[0][i], self.errors[1][i]] = map(error, place);
        }
    }

    /// The nodes in whole registers of `lanes` numbers.
    pub(crate) fn in_registers(&self, lanes: usize) -> std::ops::Range<usize> {
        0..self.count.next_multiple_of(lanes)
    }

    /// Place, weight and errors of each.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (f64, f64, [f64; 2])> {
        (0..self.count).map(|i| self.get(i))
    }

    #[inline]
    fn get(&self, i: usize) -> (f64, f64, [f64; 2]) {
        let errors = [self.errors[0][i], self.errors[1][i]];
        (self.places[i], self.weights[i], errors)
    }
}

/// Calls `f` with the Gauss rule of each panel, at least `least` nodes, with the middle and half width and the relative
/// error; the panels of [0, 1] keep clear of the singularities, to exp(-`digits`) of the integrand.
///
/// The integral may be the finite part of an inverse square at zero; `caution` is the error over the sum of what the
/// singularities would leave one by one.
#[inline(always)]
pub(crate) fn panels(
    (singularities, pole): (&Points, Complex64),
    (digits, least): (f64, f64),
    (finite_part, caution): (bool, f64),
    f: &mut impl FnMut(&gauss::Rule, (f64, f64), f64),
) {
    let mut stack: ArrayVec<[f64; 2], 64> = ArrayVec::new();
    stack.push([0.0, 1.0]);
    while let Some(ends) = stack.pop() {
        let [s0, s1] = ends;
        let smallest = singularities.smallest_axis(ends).min(FARTHEST);
        let pole = half_axes(major_axis(pole.re, pole.im, ends));
        let (rate, pole_rate) = (half_axes(smallest).ln(), pole.ln());
        let at_cut = s0 == 0.0 && finite_part;
        // Gauss's rule has twice the degree of one that only interpolates.
        let degree = if at_cut { 1.0 } else { 2.0 };
        let least_nodes = (digits / rate).max((digits + POLE.ln()) / pole_rate);
        let nodes = (least_nodes / degree).ceil() + 1.0;
        let (middle, half) = (0.5 * (s0 + s1), 0.5 * (s1 - s0));
        if nodes > MOST_NODES as f64 && s1 - s0 > NARROWEST {
            stack.push([middle, s1]);
            stack.push([s0, middle]);
            continue;
        }
        let n = (nodes.max(least) as usize).min(MOST_NODES);
        let exponent = degree as u32 * n as u32;
        let all = singularities.sum_of_inverse_powers(ends, NEAR * smallest, exponent);
        // of the whole panel, as if one node had it
        let of_rule = caution * (all + POLE * power(pole, exponent).recip()) * (n as f64).sqrt();
        if at_cut {
            f(gauss::finite_part_rule(n), (0.0, s1), of_rule + ROUNDING);
        } else {
            f(gauss::rule(n), (middle, half), of_rule + ROUNDING);
        }
    }
}

/// Sum of half axes of the smallest ellipse with foci s0, s1 through a singularity, focal distance 2.
pub(crate) fn smallest_ellipse(images: &[Complex64], foci: [f64; 2]) -> f64 {
    let axes = images.iter().map(|v| major_axis(v.re, v.im, foci));
    half_axes(axes.fold(FARTHEST, f64::min))
}
