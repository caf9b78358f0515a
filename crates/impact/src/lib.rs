//! Impact of a body on an elastic half-space: contact force, rebound and wave fields.
//!
//! A [`Scene`] in SI units is read and checked, its contact is computed in reduced units by one of
//! the models of [`contact`] with one of the schemes of [`march`], and the fields at its probes are
//! the [`convolve`]d force.
//! [`simulate`](fn@simulate) does all of it; [`output`] writes the results file.

pub mod choose;
pub mod contact;
pub mod convolve;
pub mod energy;
pub mod march;
pub mod material;
pub mod output;
mod quadrature;
mod resample;
pub mod scene;
mod simulate;
pub mod sweep;
pub mod units;
pub mod validity;

pub use scene::{Scene, SceneError};
pub use simulate::{
    Choices, Fields, ImpactError, KernelChoice, MapFields, Outcome, Results, Series, simulate,
};
