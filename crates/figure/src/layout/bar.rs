//! The colour bar beside a panel or beside all of them.

use super::plan::Colours;
use super::typeface::Typeface;
use crate::text::{LINE, Rich, wrap};
use crate::ticks::{Room, Ticks, shown, ticks};

/// Width of the strip of colours in pixels.
const STRIP: f64 = 14.0;

/// A colour bar of a known height; x from the right side of the plot.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BarFit {
    pub(crate) colours: Colours,
    pub(crate) ticks: Ticks,
    /// Lines of the label, which runs upward at the right.
    pub(crate) label: Vec<String>,
    /// Left and right side of the strip.
    pub(crate) strip: [f64; 2],
    /// Where the numbers start.
    pub(crate) numbers: f64,
    /// Middle of the label's first line.
    pub(crate) text: f64,
    /// Everything, from the side of the plot on.
    pub(crate) width: f64,
}

impl BarFit {
    /// Fits a bar of a height.
    pub(crate) fn new(colours: &Colours, height: f64, faces: &Typeface) -> Self {
        let interval = colours.limits;
        let shown = shown(&colours.scale.quantity, &colours.scale.unit, &interval);
        let needs = |_: &str| LINE * faces.tick;
        let room = Room {
            length: height,
            distance: 3.4 * faces.tick,
            needs: &needs,
        };
        let ticks = ticks(&interval, shown.factor, &room);
        let widest = ticks
            .major
            .iter()
            .map(|tick| Rich::new(&tick.label).width(faces.tick))
            .fold(0.0, f64::max);
        let label = wrap(&shown.label, faces.label, height);
        let left = 1.2 * faces.tick;
        let numbers = left + STRIP + faces.tick_length() + 0.3 * faces.tick;
        let text = numbers + widest + faces.gap() + 0.5 * LINE * faces.label;
        Self {
            colours: colours.clone(),
            ticks,
            strip: [left, left + STRIP],
            numbers,
            text,
            width: text + LINE * faces.label * (label.len() as f64 - 0.5).max(0.0),
            label,
        }
    }

    /// Height of the arrow at an end beyond which there are values.
    pub(crate) fn arrow() -> f64 {
        0.8 * STRIP
    }
}
