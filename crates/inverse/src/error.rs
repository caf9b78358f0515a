//! Values with errors, and why traces do not determine a force.

use fault::{Class, Culprit, Fault, number};
use thiserror::Error;

/// A value with its standard deviation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Its standard deviation, in the same unit.
    pub sd: f64,
}

/// Why traces do not determine a force.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{sentence}")]
pub struct InverseError {
    /// The key at fault, or a description of a number that has none.
    key: Option<String>,
    /// The number at fault.
    value: Option<f64>,
    /// Its allowed values.
    range: Option<String>,
    /// The reason and a way out.
    sentence: String,
}

impl InverseError {
    /// A reason that is no range.
    pub(crate) fn new(key: &str, value: impl Into<Option<f64>>, sentence: String) -> Self {
        Self {
            key: Some(key.to_owned()),
            value: value.into(),
            range: None,
            sentence,
        }
    }

    /// A number outside a range; the remedy follows a colon, where the range does not say it.
    pub(crate) fn outside(key: &str, value: f64, range: &str, remedy: &str) -> Self {
        let sentence = format!("{key} = {} is outside {range}{remedy}", number(value));
        Self {
            range: Some(range.to_owned()),
            ..Self::new(key, value, sentence)
        }
    }

    /// Rounding prevents a solution.
    pub(crate) fn not_solved() -> Self {
        let sentence = "the force could not be computed: the responses are too similar for double precision; shorten the window or use a coarser force step";
        Self {
            key: None,
            ..Self::new("", None, sentence.to_owned())
        }
    }
}

impl Fault for InverseError {
    fn culprit(&self) -> Culprit<'_> {
        let Some(key) = &self.key else {
            return Culprit::of(Class::Work);
        };
        Culprit {
            number: self.value,
            range: self.range.as_deref().map(Into::into),
            ..Culprit::of(Class::Scene).key(key)
        }
    }
}

/// Rejects a number outside a range.
pub(crate) fn check(good: bool, key: &str, value: f64, range: &str) -> Result<(), InverseError> {
    if good {
        Ok(())
    } else {
        Err(InverseError::outside(key, value, range, ""))
    }
}

/// Rejects a number that is not positive and finite.
pub(crate) fn positive(key: &str, value: f64) -> Result<(), InverseError> {
    check(value > 0.0 && value.is_finite(), key, value, "(0, inf)")
}

/// Rejects samples that are not finite.
pub(crate) fn finite(what: &str, samples: &[f64]) -> Result<(), InverseError> {
    let found = samples.iter().position(|x| !x.is_finite());
    found.map_or(Ok(()), |i| {
        let (key, remedy) = (
            format!("sample {i} of {what}"),
            ": remove or interpolate such samples",
        );
        Err(InverseError::outside(
            &key,
            samples[i],
            "(-inf, inf)",
            remedy,
        ))
    })
}
