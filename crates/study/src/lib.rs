//! Methods compared: speed against accuracy, and where each becomes unstable.
//!
//! Three questions, answered by measurement: how to compute a kernel, an impact, and fields.
//! Beside the ways that the program takes stand those that it does not: six numerical inversions of the
//! Laplace transform with the Hankel quadrature that they need, marches of known order, whole-response
//! interpolation. [`Chart::run`] measures them, [`Chart::write`] writes rows, pictures and a report; the
//! [`map`]s show where each method works, with the boundary that theory gives.
//!
//! Used by the command `hertzlamb chart` and by tests, by no other crate.

mod axis_extended;
mod chart;
pub mod csv_file;
mod effort;
mod error;
mod extended;
mod folder;
mod hankel;
pub mod hdf_file;
pub mod inversion;
#[cfg(test)]
mod inversion_tests;
mod machine;
pub mod map;
mod marching;
mod measure;
mod picture;
mod pulse_reference;
mod question;
mod reasons;
mod record;
mod report;
mod route;
#[cfg(test)]
mod route_tests;
mod scenes;
pub mod single_integral;
mod standing;
#[cfg(test)]
mod standing_tests;
mod surface;
mod tables;
mod transform;
mod work_precision;

pub use chart::Chart;
pub use effort::Effort;
pub use error::StudyError;
pub use machine::Machine;
pub use measure::Timing;
pub use picture::Picture;
pub use reasons::reason;
pub use record::{Error, FAILED, Question, Record, pareto_front};
pub use standing::{EQUAL, LEVELS, Measure, Standing, standings};
