//! The transform of w on the axis in double-double arithmetic, for Gaver-Stehfest beyond 18 terms.

use crate::extended::{divide, exponential, root, sine_cosine};
use crate::inversion::MOST_TERMS;
use halfspace::Medium;
use twofloat::TwoFloat;

/// Step response of w at (0, z), z > 0, for real s.
#[derive(Debug)]
pub(crate) struct AxisTransform {
    z: f64,
    shear: TwoFloat,
    nodes: Vec<Node>,
}

/// A node with its weight times k Z_H(k).
#[derive(Debug)]
struct Node {
    k2: TwoFloat,
    weight: TwoFloat,
}

impl AxisTransform {
    /// For every s from `least` to [`MOST_TERMS`] times it.
    pub(crate) fn new(medium: &Medium, z: f64, least: f64) -> Self {
        const POINTS: usize = 34;
        const DIGITS: f64 = 32.0;
        let rule = rule(POINTS);
        let reach = DIGITS * std::f64::consts::LN_10 / z;
        let most = MOST_TERMS as f64 * least;
        // e^{-alpha z} over e^{-s z}
        let end = (reach * (reach + 2.0 * most)).sqrt();
        let mut transform = Self {
            z,
            // 1/kappa^2 = (2 - 2 nu)/(1 - 2 nu)
            shear: {
                let nu = TwoFloat::from(medium.poisson_ratio());
                divide(2.0 - nu * 2.0, 1.0 - nu * 2.0)
            },
            nodes: Vec::new(),
        };
        // the singularities lie on the imaginary axis at s and beyond
        let (mut from, mut width) = (0.0, least);
        while from < end {
            let to = from + width;
            // the panels join exactly
            let half = TwoFloat::new_sub(to, from) * 0.5;
            for &(x, weight) in &rule {
                let k = (x + 1.0) * half + from;
                let load = load(k) * weight * half;
                transform.nodes.push(Node {
                    k2: k * k,
                    weight: load,
                });
            }
            from = to;
            width = (0.8 * from).min(4.0);
        }
        transform
    }

    /// Integrand evaluations of one value.
    pub(crate) fn nodes(&self) -> usize {
        self.nodes.len()
    }

    /// The step response at s.
    pub(crate) fn step(&self, s: TwoFloat) -> TwoFloat {
        let s2 = s * s;
        let slow = s2 * self.shear;
        let mut sum = TwoFloat::from(0.0);
        for Node { k2, weight } in &self.nodes {
            let (alpha, beta) = (root(*k2 + s2), root(*k2 + slow));
            let gamma = *k2 * 2.0 + slow;
            let product = alpha * beta;
            let excess = divide(*k2 * (s2 + slow) + s2 * slow, product + *k2);
            let d = slow * (*k2 * 4.0 + slow) - *k2 * 4.0 * excess;
            let p = exponential(-(alpha * self.z));
            let q = exponential(-(beta * self.z));
            sum += *weight * divide(alpha * (gamma * p - *k2 * 2.0 * q), d);
        }
        divide(sum, s)
    }
}

/// k Z_H(k), see [`crate::transform::load`].
fn load(k: TwoFloat) -> TwoFloat {
    let scale = divide(TwoFloat::from(1.5), twofloat::consts::PI);
    if k.hi() < 0.5 {
        // sum (-1)^n 2 n k^(2n + 1)/(2n + 1)! over k^2
        let square = k * k;
        let mut term = divide(k, TwoFloat::from(3.0));
        let mut sum = term;
        for n in 2..14 {
            let m = f64::from(2 * n);
            term = -term * square / (m - 2.0) / (m + 1.0);
            sum += term;
        }
        return scale * sum;
    }
    let (sine, cosine) = sine_cosine(k);
    divide(scale * (sine - k * cosine), k * k)
}

/// Gauss-Legendre nodes and weights on [-1, 1].
fn rule(points: usize) -> Vec<(TwoFloat, TwoFloat)> {
    let coarse = halfspace::gauss::Rule::new(points);
    let legendre = |x: TwoFloat| {
        let (mut before, mut value) = (TwoFloat::from(0.0), TwoFloat::from(1.0));
        for j in 1..=points {
            let j = j as f64;
            (before, value) = (
                value,
                (x * value * (2.0 * j - 1.0) - before * (j - 1.0)) / j,
            );
        }
        let slope = divide((x * value - before) * points as f64, x * x - 1.0);
        (value, slope)
    };
    coarse
        .nodes()
        .iter()
        .map(|&x| {
            let mut x = TwoFloat::from(x);
            for _ in 0..2 {
                let (value, slope) = legendre(x);
                x -= divide(value, slope);
            }
            let (_, slope) = legendre(x);
            let weight = divide(TwoFloat::from(2.0), (1.0 - x * x) * slope * slope);
            (x, weight)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hankel::Hankel;

    #[test]
    fn it_continues_the_digits_of_the_double_transform() {
        let medium = Medium::new(0.3).unwrap();
        let hankel = Hankel::new(&medium, 0.0, 0.6, 14.0);
        let coarse = AxisTransform::new(&medium, 0.6, 0.1);
        let fine = AxisTransform::new(&medium, 0.6, 0.05);
        for s in [0.11, 0.7, 1.4] {
            let a = coarse.step(TwoFloat::from(s));
            let b = fine.step(TwoFloat::from(s));
            assert!(f64::from(divide(a - b, a)).abs() < 1e-26, "s = {s}");
            let double = hankel.step(&hankel.nodes(0.1, 60.0), s.into())[1].re;
            assert!((f64::from(a) / double - 1.0).abs() < 1e-12, "s = {s}");
        }
    }
}
