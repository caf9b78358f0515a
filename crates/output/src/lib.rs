//! Atomic output files: complete or absent, never replacing a file without permission, one run at a time.
//!
//! A writer claims an [`Output`], which checks the place and locks the name against other runs. It stages the file
//! under a random name next to the final one, flushes it, and commits it: a rename and a flush of the folder. Whenever
//! a run ends, the final name has the old file, the new one or none.
//!
//! - Links are followed: the file that they point to is replaced, the link remains.
//! - Folders, pipes and devices are rejected.
//! - A replaced file keeps its permissions.
//! - Temporary files of a killed run are removed by the next run with the same name.
//!
//! Long work keeps its finished parts in a [`Journal`], record by record, which survives an interruption at any moment.
//!
//! ```
//! # let folder = std::env::temp_dir().join(format!("hertzlamb-output-{}", std::process::id()));
//! # std::fs::create_dir_all(&folder).unwrap();
//! use std::io::Write;
//! let path = folder.join("numbers.csv");
//! output::write_whole(&path, output::Existing::Replace, |mut file| file.write_all(b"1,2\n"))?;
//! assert_eq!(std::fs::read_to_string(&path).unwrap(), "1,2\n");
//! # std::fs::remove_dir_all(&folder).unwrap();
//! # Ok::<(), output::OutputError>(())
//! ```

// From the bottom up: a module uses only those above it.
mod error;
mod handle;
mod journal;
mod place;
mod temporary;
mod claim;
mod folder;
mod room;

pub use claim::{Existing, Output, Staged, write_whole};
pub use error::{OutputError, OutputFault};
pub use folder::{Folder, is_hidden};
pub use journal::{Journal, Record, Records, Title, packed, unpacked};
pub use place::{
    CSV, Ending, HDF5, HISTORIES, PARQUET, ROWS, Role, SHARD, TABLE, apart, behind, folder,
    is_standard,
};
pub use room::{MOST_THREADS, free_address_space, free_disk, free_memory, processor_s};
pub use temporary::abandon;
