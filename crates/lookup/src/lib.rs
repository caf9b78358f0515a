//! Kernel tables of the elastic half-space: file format, loading, interpolation and error estimates.
//!
//! For several Poisson ratios and a grid of points (r, z) a table contains the remainder R of the step response (step
//! response minus static field) averaged over time cells, and a series for the decay after the last cell. The static
//! field has a closed form and is added exactly. The response to a force P(t) that is linear between samples one cell
//! apart is
//!
//! ```text
//! u_n = P_n u_static + sum_m (P_m - P_{m-1}) Rbar_{n-m}
//! ```
//!
//! All quantities are reduced: lengths by the disc radius r0, times by r0/c1, displacements by P/(mu r0),
//! stresses by P/r0^2; z points into the body and compression is negative stress.
//! The six fields are in the order of [`halfspace::FIELDS`]: u, w, srr, stt, szz, srz.
//!
//! # Features
//!
//! - `hdf5` (default): tables on disk. Without it tables exist in memory only, and no C library is needed.
//! - `static`: the HDF5 library that its Rust binding bundles, instead of the system's.
//!
//! # A table in memory
//!
//! [`Content`] is the data of a table; [`Table`] is validated content that can be looked up.
//!
//! ```
//! use lookup::{Content, Origin, Role, Slice, Smoothness, Table, Verification};
//!
//! // Four by four nodes, five cells, two terms of the decay: one field that is 1 in all cells and decays like 1/t^2.
//! let axis = vec![0.0, 0.5, 1.0, 1.5];
//! let (nodes, meshes) = (4 * 4, 3 * 3);
//! let slice = Slice {
//!     poisson_ratio: 0.3,
//!     role: Role::Grid,
//!     cells: 5,
//!     remainder: vec![1.0; nodes * 6 * 5],
//!     moment: vec![0.0; nodes * 6 * 5],
//!     curvature: vec![0.0; nodes * 6 * 5],
//!     tail: [1.0, 0.0].repeat(nodes * 6),
//!     verification: Verification {
//!         direct: vec![1.0; meshes * 6],
//!         looked_up: vec![1.0; meshes * 6],
//!         error: vec![1e-6; meshes * 6],
//!     },
//! };
//! let table = Table::new(Content {
//!     origin: Origin {
//!         grid: String::new(),
//!         format_version: lookup::schema::FORMAT_VERSION_VALUE.to_owned(),
//!         software_version: String::new(),
//!         numbers_revision: 1,
//!         git_revision: String::new(),
//!         created_unix_s: 0,
//!         accuracy_asked: 1e-8,
//!         accuracy_reached: vec![1e-6],
//!     },
//!     r: axis.clone(),
//!     z: axis,
//!     r_max: 1.5,
//!     z_max: 1.5,
//!     cell_width: 0.2,
//!     stencil_points: 4,
//!     pulse_lengths: vec![10.0],
//!     slices: vec![slice],
//!     between_r: Vec::new(),
//!     between_z: Vec::new(),
//!     between: Vec::new(),
//! })?;
//! let mut cells = [[0.0; 6]; 6];
//! let info = table.trace(Smoothness::Linear, 0.3, 0.7, 0.2, 0, &mut cells)?;
//! assert!((cells[4][1] - 1.0).abs() < 1e-12);
//! // The sixth cell, from 1.0 to 1.2 r0/c1, is of the decay: the average of 1/t^2 there.
//! assert!((cells[5][1] - 1.0 / 1.2).abs() < 1e-12);
//! assert_eq!(info.cell_width, 0.2);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![warn(missing_docs)]

// From the bottom up: a module uses only those above it.
mod error;
pub mod schema;
mod content;
mod hash;
mod accuracy;
mod pulse;
mod series;
mod validate;
mod ratio;
mod table;
mod certificate;
mod trace;
#[cfg(feature = "hdf5")]
mod file;

pub use accuracy::{Accuracy, Quantiles, quantile, worst};
pub use certificate::{PulseErrors, SAFETY, SAFETY_BETWEEN};
pub use content::{Between, Content, Origin, Role, Slice, Verification, centres};
pub use error::{ContentError, LookupError};
#[cfg(feature = "hdf5")]
pub use file::{
    BadTable, TableError, TableFile, check_whole, damaged_patches, holds, labels, new, read,
    same_hash, stated_hash, write,
};
pub use hash::{content_hash, settings_id};
pub use pulse::PulseSum;
pub use ratio::{cell_scale, ratio_coordinate};
pub use series::smooth::{BEYOND, absorb, absorbed};
pub use series::stencil::{Stencil, locate};
pub use series::{Moments, Numbers, Series, Smoothness, round};
pub use table::Table;
pub use trace::TraceInfo;
