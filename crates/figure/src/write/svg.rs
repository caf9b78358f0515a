//! SVG.

use super::png::{encode, pixels};
use crate::drawing::{Bitmap, DrawnPath, Item, OutlinePart, Text};
use crate::error::FigureError;
use crate::figure::Figure;
use crate::font;
use crate::geometry::{Point, Rect};
use crate::layout::draw;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::collections::BTreeSet;
use svg::node::element::{ClipPath, Definitions, Group, Image, Path, Rectangle, Use};
use svg::{Document, Node};
use tiny_skia::PathSegment;

/// The figure as SVG.
///
/// Letters are outlines, each defined once, so that viewers do not need the font; `aria-label` contains the text.
///
/// # Errors
/// [`FigureError`] for a figure that cannot be drawn.
pub fn to_svg(figure: &Figure) -> Result<String, FigureError> {
    let drawing = draw(figure)?;
    // the different clipping areas
    let mut clips: Vec<Rect> = Vec::new();
    let mut letters: BTreeSet<char> = BTreeSet::new();
    let mut drawn: Vec<Box<dyn Node>> = Vec::with_capacity(drawing.items.len());
    for item in &drawing.items {
        drawn.push(match item {
            Item::DrawnPath(shape) => path(shape, &mut clips).into(),
            Item::Bitmap(picture) => image(picture)?.into(),
            Item::Text(text) => label(text, &mut letters).into(),
        });
    }
    let mut definitions = Definitions::new();
    for (i, area) in clips.iter().enumerate() {
        let clip = ClipPath::new().set("id", format!("plot{i}"));
        definitions = definitions.add(clip.add(placed(Rectangle::new(), *area)));
    }
    for letter in letters {
        if let Some(outline) = letter_outline(letter) {
            let path = Path::new().set("id", letter_id(letter)).set("d", outline);
            definitions = definitions.add(path);
        }
    }
    let (width, height) = (
        number(drawing.canvas.width()),
        number(drawing.canvas.height()),
    );
    let document = Document::new()
        .set("viewBox", format!("0 0 {width} {height}"))
        .set("width", width)
        .set("height", height)
        // the older name of a link, which all viewers support
        .set("xmlns:xlink", "http://www.w3.org/1999/xlink")
        .add(definitions);
    let document = drawn.into_iter().fold(document, Document::add);
    Ok(document.to_string())
}

/// An element that covers an area.
fn placed<N: Node>(mut node: N, area: Rect) -> N {
    node.assign("x", number(area.left));
    node.assign("y", number(area.top));
    node.assign("width", number(area.width()));
    node.assign("height", number(area.height()));
    node
}

fn path(shape: &DrawnPath, clips: &mut Vec<Rect>) -> Path {
    let fill = shape.fill.map_or("none".to_owned(), |fill| hex(fill.0));
    let mut path = Path::new()
        .set("d", outline(&shape.segments))
        .set("fill", fill);
    if let Some((_, opacity)) = shape.fill.filter(|fill| fill.1 < 1.0) {
        path = path.set("fill-opacity", opacity);
    }
    if let Some(stroke) = shape.stroke {
        path = path
            .set("stroke", hex(stroke.colour))
            .set("stroke-width", stroke.width)
            .set("stroke-linejoin", "round");
        if !stroke.dash.is_empty() {
            let dashes: Vec<String> = stroke.dash.iter().map(ToString::to_string).collect();
            path = path.set("stroke-dasharray", dashes.join(" "));
        }
    }
    clips.extend(shape.clip.filter(|area| !clips.contains(area)));
    if let Some(i) = clips.iter().position(|area| shape.clip == Some(*area)) {
        path = path.set("clip-path", format!("url(#plot{i})"));
    }
    path
}

fn hex(colour: u32) -> String {
    format!("#{colour:06x}")
}

fn outline(segments: &[OutlinePart]) -> String {
    let written = segments.iter().map(|segment| match *segment {
        OutlinePart::Move(x, y) => format!("M{} {}", number(x), number(y)),
        OutlinePart::Line(x, y) => format!("L{} {}", number(x), number(y)),
        OutlinePart::Curve(points) => format!("C{}", points.map(number).join(" ")),
        OutlinePart::Close => "Z".to_owned(),
    });
    written.collect()
}

fn image(picture: &Bitmap) -> Result<Image, FigureError> {
    let png = encode(&pixels(picture)?)?;
    let data = format!("data:image/png;base64,{}", STANDARD.encode(png));
    Ok(placed(Image::new(), picture.area)
        .set("preserveAspectRatio", "none")
        .set("xlink:href", data))
}

/// Units per font size in the outlines of letters.
const OUTLINE_UNITS: f64 = 1000.0;

fn letter_id(letter: char) -> String {
    format!("u{:x}", u32::from(letter))
}

/// The outline of a letter in the font's units; none for a blank.
fn letter_outline(letter: char) -> Option<String> {
    let outline = font::outline(letter.encode_utf8(&mut [0; 4]), OUTLINE_UNITS)?;
    let at = |p: tiny_skia::Point| format!("{} {}", number(p.x.into()), number(p.y.into()));
    let segments = outline.segments().map(|segment| match segment {
        PathSegment::MoveTo(p) => format!("M{}", at(p)),
        PathSegment::LineTo(p) => format!("L{}", at(p)),
        PathSegment::QuadTo(a, p) => format!("Q{} {}", at(a), at(p)),
        PathSegment::CubicTo(a, b, p) => format!("C{} {} {}", at(a), at(b), at(p)),
        PathSegment::Close => "Z".to_owned(),
    });
    Some(segments.collect())
}

/// A text with its superscripts and subscripts as separate parts; a rim lies below all letters.
fn label(text: &Text, used: &mut BTreeSet<char>) -> Group {
    let plain = text.plain();
    used.extend(plain.chars());
    let mut group = Group::new().set("aria-label", plain);
    if text.has_rim {
        for part in text.parts() {
            let rim = letters(part, text.is_upward)
                .set("stroke", "#ffffff")
                .set("stroke-width", number(3.0 * OUTLINE_UNITS / part.1))
                .set("stroke-linejoin", "round");
            group = group.add(rim);
        }
    }
    for part in text.parts() {
        group = group.add(letters(part, text.is_upward).set("fill", "#111111"));
    }
    group
}

fn letters((text, size, (x, y)): (&str, f64, Point), is_upward: bool) -> Group {
    let turned = if is_upward { "rotate(-90)" } else { "" };
    let (x, y, size) = (number(x), number(y), size / OUTLINE_UNITS);
    let mut group = Group::new().set(
        "transform",
        format!("translate({x} {y}){turned}scale({size:.5})"),
    );
    let mut along = 0.0;
    for letter in text.chars() {
        if !letter.is_whitespace() {
            let link = format!("#{}", letter_id(letter));
            let letter = Use::new().set("xlink:href", link);
            group = group.add(letter.set("x", number(along)));
        }
        along += OUTLINE_UNITS * font::width(letter.encode_utf8(&mut [0; 4]));
    }
    group
}

/// Rounds to a hundredth of a pixel.
fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    let short = if short == "-0" { "0" } else { short };
    short.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let written: Vec<String> = [1.0, -0.001, 2.345, 0.5, 100.0].map(number).into();
        assert_eq!(written, ["1", "0", "2.35", "0.5", "100"]);
    }
}
