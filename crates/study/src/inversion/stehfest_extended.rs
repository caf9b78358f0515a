//! Gaver-Stehfest with about 31 decimal digits: double-double arithmetic for weights and transform.
//!
//! The weights of n terms cancel 0.45 n digits on top of the 0.45 n that the result has, so a double ends
//! at 14 to 18 terms whatever the transform; here n may reach [`MOST_TERMS`].

use crate::extended::divide;
use twofloat::TwoFloat;

/// Beyond this many terms 31 digits are used up too.
pub const MOST_TERMS: usize = 30;

/// Weights of `terms` (even) nodes k ln 2/t, k = 1 ..= terms; f(t) = (1/t) sum weight F(node).
#[derive(Debug, Clone)]
pub struct ExtendedWeights {
    weights: Vec<TwoFloat>,
}

impl ExtendedWeights {
    /// The weights of an even number of terms.
    #[must_use]
    pub fn new(terms: usize) -> Self {
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
    #[must_use]
    pub fn terms(&self) -> usize {
        self.weights.len()
    }
}

/// f(t) of a transform of a real variable in double-double arithmetic.
pub fn stehfest_extended(
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
