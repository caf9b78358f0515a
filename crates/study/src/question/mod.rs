//! The four questions, with their methods, settings, scenes and measurements.
//!
//! Each question has a file: `kernels`, `force`, `fields`, `impacts`. `marching` contains marches that the program does
//! not use.

pub(crate) mod fields;
pub(crate) mod force;
pub(crate) mod impacts;
pub(crate) mod kernels;
pub(crate) mod marching;
#[cfg(test)]
mod tests;
