//! Sweeps: many scenes that differ in some keys, computed and written as one table.
//!
//! Input: a [`Spec`] is read from TOML (`spec`). It has a base scene with its files and the keys that vary (`axes`,
//! `draws`), as a Cartesian product, as a list of keys that vary together, and as random draws. `fields` selects the
//! results that are written, and `kernels` the source of the kernels for fields at probes.
//!
//! Work: `template` makes the scene of a row, `run` computes rows in blocks that a `journal` keeps, so that an
//! interrupted sweep can be resumed, and `rows` writes the file block by block once all rows are computed. A scene that
//! fails is a row with a reason. A [`Selection`] of rows, such as a [`Shard`], has a file of its own (`shard`).

mod axes;
mod draws;
mod error;
mod fields;
mod journal;
mod kernels;
mod rows;
mod run;
mod shard;
mod spec;
mod template;

pub use axes::{SweepAxis, SweptKey, Values};
pub use draws::Drawn;
pub use error::SweepError;
pub(crate) use fields::stored_columns;
pub use fields::{Precision, WrittenResults};
pub use journal::{Kept, Unfinished, is_computed, kept_places};
pub use ledger::Shard;
pub use rows::{
    Block, Blocks, Held, NO_MODEL, PARQUET_VERSION, check_rows, column_names, described_keys,
    key_unit, print_csv, row_bytes, stage_csv, stage_rows,
};
pub(crate) use rows::{Cells, Footer, MAGIC, NOT_HELD, What, columns, stage_hdf5};
pub use run::{Computed, check_at_once, compute_columns, compute_rows, fields_bytes, run_rows};
pub use shard::{BLOCK, Part, Selection, grain};
pub use spec::Spec;
pub(crate) use template::{Memory, Templates};
