//! Pictures of a section: its frames and largest values as `maps`, and what is seen along its sides as `lines`.
//!
//! `frames` reads a section and knows its near field and its fronts, `quantity` says what is shown of a frame.

mod frames;
mod lines;
mod maps;
mod quantity;

pub(crate) use lines::{Path, axis_profile, space_time};
pub(crate) use maps::{frames, peak};
