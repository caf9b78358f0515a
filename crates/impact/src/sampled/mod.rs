//! Sums of a sampled force over the cells of a kernel.

pub mod convolve;
pub(crate) mod projection;
