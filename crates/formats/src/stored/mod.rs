//! Reading back what the program has written.
//!
//! [`file_kind`] says what a file is. A reader takes one kind and says so of any other; it reads no more than it is
//! asked for, and no dataset beyond a size.

#[cfg(feature = "parquet")]
mod groups;
mod impact;
mod open;
mod rows;

pub use crate::sweep::Part;
pub use impact::{StoredImpact, StoredProbes, StoredSection};
pub use open::{FileKind, file_kind};
pub(crate) use rows::whole_sweep;
pub use rows::{StoredPart, StoredSweep};
pub use toml::Value;
