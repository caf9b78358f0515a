//! Stability maps: where each method works, where it fails, and where theory says it should.

pub mod disc_models;
pub mod dynamic;
pub(crate) mod inversions;
pub mod kernels;
pub mod lookups;
pub mod marches;
pub mod models;
pub mod recurrence;
