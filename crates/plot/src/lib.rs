//! Figures composed from the files of the program.
//!
//! [`compose`] reads results, sweeps or tables and returns a [`figure::Figure`] for a [`Request`]; `figure` draws it.
//! The [`PictureKind`] selects the content, by default the one that suits the file.
//!
//! ```no_run
//! use plot::{PictureKind, Request, compose};
//!
//! let request = Request { kind: Some(PictureKind::Spectrum), ..Request::default() };
//! let (figure, notes) = compose(&["drop.h5".into()], &request)?;
//! std::fs::write("spectrum.svg", figure::to_svg(&figure)?)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(doctest, doc = include_str!("../README.md"))]

// From the bottom up: a module uses only those above it.
mod error;
mod request;
mod words;
mod series;
mod section;
mod impacts;
mod sweep;
mod table;
mod compose;

pub use compose::{animate, compose};
pub use error::PlotError;
pub use request::{PictureKind, Request};
