//! Pixels: PNG, and GIF of several scenes.

use crate::colour::{BLACK, Colour, WHITE};
use crate::error::FigureError;
use crate::font;
use crate::geometry::Rect;
use crate::scene::{Item, Picture, Scene, Segment, Shape, Text, Turn};
use gif::{Encoder, Frame, Repeat};
use tiny_skia::{
    ColorU8, FillRule, FilterQuality, LineJoin, Mask, Paint, PathBuilder, Pattern, Pixmap,
    SpreadMode, Stroke, StrokeDash, Transform,
};

/// A scene at so many pixels for each of its own.
pub(crate) fn png(scene: &Scene, scale: f32) -> Result<Vec<u8>, FigureError> {
    encode(&rendered(scene, scale)?)
}

/// Width and height in pixels.
fn size(scene: &Scene, scale: f32) -> [u32; 2] {
    // a hundredth of a pixel more is none
    let pixels = |side: f64| (f64::from(scale) * (side - 0.005)).ceil() as u32;
    [scene.width, scene.height].map(pixels)
}

/// The pixels of a scene.
fn rendered(scene: &Scene, scale: f32) -> Result<Pixmap, FigureError> {
    let [width, height] = size(scene, scale);
    let map = Pixmap::new(width, height).ok_or(FigureError::Pixels { width, height })?;
    let mut canvas = Canvas {
        map,
        place: Transform::from_scale(scale, scale),
        clip: None,
    };
    for item in &scene.items {
        match item {
            Item::Shape(shape) => canvas.shape(shape),
            Item::Picture(picture) => canvas.picture(picture)?,
            Item::Text(text) => canvas.text(text),
        }
    }
    Ok(canvas.map)
}

/// How long it takes to find the colours of a frame: 1 is the best, 30 the fastest.
const SPEED: i32 = 10;

/// The frames as a GIF that repeats, each `frame_s` long, to the hundredth.
pub(crate) fn gif(scenes: &[Scene], scale: f32, frame_s: f64) -> Result<Vec<u8>, FigureError> {
    let fault = |error: gif::EncodingError| FigureError::Gif(error.to_string());
    let side = |pixels: u32| {
        u16::try_from(pixels)
            .map_err(|_| FigureError::Gif(format!("{pixels} pixels is more than 65535")))
    };
    let first = size(scenes.first().ok_or(FigureError::NoPanels)?, scale);
    let (width, height) = (side(first[0])?, side(first[1])?);
    let mut encoder = Encoder::new(Vec::new(), width, height, &[]).map_err(fault)?;
    encoder.set_repeat(Repeat::Infinite).map_err(fault)?;
    for scene in scenes {
        if size(scene, scale) != first {
            let fault = "its frames are not of one size";
            return Err(FigureError::Gif(fault.to_owned()));
        }
        // the page is white throughout: no pixel is transparent
        let mut rgba = rendered(scene, scale)?.take();
        let mut frame = Frame::from_rgba_speed(width, height, &mut rgba, SPEED);
        frame.delay = (100.0 * frame_s).round().clamp(2.0, 6000.0) as u16;
        encoder.write_frame(&frame).map_err(fault)?;
    }
    let bytes = encoder.into_inner();
    bytes.map_err(|error| FigureError::Gif(error.to_string()))
}

/// A picture's pixels, transparent where nothing is to be seen.
pub(super) fn pixels(picture: &Picture) -> Result<Pixmap, FigureError> {
    let (width, height) = (picture.columns, picture.rows);
    let mut map = Pixmap::new(width, height).ok_or(FigureError::Pixels { width, height })?;
    for (to, from) in map.pixels_mut().iter_mut().zip(&picture.pixels) {
        *to = match from {
            Some(c) => ColorU8::from_rgba(c.red, c.green, c.blue, 255).premultiply(),
            None => ColorU8::from_rgba(0, 0, 0, 0).premultiply(),
        };
    }
    Ok(map)
}

/// Pixels as PNG.
pub(super) fn encode(map: &Pixmap) -> Result<Vec<u8>, FigureError> {
    map.encode_png()
        .map_err(|error| FigureError::Png(error.to_string()))
}

struct Canvas {
    map: Pixmap,
    /// From a scene's pixels to those of the map.
    place: Transform,
    /// The last area outside of which nothing was drawn; shapes of a plot follow one another.
    clip: Option<(Rect, Mask)>,
}

impl Canvas {
    fn shape(&mut self, shape: &Shape) {
        let mut outline = PathBuilder::new();
        for segment in &shape.segments {
            match *segment {
                Segment::Move(x, y) => outline.move_to(x as f32, y as f32),
                Segment::Line(x, y) => outline.line_to(x as f32, y as f32),
                Segment::Curve(points) => {
                    let [a, b, c, d, x, y] = points.map(|p| p as f32);
                    outline.cubic_to(a, b, c, d, x, y);
                }
                Segment::Close => outline.close(),
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

    fn picture(&mut self, picture: &Picture) -> Result<(), FigureError> {
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

    fn text(&mut self, text: &Text) {
        let rim = Stroke {
            width: 3.0,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        for part in text.parts() {
            let (x, y) = (part.start.0 as f32, part.start.1 as f32);
            let turned = match text.turn {
                Turn::Level => Transform::from_translate(x, y),
                Turn::Upward => Transform::from_translate(x, y).pre_rotate(-90.0),
            };
            let place = self.place.pre_concat(turned);
            let Some(letters) = font::outline(part.text, part.size) else {
                continue;
            };
            if text.rim {
                let white = paint(WHITE, 1.0);
                self.map.stroke_path(&letters, &white, &rim, place, None);
            }
            let black = paint(BLACK, 1.0);
            self.map
                .fill_path(&letters, &black, FillRule::Winding, place, None);
        }
    }
}

fn paint(colour: Colour, opacity: f64) -> Paint<'static> {
    let Colour { red, green, blue } = colour;
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, (255.0 * opacity).round() as u8);
    paint.anti_alias = true;
    paint
}

fn rectangle(area: Rect) -> Option<tiny_skia::Rect> {
    let Rect {
        left,
        top,
        right,
        bottom,
    } = area;
    tiny_skia::Rect::from_ltrb(left as f32, top as f32, right as f32, bottom as f32)
}
