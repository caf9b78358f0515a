//! Sweeps: many scenes that differ in some keys, their contacts computed and written as one table.
//!
//! A [`Spec`] is read from TOML: a base scene and the keys that vary, as a Cartesian product, as a
//! list of keys that vary together, and as random draws.
//! Row by row the contact is computed, and the peaks of the fields at probes where the base scene has some; a scene that
//! fails is a row with a reason.
//! Rows are computed in blocks that a journal keeps, so that an interrupted sweep goes on where
//! it stopped, and the file is written from it, block by block, when all of them are there.
//! A [`Selection`] of the rows, such as a [`Shard`], has a file of its own.

mod axis;
mod block;
mod blocks;
mod boxes;
#[cfg(feature = "parquet")]
mod cells;
mod columns;
mod correlation;
mod csv;
mod drawn;
mod fields;
mod file;
mod files;
mod fingerprint;
mod footer;
mod journal;
mod kernels;
mod observed;
#[cfg(feature = "parquet")]
mod parquet;
mod part;
mod probed;
mod random;
mod run;
pub mod schema;
#[cfg(feature = "parquet")]
mod seal;
mod shard;
mod spec;
mod store;
mod table;
mod template;
mod virtual_file;

pub use axis::{Axis, Column, Values};
pub use block::{Block, NO_MODEL};
pub use blocks::Blocks;
pub use csv::{print_csv, stage_csv, write_csv};
pub use drawn::Drawn;
pub use fields::{Fields, Precision};
pub use file::{stage_sweep, write_sweep};
pub(crate) use fingerprint::from_hexadecimal;
pub use footer::FORMAT_VERSION as PARQUET_VERSION;
pub(crate) use footer::{Footer, MAGIC};
pub use journal::{Journal, JournalError};
pub use kernels::{FieldKernels, KernelsError};
pub use part::{column_names, row_bytes, stage_part};
pub(crate) use probed::{Described, stored_columns};
pub(crate) use run::gaps;
pub use run::{
    BLOCK_S, Done, FIRST_BLOCK, Kept, Rows, SweepError, compute_rows, is_computed, run_rows,
    run_sweep,
};
pub use shard::{BLOCK, Selection, Shard};
pub use spec::Spec;
pub use store::{check_rows, stage_rows};
pub(crate) use virtual_file::{Source, stage_virtual};
