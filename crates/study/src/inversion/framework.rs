//! Methods that evaluate the transform anew for every time, in the framework of Abate and Whitt (2006).

use num_complex::Complex64;
use std::f64::consts::{LN_2, LN_10, PI};

/// f(t), t > 0, for a transform with any number of components, which is evaluated at all nodes at once.
///
/// A rule is a list of nodes beta_k, Im >= 0, with their weights.
pub(crate) fn invert<const N: usize>(
    rule: &[[Complex64; 2]],
    t: f64,
    transform: impl Fn(&[Complex64]) -> Vec<[Complex64; N]>,
) -> [f64; N] {
    let nodes: Vec<Complex64> = rule.iter().map(|[node, _]| node / t).collect();
    let mut sum = [0.0; N];
    for ([_, weight], values) in rule.iter().zip(transform(&nodes)) {
        for (total, value) in sum.iter_mut().zip(values) {
            *total += (weight * value).re;
        }
    }
    sum.map(|v| v / t)
}

/// Fixed Talbot, Talbot (1979) in the form of Abate and Valko (2004): `terms` nodes on
/// s t = (2 M/5) theta (cot theta + i).
///
/// Needs the transform continued into Re s < 0.
/// Nodes whose weight is below 1e-20 are skipped, since a transform of waves grows there as e^{-s t_last}.
pub(crate) fn talbot(terms: usize) -> Vec<[Complex64; 2]> {
    const LEAST_WEIGHT: f64 = 1e-20;
    let scale = 0.4 * terms as f64;
    let mut rule = vec![[scale.into(), (0.2 * scale.exp()).into()]];
    for k in 1..terms {
        let theta = PI * k as f64 / terms as f64;
        let cot = theta.tan().recip();
        let node = scale * theta * Complex64::new(cot, 1.0);
        let slope = Complex64::new(1.0, theta * (1.0 + cot * cot) - cot);
        let weight = 0.4 * slope * node.exp();
        if weight.norm() > LEAST_WEIGHT {
            rule.push([node, weight]);
        }
    }
    rule
}

/// Gaver-Stehfest, Gaver (1966) and Stehfest (1970): `terms` (even) real nodes k ln 2; the weights
/// alternate and grow as 10^(0.4 terms), so that double precision allows at most 14 to 18 terms.
pub(crate) fn stehfest(terms: usize) -> Vec<[Complex64; 2]> {
    let half = terms / 2;
    let factorial = |n: usize| (1..=n).map(|i| i as f64).product::<f64>();
    let node = |k: usize| {
        let sum: f64 = (k.div_ceil(2)..=k.min(half))
            .map(|j| {
                (j as f64).powi(half as i32) * factorial(2 * j)
                    / (factorial(half - j)
                        * factorial(j)
                        * factorial(j - 1)
                        * factorial(k - j)
                        * factorial(2 * j - k))
            })
            .sum();
        let weight = LN_2 * sign(k + half) * sum;
        [(k as f64 * LN_2).into(), weight.into()]
    };
    (1..=terms).map(node).collect()
}

/// Euler, a Fourier series with Euler summation, Abate and Whitt (1995, 2006): 2 `order` + 1 nodes on the line Re s t = `order` ln(10)/3; about 0.6 `order` digits for smooth functions.
pub(crate) fn euler(order: usize) -> Vec<[Complex64; 2]> {
    let m = order as f64;
    let last = 2 * order;
    let mut xi = vec![1.0; last + 1];
    xi[0] = 0.5;
    xi[last] = 0.5_f64.powi(order as i32);
    let mut binomial = 1.0;
    for k in 1..order {
        binomial *= (order + 1 - k) as f64 / k as f64;
        xi[last - k] = xi[last - k + 1] + binomial * xi[last];
    }
    let scale = 10.0_f64.powf(m / 3.0);
    let node = |(k, xi): (usize, f64)| {
        let node = Complex64::new(m * LN_10 / 3.0, PI * k as f64);
        [node, (scale * sign(k) * xi).into()]
    };
    xi.into_iter().enumerate().map(node).collect()
}

/// (-1)^k.
fn sign(k: usize) -> f64 {
    if k.is_multiple_of(2) { 1.0 } else { -1.0 }
}
