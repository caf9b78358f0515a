//! Sweeps: many scenes that differ in some keys, their contacts computed and written as one table.
//!
//! A [`Spec`] is read from TOML: a base scene and the keys that vary, as a Cartesian product, as a
//! list of keys that vary together, and as random draws.
//! Row by row the contact alone is computed; a scene that fails is a row with a reason.
//! Rows are computed in blocks that a journal keeps, so that an interrupted sweep goes on where
//! it stopped, and the file is written when all of them are there.

mod axis;
mod block;
mod correlation;
mod csv;
mod file;
mod files;
mod journal;
mod random;
mod run;
pub mod schema;
mod spec;
mod template;

pub use axis::{Axis, Column, Values};
pub use block::{Block, NO_MODEL};
pub use csv::{print_csv, stage_csv, write_csv};
pub use file::{stage_sweep, write_sweep};
pub use journal::{Journal, JournalError};
pub use run::{
    BLOCK, BLOCK_S, Done, FIRST_BLOCK, Rows, SweepError, compute_rows, is_computed, run_sweep,
};
pub use spec::Spec;
