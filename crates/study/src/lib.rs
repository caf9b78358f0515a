//! Methods compared: speed against accuracy, and where each becomes unstable.
//!
//! Four questions, answered by measurement: how to compute a kernel, an impact, fields, and the fields of an impact.
//! Beside the ways that the program takes stand those that it does not: five numerical inversions of the
//! Laplace transform with the Hankel quadrature that they need, marches of known order, whole-response
//! interpolation. [`Chart::run`] measures them, [`Chart::write`] writes rows, pictures and a report; the
//! maps show where each method works, with the boundary that theory gives.
//!
//! Used by the command `hertzlamb chart` and by tests, by no other crate.
//!
//! In reading order: `chart`; `method` (the table of methods), `measure` (one at a setting, timed) and `record` (its row);
//! the questions, with `scenes` and `inversion` for them; the maps; `ranking`, `picture` and `report`.

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
