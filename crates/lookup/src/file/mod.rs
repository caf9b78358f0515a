//! HDF5 file of a table: all code that uses the HDF5 library.

mod chunks;
mod damage;
mod error;
pub mod labels;
pub mod new;
mod open;
mod read;
mod source;
mod table_file;
mod write;

pub use damage::damaged_patches;
pub use error::{BadTable, TableError};
pub use read::{check_whole, holds, read, same_hash, stated_hash};
pub use table_file::TableFile;
pub use write::write;
