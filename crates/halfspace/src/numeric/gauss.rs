//! Gauss-Legendre rules and Legendre polynomials.
//!
//! ```
//! // int_0^1 e^x dx = e - 1
//! let sum: f64 = halfspace::gauss::rule(10).on(0.0, 1.0).map(|(x, weight)| weight * x.exp()).sum();
//! assert!((sum - (1.0_f64.exp() - 1.0)).abs() < 1e-15);
//! ```

use crate::numeric::lanes::WIDTH;
use std::sync::OnceLock;

/// Largest number of nodes of a cached rule.
pub const MAX_NODES: usize = 80;

/// Nodes and weights of one Gauss-Legendre rule on [-1, 1], nodes ascending.
#[derive(Debug, Clone)]
pub struct Rule {
    count: usize,
    /// Nodes in whole blocks; the last block is filled with nodes of zero weight.
    nodes: Vec<f64>,
    weights: Vec<f64>,
}

impl Rule {
    /// The rule with `n` > 0 nodes, exact for polynomials of degree 2n - 1.
    ///
    /// Newton iteration on the Legendre polynomial from Tricomi's initial guess.
    pub fn new(n: usize) -> Self {
        let mut nodes = vec![0.0; n];
        let mut weights = vec![0.0; n];
        for i in 0..n.div_ceil(2) {
            let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            let mut slope = 0.0;
            for _ in 0..100 {
                let (value, derivative) = legendre(n, x);
                slope = derivative;
                let step = value / derivative;
                x -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            let weight = 2.0 / ((1.0 - x * x) * slope * slope);
            (nodes[i], weights[i]) = (-x, weight);
            (nodes[n - 1 - i], weights[n - 1 - i]) = (x, weight);
        }
        if n % 2 == 1 {
            nodes[n / 2] = 0.0;
        }
        Self::of(nodes, weights)
    }

    fn of(mut nodes: Vec<f64>, mut weights: Vec<f64>) -> Self {
        let count = nodes.len();
        nodes.resize(count.next_multiple_of(WIDTH), 0.5);
        weights.resize(nodes.len(), 0.0);
        Self {
            count,
            nodes,
            weights,
        }
    }

    /// Nodes and weights in whole registers of `lanes` numbers.
    #[inline]
    pub(crate) fn in_registers(&self, lanes: usize) -> [&[f64]; 2] {
        let used = self.count.next_multiple_of(lanes);
        [&self.nodes[..used], &self.weights[..used]]
    }

    /// Nodes on [-1, 1], ascending.
    pub fn nodes(&self) -> &[f64] {
        &self.nodes[..self.count]
    }

    /// Weights of the nodes.
    pub(crate) fn weights(&self) -> &[f64] {
        &self.weights[..self.count]
    }

    /// Pairs of node and weight, mapped to the interval [a, b].
    pub fn on(&self, a: f64, b: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (mid, half) = (0.5 * (a + b), 0.5 * (b - a));
        self.nodes()
            .iter()
            .zip(self.weights())
            .map(move |(&x, &w)| (mid + half * x, half * w))
    }
}

/// The rule with `n` nodes, exact for polynomials of degree 2n - 1; it is computed once and cached.
///
/// # Panics
/// If n is not in 1 to [`MAX_NODES`].
pub fn rule(n: usize) -> &'static Rule {
    static RULES: [OnceLock<Rule>; MAX_NODES] = [const { OnceLock::new() }; MAX_NODES];
    RULES[n - 1].get_or_init(|| Rule::new(n))
}

/// The rule with `n` nodes on [0, 1] for integrands g(s)/s^2, g smooth with g'(0) = 0, in Hadamard's sense.
///
/// ```text
/// f.p. int_0^1 g(s)/s^2 ds = int_0^1 (g(s) - g(0) - g'(0) s)/s^2 ds - g(0)
/// ```
///
/// The weights multiply g(s)/s^2; g(0) and g'(0) are those of the polynomial through the nodes.
pub(crate) fn finite_part_rule(n: usize) -> &'static Rule {
    static RULES: [OnceLock<Rule>; MAX_NODES] = [const { OnceLock::new() }; MAX_NODES];
    RULES[n - 1].get_or_init(|| finite_part(n))
}

fn finite_part(n: usize) -> Rule {
    let (nodes, plain): (Vec<f64>, Vec<f64>) = rule(n).on(0.0, 1.0).unzip();
    let moment = |power: i32| -> f64 {
        nodes
            .iter()
            .zip(&plain)
            .map(|(s, w)| w * s.powi(power))
            .sum()
    };
    let (value_cost, slope_cost) = (moment(-2) + 1.0, moment(-1));
    let weights = (0..n)
        .map(|i| {
            let others = || (0..n).filter(|&j| j != i);
            let value: f64 = others().map(|j| nodes[j] / (nodes[j] - nodes[i])).product();
            let slope = -value * others().map(|j| 1.0 / nodes[j]).sum::<f64>();
            plain[i] - nodes[i] * nodes[i] * (value * value_cost + slope * slope_cost)
        })
        .collect();
    Rule::of(nodes, weights)
}

/// Legendre polynomial of degree n and its derivative at |x| < 1.
#[inline]
pub fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut current) = (0.0, 1.0);
    for k in 1..=n {
        let k = k as f64;
        (previous, current) = (
            current,
            ((2.0 * k - 1.0) * x * current - (k - 1.0) * previous) / k,
        );
    }
    let slope = n as f64 * (x * current - previous) / (x * x - 1.0);
    (current, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finite_parts_of_powers_are_exact() {
        for n in 3..=20 {
            let rule = finite_part_rule(n);
            for power in (0..n as i32).filter(|&k| k != 1).map(|k| k - 2) {
                let terms = rule.nodes().iter().zip(rule.weights());
                let sum: f64 = terms.map(|(s, w)| w * s.powi(power)).sum();
                let exact = 1.0 / (f64::from(power) + 1.0);
                assert!((sum - exact).abs() < 1e-10, "n = {n}, s^{power}: {sum}");
            }
        }
    }

    #[test]
    fn every_rule_is_exact_up_to_its_degree() {
        for n in 1..=MAX_NODES {
            for degree in 0..2 * n {
                let sum: f64 = rule(n)
                    .on(-1.0, 1.0)
                    .map(|(x, w)| w * x.powi(degree as i32))
                    .sum();
                let exact = if degree % 2 == 0 {
                    2.0 / (degree as f64 + 1.0)
                } else {
                    0.0
                };
                assert!(
                    (sum - exact).abs() < 4e-15,
                    "n = {n}, degree = {degree}: {sum} against {exact}"
                );
            }
        }
    }
}
