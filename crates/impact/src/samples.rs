//! How a sampled force is taken between its samples.

use lookup::Smoothness;

/// Half of the total variation of a sampled force that was `base` before.
pub(crate) fn half_variation(base: f64, force: &[f64]) -> f64 {
    let mut before = base;
    let changes = force.iter().map(|&p| {
        let change = (p - before).abs();
        before = p;
        change
    });
    0.5 * changes.sum::<f64>()
}

/// How the force is taken between its samples, and the largest error of that in the force's unit.
///
/// A force whose third differences are below half of its second differences is smooth on this step; one
/// with jumps or corners is not, and is linear between samples.
pub(crate) fn between_samples(force: &[f64]) -> (Smoothness, f64) {
    let difference = |order: usize| {
        let mut samples = vec![0.0; order];
        samples.extend_from_slice(force);
        for _ in 0..order {
            for i in (1..samples.len()).rev() {
                samples[i] -= samples[i - 1];
            }
        }
        samples[order..]
            .iter()
            .fold(0.0, |most: f64, d| most.max(d.abs()))
    };
    let [second, third, fourth] = [2, 3, 4].map(difference);
    if third < 0.5 * second {
        // the cubic within a cell, and its curvature taken from the cell's ends
        (Smoothness::Smooth, 0.008 * third + 0.026 * fourth)
    } else {
        (Smoothness::Linear, second / 8.0)
    }
}
