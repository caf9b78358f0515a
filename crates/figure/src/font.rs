//! The font of the library: Ubuntu Light.

use std::sync::OnceLock;
use tiny_skia::{Path, PathBuilder, Transform};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// Ascent of the tallest letters, relative to the size of the font.
pub(crate) const ASCENT: f64 = 0.78;

/// Descent of the deepest letters, relative to the size of the font.
pub(crate) const DESCENT: f64 = 0.20;

/// The font file.
pub(crate) const DATA: &[u8] = epaint_default_fonts::UBUNTU_LIGHT;

fn face() -> &'static Face<'static> {
    static FACE: OnceLock<Face<'static>> = OnceLock::new();
    FACE.get_or_init(|| {
        #[expect(clippy::unwrap_used, reason = "the file is part of the program")]
        Face::parse(DATA, 0).unwrap()
    })
}

/// The glyph of a letter; glyph 0, an empty box, for letters that are not in the font.
pub(crate) fn glyph(letter: char) -> GlyphId {
    face().glyph_index(letter).unwrap_or_default()
}

/// Width of a glyph, relative to the size of the font.
pub(crate) fn glyph_width(glyph: GlyphId) -> f64 {
    let width = face().glyph_hor_advance(glyph).unwrap_or(0);
    f64::from(width) / f64::from(face().units_per_em())
}

/// Width of a text, relative to the size of the font, without kerning, which can only reduce it.
pub(crate) fn width(text: &str) -> f64 {
    text.chars().map(|letter| glyph_width(glyph(letter))).sum()
}

/// The letters of a text as one outline, from the origin to the right and y downward; none for blanks.
pub(crate) fn outline(text: &str, size: f64) -> Option<Path> {
    let file = face();
    let mut pen = Pen {
        path: PathBuilder::new(),
        along: 0.0,
    };
    for glyph in text.chars().map(glyph) {
        // none for a blank
        let _ = file.outline_glyph(glyph, &mut pen);
        pen.along += f32::from(file.glyph_hor_advance(glyph).unwrap_or(0));
    }
    let unit = (size / f64::from(file.units_per_em())) as f32;
    pen.path
        .finish()?
        .transform(Transform::from_scale(unit, -unit))
}

/// Draws letters one after another, in the font's units.
struct Pen {
    path: PathBuilder,
    /// Start of the letter.
    along: f32,
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.along + x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.along + x, y);
    }

    fn quad_to(&mut self, a: f32, b: f32, x: f32, y: f32) {
        self.path.quad_to(self.along + a, b, self.along + x, y);
    }

    fn curve_to(&mut self, a: f32, b: f32, c: f32, d: f32, x: f32, y: f32) {
        self.path
            .cubic_to(self.along + a, b, self.along + c, d, self.along + x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
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
        // digits have equal widths, so that numbers align
        assert!(('0'..='9').all(|d| width(&d.to_string()) == width("0")));
    }

    #[test]
    fn the_letters_of_the_field_are_there() {
        for letter in "µμσρνλφτθκΩΔ∂≥≤±≈∞√·×°−–".chars() {
            assert_ne!(glyph(letter), GlyphId::default(), "{letter}");
        }
    }
}
