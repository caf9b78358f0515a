//! Single points with labels beside them.

use super::plan::PanelPlan;
use super::room::occupied;
use crate::geometry::{Frame, Point, Rect};
use crate::layers::{LabelledPoint, Layer, Symbol};
use crate::look::star;
use crate::scene::{Anchor, Scene, Text};
use crate::text::{LINE, wrap};

/// Half of a star's width.
const STAR: f64 = 7.0;

/// Draws the points of a panel, each label where it covers least and no place that is taken, such as by the legend.
pub(crate) fn draw(
    scene: &mut Scene,
    plan: &PanelPlan<'_>,
    frame: &Frame,
    taken: Option<Rect>,
    size: f64,
) {
    let mut points: Vec<(&LabelledPoint, Point)> = Vec::new();
    for layer in &plan.panel.layers {
        if let Layer::Point(point) = layer
            && frame.x.contains(point.x)
            && frame.y.contains(point.y)
            && let Some(place) = frame.place((point.x, point.y))
        {
            points.push((point, place));
        }
    }
    if points.is_empty() {
        return;
    }
    let curves = occupied(plan.panel, frame);
    let stars = points
        .iter()
        .filter(|(point, _)| point.symbol == Symbol::Star);
    let stars: Vec<Point> = stars.map(|(_, place)| *place).collect();
    for &at in &stars {
        star(scene, at, STAR);
    }
    let mut written: Vec<Rect> = taken.into_iter().collect();
    for (point, place) in points {
        let cost = |lines: &Vec<Text>| {
            let bounds = bounds(lines);
            let hidden = stars.iter().filter(|&&s| bounds.grown(STAR - 1.0).has(s));
            let crossed = curves.iter().filter(|&&c| bounds.has(c));
            100 * hidden.count() + crossed.count()
        };
        let best = candidates(point, place, frame.area, size)
            .into_iter()
            .filter(|lines| {
                let bounds = bounds(lines);
                frame.area.holds(&bounds) && !written.iter().any(|b| b.grown(1.0).overlaps(&bounds))
            })
            .min_by_key(cost);
        // a plot too small for all labels shows the stars alone
        for text in best.into_iter().flatten() {
            written.push(text.bounds());
            scene.text(text.rimmed());
        }
    }
}

/// Labels around a point, the nearest first, moved into the plot and broken to its width.
fn candidates(point: &LabelledPoint, (x, y): Point, area: Rect, size: f64) -> Vec<Vec<Text>> {
    let lines = wrap(&point.label, size, area.width() - 4.0);
    let mut found = Vec::new();
    let rises = [0.0, -1.2, 1.2, -2.4, 2.4, -4.0, 4.0, -6.0, 6.0, -9.0, 9.0];
    let (side, near) = match point.symbol {
        Symbol::Star => (STAR + 0.35 * size, rises.len()),
        // a name of its own that has moved away names something else
        Symbol::Label => (0.5 * size, 3),
    };
    for rise in rises.into_iter().take(near) {
        let above = (x, Anchor::Middle);
        let beside = [(x + side, Anchor::Start), (x - side, Anchor::End)];
        let places = match point.symbol {
            Symbol::Star if rise == 0.0 => beside.to_vec(),
            Symbol::Star => vec![beside[0], beside[1], above],
            Symbol::Label => vec![above, beside[0], beside[1]],
        };
        for (across, anchor) in places {
            let first = y + size * (0.35 + rise - 0.5 * LINE * (lines.len() as f64 - 1.0));
            let block = |dx: f64, dy: f64| -> Vec<Text> {
                let line = |(i, text): (usize, &String)| {
                    let down = first + LINE * size * i as f64;
                    Text::new(text, (across + dx, down + dy), size, anchor)
                };
                lines.iter().enumerate().map(line).collect()
            };
            let free = bounds(&block(0.0, 0.0));
            let into = area.grown(-1.5);
            let shift = |low: f64, high: f64, from: f64, to: f64| {
                (from - low).max(0.0) + (to - high).min(0.0)
            };
            found.push(block(
                shift(free.left, free.right, into.left, into.right),
                shift(free.top, free.bottom, into.top, into.bottom),
            ));
        }
    }
    found
}

/// The rectangle around all lines.
fn bounds(lines: &[Text]) -> Rect {
    let all = lines.iter().map(Text::bounds);
    all.reduce(Rect::union).unwrap_or_default()
}
