//! Scientific figures as data, drawn as SVG, PNG and PDF.
//!
//! A [`Figure`] holds [`Panel`]s in rows; a panel has two [`Axis`]es and [`Layer`]s; and that is all: there is no
//! state, no canvas and no font of the system. Everything else follows:
//!
//! - ranges from the data, ticks at round values whose labels fit, minor ticks, SI prefixes;
//! - colour, dash and marker of a curve from its name, different in grey and for eyes that see few colours;
//! - legends in a corner that no curve enters, or beside the panel;
//! - margins from the size of every label, so that none is cut off and none lies over another.
//!
//! ```
//! use figure::{Axis, Figure, Panel, Sharing, Style};
//!
//! let time = || (0..=100).map(|i| f64::from(i) * 0.25e-6);
//! let pulse = |t: f64| 160e3 * (std::f64::consts::PI * t / 25e-6).sin().powf(1.5);
//! let force: Vec<_> = time().map(|t| (t, [0.9 * pulse(t), pulse(t), 1.1 * pulse(t)])).collect();
//!
//! let figure = Figure::new("Copper rod on a steel block")
//!     .sharing(Sharing::X)
//!     .panel(
//!         Panel::new(Axis::linear("time").si("s"), Axis::linear("force").si("N"))
//!             .banded("contact force", Style::Plain, &force)
//!             .mark(2.0e-6, "P")
//!             .mark(3.8e-6, "S"),
//!     );
//! let svg = figure::to_svg(&figure)?;
//! assert!(svg.contains("force [kN]") && svg.contains("time [µs]"));
//! # Ok::<(), figure::FigureError>(())
//! ```
//!
//! Labels may hold raised and lowered parts: `Axis::linear("radius").unit("r_{0}")`. Lengths are in pixels of
//! 1/96 inch from the upper left corner. The same figure gives the same bytes.
#![cfg_attr(doctest, doc = include_str!("../README.md"))]

// From the bottom up: a module uses only those above it.
mod error;
mod axis;
mod geometry;
mod colour;
mod font;
mod text;
mod ticks;
mod drawing;
mod look;
mod layers;
mod figure;
mod layout;
mod write;

pub use axis::{Axis, Interval, Scale};
pub use colour::ColourMap;
pub use drawing::Drawing;
pub use error::FigureError;
pub use figure::{Figure, Legend, Panel, Sharing};
pub use geometry::Rect;
pub use layers::{Classes, Image, Layer, Line};
pub use layout::draw as measure;
pub use look::Style;
pub use write::{to_gif, to_pdf, to_png, to_svg};
