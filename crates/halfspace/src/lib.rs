//! Elastodynamic kernels of a half-space, exact, in reduced units.
//!
//! Length is reduced by the radius r0 of the loaded disc, speed by the longitudinal wave speed c1,
//! time by r0/c1, displacement by P/(mu r0) and stress by P/r0^2 (P the total force, mu the shear
//! modulus). The only material parameter left is Poisson's ratio.
//! z points into the half-space; compression is negative stress.

mod arrivals;
mod axis;
mod cells;
mod compact;
mod error;
mod fast;
mod field;
mod fronts;
mod gauss;
pub mod kausel;
mod kernel;
mod medium;
mod multipole;
mod panels;
mod potential;
mod profile;
mod slow;
mod spectrum;
mod statics;
mod surface;

pub use arrivals::Arrivals;
pub use error::DomainError;
pub use field::{Estimate, FIELDS, Field, Six};
pub use kernel::Kernel;
pub use medium::Medium;
pub use profile::Profile;
pub use surface::{Deflection, SurfaceResponse};
