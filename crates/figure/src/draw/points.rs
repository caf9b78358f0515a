//! Single points with labels beside them.

use super::marker;
use crate::colour::BLACK;
use crate::geometry::Rect;
use crate::layer::{LabelledPoint, Layer};
use crate::layout::{Placed, Typeface, occupied};
use crate::scene::{Anchor, Scene, Text};

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
            | Layer::Traces(_)
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
    let stars: Vec<(f64, f64)> = points.iter().filter_map(|p| frame.place((p.x, p.y))).collect();
    for &star in &stars {
        marker::star(scene, star, STAR, BLACK);
    }
    let mut written: Vec<Rect> = match &placed.fitted.legend {
        Some((_, crate::layout::LegendPlace::Inside(found))) => {
            vec![Rect {
                left: found.left + frame.area.left,
                right: found.right + frame.area.left,
                top: found.top + frame.area.top,
                bottom: found.bottom + frame.area.top,
            }]
        }
        Some(_) | None => Vec::new(),
    };
    for (point, &star) in points.iter().zip(&stars) {
        let cost = |text: &Text| {
            let bounds = text.bounds();
            let outside = !frame.area.grown(-2.0).holds(&bounds);
            let over = written.iter().filter(|b| b.grown(2.0).overlaps(&bounds)).count();
            let hidden = stars.iter().filter(|&&s| bounds.grown(STAR - 1.0).has(s)).count();
            let crossed = curves.iter().filter(|&&c| bounds.has(c)).count();
            10_000 * (over + usize::from(outside)) + 100 * hidden + crossed
        };
        let best = candidates(&point.label, star, faces.tick).into_iter().min_by_key(cost);
        if let Some(text) = best {
            written.push(text.bounds());
            scene.text(text.rimmed());
        }
    }
}

/// Labels at the sides of a point, the nearest first.
fn candidates(label: &str, (x, y): (f64, f64), size: f64) -> Vec<Text> {
    let side = STAR + 0.35 * size;
    let mut found = Vec::new();
    for rise in [0.0, -1.0, 1.0, -2.0, 2.0, -3.5, 3.5] {
        let line = y + 0.35 * size + rise * 1.2 * size;
        found.push(Text::new(label, (x + side, line), size, Anchor::Start));
        found.push(Text::new(label, (x - side, line), size, Anchor::End));
        if rise != 0.0 {
            found.push(Text::new(label, (x, line), size, Anchor::Middle));
        }
    }
    found
}
