//! What can be wrong with the file of a table. Every error names the file, once.

use crate::error::ContentError;
use std::path::PathBuf;
use thiserror::Error;

/// The file of a kernel table could not be read, accepted or written.
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
        /// What is missing, or the first line of what the HDF5 library said.
        detail: String,
    },
    /// Bytes of the file are not those that were written.
    #[error("kernel table {} is damaged: {detail}", path.display())]
    Damaged {
        /// File asked for.
        path: PathBuf,
        /// What does not agree.
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
    /// A dataset or an attribute is absent, unreadable or not as the format demands.
    #[error("kernel table {}: cannot read {item}: {detail}", path.display())]
    Item {
        /// File asked for.
        path: PathBuf,
        /// Path of the dataset or attribute inside the file.
        item: String,
        /// What is wrong, or the first line of what the HDF5 library said.
        detail: String,
    },
    /// A dataset has other dimensions than the axes demand.
    #[error("kernel table {}: {item} has the dimensions {found:?}, needed {needed:?}", path.display())]
    Dimensions {
        /// File asked for.
        path: PathBuf,
        /// Path of the dataset inside the file.
        item: String,
        /// Dimensions that the axes demand.
        needed: Vec<usize>,
        /// Dimensions found.
        found: Vec<usize>,
    },
    /// More memory than a file of this size can need.
    #[error("kernel table {}: {item} makes {needed} bytes of numbers to load, more than the {limit} that its size explains", path.display())]
    TooLarge {
        /// File asked for.
        path: PathBuf,
        /// Path of the dataset inside the file.
        item: String,
        /// Bytes to be loaded up to there.
        needed: u64,
        /// Bytes allowed.
        limit: u64,
    },
    /// The numbers read are no table.
    #[error("kernel table {}: {source}", path.display())]
    Content {
        /// File asked for.
        path: PathBuf,
        /// What is wrong with them.
        source: ContentError,
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
        /// What the system or the HDF5 library said.
        detail: String,
    },
}
