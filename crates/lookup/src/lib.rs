//! Kernel tables of the elastic half-space: the file format, loading, interpolation, error estimate.
//!
//! A table holds, for a few Poisson ratios and a grid of points (r, z), the remainder R of the step
//! response (step response minus static field) averaged over time cells, and a series for the decay
//! after its last cell. The static field is closed form and is added exactly, so that the response
//! to a force P(t) that is linear between samples one cell apart is
//!
//! ```text
//! u_n = P_n u_static + sum_m (P_m - P_{m-1}) Rbar_{n-m}
//! ```
//!
//! Everything is reduced: lengths by the disc radius r0, times by r0/c1, displacements by P/(mu r0),
//! stresses by P/r0^2; z points into the body and compression is negative stress.
//! The six fields are in the order of [`halfspace::FIELDS`]: u, w, srr, stt, szz, srz.

mod certificate;
mod content;
mod damage;
mod error;
mod file;
mod gather;
mod hash;
pub mod labels;
mod part;
mod pulse;
mod ratio;
mod read;
pub mod schema;
mod series;
mod smooth;
mod stencil;
mod table;
mod tail;
mod trace;
mod write;

pub use certificate::{SAFETY, SAFETY_BETWEEN};
pub use content::{Between, Content, Origin, Role, Slice, Verification, centres};
pub use damage::{DamagedPatch, damaged_patches};
pub use error::{LookupError, TableError};
pub use hash::{content_hash, settings_id};
pub use part::TableFile;
pub use pulse::PulseSum;
pub use ratio::{cell_scale, ratio_coordinate};
pub use read::{check_hash, read, stated_hash};
pub use series::{Numbers, Series, Smoothness};
pub use smooth::correct_for_curvature;
pub use stencil::{Stencil, locate};
pub use table::Table;
pub use tail::{Tail, chebyshev};
pub use trace::TraceInfo;
pub use write::write;
