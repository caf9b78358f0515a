//! Comparison of numerical methods: speed against accuracy, and limits of stability.
//!
//! Measurements answer four questions: how to compute a kernel, an impact, fields, and the fields of an impact.
//! The program's own methods are compared with others: five numerical inversions of the Laplace transform with their
//! Hankel quadrature, marches of known order, and interpolation of the whole response. [`Chart::run`] measures them,
//! and
//! [`Chart::write`] writes rows, pictures and a report. Maps show where each method works, with the theoretical boundaries.
//!
//! Only the command `hertzlamb chart` and tests use this crate.
//!
//! In reading order: `chart`; `method` (the table of methods), `measure` (a method at a setting, timed) and `record`
//! (its row); the questions, with `scenes` and `inversion`; the maps; `ranking`, `picture` and `report`.

// From the bottom up: a module uses only those above it.
mod method;
mod record;
mod measure;
mod scenes;
mod picture;
mod ranking;
mod inversion;
mod question;
mod map;
mod chart;
mod report;

pub use chart::Chart;
pub use measure::Effort;
pub use method::ComparedMethod;
pub use picture::Picture;
pub use record::{Question, Record};
pub use report::PICTURE_COLUMNS;
