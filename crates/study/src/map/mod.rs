//! Maps of where each method works, where it fails, and where theory says it should.
//!
//! `marches`: the steps of marches; `models`: which contact model a scene needs; `inversions`, `kernels`
//! and `lookups`: the errors of kernels and tables.

pub(crate) mod inversions;
pub mod kernels;
pub(crate) mod lookups;
pub mod marches;
pub mod models;
