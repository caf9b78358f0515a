//! Elastodynamic kernels of a half-space, exact, in reduced units.
//!
//! Length is reduced by the radius r0 of the loaded disc, speed by the longitudinal wave speed c1,
//! time by r0/c1, displacement by P/(mu r0) and stress by P/r0^2 (P the total force, mu the shear
//! modulus). The only material parameter left is Poisson's ratio.
//! z points into the half-space; compression is negative stress.

mod error;
mod gauss;
pub mod kausel;
mod medium;
mod surface;

pub use error::DomainError;
pub use medium::Medium;
pub use surface::{Deflection, SurfaceResponse};
