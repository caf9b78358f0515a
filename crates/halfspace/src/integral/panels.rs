//! Gauss rules on panels that avoid singularities.
//!
//! A panel is accepted if every singularity lies outside a Bernstein ellipse that is large enough for a Gauss rule of
//! the requested accuracy; otherwise it is halved. The number of nodes follows from the geometry, and no integrand is
//! evaluated twice. The error estimate depends on the strength of the singularities at the fronts.
//!
//! Theory: `docs/theory.md` (T18).

use crate::numeric::gauss;
use crate::numeric::lanes::{Points, half_axes, major_axis, power};
use crate::numeric::scalar::Real;
use crate::potentials::Order;
use crate::profile::Profile;
use arrayvec::ArrayVec;
use num_complex::Complex64;

/// Largest number of nodes of a panel, a whole number of blocks; panels that need more are halved.
const MOST_NODES: usize = 24;

/// Width of a panel, as a fraction of its piece, below which it is not halved.
const NARROWEST: f64 = 1e-9;

/// Axis of the ellipse beyond which singularities are ignored.
const FARTHEST_ELLIPSE: f64 = 7.0;

/// Ratio to the smallest ellipse above which the errors of other singularities are negligible.
const FARTHER_ELLIPSE: f64 = 2.0;

/// Ratio of the error at a pole of third order to that at a simple pole.
const POLE: f64 = 30.0;

/// Relative rounding error of a term.
pub(crate) const TERM_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The map from one end of an interval: v = start + scale s^power for s in [0, 1].
#[derive(Debug, Clone, Copy)]
pub(crate) struct IntervalEnd {
    pub(crate) start: f64,
    pub(crate) scale: f64,
    pub(crate) power: i32,
    pub(crate) strength: SingularityStrength,
    /// Rounding error of `start`, if it matters.
    pub(crate) place_error: f64,
}

/// Nodes of a rule on a panel.
#[derive(Debug)]
pub(crate) struct PanelNodes {
    pub(crate) rule: &'static gauss::Rule,
    middle: f64,
    half: f64,
    piece: IntervalEnd,
    /// Relative error of the integrand.
    error: f64,
}

impl PanelNodes {
    /// Place and weight of a node, with the relative errors of displacements and stresses; the squares of errors add
    /// up. A node that rounds to the start of the piece is moved and has zero weight.
    #[inline(always)]
    pub(crate) fn at<T: Real>(&self, node: T, weight: T) -> (T, T, [T; 2]) {
        let piece = self.piece;
        let s = node * self.half + self.middle;
        let below = power(s, piece.power as u32 - 1);
        let (least, zero) = (s.constant(f64::MIN_POSITIVE), s.constant(0.0));
        let exact = below * s * piece.scale;
        let distance = (exact + piece.start - piece.start).abs();
        let along = distance.where_below(least, s.constant(0.5 * piece.scale), exact);
        let slope = piece.scale.abs() * f64::from(piece.power) * self.half;
        let mut errors = [s.constant(self.error); 2];
        if piece.place_error > 0.0 {
            let strength = piece.strength;
            errors = strength.at_front(errors, piece.place_error, along.abs(), s);
        }
        let weight = distance.where_below(least, zero, below * weight * slope);
        (along + piece.start, weight, errors)
    }

    /// Place, weight and errors of each node.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (f64, f64, [f64; 2])> {
        let rule = self.rule.nodes().iter().zip(self.rule.weights());
        rule.map(|(&node, &weight)| self.at(node, weight))
    }
}

/// Calls `f` with the nodes of each panel of a piece, whose places are at least `least`. The panels of [0, 1] avoid the
/// singularities, for errors of exp(-`digits`) of the integrand.
///
/// The integral may be the finite part of an inverse square at zero.
#[inline(always)]
pub(crate) fn panels(
    (singularities, pole): (&Points, Complex64),
    (digits, least): (f64, usize),
    piece: IntervalEnd,
    f: &mut impl FnMut(&PanelNodes),
) {
    let finite_part = piece.power > 1 && piece.strength == SingularityStrength::FinitePart;
    let caution = piece.strength.caution();
    let mut stack: ArrayVec<[f64; 2], 64> = ArrayVec::new();
    stack.push([0.0, 1.0]);
    while let Some(ends) = stack.pop() {
        let [s0, s1] = ends;
        let smallest = singularities.smallest_axis(ends).min(FARTHEST_ELLIPSE);
        let pole = half_axes(major_axis(pole.re, pole.im, ends));
        let (rate, pole_rate) = (half_axes(smallest).ln(), pole.ln());
        let at_cut = s0 == 0.0 && finite_part;
        // a Gauss rule has twice the degree of an interpolatory one
        let degree = if at_cut { 1.0 } else { 2.0 };
        let least_nodes = (digits / rate).max((digits + POLE.ln()) / pole_rate);
        let nodes = (least_nodes / degree) as usize;
        let (middle, half) = (0.5 * (s0 + s1), 0.5 * (s1 - s0));
        if nodes > MOST_NODES - 2 && s1 - s0 > NARROWEST {
            stack.push([middle, s1]);
            stack.push([s0, middle]);
            continue;
        }
        let n = nodes.saturating_add(2).max(least).min(MOST_NODES);
        let exponent = degree as u32 * n as u32;
        let all = singularities.sum_of_inverse_powers(ends, FARTHER_ELLIPSE * smallest, exponent);
        // error of the whole panel, assigned to its nodes
        let of_rule = caution * (all + POLE * power(pole, exponent).recip()) * (n as f64).sqrt();
        let (rule, middle, half) = if at_cut {
            (gauss::finite_part_rule(n), 0.0, s1)
        } else {
            (gauss::rule(n), middle, half)
        };
        let error = of_rule + TERM_ROUNDING;
        f(&PanelNodes {
            rule,
            middle,
            half,
            piece,
            error,
        });
    }
}

/// Sum of half axes of the smallest ellipse with foci s0, s1 through a singularity, focal distance 2.
pub(crate) fn smallest_ellipse(images: &[Complex64], foci: [f64; 2]) -> f64 {
    let axes = images.iter().map(|v| major_axis(v.re, v.im, foci));
    half_axes(axes.fold(FARTHEST_ELLIPSE, f64::min))
}

/// Strength of the singularities at the cuts of an integration interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SingularityStrength {
    /// The integrand stays finite.
    Bounded,
    /// The inverse square root.
    InverseRoot,
    /// The power -3/2, as Hadamard's finite part.
    FinitePart,
}

impl SingularityStrength {
    /// Strength for a profile and an order in time.
    ///
    /// The step response of stress has fronts of power -3/2 for a point force and -1/2 for a punch; each time
    /// derivative lowers the power by one.
    pub(crate) fn of<const N: i32>(profile: Profile) -> Self {
        match (profile, Order::of(N)) {
            (Profile::Point, Order::Impulse | Order::Step) => Self::FinitePart,
            (Profile::Hertz, Order::Step | Order::StepIntegral)
            | (Profile::Punch, Order::StepIntegral) => Self::Bounded,
            (Profile::Hertz, Order::Impulse)
            | (Profile::Punch, Order::Impulse | Order::Step)
            | (Profile::Point, Order::StepIntegral) => Self::InverseRoot,
        }
    }

    /// Relative errors of displacements and stresses near a cut, from those of the quadrature rule.
    ///
    /// `place_error` is the rounding error of the place of the cut, `distance` the distance
    /// from it in slowness and `s` in the variable that smooths the singularity.
    #[inline(always)]
    pub(crate) fn at_front<T: Real>(
        self,
        [displacement, stress]: [T; 2],
        place_error: f64,
        distance: T,
        s: T,
    ) -> [T; 2] {
        /// Factor for the shared error: all nodes near a front have the error of its place, so that errors add up
        /// rather than squares.
        const SHARED: f64 = 5.0;
        let front = s.constant(SHARED * place_error) / distance;
        match self {
            Self::Bounded => [displacement, stress],
            // displacements have a square root at the front
            Self::InverseRoot => [displacement + front * s, stress + front],
            Self::FinitePart => [displacement + front, stress + front * 3.0],
        }
    }

    /// Ratio of the error of a Gauss rule to the sum of rho^(-2n) over all singularities near it.
    ///
    /// Calibrated on the random points of `tests/estimate.rs`; `tests/estimate_by_region.rs` checks it at others.
    pub(crate) fn caution(self) -> f64 {
        const BOUNDED: f64 = 56.0;
        match self {
            Self::Bounded => BOUNDED,
            Self::InverseRoot => 3.0 * BOUNDED,
            Self::FinitePart => 60.0 * BOUNDED,
        }
    }
}
