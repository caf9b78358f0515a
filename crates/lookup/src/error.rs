//! What can be wrong with a table, and what can be wrong with a question to it.

use halfspace::DomainError;
use std::path::PathBuf;
use thiserror::Error;

/// A kernel table could not be read, written or accepted.
#[derive(Debug, Error)]
pub enum TableError {
    /// The file is not there or may not be read.
    #[error("cannot read the kernel table {}: {source}", path.display())]
    Unreadable {
        /// File asked for.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file is not HDF5, or is cut short.
    #[error("{} is not a complete HDF5 file: {detail}", path.display())]
    NotHdf5 {
        /// File asked for.
        path: PathBuf,
        /// First line of what the HDF5 library said.
        detail: String,
    },
    /// An HDF5 file of another kind.
    #[error("{} is not a kernel table: file_type = {found:?}, needed \"{}\"", path.display(), crate::schema::FILE_TYPE_VALUE)]
    Foreign {
        /// File asked for.
        path: PathBuf,
        /// Its `file_type`, empty when there is none.
        found: String,
    },
    /// A format that this program does not know.
    #[error("{} has kernel-table format version {found:?}; this program reads version {}.x", path.display(), crate::schema::MAJOR_READ)]
    Version {
        /// File asked for.
        path: PathBuf,
        /// Its `format_version`.
        found: String,
    },
    /// A dataset or an attribute is absent, unreadable or of another type.
    #[error("kernel table {}: cannot read {item}: {detail}", path.display())]
    Item {
        /// File asked for.
        path: PathBuf,
        /// Path of the dataset or attribute inside the file.
        item: String,
        /// First line of what the HDF5 library said.
        detail: String,
    },
    /// A dataset has another shape than the axes demand.
    #[error("kernel table: {item} has {found} values, needed {needed}")]
    Shape {
        /// Path of the dataset.
        item: String,
        /// Number of values that the axes demand.
        needed: usize,
        /// Number of values found.
        found: usize,
    },
    /// A value that may not be there.
    #[error("kernel table: {item} = {value}, allowed: {range}")]
    Value {
        /// Path of the dataset or attribute, with the index of the value where it has one.
        item: String,
        /// The value found.
        value: f64,
        /// What is allowed.
        range: &'static str,
    },
    /// The content does not have the checksum that the file states.
    #[error("kernel table {}: content hash {found}, stated {stated}: the content was changed", path.display())]
    Checksum {
        /// File asked for.
        path: PathBuf,
        /// Hash in the file.
        stated: String,
        /// Hash of the content.
        found: String,
    },
    /// The file could not be written.
    #[error("cannot write the kernel table {}: {detail}", path.display())]
    Unwritable {
        /// File to be written.
        path: PathBuf,
        /// What the HDF5 library said.
        detail: String,
    },
    /// Poisson's ratio of a slice is outside the physics.
    #[error("kernel table: {0}")]
    Domain(#[from] DomainError),
}

/// A question that a table cannot answer.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LookupError {
    /// The point lies outside the table.
    #[error("{axis} = {value} is outside the table's range [{min}, {max}]")]
    Outside {
        /// `r/r0`, `z/r0` or `poisson_ratio`.
        axis: &'static str,
        /// The value asked for.
        value: f64,
        /// Smallest value that the table serves.
        min: f64,
        /// Largest value that the table serves.
        max: f64,
    },
    /// Time cells beyond anything that a table can hold.
    #[error("coarsening = {value} is outside [0, {max}]")]
    Coarsening {
        /// The value asked for.
        value: u32,
        /// Largest value allowed.
        max: u32,
    },
    /// The slices for the results of a batch do not fit the points.
    #[error(
        "{points} points with memory for {infos} results and {cells} cells: needed as many results as points and a multiple of cells"
    )]
    Lengths {
        /// Points asked for.
        points: usize,
        /// Places for their results.
        infos: usize,
        /// Places for all their cells.
        cells: usize,
    },
    /// The pulse of an error estimate has no length.
    #[error("pulse_length = {value} is outside (0, inf)")]
    PulseLength {
        /// The value asked for.
        value: f64,
    },
    /// The static field cannot be computed there.
    #[error(transparent)]
    Domain(#[from] DomainError),
}
