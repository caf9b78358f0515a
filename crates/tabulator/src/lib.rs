//! Computes kernel tables of the elastic half-space: from a grid to exact values, their verification and one complete
//! file.
//!
//! A table is built from blocks, each of which is one row of points of one slice. A block depends on the settings only,
//! so the bytes of a table do not depend on threads, interruptions or the order of work.
//!
//! ```
//! use tabulator::{Axis, Grid, Silent, build};
//!
//! // eight by eight nodes, and cells five times as wide as in a real table
//! let grid = Grid {
//!     cell_width: 0.5,
//!     pulse_lengths: vec![10.0],
//!     tolerance: 1e-6,
//!     r: Axis::uniform(0.875, 0.125),
//!     z: Axis::uniform(0.875, 0.125),
//!     ..Grid::demo()
//! };
//! let folder = tempfile::tempdir()?;
//! let summary = build(&grid, &folder.path().join("small.h5"), &Silent)?;
//! let (field, errors) = lookup::worst(&summary.accuracy[0].on_slices);
//! println!("{field:?}: p50 {:.1e}, p99 {:.1e}, max {:.1e}", errors.p50, errors.p99, errors.max);
//! # assert!(errors.p99 < 0.1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

// From the bottom up: a module uses only those above it.
mod error;
mod numbers;
mod progress;
mod grid;
mod block;
mod point;
mod journal;
mod known;
mod rows;
mod plan;
mod assemble;
mod build;
mod extend;
mod shard;
mod measure;

pub use assemble::BuildSummary;
pub use build::{build, build_over};
pub use error::BuildError;
pub use extend::{Extension, extend};
pub use grid::{Axis, Grid, PRESETS, PULSE_LENGTHS};
pub use ledger::Shard;
pub use lookup::quantile;
pub use measure::check::{CheckReport, check_table};
pub use measure::difference::differences;
pub use measure::refine::refine;
pub use numbers::NUMBERS_REVISION;
pub use output::{Existing, OutputError};
pub use plan::TableCost;
pub use point::PointPlan;
pub use progress::{Progress, Silent};
pub use shard::{build_shard, merge};
