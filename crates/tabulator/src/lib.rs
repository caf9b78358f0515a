//! Fills kernel tables of the elastic half-space: grid, exact values, verification, one complete file.
//!
//! A table is built from blocks, each one row of points of one slice; a block depends on the settings
//! alone, so the bytes of the table do not depend on threads, interruptions or the order of work.

mod axis;
mod blocks;
mod build;
mod check;
mod difference;
mod error;
mod extend;
mod grid;
mod journal;
mod known;
mod late;
mod moments;
mod observe;
mod point;
mod progress;
mod refine;
mod sample;
mod verify;

pub use axis::Axis;
pub use build::{Existing, Summary, build, build_over, build_shard, merge};
pub use check::{BadNode, CheckReport, check_table};
pub use difference::{Difference, differences};
pub use error::BuildError;
pub use extend::{Extension, extend};
pub use grid::{Grid, PRESETS};
pub use observe::{Observation, observe, observe_lengths};
pub use point::{PointKernels, PointPlan};
pub use progress::{Progress, Silent};
pub use refine::{Trial, refine};
pub use sample::{Storage, sample_errors};
pub use verify::{PULSE_LENGTHS, quantile};
