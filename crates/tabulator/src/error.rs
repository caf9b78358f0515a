//! What can stop a build.

use fault::{Class, Culprit, Fault};
use halfspace::DomainError;
use lookup::{ContentError, TableError};
use output::OutputError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A table could not be built.
#[derive(Debug, Error)]
pub enum BuildError {
    /// Settings that are no grid or that nothing serves, and shards that make no table.
    #[error("{sentence}")]
    Refused {
        /// What is wrong and, where there is one, the way out.
        sentence: String,
        /// The file, where one is wrong.
        file: Option<PathBuf>,
    },
    /// A kernel value that is no number; it does not happen at a point that a grid can have.
    #[error("no finite kernel value at {0}")]
    NotFinite(String),
    /// A setting of the grid is outside its range.
    #[error("grid: {key} = {value} is outside {range}")]
    Setting {
        /// Key in the grid file.
        key: String,
        value: f64,
        range: &'static str,
    },
    /// Settings from a file are not a grid, or not an accepted one.
    #[error("{}: {source}", path.display())]
    InFile {
        /// Grid file, table or shard.
        path: PathBuf,
        /// What is wrong with them.
        source: Box<BuildError>,
    },
    /// The settings cannot be written as TOML.
    #[error("grid: {0}")]
    Unwritable(#[from] toml::ser::Error),
    /// A table is to be made smaller.
    #[error("{key} = {value} is less than the {present} that the table has: tables only grow")]
    Shrinks {
        /// What is to be changed.
        key: &'static str,
        value: f64,
        /// The value of the table.
        present: f64,
    },
    /// The output cannot be written, or is not to be; something else that is unfinished is in the way, or cannot be read.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A grid file cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
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
        let file = file.map(Path::to_owned);
        Self::Refused { sentence, file }
    }

    /// The error of settings that came from a file.
    pub(crate) fn in_file(self, path: &Path) -> Self {
        Self::InFile {
            path: path.to_owned(),
            source: Box::new(self),
        }
    }
}

impl Fault for BuildError {
    fn culprit(&self) -> Culprit<'_> {
        let (grid, work) = (Culprit::of(Class::Scene), Culprit::of(Class::Work));
        match self {
            Self::Output(error) => error.culprit(),
            Self::Table(error) => error.culprit(),
            Self::Domain(error) => error.culprit().unmendable(),
            Self::Lookup(error) => error.culprit().unmendable(),
            Self::Setting { key, value, range } => grid.key(key).number(*value).range(range),
            Self::Shrinks { key, value, .. } => grid.key(key).number(*value),
            Self::Refused { file, .. } => Culprit {
                file: file.as_deref().map(Into::into),
                ..grid
            },
            Self::InFile { path, source } => {
                let found = source.culprit();
                let file = found.file.or(Some(path.into()));
                Culprit { file, ..found }
            }
            Self::File { path, .. } => grid.file(path),
            Self::Unwritable(_) | Self::NotFinite(_) | Self::Content(_) => work,
        }
    }
}
