//! What a file is of, what is done of it, and whether its bytes are those that were written.
//!
//! - [`Identity`]: two files with the same are made of the same.
//! - [`Journal`]: what is done is appended, record by record, and survives an interruption at any moment.
//! - [`Shard`] and [`gaps`]: work in parts, and what of it is not there.
//! - [`seal`] and [`HdfFile`]: every byte of a finished HDF5 file is compared with what was written before it is used.

mod error;
mod hdf;
mod identity;
mod journal;
mod seal;
mod shard;

pub use error::HdfError;
pub use hdf::{Dataset, Group, HdfFile};
pub use hdf5_reader::H5Type;
pub use identity::Identity;
pub use journal::{Journal, JournalError, Record, Records, Title};
pub use seal::seal;
pub use shard::{Shard, gaps};
