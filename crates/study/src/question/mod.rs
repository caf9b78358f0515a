//! The four questions: methods, settings and scenes, and what each costs.
//!
//! A question a file: `kernels`, `force`, `fields`, `impacts`. `single_integral`, `marching` and `interpolation` have
//! what the program itself does not do, `pulse` what the fields of a pulse are compared with.

pub(crate) mod fields;
pub(crate) mod force;
pub(crate) mod impacts;
pub(crate) mod interpolation;
pub(crate) mod kernels;
pub(crate) mod marching;
mod pulse;
pub(crate) mod single_integral;
#[cfg(test)]
mod tests;
