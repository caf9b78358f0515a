//! Fixed Talbot: Talbot (1979) in the form of Abate and Valko (2004).

use super::Framework;
use num_complex::Complex64;
use std::f64::consts::PI;

/// `terms` nodes on s t = (2 M/5) theta (cot theta + i).
///
/// Needs the transform continued into Re s < 0.
/// Nodes whose weight is below 1e-20 are left out: there a transform of waves grows as e^{-s t_last}.
#[must_use]
pub fn talbot(terms: usize) -> Framework {
    const SMALLEST: f64 = 1e-20;
    let scale = 0.4 * terms as f64;
    let mut rule = Framework {
        nodes: vec![scale.into()],
        weights: vec![(0.2 * scale.exp()).into()],
    };
    for k in 1..terms {
        let theta = PI * k as f64 / terms as f64;
        let cot = theta.tan().recip();
        let node = scale * theta * Complex64::new(cot, 1.0);
        let slope = Complex64::new(1.0, theta * (1.0 + cot * cot) - cot);
        let weight = 0.4 * slope * node.exp();
        if weight.norm() > SMALLEST {
            rule.nodes.push(node);
            rule.weights.push(weight);
        }
    }
    rule
}
