//! Elastodynamic kernels of a half-space under a disc load, exact, in reduced units.
//!
//! A force is applied suddenly to a disc on the surface of an elastic half-space. This crate computes the six
//! displacement and stress fields at any point and time, each as one integral of elementary functions over slowness, to
//! an accuracy that you choose, with an error estimate.
//!
//! # Units and signs
//!
//! | quantity | reduced by |
//! |---|---|
//! | length | r0, the radius of the disc |
//! | speed | c1, the longitudinal wave speed |
//! | time | r0/c1 |
//! | displacement | P/(mu r0), P the force, mu the shear modulus |
//! | stress | P/r0^2 |
//!
//! Poisson's ratio is the only remaining material parameter, so one kernel is valid for all materials with the same
//! ratio. z points into the half-space, the load presses on z = 0, and compression is negative stress.
//!
//! # Contents
//!
//! - [`Medium`]: wave speeds and Rayleigh function of a Poisson ratio.
//! - [`Kernel`]: static field, step-response remainder, impulse response and time integral.
//! - [`Trace`]: the remainder at one place over time, with averages and moments over cells of any width.
//! - [`Kernel::spectrum`]: the response to a force at one frequency.
//! - [`Attenuation`]: a constant quality factor, in spectra and, by [`Damping`], in traces.
//! - [`Face`]: the mean over a circular face, such as that of a sensor.
//! - [`Plate`]: the echoes that a second free face adds, to sixteen transits.
//! - [`SurfaceResponse`]: the deflection under the load itself, with finite memory.
//! - [`Arrivals`]: times of all wave fronts.
//! - [`gauss`]: Gauss-Legendre rules for integrals of kernels; [`chebyshev`], [`chebyshev_each`], [`lagrange`],
//!   [`leja_nodes`] and [`leja_series`] for interpolation.
//! - [`kausel`]: the surface-centre response in closed form, for comparison.
//!
//! # Example
//!
//! The response to any force history P(t) follows from the static part and the remainder:
//! u(t) = P(t) static + int P'(t') R(t - t') dt'.
//!
//! ```
//! use halfspace::{Field, Kernel, Medium, Profile};
//!
//! let steel = Medium::new(0.3)?;
//! let kernel = Kernel::new(&steel, Profile::Hertz, 1e-10)?;
//! // one value: w half a radius out and 0.6 radii down at t = 2, 0.1196 of a static 0.1676; from an independent
//! // Laplace-Hankel inversion
//! let w = Field::DisplacementZ.index();
//! let found = kernel.static_field(0.5, 0.6)?[w] + kernel.remainder(0.5, 0.6, 2.0)?.value[w];
//! assert!((found - 0.11959942786).abs() < 1e-10);
//! // step response two radii below the centre, long after the waves have passed: the static field
//! let rest = kernel.static_field(0.0, 2.0)?;
//! let late = kernel.remainder(0.0, 2.0, 200.0)?;
//! let szz = Field::StressZz.index();
//! assert!(late.value[szz].abs() < 1e-4 * rest[szz].abs());
//! // before the first arrival nothing has moved: remainder and static part cancel
//! let early = kernel.remainder(0.0, 2.0, 1.9)?;
//! assert_eq!(early.value[szz], -rest[szz]);
//! # Ok::<(), halfspace::DomainError>(())
//! ```
//!
//! # Sources
//!
//! The Laplace-Hankel solution is that of the paper on the impact of a rod on an anvil (its equations (22) to
//! (29), with the coefficient of (24) corrected to 4); the static field is Huber's (1904); the surface-centre
//! response agrees with the closed form of Kausel (2012).
#![cfg_attr(doctest, doc = include_str!("../README.md"))]
#![warn(missing_docs)]

// From the bottom up: a module uses only those above it.
mod field;
mod profile;
mod domain;
mod numeric;
mod medium;
mod arrivals;
mod attenuation;
mod potentials;
pub mod kausel;
mod statics;
mod surface;
mod integral;
mod kernel;
mod spectrum;
mod damping;
mod trace;
mod face;
mod plate;

pub use arrivals::Arrivals;
pub use attenuation::Attenuation;
pub use damping::Damping;
pub use domain::{DomainError, check};
pub use face::{Arc, Face};
pub use field::{Estimate, FIELDS, Field, Six};
pub use integral::axis::weights_off_axis;
pub use kernel::Kernel;
pub use medium::Medium;
pub use numeric::polynomial::{chebyshev, chebyshev_each, lagrange, leja_nodes, leja_series};
pub use numeric::{bisected, gauss, random};
pub use plate::{Echo, Plate, Rays};
pub use profile::Profile;
pub use spectrum::Spectrum;
pub use surface::{Deflection, LoadedDisc, SurfaceResponse, surface_measure};
pub use trace::Trace;
