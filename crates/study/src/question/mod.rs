//! The four questions: methods, settings and scenes, and what each costs.
//!
//! A question a file: `kernels`, `force`, `fields`, `impacts`. `single_integral` and `marching` have what the
//! program itself does not do.

pub(crate) mod fields;
pub(crate) mod force;
pub(crate) mod impacts;
pub(crate) mod kernels;
pub(crate) mod marching;
pub(crate) mod single_integral;
#[cfg(test)]
mod tests;
