//! Gauss-Legendre rules of any order.

use std::f64::consts::PI;

/// Nodes and weights on [-1, 1].
#[derive(Debug, Clone)]
pub(crate) struct Rule {
    pub(crate) nodes: Vec<f64>,
    pub(crate) weights: Vec<f64>,
}

impl Rule {
    /// The rule of `n` points, exact for polynomials of degree 2 n - 1.
    pub(crate) fn new(n: usize) -> Self {
        let mut rule = Self {
            nodes: vec![0.0; n],
            weights: vec![0.0; n],
        };
        for i in 0..n {
            let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            let mut slope = 0.0;
            for _ in 0..60 {
                let (value, derivative) = legendre(n, x);
                slope = derivative;
                let step = value / derivative;
                x -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            rule.nodes[i] = x;
            rule.weights[i] = 2.0 / ((1.0 - x * x) * slope * slope);
        }
        rule
    }

    /// Nodes and weights on [from, to].
    pub(crate) fn on(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        self.nodes
            .iter()
            .zip(&self.weights)
            .map(move |(x, w)| (middle + half * x, half * w))
    }
}

/// P_n(x) and its derivative.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (0.0, 1.0);
    for j in 1..=n {
        let j = j as f64;
        (before, value) = (
            value,
            ((2.0 * j - 1.0) * x * value - (j - 1.0) * before) / j,
        );
    }
    (value, n as f64 * (x * value - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_exact() {
        for n in [2, 5, 16, 24, 48] {
            let rule = Rule::new(n);
            for power in [0, 2, 2 * n - 2] {
                let sum: f64 = rule
                    .on(0.0, 2.0)
                    .map(|(x, w)| w * x.powi(power as i32))
                    .sum();
                let exact = 2.0_f64.powi(power as i32 + 1) / (power as f64 + 1.0);
                assert!((sum / exact - 1.0).abs() < 1e-12, "n = {n}, x^{power}");
            }
        }
    }
}
