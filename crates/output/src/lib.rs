//! Where a file goes: whole or not at all, never over another one unasked, by one run at a time.
//!
//! A writer claims an [`Output`], which checks the place and locks the name against other runs.
//! It stages the file under a random name beside the final one, flushes it, and commits it: a rename and a flush of
//! the folder. Whatever moment a run ends at, the final name holds the old file, the new one or nothing.
//!
//! - Links are written through: the file behind them is replaced, the link stays.
//! - Folders, pipes and devices are refused.
//! - A replaced file keeps its permissions.
//! - What a killed run leaves beside a name, the next run on that name removes.
//!
//! What takes long keeps what is done of it in a [`Journal`], record by record, which survives an interruption at any moment.
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
    CSV, Ending, HDF5, PARQUET, ROWS, Role, SHARD, TABLE, apart, behind, folder, is_standard,
};
pub use room::{MOST_THREADS, free_address_space, free_disk, free_memory, processor_s};
pub use temporary::abandon;
