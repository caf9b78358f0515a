//! The content of the page.

use super::font::Subset;
use crate::colour::{BLACK, Colour, WHITE};
use crate::geometry::Rect;
use crate::scene::{Item, Picture, Scene, Segment, Shape, Text, Turn};
use pdf_writer::types::{LineJoinStyle, TextRenderingMode};
use pdf_writer::{Content, Name, Str};

/// Name of the font in the page's resources.
pub(super) const FONT: &[u8] = b"F";

/// Name of the n-th picture.
pub(super) fn picture_name(n: usize) -> String {
    format!("I{n}")
}

/// Name of the state with an opacity.
pub(super) fn state_name(opacity: f64) -> String {
    format!("G{:.0}", 1000.0 * opacity)
}

/// The different opacities of a scene.
pub(super) fn opacities(scene: &Scene) -> Vec<f64> {
    let mut found = Vec::new();
    for item in &scene.items {
        if let Item::Shape(Shape {
            fill: Some(fill), ..
        }) = item
            && fill.opacity < 1.0
            && !found.contains(&fill.opacity)
        {
            found.push(fill.opacity);
        }
    }
    found
}

/// Paints everything, in pixels from the upper left corner.
pub(super) fn paint(content: &mut Content, scene: &Scene, font: &Subset) {
    let mut pictures = 0;
    for item in &scene.items {
        match item {
            Item::Shape(shape) => draw_shape(content, shape),
            Item::Picture(picture) => {
                draw_picture(content, picture, &picture_name(pictures));
                pictures += 1;
            }
            Item::Text(text) => draw_text(content, text, font),
        }
    }
}

fn rgb(colour: Colour) -> [f32; 3] {
    [colour.red, colour.green, colour.blue].map(|c| f32::from(c) / 255.0)
}

fn draw_shape(content: &mut Content, shape: &Shape) {
    content.save_state();
    if let Some(area) = shape.clip {
        let Rect { left, top, .. } = area;
        let (width, height) = (area.width() as f32, area.height() as f32);
        content.rect(left as f32, top as f32, width, height);
        content.clip_nonzero().end_path();
    }
    if let Some(fill) = shape.fill {
        let [r, g, b] = rgb(fill.colour);
        content.set_fill_rgb(r, g, b);
        if fill.opacity < 1.0 {
            content.set_parameters(Name(state_name(fill.opacity).as_bytes()));
        }
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
            Segment::Move(x, y) => content.move_to(x as f32, y as f32),
            Segment::Line(x, y) => content.line_to(x as f32, y as f32),
            Segment::Curve(points) => {
                let [a, b, c, d, e, f] = points.map(|p| p as f32);
                content.cubic_to(a, b, c, d, e, f)
            }
            Segment::Close => content.close_path(),
        };
    }
    match (shape.fill, shape.stroke) {
        (Some(_), Some(_)) => content.fill_nonzero_and_stroke(),
        (Some(_), None) => content.fill_nonzero(),
        (None, Some(_)) => content.stroke(),
        (None, None) => content.end_path(),
    };
    content.restore_state();
}

fn draw_picture(content: &mut Content, picture: &Picture, name: &str) {
    let area = picture.area;
    content.save_state();
    // a picture stands on its lower side in a unit square
    content.transform([
        area.width() as f32,
        0.0,
        0.0,
        -area.height() as f32,
        area.left as f32,
        area.bottom as f32,
    ]);
    content.x_object(Name(name.as_bytes()));
    content.restore_state();
}

fn draw_text(content: &mut Content, text: &Text, font: &Subset) {
    content.save_state();
    // the rim below, then the letters
    let passes: &[TextRenderingMode] = if text.rim {
        &[TextRenderingMode::Stroke, TextRenderingMode::Fill]
    } else {
        &[TextRenderingMode::Fill]
    };
    let [r, g, b] = rgb(BLACK);
    content.set_fill_rgb(r, g, b);
    let [r, g, b] = rgb(WHITE);
    content.set_stroke_rgb(r, g, b);
    content.set_line_width(3.0);
    content.set_line_join(LineJoinStyle::RoundJoin);
    for &pass in passes {
        content.begin_text();
        content.set_text_rendering_mode(pass);
        for part in text.parts() {
            content.set_font(Name(FONT), part.size as f32);
            let (x, y) = (part.start.0 as f32, part.start.1 as f32);
            content.set_text_matrix(match text.turn {
                Turn::Level => [1.0, 0.0, 0.0, -1.0, x, y],
                Turn::Upward => [0.0, -1.0, -1.0, 0.0, x, y],
            });
            content.show(Str(&font.encode(part.text)));
        }
        content.end_text();
    }
    content.restore_state();
}
