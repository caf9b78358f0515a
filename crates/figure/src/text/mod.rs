//! Text whose size is known before it is drawn.
//!
//! Labels may hold raised and lowered parts: `10^{-6}`, `r_{0}/c_{1}`. Everything else stands for itself.

mod font;
mod number;
mod rich;
mod wrap;

pub(crate) use font::width as text_width;
pub(crate) use font::{ASCENT, DESCENT, FAMILY, data, glyph, glyph_width, outline};
pub(crate) use number::{decimal, power_of_ten};
pub(crate) use rich::Rich;
pub(crate) use wrap::wrap;

/// Height of a line of text over the height of its letters.
pub(crate) const LINE: f64 = 1.25;
