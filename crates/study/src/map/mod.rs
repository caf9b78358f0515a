//! Stability maps: where each method works, where it fails, and where theory says it should.

pub(crate) mod inversions;
pub mod kernels;
pub(crate) mod lookups;
pub mod marches;
pub mod models;
