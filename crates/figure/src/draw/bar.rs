//! The colour bar.

use super::thin;
use crate::colour::Colour;
use crate::geometry::Rect;
use crate::layout::{BarFit, Colours, Typeface};
use crate::scene::{Anchor, Fill, Item, Picture, Scene, Segment, Shape, Text};
use crate::text::LINE;

/// Colours of the strip from its bottom to its top.
const STEPS: u32 = 256;

/// Draws a colour bar at the right of a plot, or of all plots.
pub(super) fn draw(scene: &mut Scene, bar: &BarFit, plot: Rect, faces: &Typeface) {
    let [left, right] = bar.strip.map(|x| plot.right + x);
    let strip = Rect {
        left,
        right,
        top: plot.top,
        bottom: plot.bottom,
    };
    let body = draw_strip(scene, &bar.colours, strip);
    let limits = bar.colours.limits;
    let down = |value: f64| body.bottom - limits.fraction(value) * body.height();
    let mut segments = Vec::new();
    for tick in &bar.ticks.major {
        let y = down(tick.value);
        segments.extend([
            Segment::Move(right, y),
            Segment::Line(right + faces.tick_length(), y),
        ]);
        let start = (plot.right + bar.numbers, y + 0.35 * faces.tick);
        scene.text(Text::new(&tick.label, start, faces.tick, Anchor::Start));
    }
    for &value in &bar.ticks.minor {
        let y = down(value);
        segments.extend([
            Segment::Move(right, y),
            Segment::Line(right + faces.minor_length(), y),
        ]);
    }
    scene.shape(Shape {
        segments,
        stroke: Some(thin()),
        ..Shape::default()
    });
    let mut line = plot.right + bar.text + 0.3 * faces.label;
    for label in &bar.label {
        scene.text(Text::upward(label, (line, plot.centre().1), faces.label));
        line += LINE * faces.label;
    }
}

/// The strip of colours with arrows where values go on beyond its limits; gives the strip between the arrows.
fn draw_strip(scene: &mut Scene, colours: &Colours, strip: Rect) -> Rect {
    let at = |fraction: f64| colours.scale.map.at(fraction);
    let (left, right) = (strip.left, strip.right);
    // within the height of the plot
    let [below, above] = colours
        .beyond
        .map(|is| if is { BarFit::arrow() } else { 0.0 });
    let body = Rect {
        top: strip.top + above,
        bottom: strip.bottom - below,
        ..strip
    };
    let pixels: Vec<Option<Colour>> = (0..STEPS)
        .rev()
        .map(|i| Some(at((f64::from(i) + 0.5) / f64::from(STEPS))))
        .collect();
    scene.items.push(Item::Picture(Picture {
        area: body,
        columns: 1,
        rows: STEPS,
        pixels,
    }));
    let middle = body.centre().0;
    for (is, fraction, base, tip) in [
        (colours.beyond[0], 0.0, body.bottom, strip.bottom),
        (colours.beyond[1], 1.0, body.top, strip.top),
    ] {
        if is {
            let triangle = Shape::polygon(&[(left, base), (right, base), (middle, tip)]);
            scene.shape(triangle.filled(Fill::solid(at(fraction))));
        }
    }
    let outline = Shape::polygon(&[
        (left, body.top),
        (middle, strip.top),
        (right, body.top),
        (right, body.bottom),
        (middle, strip.bottom),
        (left, body.bottom),
    ]);
    let square = Shape::rectangle(strip);
    let is_square = colours.beyond == [false, false];
    scene.shape(if is_square { square } else { outline }.stroked(thin()));
    body
}
