//! Maps of where each method works, where it fails, and where theory says it should.
//!
//! `marches`: the steps of marches; `models`: which contact model a scene needs; `inversions` and `kernels`: the errors
//! of kernels.

pub(crate) mod inversions;
pub mod kernels;
pub mod marches;
pub mod models;
