//! Why an HDF5 file could not be read.

use hdf5_reader::error::Error;
use std::io::{self, ErrorKind};

/// A file that could not be read; none of these names the file, whoever asked for it does.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HdfError {
    /// The system says no.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// Bytes that no HDF5 library would write, or not those that were sealed.
    #[error("it is damaged: {0}")]
    Damaged(String),
    /// Nothing of that name.
    #[error("there is no {0}")]
    Absent(String),
    /// No HDF5 file, a part of HDF5 that is not read, another type than asked for, too much memory.
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
