//! Single points with labels beside them.

use super::marker;
use crate::colour::BLACK;
use crate::geometry::Rect;
use crate::layer::{LabelledPoint, Layer, Symbol};
use crate::layout::{LegendPlace, Placed, Typeface, occupied};
use crate::scene::{Anchor, Scene, Text};
use crate::text::{LINE, wrap};

/// Half of a star's width.
const STAR: f64 = 7.0;

/// Draws the points of a panel, each label where it covers least.
pub(super) fn draw(scene: &mut Scene, placed: &Placed<'_>, faces: &Typeface) {
    let frame = &placed.frame;
    let shown = |point: &&LabelledPoint| frame.x.contains(point.x) && frame.y.contains(point.y);
    let points: Vec<&LabelledPoint> = placed
        .plan
        .panel
        .layers
        .iter()
        .filter_map(|layer| match layer {
            Layer::Point(point) => Some(point),
            Layer::Line(_)
            | Layer::Band(_)
            | Layer::Histogram(_)
            | Layer::Image(_)
            | Layer::Classes(_)
            | Layer::Mark(_) => None,
        })
        .filter(shown)
        .collect();
    if points.is_empty() {
        return;
    }
    let curves = occupied(placed.plan.panel, frame);
    let at = |point: &LabelledPoint| frame.place((point.x, point.y));
    let is_star = |point: &&&LabelledPoint| point.symbol == Symbol::Star;
    let stars: Vec<(f64, f64)> = points
        .iter()
        .filter(is_star)
        .filter_map(|p| at(p))
        .collect();
    for &star in &stars {
        marker::star(scene, star, STAR, BLACK);
    }
    let mut written: Vec<Rect> = match &placed.fitted.legend {
        Some((_, LegendPlace::Inside(found))) => {
            vec![Rect {
                left: found.left + frame.area.left,
                right: found.right + frame.area.left,
                top: found.top + frame.area.top,
                bottom: found.bottom + frame.area.top,
            }]
        }
        Some(_) | None => Vec::new(),
    };
    for point in points {
        let Some(place) = at(point) else {
            continue;
        };
        let cost = |lines: &Vec<Text>| {
            let bounds = bounds(lines);
            let hidden = stars.iter().filter(|&&s| bounds.grown(STAR - 1.0).has(s));
            let crossed = curves.iter().filter(|&&c| bounds.has(c));
            100 * hidden.count() + crossed.count()
        };
        let best = candidates(point, place, frame.area, faces.tick)
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
fn candidates(point: &LabelledPoint, (x, y): (f64, f64), area: Rect, size: f64) -> Vec<Vec<Text>> {
    let side = match point.symbol {
        Symbol::Star => STAR + 0.35 * size,
        Symbol::Label => 0.5 * size,
    };
    let lines = wrap(&point.label, size, area.width() - 4.0);
    let mut found = Vec::new();
    let rises = [0.0, -1.2, 1.2, -2.4, 2.4, -4.0, 4.0, -6.0, 6.0, -9.0, 9.0];
    // a name of its own that has moved away names something else
    let near = match point.symbol {
        Symbol::Star => rises.len(),
        Symbol::Label => 3,
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
    all.reduce(|a, b| Rect {
        left: a.left.min(b.left),
        top: a.top.min(b.top),
        right: a.right.max(b.right),
        bottom: a.bottom.max(b.bottom),
    })
    .unwrap_or(Rect::new(0.0, 0.0, 0.0, 0.0))
}
