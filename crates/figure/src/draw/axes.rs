//! Axes with ticks and labels.

use super::thin;
use crate::colour::GRID;
use crate::layout::{Placed, Typeface};
use crate::scene::{Anchor, Scene, Segment, Shape, Stroke, Text};
use crate::text::LINE;

/// Lines at the ticks, below everything else.
pub(super) fn grid(scene: &mut Scene, placed: &Placed<'_>) {
    let (frame, area) = (&placed.frame, placed.frame.area);
    let mut segments = Vec::new();
    for tick in &placed.fitted.x_ticks.major {
        let x = frame.across(tick.value);
        segments.extend([Segment::Move(x, area.top), Segment::Line(x, area.bottom)]);
    }
    for tick in &placed.fitted.y_ticks.major {
        let y = frame.down(tick.value);
        segments.extend([Segment::Move(area.left, y), Segment::Line(area.right, y)]);
    }
    let stroke = Stroke::solid(GRID, 1.0);
    scene.shape(Shape {
        segments,
        stroke: Some(stroke),
        ..Shape::default()
    });
}

/// Frame, ticks, numbers, labels and title of a panel.
pub(super) fn draw(scene: &mut Scene, placed: &Placed<'_>, faces: &Typeface) {
    let area = placed.frame.area;
    scene.shape(ticks(placed, faces));
    scene.shape(Shape::rectangle(area).stroked(thin()));
    let fitted = &placed.fitted;
    let middle = area.centre();
    if placed.plan.x.labelled {
        let mut line = area.bottom + faces.tick_length() + 0.2 * faces.tick + faces.tick;
        for tick in &fitted.x_ticks.major {
            let at = (placed.frame.across(tick.value), line);
            scene.text(Text::new(&tick.label, at, faces.tick, Anchor::Middle));
        }
        line += 0.55 * faces.tick + faces.label;
        for label in &fitted.x_label {
            scene.text(Text::new(
                label,
                (middle.0, line),
                faces.label,
                Anchor::Middle,
            ));
            line += LINE * faces.label;
        }
    }
    if placed.plan.y.labelled {
        let right = area.left - faces.tick_length() - 0.35 * faces.tick;
        for tick in &fitted.y_ticks.major {
            let at = (right, placed.frame.down(tick.value) + 0.35 * faces.tick);
            scene.text(Text::new(&tick.label, at, faces.tick, Anchor::End));
        }
        // upward text stands on its right side, its first line at the left
        let mut line = right - fitted.y_numbers - faces.gap() - 0.25 * faces.label;
        for label in fitted.y_label.iter().rev() {
            scene.text(Text::upward(label, (line, middle.1), faces.label));
            line -= LINE * faces.label;
        }
    }
    let mut line = area.top - faces.gap() - Typeface::lines(faces.mark, fitted.mark_rows);
    for title in fitted.title.iter().rev() {
        let at = (middle.0, line - 0.2 * faces.panel);
        scene.text(Text::new(title, at, faces.panel, Anchor::Middle));
        line -= LINE * faces.panel;
    }
}

/// All ticks, outside of the plot.
fn ticks(placed: &Placed<'_>, faces: &Typeface) -> Shape {
    let (frame, area, fitted) = (&placed.frame, placed.frame.area, &placed.fitted);
    let mut segments = Vec::new();
    let both = |major: &[crate::ticks::Tick], minor: &[f64]| -> Vec<(f64, f64)> {
        let long = major.iter().map(|tick| (tick.value, faces.tick_length()));
        long.chain(minor.iter().map(|&value| (value, faces.minor_length())))
            .collect()
    };
    for (value, length) in both(&fitted.x_ticks.major, &fitted.x_ticks.minor) {
        let x = frame.across(value);
        segments.extend([
            Segment::Move(x, area.bottom),
            Segment::Line(x, area.bottom + length),
        ]);
    }
    for (value, length) in both(&fitted.y_ticks.major, &fitted.y_ticks.minor) {
        let y = frame.down(value);
        segments.extend([
            Segment::Move(area.left - length, y),
            Segment::Line(area.left, y),
        ]);
    }
    Shape {
        segments,
        stroke: Some(thin()),
        ..Shape::default()
    }
}
