//! Vertical lines with labels above the plot.

use crate::colour::{MARK, WHITE};
use crate::layer::Layer;
use crate::layout::{Placed, Typeface};
use crate::scene::{Anchor, Scene, Shape, Stroke, Text};
use crate::text::LINE;

/// Draws the lines and labels of a panel.
pub(super) fn draw(scene: &mut Scene, placed: &Placed<'_>, faces: &Typeface) {
    let frame = &placed.frame;
    let area = frame.area;
    let stroke = Stroke {
        colour: MARK,
        width: 1.0,
        dash: &[3.0, 3.0],
    };
    let is_filled = placed.plan.panel.layers.iter().any(Layer::fills);
    for layer in &placed.plan.panel.layers {
        if let Layer::Mark(mark) = layer
            && frame.x.contains(mark.x)
        {
            let x = frame.across(mark.x);
            if is_filled {
                let rim = Stroke::solid(WHITE, 2.2);
                scene.shape(Shape::polyline(&[(x, area.bottom), (x, area.top)], rim));
            }
            scene.shape(Shape::polyline(&[(x, area.bottom), (x, area.top)], stroke));
        }
    }
    for mark in &placed.fitted.marks {
        let rise = faces.gap() + (mark.row as f64 + 0.2) * LINE * faces.mark;
        let at = (area.left + mark.centre, area.top - rise);
        scene.text(Text::new(&mark.label, at, faces.mark, Anchor::Middle));
        if mark.row == 0 {
            // from the line to its label, which may have moved aside
            let from = (area.left + mark.line, area.top);
            let foot = (at.0, area.top - 0.8 * faces.gap());
            scene.shape(Shape::polyline(&[from, foot], Stroke::solid(MARK, 1.0)));
        }
    }
}
