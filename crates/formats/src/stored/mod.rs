//! Reading back what the program has written.
//!
//! [`file_kind`] says what a file is. A reader takes one kind and says so of any other; it reads no more than it is
//! asked for, and no dataset beyond a size.

mod error;
mod file;
#[cfg(feature = "parquet")]
mod groups;
mod impact;
mod kind;
mod open;
mod parquet;
mod part;
mod part_hdf5;
mod probes;
mod rows;
mod scene;
mod section;
mod sweep;

pub use error::ReadError;
pub use file::file_kind;
pub use impact::StoredImpact;
pub use kind::FileKind;
pub use open::StoredQuantity;
pub use parquet::StoredParquet;
pub use part::Part;
pub use probes::StoredProbes;
pub use rows::{StoredPart, StoredWhole};
pub use scene::{StoredScene, StoredValue};
pub use section::StoredSection;
pub use sweep::{StoredAxis, StoredColumn, StoredSweep};
