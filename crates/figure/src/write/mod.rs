//! From a figure to the bytes of a file, one format a file; `png` writes the frames of a GIF too.

mod pdf;
mod png;
mod svg;

pub use pdf::to_pdf;
pub use png::{to_gif, to_png};
pub use svg::to_svg;
