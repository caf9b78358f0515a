//! SVG.

use super::png::{encode, pixels};
use crate::error::RenderError;
use crate::font::FAMILY;
use crate::geometry::Rect;
use crate::scene::{Item, Picture, Scene, Segment, Shape, Text, Turn};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use svg::node::element::{ClipPath, Definitions, Group, Image, Path, Rectangle, Text as Label};
use svg::{Document, Node};

/// Writes a scene.
///
/// Every text says how long it is, so that a viewer without the font keeps it in its place.
pub(crate) fn svg(scene: &Scene) -> Result<String, RenderError> {
    // the different areas outside of which something is not drawn
    let mut clips: Vec<Rect> = Vec::new();
    let mut definitions = Definitions::new();
    for item in &scene.items {
        if let Item::Shape(shape) = item
            && let Some(area) = shape.clip
            && !clips.contains(&area)
        {
            let clip = ClipPath::new().set("id", format!("plot{}", clips.len()));
            definitions = definitions.add(clip.add(placed(Rectangle::new(), area)));
            clips.push(area);
        }
    }
    let (width, height) = (number(scene.width), number(scene.height));
    let mut document = Document::new()
        .set("viewBox", format!("0 0 {width} {height}"))
        .set("width", width)
        .set("height", height)
        .set("font-family", FAMILY)
        .set("font-weight", "300");
    if !clips.is_empty() {
        document = document.add(definitions);
    }
    for item in &scene.items {
        document = match item {
            Item::Shape(shape) => document.add(path(shape, &clips)),
            Item::Picture(picture) => document.add(image(picture)?),
            Item::Text(text) => document.add(label(text)),
        };
    }
    Ok(document.to_string())
}

/// An element with numbers to a hundredth of a pixel.
fn with_numbers<N: Node, const M: usize>(mut node: N, numbers: [(&str, f64); M]) -> N {
    for (name, value) in numbers {
        node.assign(name, number(value));
    }
    node
}

/// An element that covers an area.
fn placed<N: Node>(node: N, area: Rect) -> N {
    let size = [("width", area.width()), ("height", area.height())];
    with_numbers(
        with_numbers(node, [("x", area.left), ("y", area.top)]),
        size,
    )
}

fn path(shape: &Shape, clips: &[Rect]) -> Path {
    let mut path = Path::new().set("d", outline(&shape.segments));
    path = match shape.fill {
        Some(fill) if fill.opacity < 1.0 => path
            .set("fill", fill.colour.hex())
            .set("fill-opacity", fill.opacity),
        Some(fill) => path.set("fill", fill.colour.hex()),
        None => path.set("fill", "none"),
    };
    if let Some(stroke) = shape.stroke {
        path = path
            .set("stroke", stroke.colour.hex())
            .set("stroke-width", stroke.width)
            .set("stroke-linejoin", "round");
        if !stroke.dash.is_empty() {
            let dashes: Vec<String> = stroke.dash.iter().map(ToString::to_string).collect();
            path = path.set("stroke-dasharray", dashes.join(" "));
        }
    }
    let clip = clips.iter().position(|area| shape.clip == Some(*area));
    match clip {
        Some(i) => path.set("clip-path", format!("url(#plot{i})")),
        None => path,
    }
}

fn outline(segments: &[Segment]) -> String {
    let mut text = String::new();
    for segment in segments {
        match segment {
            Segment::Move(x, y) => text += &format!("M{} {}", number(*x), number(*y)),
            Segment::Line(x, y) => text += &format!("L{} {}", number(*x), number(*y)),
            Segment::Curve(points) => {
                text += &format!("C{}", points.map(number).join(" "));
            }
            Segment::Close => text.push('Z'),
        }
    }
    text
}

fn image(picture: &Picture) -> Result<Image, RenderError> {
    let png = encode(&pixels(picture)?)?;
    let data = format!("data:image/png;base64,{}", STANDARD.encode(png));
    Ok(placed(Image::new(), picture.area)
        .set("preserveAspectRatio", "none")
        .set("href", data))
}

/// A text, its raised and lowered parts each on its own.
fn label(text: &Text) -> Group {
    let mut group = Group::new();
    if text.rim {
        group = group
            .set("stroke", "#ffffff")
            .set("stroke-width", 3)
            .set("paint-order", "stroke")
            .set("stroke-linejoin", "round");
    }
    for part in text.parts() {
        let (x, y) = part.start;
        let lengths = [("font-size", part.size), ("textLength", part.width)];
        let label = with_numbers(Label::new(part.text), [("x", x), ("y", y)]);
        let mut label = with_numbers(label, lengths)
            .set("lengthAdjust", "spacingAndGlyphs")
            .set("fill", "#111111");
        if text.turn == Turn::Upward {
            let turn = format!("rotate(-90 {} {})", number(x), number(y));
            label = label.set("transform", turn);
        }
        group = group.add(label);
    }
    group
}

/// To a hundredth of a pixel.
fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" {
        "0".to_owned()
    } else {
        short.to_owned()
    }
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
