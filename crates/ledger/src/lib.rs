//! What a file is of, which part of the work it is, and whether its bytes are those that were written.
//!
//! - [`Identity`]: two files with the same are made of the same; [`sha256_hex`] is the hash of plain bytes.
//! - [`Shard`] and [`gaps`]: work in parts, and what of it is not there.
//! - [`seal`] and [`HdfFile`]: every byte of a finished HDF5 file is compared with what was written before it is used.

// From the bottom up: a module uses only those above it.
mod error;
mod identity;
mod shard;
mod seal;
mod hdf;

pub use error::HdfError;
pub use hdf::{Dataset, Group, HdfFile};
pub use hdf5_reader::H5Type;
pub use identity::{Identity, sha256_hex};
pub use seal::seal;
pub use shard::{Shard, gaps};
