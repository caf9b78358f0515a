//! The colour bar next to a panel or to all panels, fitted and drawn.

use super::axes::{FittedAxis, THIN};
use crate::drawing::{Bitmap, Drawing, DrawnPath, Item, START, Text};
use crate::geometry::Rect;
use crate::layers::Colours;
use crate::text::{LINE, Typeface};
use crate::ticks::Room;

/// Width of the strip of colours in pixels.
const STRIP: f64 = 14.0;

/// Height of the arrow at an end with values beyond it.
fn arrow(is_beyond: bool) -> f64 {
    if is_beyond { 0.8 * STRIP } else { 0.0 }
}

/// Colours of the strip from bottom to top.
const STRIP_COLOURS: u32 = 256;

/// A colour bar of a given height; x is measured from the right side of the plot.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ColourBar {
    colours: Colours,
    /// Its label runs upward at the right.
    axis: FittedAxis,
    /// Left and right side of the strip.
    strip: [f64; 2],
    /// Start of the numbers.
    numbers: f64,
    /// Middle of the label's first line.
    text: f64,
    /// Total width, measured from the side of the plot.
    pub(super) width: f64,
}

impl ColourBar {
    /// Fits a bar to a height.
    pub(super) fn new(colours: &Colours, height: f64, faces: &Typeface) -> Self {
        let room = Room {
            length: height - colours.beyond.map(arrow).iter().sum::<f64>(),
            distance: 3.4 * faces.tick,
            needs: &|_| LINE * faces.tick,
        };
        let axis = FittedAxis::new(&colours.axis, &colours.limits, &room, faces);
        let left = 1.2 * faces.tick;
        let numbers = left + STRIP + faces.tick_length() + 0.3 * faces.tick;
        let text = numbers + axis.numbers + faces.gap() + 0.5 * LINE * faces.label;
        Self {
            colours: colours.clone(),
            strip: [left, left + STRIP],
            numbers,
            text,
            width: text + LINE * faces.label * (axis.label.len() as f64 - 0.5).max(0.0),
            axis,
        }
    }

    /// Draws it at the right of a plot, or of all plots.
    pub(crate) fn draw(&self, drawing: &mut Drawing, plot: Rect, faces: &Typeface) {
        let [left, right] = self.strip.map(|x| plot.right + x);
        let strip = Rect {
            left,
            right,
            ..plot
        };
        let body = self.draw_strip(drawing, strip);
        let down = |value: f64| body.bottom - self.colours.limits.fraction(value) * body.height();
        for (value, label) in &self.axis.ticks.major {
            let start = (plot.right + self.numbers, down(*value) + 0.35 * faces.tick);
            drawing.text(Text::new(label, start, faces.tick, START));
        }
        let ticks = self.axis.lengths(faces).map(|(value, length)| {
            let y = down(value);
            [(right, y), (right + length, y)]
        });
        drawing.shape(DrawnPath::lines(ticks).stroked(THIN));
        let mut line = plot.right + self.text + 0.3 * faces.label;
        for label in &self.axis.label {
            drawing.text(Text::upward(label, (line, plot.centre().1), faces.label));
            line += LINE * faces.label;
        }
    }

    /// Draws the strip of colours with arrows for values beyond its limits; returns the strip between the arrows.
    fn draw_strip(&self, drawing: &mut Drawing, strip: Rect) -> Rect {
        let at = |fraction: f64| self.colours.map.at(fraction);
        let Rect { left, right, .. } = strip;
        let beyond = self.colours.beyond;
        // within the height of the plot
        let [below, above] = beyond.map(arrow);
        let body = Rect {
            top: strip.top + above,
            bottom: strip.bottom - below,
            ..strip
        };
        let middle_of = |i: u32| (f64::from(i) + 0.5) / f64::from(STRIP_COLOURS);
        drawing.items.push(Item::Bitmap(Bitmap {
            area: body,
            columns: 1,
            rows: STRIP_COLOURS,
            pixels: (0..STRIP_COLOURS)
                .rev()
                .map(|i| Some(at(middle_of(i))))
                .collect(),
        }));
        let middle = body.centre().0;
        for (is, fraction, base, tip) in [
            (beyond[0], 0.0, body.bottom, strip.bottom),
            (beyond[1], 1.0, body.top, strip.top),
        ] {
            if is {
                let triangle = DrawnPath::polygon(&[(left, base), (right, base), (middle, tip)]);
                drawing.shape(triangle.filled(at(fraction), 1.0));
            }
        }
        let outline = match beyond {
            [false, false] => DrawnPath::rectangle(strip),
            [true, _] | [_, true] => DrawnPath::polygon(&[
                (left, body.top),
                (middle, strip.top),
                (right, body.top),
                (right, body.bottom),
                (middle, strip.bottom),
                (left, body.bottom),
            ]),
        };
        drawing.shape(outline.stroked(THIN));
        body
    }
}
