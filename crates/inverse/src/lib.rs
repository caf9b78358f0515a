//! The contact force behind the traces of sensors.
//!
//! You pass traces with the response of their sensors to a hat of force; nothing here computes waves or reads a file.
//!
//! 1. [`PulseFit`]: peak, duration and start of the contact law's pulse, by Gauss and Newton's steps.
//! 2. [`ForceHistory`]: a force of any shape, not negative, as smooth as the traces allow, with a 95 % band.
//! 3. [`ball`]: mass and velocity of the ball, if one property of it is known.
//!
//! [`average`] aligns repeated drops and averages them; [`Whitening`] removes the colour of the noise of resonant sensors.
//!
//! ```
//! use inverse::{Gain, Noise, Problem, Pulse, Trace, infer};
//!
//! // a sensor that shows the force itself 20 us later; a step of 1 us, a contact of 100 us
//! let response: Vec<f64> = (0..300).map(|k| f64::from(u8::from(k == 20))).collect();
//! let pulse = Pulse::hertz();
//! let noise = |i: usize| 0.5 * ((i * i) as f64 * 0.7).sin();
//! let samples = (0..300).map(|i| noise(i) + 50.0 * pulse.at((i as f64 - 70.0) / 100.0)[0]).collect();
//! let problem = Problem {
//!     step_s: 1e-6,
//!     oversampling: 1,
//!     lead: 0,
//!     traces: vec![Trace { samples, response, noise: Noise::Quiet(0..60), gain: Gain::Known(1.0), valid_until_s: None }],
//!     pulse: &pulse,
//!     window_s: None,
//!     impulse_n_s: None,
//!     lambda: None,
//!     confidence: 0.95,
//! };
//! let found = infer(&problem)?;
//! assert!((found.fit.peak_n.value - 50.0).abs() < 0.5);
//! assert!((found.fit.start_s.value - 50e-6).abs() < 1e-6);
//! assert!((found.history.peak_n.value - 50.0).abs() < 1.0);
//! # Ok::<(), inverse::InverseError>(())
//! ```
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
