//! Errors of a build.

use fault::{Class, Culprit, Fault};
use halfspace::DomainError;
use lookup::{ContentError, TableError};
use output::OutputError;
use std::path::Path;
use thiserror::Error;

/// Reason why a table could not be built.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BuildError {
    /// Settings that are not a grid, are outside their ranges or less than those of the table to extend; files that
    /// cannot be read; shards that do not make a table.
    #[error("{sentence}")]
    Refused {
        /// Description of the error and, if there is one, of the way out.
        sentence: String,
        /// Key or file at fault, if there is one.
        culprit: Box<Culprit<'static>>,
    },
    /// A kernel value that is not finite; this does not occur at the points of a valid grid.
    #[error("no finite kernel value at {0}")]
    NotFinite(String),
    /// The settings cannot be written as TOML.
    #[error("grid: {0}")]
    Unwritable(#[from] toml::ser::Error),
    /// The output cannot be written or must not be replaced, or an unfinished file of another run is in its place.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The exact kernels reject a point.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// The table cannot be written, read back or validated.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The computed numbers are not a table.
    #[error("the computed numbers are not a table: {0}")]
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

    /// Error of a key with a number outside its range.
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

    /// The error with the file of the settings.
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
