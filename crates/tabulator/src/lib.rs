//! Fills kernel tables of the elastic half-space: grid, exact values, verification, one complete file.
//!
//! A table is built from blocks, each one row of points of one slice; a block depends on the settings
//! alone, so the bytes of the table do not depend on threads, interruptions or the order of work.

mod assemble;
mod axis;
mod block;
mod build;
mod check;
mod difference;
mod error;
mod extend;
mod grid;
mod journal;
mod known;
mod late;
mod limits;
mod moments;
mod numbers;
mod observe;
mod output;
mod plans;
mod point;
mod presets;
mod progress;
mod random;
mod refine;
mod rounding;
mod rows;
mod sample;
mod shard;
mod summary;
mod verify;

pub use axis::Axis;
pub use build::{build, build_over};
pub use check::{BadNode, CheckReport, check_table};
pub use difference::{Difference, differences};
pub use error::BuildError;
pub use extend::{Extension, extend};
pub use grid::{Grid, PULSE_LENGTHS};
pub use lookup::quantile;
pub use numbers::NUMBERS_REVISION;
pub use observe::{Observation, observe, observe_lengths};
pub use output::Existing;
pub use point::{PointKernels, PointPlan};
pub use presets::PRESETS;
pub use progress::{Progress, Silent};
pub use refine::{Trial, refine};
pub use sample::{Storage, sample_errors};
pub use shard::{build_shard, merge};
pub use summary::Summary;
