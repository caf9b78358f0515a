//! Gaver-Stehfest with about 31 decimal digits: double-double arithmetic for weights and transform.
//!
//! The weights of n terms cancel 0.45 n digits on top of the 0.45 n that the result has, so a double ends
//! at 14 to 18 terms whatever the transform; here n may reach [`MOST_TERMS`].
//! `twofloat`'s sums and products, and quotients by a double, are exact to 31 digits; its quotients of two
//! double-doubles and its elementary functions stop at 17 to 23 (version 0.8), and are finished here.

use halfspace::Medium;
use twofloat::TwoFloat;

/// Beyond this many terms 31 digits are used up too.
pub(crate) const MOST_TERMS: usize = 30;

/// Weights of `terms` (even) nodes k ln 2/t, k = 1 ..= terms; f(t) = (1/t) sum weight F(node).
#[derive(Debug, Clone)]
pub(crate) struct ExtendedWeights {
    weights: Vec<TwoFloat>,
}

impl ExtendedWeights {
    /// The weights of an even number of terms.
    pub(crate) fn new(terms: usize) -> Self {
        let half = terms / 2;
        let factorial =
            |n: usize| (1..=n).fold(TwoFloat::from(1.0), |product, i| product * i as f64);
        let power = |j: usize| (0..half).fold(TwoFloat::from(1.0), |product, _| product * j as f64);
        let weights = (1..=terms)
            .map(|k| {
                let sum = (k.div_ceil(2)..=k.min(half)).fold(TwoFloat::from(0.0), |sum, j| {
                    let below = factorial(half - j)
                        * factorial(j)
                        * factorial(j - 1)
                        * factorial(k - j)
                        * factorial(2 * j - k);
                    sum + divide(power(j) * factorial(2 * j), below)
                });
                let sign = if (k + half).is_multiple_of(2) {
                    1.0
                } else {
                    -1.0
                };
                sum * sign * twofloat::consts::LN_2
            })
            .collect();
        Self { weights }
    }

    /// Number of terms.
    pub(crate) fn terms(&self) -> usize {
        self.weights.len()
    }
}

/// f(t) of a transform of a real variable in double-double arithmetic.
pub(crate) fn stehfest_extended(
    weights: &ExtendedWeights,
    t: f64,
    mut transform: impl FnMut(TwoFloat) -> TwoFloat,
) -> f64 {
    let mut sum = TwoFloat::from(0.0);
    for (i, &weight) in weights.weights.iter().enumerate() {
        let node = twofloat::consts::LN_2 * (i + 1) as f64 / t;
        sum += weight * transform(node);
    }
    (sum / t).into()
}

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

/// k Z_H(k), see [`super::transform::load`].
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

/// 2 pi.
const TURN: TwoFloat = twofloat::consts::TAU;

/// a/b.
pub(crate) fn divide(a: TwoFloat, b: TwoFloat) -> TwoFloat {
    let first = a.hi() / b.hi();
    let rest = a - b * first;
    let second = rest.hi() / b.hi();
    let third = (rest - b * second).hi() / b.hi();
    TwoFloat::new_add(first, second) + third
}

/// The square root of a > 0.
pub(crate) fn root(a: TwoFloat) -> TwoFloat {
    let x = TwoFloat::from(a.hi().sqrt());
    let x = x + (a - x * x) / (2.0 * x.hi());
    x + (a - x * x) / (2.0 * x.hi())
}

/// e^x for |x| < 700.
pub(crate) fn exponential(x: TwoFloat) -> TwoFloat {
    const HALVINGS: i32 = 9;
    let doublings = (x.hi() / std::f64::consts::LN_2).round();
    let reduced = (x - twofloat::consts::LN_2 * doublings) * 0.5_f64.powi(HALVINGS);
    // e^x - 1 by its series, then doubled: (1 + y)^2 - 1 = y (2 + y)
    let mut term = reduced;
    let mut sum = reduced;
    for n in 2..=12 {
        term = term * reduced / f64::from(n);
        sum += term;
    }
    for _ in 0..HALVINGS {
        sum = sum * (sum + 2.0);
    }
    (sum + 1.0) * doublings.exp2()
}

/// sin x and cos x.
pub(crate) fn sine_cosine(x: TwoFloat) -> (TwoFloat, TwoFloat) {
    const HALVINGS: i32 = 6;
    let turns = (x.hi() / TURN.hi()).round();
    let reduced = (x - TURN * turns) * 0.5_f64.powi(HALVINGS);
    let square = reduced * reduced;
    let (mut sine, mut versed) = (reduced, square * 0.5);
    let (mut odd, mut even) = (sine, versed);
    for n in 1..=9 {
        let m = f64::from(2 * n);
        odd = -odd * square / (m * (m + 1.0));
        even = -even * square / ((m + 1.0) * (m + 2.0));
        sine += odd;
        versed += even;
    }
    // 1 - cos 2x = 2 sin^2 x keeps its digits where cos is near one
    for _ in 0..HALVINGS {
        (sine, versed) = (sine * (1.0 - versed) * 2.0, sine * sine * 2.0);
    }
    (sine, 1.0 - versed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inversion::hankel::Hankel;

    fn small(x: TwoFloat) -> f64 {
        f64::from(x).abs()
    }

    #[test]
    fn functions_keep_thirty_digits() {
        for i in 1..60 {
            let x = divide(TwoFloat::from(f64::from(i)), TwoFloat::from(7.0)) * 3.0;
            assert!(small(divide(x, x * 3.0) * 3.0 - 1.0) < 1e-30);
            assert!(small(divide(root(x) * root(x), x) - 1.0) < 1e-30);
            let (sine, cosine) = sine_cosine(x);
            let (twice, _) = sine_cosine(x * 2.0);
            assert!(small(sine * sine + cosine * cosine - 1.0) < 1e-29, "{i}");
            assert!(small(twice - sine * cosine * 2.0) < 3e-29, "{i}");
            let product = exponential(x) * exponential(-x * 2.0) * exponential(x);
            assert!(small(product - 1.0) < 3e-29, "{i}");
            assert!((f64::from(exponential(x)) / f64::from(x).exp() - 1.0).abs() < 1e-14);
            assert!((f64::from(sine) - f64::from(x).sin()).abs() < 1e-14);
        }
    }

    #[test]
    fn it_continues_the_digits_of_the_double_transform() {
        let medium = Medium::new(0.3).unwrap();
        let hankel = Hankel::new(&medium, [0.0, 0.6], 14.0);
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
