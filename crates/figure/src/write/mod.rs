//! From a scene to a file, one format a file.

mod gif;
mod pdf;
mod pixels;
mod png;
mod svg;

pub(crate) use gif::gif;
pub(crate) use pdf::pdf;
pub(crate) use png::png;
pub(crate) use svg::svg;
