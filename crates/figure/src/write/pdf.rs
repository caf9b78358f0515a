//! PDF: one page, with vector shapes and with text in an embedded font.

use crate::colour::{self, BLACK, WHITE};
use crate::drawing::{Bitmap, Drawing, DrawnPath, Item, OutlinePart, Text};
use crate::error::FigureError;
use crate::figure::Figure;
use crate::font;
use crate::layout::draw;
use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{
    CidFontType, FontFlags, LineJoinStyle, SystemInfo, TextRenderingMode, UnicodeCmap,
};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str};
use std::collections::{BTreeMap, BTreeSet};
use subsetter::GlyphRemapper;

/// Points per pixel: 96 pixels and 72 points are an inch.
const POINT: f32 = 0.75;

/// Name of the font in the page's resources.
const FONT: Name<'_> = Name(b"F");

/// The six letters that the format requires for a subset of a font.
const FONT_NAME: Name<'_> = Name(b"FIGURE+Ubuntu-Light");

const SYSTEM: SystemInfo<'_> = SystemInfo {
    registry: Str(b"Adobe"),
    ordering: Str(b"Identity"),
    supplement: 0,
};

/// The figure as PDF: a page of its size with an embedded font.
///
/// # Errors
/// [`FigureError`] for a figure that cannot be drawn.
pub fn to_pdf(figure: &Figure) -> Result<Vec<u8>, FigureError> {
    let drawing = draw(figure)?;
    let subset = Subset::of(&drawing)?;
    let mut next = Ref::new(1);
    let [catalog, tree, page, content, font] = std::array::from_fn(|_| next.bump());
    let font_parts = std::array::from_fn(|_| next.bump());
    let (width, height) = (
        drawing.canvas.width() as f32,
        drawing.canvas.height() as f32,
    );
    let mut painted = Content::new();
    // pixels from the upper left corner
    painted.transform([POINT, 0.0, 0.0, -POINT, 0.0, POINT * height]);
    // pictures by their names, and opacities
    let (mut pictures, mut opacities) = (Vec::new(), BTreeSet::new());
    for item in &drawing.items {
        painted.save_state();
        match item {
            Item::DrawnPath(shape) => opacities.extend(draw_shape(&mut painted, shape)),
            Item::Bitmap(picture) => {
                let area = picture.area;
                // a picture is drawn upright in a unit square
                let (width, height) = (area.width() as f32, area.height() as f32);
                let place = [area.left as f32, area.bottom as f32];
                painted.transform([width, 0.0, 0.0, -height, place[0], place[1]]);
                painted.x_object(Name(format!("I{}", pictures.len()).as_bytes()));
                pictures.push((next.bump(), picture));
            }
            Item::Text(text) => draw_text(&mut painted, text, &subset),
        }
        painted.restore_state();
    }
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(tree);
    pdf.pages(tree).kids([page]).count(1);
    let mut sheet = pdf.page(page);
    sheet.media_box(Rect::new(0.0, 0.0, POINT * width, POINT * height));
    sheet.parent(tree).contents(content);
    let mut resources = sheet.resources();
    resources.fonts().pair(FONT, font);
    let mut objects = resources.x_objects();
    for (i, (id, _)) in pictures.iter().enumerate() {
        objects.pair(Name(format!("I{i}").as_bytes()), *id);
    }
    objects.finish();
    let mut states = resources.ext_g_states();
    for opacity in opacities {
        let name = format!("G{opacity}");
        let mut state = states.insert(Name(name.as_bytes())).dict();
        state.pair(Name(b"ca"), opacity as f32 / 1000.0);
    }
    states.finish();
    resources.finish();
    sheet.finish();

    let stream = compressed(&painted.finish());
    pdf.stream(content, &stream).filter(Filter::FlateDecode);
    subset.write(&mut pdf, font, font_parts);
    for (id, picture) in pictures {
        write_picture(&mut pdf, id, picture);
    }
    Ok(pdf.finish())
}

fn compressed(bytes: &[u8]) -> Vec<u8> {
    compress_to_vec_zlib(bytes, 6)
}

/// The pixels of a picture; transparent ones are white.
fn write_picture(pdf: &mut Pdf, id: Ref, picture: &Bitmap) {
    let colours = picture.pixels.iter().map(|pixel| pixel.unwrap_or(WHITE));
    let bytes: Vec<u8> = colours.flat_map(colour::rgb).collect();
    let stream = compressed(&bytes);
    let mut image = pdf.image_xobject(id, &stream);
    image.filter(Filter::FlateDecode);
    image.width(picture.columns.cast_signed());
    image.height(picture.rows.cast_signed());
    image.bits_per_component(8);
    image.color_space().device_rgb();
}

/// The letters of the font that a drawing uses, embedded.
struct Subset {
    file: Vec<u8>,
    /// Number of each letter in the subset, and its width relative to the size of the font.
    letters: BTreeMap<char, (u16, f64)>,
}

impl Subset {
    fn of(drawing: &Drawing) -> Result<Self, FigureError> {
        let mut remapper = GlyphRemapper::new();
        let mut letters = BTreeMap::new();
        for item in &drawing.items {
            if let Item::Text(text) = item {
                for letter in text.plain().chars() {
                    let glyph = font::glyph(letter);
                    let new = remapper.remap(glyph.0);
                    letters.insert(letter, (new, font::glyph_width(glyph)));
                }
            }
        }
        let file = subsetter::subset(font::DATA, 0, &remapper)
            .map_err(|error| FigureError(format!("the font cannot be embedded: {error}")))?;
        Ok(Self { file, letters })
    }

    /// A text as numbers of letters, two bytes each.
    fn encode(&self, text: &str) -> Vec<u8> {
        let number = |letter| self.letters.get(&letter).map_or(0, |l| l.0);
        text.chars()
            .map(number)
            .flat_map(u16::to_be_bytes)
            .collect()
    }

    fn write(&self, pdf: &mut Pdf, id: Ref, [cid, descriptor, map, file]: [Ref; 4]) {
        pdf.type0_font(id)
            .base_font(FONT_NAME)
            .encoding_predefined(Name(b"Identity-H"))
            .descendant_font(cid)
            .to_unicode(map);
        let mut part = pdf.cid_font(cid);
        part.subtype(CidFontType::Type2);
        part.base_font(FONT_NAME);
        part.system_info(SYSTEM);
        part.font_descriptor(descriptor);
        part.default_width(0.0);
        part.cid_to_gid_map_predefined(Name(b"Identity"));
        let mut widths = part.widths();
        for &(number, width) in self.letters.values() {
            widths.same(number, number, (1000.0 * width) as f32);
        }
        widths.finish();
        part.finish();
        pdf.font_descriptor(descriptor)
            .name(FONT_NAME)
            .flags(FontFlags::SYMBOLIC)
            .bbox(Rect::new(-200.0, -250.0, 2000.0, 1000.0))
            .italic_angle(0.0)
            .ascent((1000.0 * font::ASCENT) as f32)
            .descent((-1000.0 * font::DESCENT) as f32)
            .cap_height(693.0)
            .stem_v(60.0)
            .font_file2(file);
        let mut codes = UnicodeCmap::new(Name(b"Letters"), SYSTEM);
        for (&letter, &(number, _)) in &self.letters {
            codes.pair(number, letter);
        }
        let codes = compressed(&codes.finish());
        pdf.cmap(map, &codes).filter(Filter::FlateDecode);
        let data = compressed(&self.file);
        pdf.stream(file, &data).filter(Filter::FlateDecode);
    }
}

fn rgb(colour: u32) -> [f32; 3] {
    colour::rgb(colour).map(|c| f32::from(c) / 255.0)
}

/// Draws a shape; returns the opacity of its filling in thousandths, which names the graphics state for it.
fn draw_shape(content: &mut Content, shape: &DrawnPath) -> Option<u32> {
    let opacity = shape.fill.map(|fill| (1000.0 * fill.1).round() as u32);
    if let Some(area) = shape.clip {
        let corner = [area.left, area.top, area.width(), area.height()];
        let [left, top, width, height] = corner.map(|x| x as f32);
        content.rect(left, top, width, height);
        content.clip_nonzero().end_path();
    }
    if let Some(((colour, _), opacity)) = shape.fill.zip(opacity) {
        let [r, g, b] = rgb(colour);
        content.set_fill_rgb(r, g, b);
        let state = format!("G{opacity}");
        content.set_parameters(Name(state.as_bytes()));
    }
    if let Some(stroke) = shape.stroke {
        let [r, g, b] = rgb(stroke.colour);
        content.set_stroke_rgb(r, g, b);
        content.set_line_width(stroke.width as f32);
        content.set_line_join(LineJoinStyle::RoundJoin);
        content.set_dash_pattern(stroke.dash.iter().map(|&d| d as f32), 0.0);
    }
    for segment in &shape.segments {
        match *segment {
            OutlinePart::Move(x, y) => content.move_to(x as f32, y as f32),
            OutlinePart::Line(x, y) => content.line_to(x as f32, y as f32),
            OutlinePart::Curve(points) => {
                let [a, b, c, d, e, f] = points.map(|p| p as f32);
                content.cubic_to(a, b, c, d, e, f)
            }
            OutlinePart::Close => content.close_path(),
        };
    }
    match (shape.fill, shape.stroke) {
        (Some(_), Some(_)) => content.fill_nonzero_and_stroke(),
        (Some(_), None) => content.fill_nonzero(),
        (None, Some(_)) => content.stroke(),
        (None, None) => content.end_path(),
    };
    opacity
}

fn draw_text(content: &mut Content, text: &Text, font: &Subset) {
    let [r, g, b] = rgb(BLACK);
    content.set_fill_rgb(r, g, b);
    let [r, g, b] = rgb(WHITE);
    content.set_stroke_rgb(r, g, b);
    content.set_line_width(3.0);
    content.set_line_join(LineJoinStyle::RoundJoin);
    // the rim first, then the letters
    let rim = text.has_rim.then_some(TextRenderingMode::Stroke);
    for pass in rim.into_iter().chain([TextRenderingMode::Fill]) {
        content.begin_text();
        content.set_text_rendering_mode(pass);
        for (part, size, (x, y)) in text.parts() {
            content.set_font(FONT, size as f32);
            let (x, y) = (x as f32, y as f32);
            content.set_text_matrix(match text.is_upward {
                true => [0.0, -1.0, -1.0, 0.0, x, y],
                false => [1.0, 0.0, 0.0, -1.0, x, y],
            });
            content.show(Str(&font.encode(part)));
        }
        content.end_text();
    }
}
