//! The letters of the font that a scene uses, embedded.

use super::LEVEL;
use crate::error::RenderError;
use crate::scene::{Item, Scene};
use crate::text;
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, Str};
use std::collections::BTreeMap;
use subsetter::GlyphRemapper;

/// Marked as a part of a font by the six letters that the format asks for.
const NAME: Name<'_> = Name(b"FIGURE+Ubuntu-Light");

const SYSTEM: SystemInfo<'_> = SystemInfo {
    registry: Str(b"Adobe"),
    ordering: Str(b"Identity"),
    supplement: 0,
};

/// A part of the font.
pub(super) struct Subset {
    file: Vec<u8>,
    /// Number of each letter in the part, and its width over the font's size.
    letters: BTreeMap<char, (u16, f64)>,
}

impl Subset {
    /// The letters of a scene.
    pub(super) fn of(scene: &Scene) -> Result<Self, RenderError> {
        let mut remapper = GlyphRemapper::new();
        let mut letters = BTreeMap::new();
        let texts = scene.items.iter().filter_map(|item| match item {
            Item::Text(text) => Some(text.plain()),
            Item::Shape(_) | Item::Picture(_) => None,
        });
        for letter in texts.collect::<String>().chars() {
            let glyph = text::glyph(letter);
            let new = remapper.remap(glyph.0);
            letters.insert(letter, (new, text::glyph_width(glyph)));
        }
        let file = subsetter::subset(text::data(), 0, &remapper)
            .map_err(|error| RenderError::Font(error.to_string()))?;
        Ok(Self { file, letters })
    }

    /// A text as numbers of letters, two bytes each.
    pub(super) fn encode(&self, text: &str) -> Vec<u8> {
        let numbers = text
            .chars()
            .map(|c| self.letters.get(&c).map_or(0, |l| l.0));
        numbers.flat_map(u16::to_be_bytes).collect()
    }

    /// Writes the font.
    pub(super) fn write(&self, pdf: &mut Pdf, id: Ref, [cid, descriptor, map, file]: [Ref; 4]) {
        pdf.type0_font(id)
            .base_font(NAME)
            .encoding_predefined(Name(b"Identity-H"))
            .descendant_font(cid)
            .to_unicode(map);
        let mut font = pdf.cid_font(cid);
        font.subtype(CidFontType::Type2);
        font.base_font(NAME);
        font.system_info(SYSTEM);
        font.font_descriptor(descriptor);
        font.default_width(0.0);
        font.cid_to_gid_map_predefined(Name(b"Identity"));
        let mut widths = font.widths();
        for &(number, width) in self.letters.values() {
            widths.same(number, number, (1000.0 * width) as f32);
        }
        widths.finish();
        font.finish();
        let (top, bottom) = (1000.0 * text::ASCENT, -1000.0 * text::DESCENT);
        pdf.font_descriptor(descriptor)
            .name(NAME)
            .flags(FontFlags::SYMBOLIC)
            .bbox(Rect::new(-200.0, -250.0, 2000.0, 1000.0))
            .italic_angle(0.0)
            .ascent(top as f32)
            .descent(bottom as f32)
            .cap_height(693.0)
            .stem_v(60.0)
            .font_file2(file);
        let mut codes = UnicodeCmap::new(Name(b"Letters"), SYSTEM);
        for (&letter, &(number, _)) in &self.letters {
            codes.pair(number, letter);
        }
        let codes = compress_to_vec_zlib(&codes.finish(), LEVEL);
        pdf.cmap(map, &codes).filter(Filter::FlateDecode);
        let data = compress_to_vec_zlib(&self.file, LEVEL);
        pdf.stream(file, &data).filter(Filter::FlateDecode);
    }
}
