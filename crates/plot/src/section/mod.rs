//! Pictures of a section: its frames and largest values as `maps`, and what is seen along its sides as `lines`.
//!
//! `frames` reads a section, says what can be shown of it, and knows its near field and its fronts; `contour` finds the
//! line of a value.

mod contour;
mod frames;
mod lines;
mod maps;

pub(crate) use lines::{axis_profile, space_time};
pub(crate) use maps::{frames, peak};
