//! Correlations between random draws: Gauss's copula.
//!
//! Each key has a standard normal number a draw; those of correlated keys are mixed by the Cholesky factor of their
//! correlation matrix, and each is then taken to its own distribution at the same quantile.
//! So every key keeps its distribution, and the coefficient is that of the values for normal, and of their logarithms
//! for log-normal keys.

use crate::error::SceneError;
use crate::section::{Range, Section};
use std::f64::consts::FRAC_1_SQRT_2;
use toml::Value;

/// Open on both sides: keys that follow each other wholly are one key.
const COEFFICIENT: Range = Range {
    name: "(-1, 1)",
    holds: |x| x > -1.0 && x < 1.0,
};

/// The lower Cholesky factor of the correlation matrix of some keys, in their order.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Correlations {
    factor: Vec<Vec<f64>>,
}

impl Correlations {
    /// Reads `[[random.correlation]]`, sections of `keys`, a pair, and `coefficient`.
    pub(crate) fn read(random: &Section<'_>, keys: &[String]) -> Result<Self, SceneError> {
        let n = keys.len();
        let mut matrix: Vec<Vec<f64>> = (0..n)
            .map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect())
            .collect();
        for (name, table) in random.list("correlation")? {
            let section = Section::of(&name, table);
            section.allow(&["keys", "coefficient"])?;
            let [i, j] = pair(&section, keys)?;
            let coefficient = section.required(
                "coefficient",
                COEFFICIENT,
                "the correlation of the two keys",
            )?;
            if matrix[i][j] != 0.0 || i == j {
                return Err(SceneError::Conflict {
                    first: format!("{name} of {}", keys[i]),
                    second: keys[j].clone(),
                    reason: "two different keys have one correlation",
                });
            }
            matrix[i][j] = coefficient;
            matrix[j][i] = coefficient;
        }
        cholesky(&matrix)
            .map(|factor| Self { factor })
            .ok_or_else(|| SceneError::Conflict {
                first: "random.correlation".to_owned(),
                second: "the other ones".to_owned(),
                reason: "together these coefficients are no correlation matrix: it is not positive definite",
            })
    }

    /// Whether a key hangs together with another.
    pub(crate) fn binds(&self, key: usize) -> bool {
        let off = |(column, &l): (usize, &f64)| column != key && l != 0.0;
        self.factor[key].iter().enumerate().any(off)
            || self.factor.iter().skip(key + 1).any(|row| row[key] != 0.0)
    }

    /// The standard normal number of a key from the independent ones of all keys.
    pub(crate) fn mixed(&self, key: usize, normal: impl Fn(usize) -> f64) -> f64 {
        let row = self.factor[key][..=key].iter().enumerate();
        row.map(|(j, &l)| if l == 0.0 { 0.0 } else { l * normal(j) })
            .sum()
    }
}

fn pair(section: &Section<'_>, keys: &[String]) -> Result<[usize; 2], SceneError> {
    let hint =
        "two keys that are drawn, such as [\"striker.diameter_m\", \"striker.velocity_m_s\"]";
    let value = section
        .value("keys")
        .ok_or_else(|| section.missing("keys", hint))?;
    let wrong = || section.wrong_kind("keys", value, "a pair of keys that are drawn");
    let Value::Array(items) = value else {
        return Err(wrong());
    };
    let place = |item: &Value| {
        let word = item.as_str().ok_or_else(wrong)?;
        let found = keys.iter().position(|key| key == word);
        found.ok_or_else(|| SceneError::UnknownChoice {
            key: section.key("keys"),
            value: word.to_owned(),
            allowed: format!("the keys that are drawn: {}", keys.join(", ")),
        })
    };
    match items.as_slice() {
        [first, second] => Ok([place(first)?, place(second)?]),
        _ => Err(wrong()),
    }
}

/// The lower factor; none where the matrix is not positive definite.
fn cholesky(matrix: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let n = matrix.len();
    let mut factor = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            let rest = matrix[i][j] - known;
            factor[i][j] = if i == j {
                if rest <= 1e-12 {
                    return None;
                }
                rest.sqrt()
            } else {
                rest / factor[j][j]
            };
        }
    }
    Some(factor)
}

/// The probability of a standard normal number below this one, in (0, 1).
pub(crate) fn normal_probability(normal: f64) -> f64 {
    let below = 0.5 * libm::erfc(-normal * FRAC_1_SQRT_2);
    below.clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_give_their_matrix() {
        let matrix = vec![
            vec![1.0, 0.6, -0.2],
            vec![0.6, 1.0, 0.3],
            vec![-0.2, 0.3, 1.0],
        ];
        let factor = cholesky(&matrix).unwrap_or_default();
        for i in 0..3 {
            for j in 0..3 {
                let product: f64 = (0..3).map(|k| factor[i][k] * factor[j][k]).sum();
                assert!((product - matrix[i][j]).abs() < 1e-15);
            }
        }
        let impossible = [
            vec![1.0, 0.9, -0.9],
            vec![0.9, 1.0, 0.9],
            vec![-0.9, 0.9, 1.0],
        ];
        assert_eq!(cholesky(&impossible), None);
    }

    #[test]
    fn probabilities_are_those_of_tables() {
        // Abramowitz and Stegun, table 26.1
        assert_eq!(normal_probability(0.0), 0.5);
        assert!((normal_probability(1.0) - 0.841344746068543).abs() < 1e-15);
        assert!((normal_probability(-2.0) - 0.022750131948179).abs() < 1e-15);
        assert!(normal_probability(50.0) < 1.0 && normal_probability(-50.0) > 0.0);
    }
}
