//! Counts over bins.

use crate::geometry::Rect;
use crate::layer::{Histogram, Style};
use crate::layout::{Frame, Look, Slot, look};
use crate::scene::{Fill, Scene, Shape, Stroke};

/// Draws the bars of a histogram within its plot.
pub(super) fn draw(scene: &mut Scene, frame: &Frame, bars: &Histogram, slot: Slot) {
    // a logarithmic axis has no zero: bars stand on its end
    let above = |(x, y): (f64, f64)| (x, y.max(frame.y.low));
    let points: Vec<(f64, f64)> = bars.outline().into_iter().map(above).collect();
    for run in frame.runs(&points).iter().filter(|run| run.len() > 1) {
        outline(scene, run, &look(slot, Style::Plain), frame.area);
    }
}

/// Bars as one outline, lightly filled, so that several lie over one another.
pub(super) fn outline(scene: &mut Scene, points: &[(f64, f64)], look: &Look, clip: Rect) {
    let fill = Fill {
        colour: look.colour,
        opacity: 0.18,
    };
    scene.shape(Shape::polygon(points).filled(fill).clipped(clip));
    let stroke = Stroke {
        colour: look.colour,
        width: look.width,
        dash: look.dash,
    };
    scene.shape(Shape::polyline(points, stroke).clipped(clip));
}
