//! Writes a figure as the bytes of a file, one format per file; `png` also writes the frames of a GIF.

mod pdf;
mod png;
mod svg;

pub use pdf::to_pdf;
pub use png::{to_gif, to_png};
pub use svg::to_svg;
