//! Adaptive quadrature of six functions at a time, several nodes in a register.

use crate::field::Six;
use crate::numeric::gauss;
use std::sync::LazyLock;

/// Nodes of a panel, a whole number of blocks.
pub(crate) const NODES: usize = 16;

/// Values of six functions at the nodes of a panel.
pub(crate) type Values = [[f64; NODES]; 6];

/// Sum of panels, with the errors of those that are not halved further.
#[derive(Debug, Default)]
pub(crate) struct Panels {
    pub(crate) value: Six,
    pub(crate) error: Six,
    /// Sum of the magnitudes of all terms.
    pub(crate) size: Six,
}

/// Gauss's rule, and the weights of the last two Legendre coefficients.
struct Rule {
    nodes: [f64; NODES],
    weights: [f64; NODES],
    last: [[f64; NODES]; 2],
}

static RULE: LazyLock<Rule> = LazyLock::new(|| {
    let rule = gauss::rule(NODES);
    let mut found = Rule {
        nodes: [0.0; NODES],
        weights: [0.0; NODES],
        last: [[0.0; NODES]; 2],
    };
    for (i, (x, weight)) in rule.on(-1.0, 1.0).enumerate() {
        (found.nodes[i], found.weights[i]) = (x, weight);
        for (j, last) in found.last.iter_mut().enumerate() {
            let degree = NODES - 2 + j;
            last[i] = (degree as f64 + 0.5) * weight * gauss::legendre(degree, x).0;
        }
    }
    found
});

impl Panels {
    /// Adds the integral over an interval of functions whose values `of` gives at the nodes of a panel; `allowed` is the
    /// error of a panel.
    pub(crate) fn add(
        &mut self,
        interval: [f64; 2],
        allowed: &Six,
        mut of: impl FnMut(&[f64; NODES]) -> Values,
    ) {
        /// Most panels of an interval.
        const MOST: usize = 200;
        /// Error of a Gauss rule over the square of the last coefficients, over the largest value.
        const CAUTION: f64 = 4.0;
        /// Ratio of errors above which halving has not reduced one.
        const STAYS: f64 = 0.45;
        /// Error over the size of a panel below which it may be rounding.
        const ROUNDING: f64 = 1e-8;
        let rule = &*RULE;
        // with the excess of the error over the allowed one, and how often halving has not reduced it
        let mut stack = vec![(interval, f64::INFINITY, 0)];
        let mut count = 0;
        while let Some(([from, to], before, stays)) = stack.pop() {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            let nodes = rule.nodes.map(|x| middle + half * x);
            let values = of(&nodes);
            let (mut sums, mut errors, mut sizes) = ([0.0; 6], [0.0; 6], [0.0; 6]);
            for (f, values) in values.iter().enumerate() {
                let mut last = [0.0; 2];
                let mut largest = f64::MIN_POSITIVE;
                for (i, value) in values.iter().enumerate() {
                    sums[f] += half * rule.weights[i] * value;
                    sizes[f] += half * rule.weights[i] * value.abs();
                    largest = largest.max(value.abs());
                    for (last, weights) in last.iter_mut().zip(&rule.last) {
                        *last += weights[i] * value;
                    }
                }
                let rest = last[0].abs() + last[1].abs();
                errors[f] = CAUTION * half * rest * (rest / largest).min(1.0);
            }
            count += 1;
            let excess = (0..6)
                .map(|f| errors[f] / allowed[f].max(f64::EPSILON * sizes[f]))
                .fold(0.0, f64::max);
            // a small error that halving does not reduce is rounding
            let is_small = (0..6).all(|f| errors[f] <= allowed[f].max(ROUNDING * sizes[f]));
            let stays = if is_small && excess > STAYS * before {
                stays + 1
            } else {
                0
            };
            if excess <= 1.0 || stays > 1 || count + stack.len() >= MOST {
                for f in 0..6 {
                    self.value[f] += sums[f];
                    self.error[f] += errors[f];
                    self.size[f] += sizes[f];
                }
            } else {
                stack.push(([middle, to], excess, stays));
                stack.push(([from, middle], excess, stays));
            }
        }
    }
}
