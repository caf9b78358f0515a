//! The results file: HDF5, or its histories as text; `data-schema/results.md` describes it.
//!
//! Every name on disk is a constant of [`schema`](crate::schema::results) or in the table of quantities. The file is
//! written under a temporary name next to its final one and renamed when it is complete.

mod identity;
mod section;
mod sensors;
mod write;

pub use identity::{check_results, scene_sha256};
pub use section::beside;
pub(crate) use write::{ending, write_columns};
pub use write::{stage_results, stage_results_csv, write_results};
