//! Pixels: PNG, and GIF of several drawings.

use crate::colour::{BLACK, WHITE, rgb};
use crate::drawing::{Bitmap, Drawing, DrawnPath, Item, OutlinePart, Text};
use crate::error::FigureError;
use crate::figure::Figure;
use crate::font;
use crate::geometry::Rect;
use crate::layout::draw;
use gif::{Encoder, Frame, Repeat};
use std::fmt::Display;
use tiny_skia::{
    Color, ColorU8, FillRule, FilterQuality, LineJoin, Mask, Paint, PathBuilder, Pattern, Pixmap,
    SpreadMode, Stroke, StrokeDash, Transform,
};

/// The figure as PNG, with `scale` pixels of the PNG per pixel of the figure.
///
/// # Errors
/// [`FigureError`] for a figure that cannot be drawn, or a picture that is too large.
pub fn to_png(figure: &Figure, scale: f32) -> Result<Vec<u8>, FigureError> {
    let drawing = draw(figure)?;
    encode(&rendered(&drawing, scale, size(&drawing, scale))?)
}

/// Width and height in pixels.
fn size(drawing: &Drawing, scale: f32) -> [u32; 2] {
    // ignores up to a hundredth of a pixel
    let pixels = |side: f64| (f64::from(scale) * (side - 0.005)).ceil() as u32;
    [drawing.canvas.width(), drawing.canvas.height()].map(pixels)
}

/// The pixels of a drawing on a page of a size.
fn rendered(
    drawing: &Drawing,
    scale: f32,
    [width, height]: [u32; 2],
) -> Result<Pixmap, FigureError> {
    let mut canvas = Canvas {
        map: page(width, height)?,
        place: Transform::from_scale(scale, scale),
        clip: None,
    };
    for item in &drawing.items {
        match item {
            Item::DrawnPath(shape) => canvas.shape(shape),
            Item::Bitmap(picture) => canvas.picture(picture)?,
            Item::Text(text) => canvas.text(text),
        }
    }
    Ok(canvas.map)
}

/// Effort for finding the colours of a frame: 1 is the best, 30 the fastest.
const SPEED: i32 = 10;

/// Figures as an endless animated GIF: one frame per figure, all on a page of the size of the largest, shown for `frame_s`
/// rounded to 0.01 s.
///
/// # Errors
/// [`FigureError`] for a figure that cannot be drawn, or a side of 65536 pixels or more.
pub fn to_gif(figures: &[Figure], scale: f32, frame_s: f64) -> Result<Vec<u8>, FigureError> {
    let drawings = figures.iter().map(draw).collect::<Result<Vec<_>, _>>()?;
    let sizes = drawings.iter().map(|drawing| size(drawing, scale));
    let page = sizes.fold([0; 2], |most: [u32; 2], own| {
        [most[0].max(own[0]), most[1].max(own[1])]
    });
    let [Ok(width), Ok(height)] = page.map(u16::try_from) else {
        return Err(no_gif("its sides must be below 65536 pixels"));
    };
    let mut encoder = Encoder::new(Vec::new(), width, height, &[]).map_err(no_gif)?;
    encoder.set_repeat(Repeat::Infinite).map_err(no_gif)?;
    for drawing in &drawings {
        // the page is white everywhere: no pixel is transparent
        let mut rgba = rendered(drawing, scale, page)?.take();
        let mut frame = Frame::from_rgba_speed(width, height, &mut rgba, SPEED);
        frame.delay = (100.0 * frame_s).round().clamp(2.0, 6000.0) as u16;
        encoder.write_frame(&frame).map_err(no_gif)?;
    }
    encoder.into_inner().map_err(no_gif)
}

fn no_gif(why: impl Display) -> FigureError {
    FigureError(format!("the GIF cannot be encoded: {why}"))
}

/// A white page, including the last row, which the drawing may fill only partly.
fn page(width: u32, height: u32) -> Result<Pixmap, FigureError> {
    let mut map = pixmap(width, height)?;
    let [red, green, blue] = rgb(WHITE);
    map.fill(Color::from_rgba8(red, green, blue, 255));
    Ok(map)
}

/// Allocates the pixels.
fn pixmap(width: u32, height: u32) -> Result<Pixmap, FigureError> {
    let fault = || format!("a picture of {width} by {height} pixels cannot be created");
    Pixmap::new(width, height).ok_or_else(|| FigureError(fault()))
}

/// A picture's pixels.
pub(super) fn pixels(picture: &Bitmap) -> Result<Pixmap, FigureError> {
    let mut map = pixmap(picture.columns, picture.rows)?;
    for (to, from) in map.pixels_mut().iter_mut().zip(&picture.pixels) {
        if let Some([red, green, blue]) = from.map(rgb) {
            *to = ColorU8::from_rgba(red, green, blue, 255).premultiply();
        }
    }
    Ok(map)
}

/// Pixels as PNG.
pub(super) fn encode(map: &Pixmap) -> Result<Vec<u8>, FigureError> {
    map.encode_png()
        .map_err(|error| FigureError(format!("the PNG cannot be encoded: {error}")))
}

struct Canvas {
    map: Pixmap,
    /// Map from a drawing's pixels to those of the picture.
    place: Transform,
    /// The last clipping area; the shapes of a plot follow one another.
    clip: Option<(Rect, Mask)>,
}

impl Canvas {
    fn shape(&mut self, shape: &DrawnPath) {
        let mut outline = PathBuilder::new();
        for segment in &shape.segments {
            match *segment {
                OutlinePart::Move(x, y) => outline.move_to(x as f32, y as f32),
                OutlinePart::Line(x, y) => outline.line_to(x as f32, y as f32),
                OutlinePart::Curve(points) => {
                    let [a, b, c, d, x, y] = points.map(|p| p as f32);
                    outline.cubic_to(a, b, c, d, x, y);
                }
                OutlinePart::Close => outline.close(),
            }
        }
        let Some(outline) = outline.finish() else {
            return;
        };
        if let Some(area) = shape.clip {
            self.clip_to(area);
        }
        let mask = shape.clip.and(self.clip.as_ref()).map(|(_, mask)| mask);
        if let Some((colour, opacity)) = shape.fill {
            let paint = paint(colour, opacity);
            let rule = FillRule::Winding;
            self.map.fill_path(&outline, &paint, rule, self.place, mask);
        }
        if let Some(pen) = shape.stroke {
            let dash = pen.dash.iter().map(|&length| length as f32).collect();
            let stroke = Stroke {
                width: pen.width as f32,
                line_join: LineJoin::Round,
                dash: StrokeDash::new(dash, 0.0),
                ..Stroke::default()
            };
            let paint = paint(pen.colour, 1.0);
            self.map
                .stroke_path(&outline, &paint, &stroke, self.place, mask);
        }
    }

    fn clip_to(&mut self, area: Rect) {
        if self.clip.as_ref().is_some_and(|(known, _)| *known == area) {
            return;
        }
        let mask = Mask::new(self.map.width(), self.map.height());
        self.clip = mask.zip(rectangle(area)).map(|(mut mask, inside)| {
            let inside = PathBuilder::from_rect(inside);
            mask.fill_path(&inside, FillRule::Winding, true, self.place);
            (area, mask)
        });
    }

    fn picture(&mut self, picture: &Bitmap) -> Result<(), FigureError> {
        let source = pixels(picture)?;
        if let Some(area) = rectangle(picture.area) {
            let size = [source.width(), source.height()].map(|pixels| pixels as f32);
            let place = Transform::from_translate(area.x(), area.y())
                .pre_scale(area.width() / size[0], area.height() / size[1]);
            let quality = FilterQuality::Bicubic;
            let shader = Pattern::new(source.as_ref(), SpreadMode::Pad, quality, 1.0, place);
            let paint = Paint {
                shader,
                ..Paint::default()
            };
            self.map.fill_rect(area, &paint, self.place, None);
        }
        Ok(())
    }

    fn text(&mut self, label: &Text) {
        let rim = Stroke {
            width: 3.0,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        for (text, size, (x, y)) in label.parts() {
            let mut turned = Transform::from_translate(x as f32, y as f32);
            if label.is_upward {
                turned = turned.pre_rotate(-90.0);
            }
            let place = self.place.pre_concat(turned);
            let Some(letters) = font::outline(text, size) else {
                continue;
            };
            if label.has_rim {
                let white = paint(WHITE, 1.0);
                self.map.stroke_path(&letters, &white, &rim, place, None);
            }
            let black = paint(BLACK, 1.0);
            self.map
                .fill_path(&letters, &black, FillRule::Winding, place, None);
        }
    }
}

fn paint(colour: u32, opacity: f64) -> Paint<'static> {
    let [red, green, blue] = rgb(colour);
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, (255.0 * opacity).round() as u8);
    paint.anti_alias = true;
    paint
}

fn rectangle(area: Rect) -> Option<tiny_skia::Rect> {
    let sides = [area.left, area.top, area.right, area.bottom];
    let [left, top, right, bottom] = sides.map(|side| side as f32);
    tiny_skia::Rect::from_ltrb(left, top, right, bottom)
}
