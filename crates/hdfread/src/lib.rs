//! Reads HDF5 files that nobody vouches for.
//!
//! The HDF5 library trusts what it reads: damaged or forged metadata make it crash, loop, follow links into other files,
//! load code, or take memory without end.
//! Nothing of that can happen here: no C code runs, every address and length is compared with the file before memory is
//! taken for it, trees end, and a chunk is decompressed into exactly the room that its dimensions state.
//!
//! What is read is what plain files have: groups of hard links, datasets of numbers that are contiguous, compact or in
//! chunks (shuffle, deflate, Fletcher-32), and attributes; superblocks 0 to 3 and both versions of object headers.
//! Everything else is refused by name: links to names or files, external storage, virtual datasets, other filters, named
//! types, dense groups and the chunk indices of the newest format other than that of a single chunk.
//!
//! ```
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("a.h5");
//! # hdf5::File::create(&path)?.new_dataset_builder().with_data(&[1.0, 2.0, 4.0]).create("force")?;
//! let file = hdfread::File::open(&path)?;
//! let force = file.root()?.dataset("force")?;
//! assert_eq!(force.shape(), [3]);
//! assert_eq!(force.as_f64(1 << 20)?, [1.0, 2.0, 4.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

// in reading order
mod attribute;
mod block;
mod bytes;
mod chunks;
mod dataset;
mod error;
mod file;
mod filter;
mod group;
mod heap;
mod kind;
mod object;
mod space;

pub use attribute::Attribute;
pub use bytes::Bytes;
pub use dataset::Dataset;
pub use error::HdfError;
pub use file::File;
pub use filter::Filter;
pub use group::Group;
pub use kind::{Kind, Number};

/// The README's program runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
