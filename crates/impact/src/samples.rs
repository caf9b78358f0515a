//! How a sampled force is taken between its samples.

use crate::stretch::Departure;
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

/// How the force is taken between its samples, and what that leaves of it.
///
/// A force whose third differences are below half of its second differences is smooth on this step; one
/// with jumps or corners is not, and is linear between samples.
/// `known` is what straight lines between the samples leave, where that is known exactly, as of a record: a force that
/// departs from them by more than its samples bend hides something between them, and is not smooth either.
pub(crate) fn between_samples(force: &[f64], known: Option<Departure>) -> (Smoothness, Departure) {
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
    let hidden = known.is_some_and(|known| known.most_n > second / 4.0);
    if third < 0.5 * second && !hidden {
        // the cubic within a cell, and its curvature taken from the cell's ends
        let most_n = 0.008 * third + 0.026 * fourth;
        return (Smoothness::Smooth, Departure::at_most(most_n));
    }
    let bent = || Departure::at_most(second / 8.0);
    (Smoothness::Linear, known.unwrap_or_else(bent))
}
