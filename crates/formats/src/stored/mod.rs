//! Reading back what the program has written.
//!
//! [`file_kind`] says what a file is. A reader takes one kind and says so of any other; it reads no more than it is
//! asked for, and no dataset beyond a size.

mod error;
mod file;
mod impact;
mod kind;
mod open;
mod part;
mod probes;
mod scene;
mod section;
mod sweep;

pub use error::ReadError;
pub use file::file_kind;
pub use impact::StoredImpact;
pub use kind::FileKind;
pub use open::StoredQuantity;
pub use part::{Part, StoredPart};
pub use probes::StoredProbes;
pub use scene::{StoredScene, StoredValue};
pub use section::StoredSection;
pub use sweep::{StoredAxis, StoredColumn, StoredSweep};
