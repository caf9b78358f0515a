//! Scientific figures as data, drawn as SVG, PNG, PDF and GIF.
//!
//! A [`Figure`] has [`Panel`]s in rows; a panel has two [`Axis`]es and [`Layer`]s. There is no state, no canvas and no
//! system font. Everything else is automatic:
//!
//! - ranges from the data, ticks at round values with labels that fit, minor ticks, SI prefixes;
//! - colour, dash and marker of a curve from its name, distinguishable in grey and with colour-vision deficiency;
//! - legends in a corner that no curve enters, or outside the panel;
//! - margins from the size of all labels, so that none is cut off and none overlaps another.
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
//! Labels may contain superscripts and subscripts: `Axis::linear("radius").unit("r_{0}")`. Lengths are in pixels of
//! 1/96 inch from the upper left corner. The same figure always produces the same bytes.
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
