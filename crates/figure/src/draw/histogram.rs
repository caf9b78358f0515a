//! Counts over bins.

use crate::layer::{Histogram, Style};
use crate::layout::{Frame, look};
use crate::scene::{Fill, Scene, Shape, Stroke};

/// Draws bars as one outline, lightly filled, so that several lie over one another.
pub(super) fn draw(scene: &mut Scene, frame: &Frame, bars: &Histogram, index: usize) {
    let look = look(index, Style::Plain);
    // a logarithmic axis has no zero: bars stand on its end
    let above = |(x, y): (f64, f64)| (x, y.max(frame.y.low));
    let outline: Vec<(f64, f64)> = bars.outline().into_iter().map(above).collect();
    for run in frame.runs(&outline).iter().filter(|run| run.len() > 1) {
        let fill = Fill {
            colour: look.colour,
            opacity: 0.18,
        };
        scene.shape(Shape::polygon(run).filled(fill).clipped(frame.area));
        let stroke = Stroke {
            colour: look.colour,
            width: look.width,
            dash: look.dash,
        };
        scene.shape(Shape::polyline(run, stroke).clipped(frame.area));
    }
}
