//! Adaptive quadrature of six fields at a time, several nodes in a register.

use crate::field::Six;
use crate::numeric::gauss;
use std::sync::LazyLock;

/// Nodes of a panel, a whole number of blocks.
pub(crate) const NODES: usize = 16;

/// Six fields at the nodes of a panel, then the sums of the magnitudes of the terms of which displacements and stresses are made.
pub(crate) type Values = [[f64; NODES]; 8];

/// Sum of panels, with the errors of their rules and of rounding.
#[derive(Debug, Default)]
pub(crate) struct Panels {
    pub(crate) value: Six,
    pub(crate) error: Six,
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
    /// Adds the integral over an interval; `of` gives the values at the nodes of a panel, and `allowed` is its error.
    pub(crate) fn add(
        &mut self,
        interval: [f64; 2],
        allowed: &Six,
        mut of: impl FnMut(&[f64; NODES]) -> Values,
    ) {
        /// Most panels of an interval.
        const MOST_PANELS: usize = 200;
        /// Error of a Gauss rule over the power 3/2 of the last two Legendre coefficients, over the root of the largest value.
        const CAUTION: f64 = 4.0;
        /// Rounding error over the magnitudes of the terms, which are products over all legs; at 1e-15 twice as many
        /// fields are above their estimate at 12 transits.
        const ROUNDING: f64 = 1e-14;
        let rule = &*RULE;
        let mut stack = vec![interval];
        let mut count = 0;
        while let Some([from, to]) = stack.pop() {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            let values = of(&rule.nodes.map(|x| middle + half * x));
            let dot = |weights: &[f64; NODES], values: &[f64; NODES]| {
                weights.iter().zip(values).map(|(w, v)| w * v).sum::<f64>()
            };
            let rounding = [6, 7].map(|kind| ROUNDING * half * dot(&rule.weights, &values[kind]));
            let mut errors = Six::default();
            for (error, values) in errors.iter_mut().zip(&values) {
                let rest: f64 = rule.last.iter().map(|last| dot(last, values).abs()).sum();
                let largest = values
                    .iter()
                    .fold(f64::MIN_POSITIVE, |most, v| most.max(v.abs()));
                *error = CAUTION * half * rest * (rest / largest).min(1.0).sqrt();
            }
            count += 1;
            let is_fine =
                (0..6).all(|f| errors[f] <= allowed[f].max(rounding[usize::from(f >= 2)]));
            if !is_fine && count + stack.len() < MOST_PANELS {
                stack.push([middle, to]);
                stack.push([from, middle]);
                continue;
            }
            for (f, values) in values[..6].iter().enumerate() {
                self.value[f] += half * dot(&rule.weights, values);
                self.error[f] += errors[f] + rounding[usize::from(f >= 2)];
            }
        }
    }
}
