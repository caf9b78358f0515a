//! Sums of a sampled force over the cells of a kernel.

pub mod convolve;
pub(crate) mod low_pass;
pub(crate) mod low_passed;
pub(crate) mod projection;
