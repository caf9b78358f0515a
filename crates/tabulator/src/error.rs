//! What can stop a build.

use fault::{Class, Culprit, Fault};
use halfspace::DomainError;
use lookup::{ContentError, TableError};
use output::OutputError;
use std::path::Path;
use thiserror::Error;

/// A table could not be built.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BuildError {
    /// Settings that are no grid, outside their ranges or less than a table has, files that cannot be read, shards that make no
    /// table.
    #[error("{sentence}")]
    Refused {
        /// What is wrong and, where there is one, the way out.
        sentence: String,
        /// The key or the file, where one is wrong.
        culprit: Box<Culprit<'static>>,
    },
    /// A kernel value that is no number; it does not happen at a point that a grid can have.
    #[error("no finite kernel value at {0}")]
    NotFinite(String),
    /// The settings cannot be written as TOML.
    #[error("grid: {0}")]
    Unwritable(#[from] toml::ser::Error),
    /// The output cannot be written, or is not to be; something else that is unfinished is in the way, or cannot be read.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The exact kernels refuse a point.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// The table cannot be written, read back or accepted.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The numbers computed are no table.
    #[error("the numbers computed are no table: {0}")]
    Content(#[from] ContentError),
    /// A probe cannot be looked up.
    #[error("verification: {0}")]
    Lookup(#[from] lookup::LookupError),
}

impl BuildError {
    pub(crate) fn refused(file: Option<&Path>, sentence: String) -> Self {
        let culprit = Box::new(Culprit {
            file: file.map(|file| file.to_owned().into()),
            ..Culprit::of(Class::Scene)
        });
        Self::Refused { sentence, culprit }
    }

    /// The error of a key with a number that it cannot have.
    pub(crate) fn of_key(
        key: &str,
        value: f64,
        range: Option<&'static str>,
        sentence: String,
    ) -> Self {
        let culprit = Box::new(Culprit {
            key: Some(key.to_owned().into()),
            number: Some(value),
            range: range.map(Into::into),
            ..Culprit::of(Class::Scene)
        });
        Self::Refused { sentence, culprit }
    }

    /// The error of settings that came from a file.
    pub(crate) fn in_file(mut self, path: &Path) -> Self {
        if let Self::Refused { sentence, culprit } = &mut self {
            *sentence = format!("{}: {sentence}", path.display());
            culprit.file = Some(path.to_owned().into());
        }
        self
    }
}

impl Fault for BuildError {
    fn culprit(&self) -> Culprit<'_> {
        match self {
            Self::Output(error) => error.culprit(),
            Self::Table(error) => error.culprit(),
            Self::Domain(error) => error.culprit().unmendable(),
            Self::Lookup(error) => error.culprit().unmendable(),
            Self::Refused { culprit, .. } => (**culprit).clone(),
            Self::Unwritable(_) | Self::NotFinite(_) | Self::Content(_) => Culprit::of(Class::Work),
        }
    }
}
