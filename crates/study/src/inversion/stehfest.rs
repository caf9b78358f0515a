//! Gaver-Stehfest: Gaver (1966), Stehfest (1970), in double precision.

use super::Framework;
use std::f64::consts::LN_2;

/// `terms` (even) real nodes k ln 2; the weights alternate and grow as 10^(0.4 terms), so that 14 to 18
/// terms are the most that a double carries; [`super::stehfest_extended`] goes on.
#[must_use]
pub fn stehfest(terms: usize) -> Framework {
    let half = terms / 2;
    let factorial = |n: usize| (1..=n).map(|i| i as f64).product::<f64>();
    let weight = |k: usize| {
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
        if (k + half).is_multiple_of(2) {
            sum
        } else {
            -sum
        }
    };
    Framework {
        nodes: (1..=terms).map(|k| (k as f64 * LN_2).into()).collect(),
        weights: (1..=terms).map(|k| (LN_2 * weight(k)).into()).collect(),
    }
}
