//! The error of this crate: a sentence with its key.

use fault::{Class, Culprit, Fault};
use halfspace::DomainError;
use thiserror::Error;

/// A case that has no histories, or histories that cannot be compared.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{sentence}")]
pub struct OracleError {
    key: String,
    sentence: String,
}

impl OracleError {
    /// Of a key or column.
    pub fn new(key: impl Into<String>, sentence: impl Into<String>) -> Self {
        Self {
            key: key.into(),
            sentence: sentence.into(),
        }
    }
}

impl From<DomainError> for OracleError {
    fn from(error: DomainError) -> Self {
        Self::new(
            "receiver",
            format!("a receiver in units of the disc radius: {error}"),
        )
    }
}

impl Fault for OracleError {
    fn culprit(&self) -> Culprit<'_> {
        Culprit::of(Class::Scene).key(&self.key)
    }
}
