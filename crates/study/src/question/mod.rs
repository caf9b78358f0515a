//! The four questions: methods, settings and scenes, and what each costs.
//!
//! A question a file: `kernels`, `force`, `fields`, `impacts`. `marching` has marches that
//! the program itself does not take.

pub(crate) mod fields;
pub(crate) mod force;
pub(crate) mod impacts;
pub(crate) mod kernels;
pub(crate) mod marching;
#[cfg(test)]
mod tests;
