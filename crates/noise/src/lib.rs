//! Ground motion of many impacts on an elastic half-space.
//!
//! Impacts fall on an [`Area`] as a Poisson process, or are listed with their times and places ([`Source`]).
//! [`Noise::spectra`] returns the power spectra at receivers by Campbell's theorem, [`Tiles::tile`] a part of the traces by
//! superposition.
//! Each impact is a vertical point force with the spectrum of its contact, [`Pulses`]; the half-space is exact ([`Ground`]).
//! Nothing here reads or writes a file.
#![cfg_attr(doctest, doc = include_str!("../README.md"))]
#![warn(missing_docs)]

// From the bottom up: a module uses only those above it.
mod error;
mod area;
mod spacing;
mod ground;
mod pulses;
mod source;
mod spectra;
mod traces;

pub use area::Area;
pub use error::NoiseError;
pub use ground::{Ground, Response};
pub use pulses::{Blow, Pulse, Pulses};
pub use source::{Noise, Receiver, Source};
pub use spectra::{Errors, Motion, Spectra};
pub use traces::{Recording, Tiles};
