//! Pictures of a section: its frames and largest values (`maps`), and fields along its sides (`lines`).
//!
//! `frames` reads a section with its quantities, near field and fronts; `contour` finds contour lines.

mod contour;
mod frames;
mod lines;
mod maps;

pub(crate) use lines::{axis_profile, space_time};
pub(crate) use maps::{frames, peak};
