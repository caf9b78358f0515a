//! Gives every reader damaged and invented inputs, and judges what it makes of them.
//!
//! A [`Target`] is a reader with what is checked of its answer, [`Seeds`] are good inputs of it, a [`Mutator`] damages
//! them, and [`campaign()`] counts how many are read and refused.
//! `fuzz/` gives the same targets to cargo-fuzz.

// in reading order
pub mod campaign;
mod draws;
mod mutate;
mod seeds;
mod stand_in;
mod target;

pub use campaign::{Report, campaign};
pub use mutate::Mutator;
pub use seeds::Seeds;
pub use target::{Target, Verdict};
