//! What can stop a build.

use fault::{Class, Culprit, Fault};
use halfspace::DomainError;
use ledger::JournalError;
use lookup::{ContentError, TableError};
use output::OutputError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A table could not be built.
#[derive(Debug, Error)]
pub enum BuildError {
    /// A setting of the grid is outside its range.
    #[error("grid: {key} = {value} is outside {range}")]
    Setting {
        /// Key in the grid file.
        key: String,
        value: f64,
        range: &'static str,
    },
    /// Text that is no grid.
    #[error("the settings are not a grid: {detail}")]
    Settings {
        /// What is wrong with them, and where.
        detail: String,
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
    /// No spacing allowed is fine enough.
    #[error(
        "an error of {tolerance} for pulses of {pulse_length} r0/c1 is not reached: {best:.1e} at the finest spacing tried; a smaller cell_width or a longer pulse is needed"
    )]
    TooFine {
        /// The error asked for.
        tolerance: f64,
        /// The length of the pulse.
        pulse_length: f64,
        /// The least error found.
        best: f64,
    },
    /// A table is to be made smaller.
    #[error("{key} = {value} is less than the {present} that the table has: tables only grow")]
    Shrinks {
        /// What is to be changed.
        key: &'static str,
        value: f64,
        /// The value of the table.
        present: f64,
    },
    /// The output cannot be written, or is not to be.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Something else that is unfinished is in the way, or its file cannot be read.
    #[error(transparent)]
    Journal(JournalError),
    /// A file that should hold blocks of a table does not.
    #[error("{} is not a shard of a kernel table made by this version of the program", path.display())]
    NotBlocks {
        /// File given.
        path: PathBuf,
    },
    /// No shard at all.
    #[error("a table is joined from one shard or more")]
    NoShards,
    /// Shards of different tables.
    #[error("{} was made with other settings than {}: shards of one table have the same grid", second.display(), first.display())]
    Mixed {
        /// The first shard.
        first: PathBuf,
        /// The one that does not fit.
        second: PathBuf,
    },
    /// Shards that do not make up a table.
    #[error(
        "{missing} of {total} blocks are missing, the first for poisson_ratio = {poisson_ratio}, row {row}: all shards are needed, each finished"
    )]
    Incomplete {
        /// Blocks missing.
        missing: usize,
        /// Blocks of the table.
        total: usize,
        /// Slice of the first missing block.
        poisson_ratio: f64,
        /// Its row.
        row: usize,
    },
    /// A file operation failed.
    #[error("cannot {action} {}: {source}", path.display())]
    File {
        /// What was to be done.
        action: &'static str,
        /// With which file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A kernel value is missing or not finite.
    #[error(
        "no finite kernel value at poisson_ratio = {poisson_ratio}, r/r0 = {r}, z/r0 = {z}: {quantity} of field {field}"
    )]
    NotFinite {
        /// Slice.
        poisson_ratio: f64,
        /// Radius of the point.
        r: f64,
        /// Depth of the point.
        z: f64,
        /// Which number.
        quantity: &'static str,
        /// Which field.
        field: &'static str,
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

impl From<JournalError> for BuildError {
    fn from(error: JournalError) -> Self {
        match error {
            JournalError::Unwritable(path, source) => OutputError::writing(&path, source).into(),
            other => Self::Journal(other),
        }
    }
}

impl BuildError {
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
            Self::Settings { .. }
            | Self::TooFine { .. }
            | Self::NoShards
            | Self::Incomplete { .. } => grid,
            Self::InFile { path, source } => {
                let found = source.culprit();
                let file = found.file.or(Some(path));
                Culprit { file, ..found }
            }
            Self::Journal(error) => error.culprit(),
            Self::NotBlocks { path }
            | Self::Mixed { second: path, .. }
            | Self::File { path, .. } => grid.file(path),
            Self::Unwritable(_) | Self::NotFinite { .. } | Self::Content(_) => work,
        }
    }
}
