//! The four questions: methods, settings and scenes, and what each costs.

pub(crate) mod fields;
pub(crate) mod force;
pub(crate) mod impacts;
pub(crate) mod interpolation;
pub(crate) mod inversions;
pub(crate) mod kernels;
mod pulse_scene;
