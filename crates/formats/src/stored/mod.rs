//! Reads the program's own files back.
//!
//! [`file_kind`] determines the kind of a file. Each reader accepts one kind and rejects the others by name. It reads
//! only the requested data, and no dataset beyond a size limit.

#[cfg(feature = "parquet")]
mod groups;
mod impact;
mod open;
mod rows;

pub use crate::sweep::Part;
pub use impact::{StoredImpact, StoredProbes, StoredSection, StoredSensor};
pub use open::{FileKind, file_kind};
pub(crate) use rows::whole_sweep;
pub use rows::{StoredPart, StoredSweep};
pub use toml::Value;
