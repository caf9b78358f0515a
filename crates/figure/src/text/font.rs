//! The font that comes with the library: Ubuntu Light.

use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};
use std::sync::OnceLock;

pub(crate) use skrifa::GlyphId;

/// Name of the font, and what takes its place in a viewer that does not have it.
pub(crate) const FAMILY: &str = "Ubuntu, sans-serif";

/// Top of the tallest letters above the line over the font's size.
pub(crate) const ASCENT: f64 = 0.78;

/// Bottom of the deepest letters below the line over the font's size.
pub(crate) const DESCENT: f64 = 0.20;

/// The font file.
pub(crate) fn data() -> &'static [u8] {
    epaint_default_fonts::UBUNTU_LIGHT
}

struct Font {
    file: FontRef<'static>,
    /// Widths of the characters of ASCII.
    ascii: [f64; 128],
}

impl Font {
    fn get() -> &'static Self {
        static FONT: OnceLock<Font> = OnceLock::new();
        FONT.get_or_init(|| {
            #[expect(clippy::unwrap_used, reason = "the file is part of the program")]
            let file = FontRef::new(data()).unwrap();
            let width = |i: usize| {
                let letter = u8::try_from(i).map_or(' ', char::from);
                width_of(&file, file.charmap().map(letter).unwrap_or_default())
            };
            Self {
                ascii: std::array::from_fn(width),
                file,
            }
        })
    }
}

fn width_of(file: &FontRef<'_>, glyph: GlyphId) -> f64 {
    let at = (Size::unscaled(), LocationRef::default());
    let units = f64::from(file.metrics(at.0, at.1).units_per_em);
    let metrics = file.glyph_metrics(at.0, at.1);
    f64::from(metrics.advance_width(glyph).unwrap_or(0.0)) / units
}

/// The glyph of a letter; glyph 0, an empty box, for one that the font does not have.
pub(crate) fn glyph(letter: char) -> GlyphId {
    Font::get().file.charmap().map(letter).unwrap_or_default()
}

/// Width of a glyph over the font's size.
pub(crate) fn glyph_width(glyph: GlyphId) -> f64 {
    width_of(&Font::get().file, glyph)
}

/// Width of a text over the font's size, without kerning, which can only narrow it.
pub(crate) fn width(text: &str) -> f64 {
    let font = Font::get();
    text.chars()
        .map(|letter| match font.ascii.get(letter as usize) {
            Some(&width) => width,
            None => glyph_width(glyph(letter)),
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_those_of_the_font() {
        // advance of the zero in the file's table: 564 of 1000 units
        assert!((width("0") - 0.564).abs() < 1e-9, "{}", width("0"));
        assert!(width("W") > 2.0 * width("i"));
        assert!((width("ab") - width("a") - width("b")).abs() < 1e-12);
        // digits are equally wide, so that numbers line up
        assert!(('0'..='9').all(|d| width(&d.to_string()) == width("0")));
    }

    #[test]
    fn the_letters_of_the_field_are_there() {
        for letter in "µμσρνλφτθκΩΔ∂≥≤±≈∞√·×°−–".chars() {
            assert_ne!(glyph(letter), GlyphId::default(), "{letter}");
        }
    }
}
