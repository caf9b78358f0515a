//! Identity of a file, shards of divided work, and integrity of the bytes.
//!
//! - [`Identity`]: files with the same identity have the same inputs; [`sha256_hex`] is the hash of plain bytes.
//! - [`Shard`] and [`gaps`]: division of work into shards, and its missing parts.
//! - [`seal`] and [`HdfFile`]: a checksum trailer on finished HDF5 files; all bytes are verified before they are used.

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
