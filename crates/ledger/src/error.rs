//! Errors of reading HDF5 files.

use hdf5_reader::error::Error;
use std::io::{self, ErrorKind};

/// A file that could not be read; the caller adds its name to the message.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HdfError {
    /// An error of the operating system.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// Bytes that no HDF5 library writes, or that differ from their checksum.
    #[error("it is damaged: {0}")]
    Damaged(String),
    /// The requested item does not exist.
    #[error("{0} does not exist")]
    Absent(String),
    /// Not an HDF5 file, an unsupported part of HDF5, another type than requested, or too much memory.
    #[error("{0}")]
    Refused(String),
}

impl From<Error> for HdfError {
    fn from(error: Error) -> Self {
        match error {
            Error::Context { source, .. } => (*source).into(),
            Error::Io(error) if error.kind() == ErrorKind::InvalidData => {
                Self::Damaged(error.to_string())
            }
            Error::Io(error) => Self::Io(error),
            Error::InvalidMagic => Self::Refused("it is not an HDF5 file".to_owned()),
            Error::GroupNotFound(name)
            | Error::DatasetNotFound(name)
            | Error::AttributeNotFound(name) => Self::Absent(name),
            Error::UnsupportedFilter(_) | Error::UnsupportedEncoding(_) => Self::Refused(format!(
                "{error}; copy the data to a file of plain datasets, such as h5py writes by default"
            )),
            Error::ResourceLimit(what) => Self::Refused(what),
            other => Self::Damaged(other.to_string()),
        }
    }
}
