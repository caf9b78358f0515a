//! Methods compared: speed against accuracy, and where each becomes unstable.
//!
//! Four questions, answered by measurement: how to compute a kernel, an impact, fields, and the fields of an impact.
//! Beside the ways that the program takes stand those that it does not: seven numerical inversions of the
//! Laplace transform with the Hankel quadrature that they need, marches of known order, whole-response
//! interpolation. [`Chart::run`] measures them, [`Chart::write`] writes rows, pictures and a report; the
//! [`map`]s show where each method works, with the boundary that theory gives.
//!
//! Used by the command `hertzlamb chart` and by tests, by no other crate.

mod chart;
pub mod csv_file;
mod error;
mod folder;
pub mod hdf_file;
mod inversion;
mod machine;
pub mod map;
mod measure;
mod picture;
mod question;
mod reasons;
mod record;
mod report;
mod scenes;
mod standing;
mod tables;
mod work_precision;

pub use chart::Chart;
pub use error::StudyError;
pub use machine::Machine;
pub use measure::Effort;
pub use picture::Picture;
pub use reasons::reason;
pub use record::{Error, FAILED, Question, Record, Timing, pareto_front};
pub use standing::{EQUAL, LEVELS, Measure, Standing, standings};
