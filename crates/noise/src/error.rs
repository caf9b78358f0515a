//! Why there is no noise.

use fault::{Class, Culprit, Fault, number};
use halfspace::DomainError;
use thiserror::Error;

/// Why there is no noise.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NoiseError {
    /// A number outside its range.
    #[error("{key} = {} is outside {range}{remedy}", number(*value))]
    Range {
        /// Key or argument.
        key: String,
        /// The rejected number.
        value: f64,
        /// Allowed values.
        range: String,
        /// What to do; begins with a colon.
        remedy: &'static str,
    },
    /// The half-space rejects an argument.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// An impact has no results.
    #[error("impact {row} (counted from 0): {reason}")]
    Impact {
        /// Its number.
        row: usize,
        /// Why.
        reason: String,
    },
}

impl NoiseError {
    /// Rejects a number outside a range.
    pub(crate) fn unless(
        holds: bool,
        key: impl Into<String>,
        value: f64,
        range: &str,
        remedy: &'static str,
    ) -> Result<(), Self> {
        let (key, range) = (key.into(), range.to_owned());
        let error = || Self::Range {
            key,
            value,
            range,
            remedy,
        };
        if holds { Ok(()) } else { Err(error()) }
    }
}

impl Fault for NoiseError {
    fn culprit(&self) -> Culprit<'_> {
        match self {
            Self::Range {
                key, value, range, ..
            } => Culprit::of(Class::Scene)
                .key(key)
                .number(*value)
                .range(range),
            Self::Domain(error) => error.culprit(),
            Self::Impact { .. } => Culprit::of(Class::Impact),
        }
    }
}
