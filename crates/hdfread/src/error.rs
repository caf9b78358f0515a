//! What can be wrong with a file.

use thiserror::Error;

/// A file that could not be read; none of these names the file, whoever asked for it does.
#[derive(Debug, Error)]
pub enum HdfError {
    /// The system says no.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// A pipe, a device, a folder: what never ends or waits for its other end.
    #[error("it is not a regular file")]
    NotAFile,
    /// No HDF5 file.
    #[error("it is not an HDF5 file")]
    NotHdf5,
    /// Bytes that no HDF5 library would write.
    #[error("it is damaged: {what}")]
    Damaged {
        /// Where and how.
        what: String,
    },
    /// A part of HDF5 that is not read here.
    #[error(
        "{what} is not read here; copy the data to a file of plain datasets, such as h5py writes by default"
    )]
    Unsupported {
        /// The part.
        what: String,
    },
    /// Nothing of that name, or something else.
    #[error("there is no {what} {name}")]
    Absent {
        /// Group, dataset or attribute.
        what: &'static str,
        name: String,
    },
    /// Numbers of another type than asked for.
    #[error("its type is {found}, needed {needed}")]
    Type {
        /// In the file.
        found: String,
        /// Asked for.
        needed: String,
    },
    /// More than asked for, or more than the file's size explains.
    #[error("it makes {needed} bytes of numbers, more than {limit}")]
    TooLarge {
        /// Bytes needed.
        needed: u64,
        /// Bytes allowed.
        limit: u64,
    },
}

/// A structure that is not as HDF5 demands.
pub(crate) fn damaged(what: impl Into<String>) -> HdfError {
    HdfError::Damaged { what: what.into() }
}

pub(crate) fn unsupported(what: impl Into<String>) -> HdfError {
    HdfError::Unsupported { what: what.into() }
}
