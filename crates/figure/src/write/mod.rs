//! From a scene to a file, one format a file; `png` writes the frames of a GIF too.

mod pdf;
mod png;
mod svg;

pub(crate) use pdf::pdf;
pub(crate) use png::{gif, png};
pub(crate) use svg::svg;
