//! Curves and bands between two of them.

use super::{marker, sides};
use crate::colour::WHITE;
use crate::layer::{Band, Style};
use crate::layout::{Frame, Look, Slot, look};
use crate::panel::Mirror;
use crate::scene::{Fill, Scene, Shape, Stroke};

/// How much a band hides.
pub(super) const BAND: f64 = 0.22;

/// Draws a curve within its plot.
pub(super) fn draw(scene: &mut Scene, frame: &Frame, points: &[(f64, f64)], look: Look) {
    let runs = frame.runs(points);
    let stroke = Stroke {
        colour: look.colour,
        width: look.width,
        dash: look.dash,
    };
    for run in runs.iter().filter(|run| look.line && run.len() > 1) {
        if look.rim {
            let rim = Stroke::solid(WHITE, look.width + 2.4);
            scene.shape(Shape::polyline(run, rim).clipped(frame.area));
        }
        scene.shape(Shape::polyline(run, stroke).clipped(frame.area));
    }
    for &at in runs.iter().flatten() {
        // whole markers at the sides of a plot, none of points beyond them
        if frame.area.grown(0.01).has(at) {
            marker::draw(scene, look.marker, at, look.colour);
        }
    }
}

/// Fills the area between two curves.
pub(super) fn band(scene: &mut Scene, frame: &Frame, band: &Band, slot: Slot, mirror: Mirror) {
    let colour = look(slot, Style::Plain).colour;
    let edge = |of: fn(&(f64, f64, f64)) -> (f64, f64)| -> Vec<(f64, f64)> {
        band.points.iter().map(of).collect()
    };
    let lower = sides(&edge(|p| (p.0, p.1)), mirror);
    let upper = sides(&edge(|p| (p.0, p.2)), mirror);
    for (lower, upper) in lower.iter().zip(&upper) {
        let pairs: Vec<_> = lower
            .iter()
            .zip(upper)
            .map(|(&a, &b)| frame.place(a).zip(frame.place(b)))
            .collect();
        for run in pairs.split(Option::is_none).filter(|run| run.len() > 1) {
            let run: Vec<_> = run.iter().copied().flatten().collect();
            let down = run.iter().map(|pair| pair.0);
            let outline: Vec<(f64, f64)> =
                down.chain(run.iter().rev().map(|pair| pair.1)).collect();
            let fill = Fill {
                colour,
                opacity: BAND,
            };
            scene.shape(Shape::polygon(&outline).filled(fill).clipped(frame.area));
        }
    }
}
