//! The results file: HDF5, or its histories as text, as `data-schema/results.md` writes it down.
//!
//! Every name on disk is a constant of [`schema`](crate::schema::results) or of the table of quantities. The file is written beside its final
//! name and renamed when it is complete.

mod identity;
mod section;
mod write;

pub use identity::{check_results, scene_sha256};
pub use section::beside;
pub use write::{peaks_of, stage_results, stage_results_csv, write_results};
