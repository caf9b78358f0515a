//! The contact force behind the traces of sensors.
//!
//! You pass traces with the response of their sensors to a hat of force; nothing here computes waves or reads a file.
//!
//! 1. [`PulseFit`]: peak, duration and start of the contact law's pulse, by Gauss and Newton's steps.
//! 2. [`ForceHistory`]: a force of any shape, not negative, as smooth as the traces allow, with a 95 % band.
//! 3. [`ball`]: mass and velocity of the ball, if one property of it is known.
//!
//! [`average`] aligns repeated drops and averages them; [`Whitening`] removes the colour of the noise of resonant sensors.
#![cfg_attr(doctest, doc = include_str!("../README.md"))]
#![warn(missing_docs)]

// From the bottom up: a module uses only those above it in this list.

// Least squares that are not negative.
mod nnls;

// Noise and the filter that whitens it.
mod noise;

// Estimates, and why there are none.
mod error;

// Pulse of a contact law.
mod pulse;

// Traces of a blow.
mod problem;

// Peak, duration and start.
mod fit;

// Mass and velocity.
mod ball;

// Force histories.
mod deconvolve;

// Jackknife, repeated drops.
mod several;

// All of it.
mod infer;

pub use ball::{Ball, Known, ball, momentum};
pub use deconvolve::{ForceHistory, LCurvePoint};
pub use error::{Estimate, InverseError};
pub use fit::PulseFit;
pub use infer::{Inferred, NoiseFound, infer};
pub use nnls::{Solution, Symmetric, nnls};
pub use noise::Whitening;
pub use problem::{Gain, Noise, Problem, Trace};
pub use pulse::Pulse;
pub use several::{Averaged, Jackknife, average};
