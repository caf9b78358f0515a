//! Where a plot is empty.

use super::frame::Frame;
use crate::geometry::Rect;
use crate::layer::Layer;
use crate::panel::{Mirror, Panel};

/// Points along everything that is drawn in a plot, in pixels, at most four apart.
pub(crate) fn occupied(panel: &Panel, frame: &Frame) -> Vec<(f64, f64)> {
    let mut found = Vec::new();
    for layer in &panel.layers {
        for curve in curves(layer, frame) {
            let mirrored = curve.iter().map(|&(x, y)| (-x, y)).collect();
            trace(&curve, frame, &mut found);
            if panel.mirror != Mirror::Off {
                trace::<Vec<_>>(&mirrored, frame, &mut found);
            }
        }
    }
    found
}

/// What of a layer must stay readable, as curves.
fn curves(layer: &Layer, frame: &Frame) -> Vec<Vec<(f64, f64)>> {
    match layer {
        Layer::Line(line) => vec![line.points.clone()],
        Layer::Band(band) => [
            |p: &(f64, f64, f64)| (p.0, p.1),
            |p: &(f64, f64, f64)| (p.0, p.2),
        ]
        .map(|side| band.points.iter().map(side).collect())
        .to_vec(),
        Layer::Histogram(histogram) => {
            // whole bars, not only their tops
            let base = frame.y.low.max(0.0);
            let bars = histogram.outline().into_iter();
            let top: Vec<(f64, f64)> = bars.clone().map(|(x, y)| (x, y.max(frame.y.low))).collect();
            let mut all = vec![top];
            all.extend(bars.map(|(x, y)| vec![(x, base), (x, y.max(frame.y.low))]));
            all
        }
        Layer::Mark(mark) => vec![vec![(mark.x, frame.y.low), (mark.x, frame.y.high)]],
        Layer::Point(point) => vec![vec![(point.x, point.y)]],
        Layer::Image(_) | Layer::Classes(_) => Vec::new(),
    }
}

fn trace<C: AsRef<[(f64, f64)]>>(curve: &C, frame: &Frame, found: &mut Vec<(f64, f64)>) {
    const STEP: f64 = 4.0;
    let near = frame.area.grown(STEP);
    for run in frame.runs(curve.as_ref()) {
        if run.len() == 1 && near.has(run[0]) {
            found.push(run[0]);
        }
        for pair in run.windows(2) {
            let ((ax, ay), (bx, by)) = (pair[0], pair[1]);
            let Some((from, to)) = inside(near, pair[0], pair[1]) else {
                continue;
            };
            let length = (to - from) * (bx - ax).hypot(by - ay);
            let parts = (length / STEP).ceil().max(1.0) as usize;
            for i in 0..=parts {
                let s = from + (to - from) * i as f64 / parts as f64;
                found.push((ax + s * (bx - ax), ay + s * (by - ay)));
            }
        }
    }
}

/// The part of a segment that lies in a rectangle, as fractions of it.
fn inside(area: Rect, (ax, ay): (f64, f64), (bx, by): (f64, f64)) -> Option<(f64, f64)> {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (a, b, low, high) in [
        (ax, bx, area.left, area.right),
        (ay, by, area.top, area.bottom),
    ] {
        let d = b - a;
        if d == 0.0 {
            if !(low..=high).contains(&a) {
                return None;
            }
            continue;
        }
        let (s, t) = ((low - a) / d, (high - a) / d);
        from = from.max(s.min(t));
        to = to.min(s.max(t));
    }
    (from <= to).then_some((from, to))
}

/// A place for a box of a size in a plot that no curve enters: corners first, then along the sides.
pub(super) fn free(
    area: Rect,
    (width, height): (f64, f64),
    air: f64,
    taken: &[(f64, f64)],
) -> Option<Rect> {
    let span = [
        area.width() - width - 2.0 * air,
        area.height() - height - 2.0 * air,
    ];
    if span.iter().any(|&s| s < 0.0) {
        return None;
    }
    // upper right, upper left, lower right, lower left, then the middles of the sides
    const PLACES: [(f64, f64); 8] = [
        (1.0, 0.0),
        (0.0, 0.0),
        (1.0, 1.0),
        (0.0, 1.0),
        (0.5, 0.0),
        (0.5, 1.0),
        (1.0, 0.5),
        (0.0, 0.5),
    ];
    let boxes = PLACES.map(|(x, y)| {
        let (left, top) = (area.left + air + x * span[0], area.top + air + y * span[1]);
        Rect::new(left, top, width, height)
    });
    let clear = |found: &Rect| {
        let reach = found.grown(air);
        !taken.iter().any(|&point| reach.has(point))
    };
    boxes.into_iter().find(clear)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::Axis;
    use crate::interval::Interval;
    use crate::layer::Style;
    use crate::layout::AxisPlan;

    fn frame() -> Frame {
        let axis = || AxisPlan::new(&Axis::linear(""), Interval::linear(0.0, 1.0));
        Frame::new(Rect::new(0.0, 0.0, 100.0, 100.0), &axis(), &axis())
    }

    #[test]
    fn a_box_goes_where_no_curve_does() {
        let axes = || Panel::new(Axis::linear(""), Axis::linear(""));
        let rising = axes().line("", Style::Plain, vec![(0.0, 0.0), (1.0, 1.0)]);
        let taken = occupied(&rising, &frame());
        assert!(taken.len() > 25);
        let found = free(frame().area, (30.0, 20.0), 4.0, &taken).unwrap();
        assert_eq!((found.left, found.top), (4.0, 4.0), "the upper left");
        let cross = rising.line("", Style::Plain, vec![(0.0, 1.0), (1.0, 0.0)]);
        let taken = occupied(&cross, &frame());
        let found = free(frame().area, (20.0, 10.0), 4.0, &taken).unwrap();
        assert!(found.centre().0 > 40.0 && found.centre().0 < 60.0);
        assert!(free(frame().area, (80.0, 60.0), 4.0, &taken).is_none());
    }

    #[test]
    fn curves_far_outside_take_nothing() {
        let axes = Panel::new(Axis::linear(""), Axis::linear(""));
        let far = axes.line("", Style::Plain, vec![(0.0, 1e9), (1.0, 2e9), (9.0, 0.5)]);
        assert!(occupied(&far, &frame()).is_empty());
        let through = inside(Rect::new(0.0, 0.0, 1.0, 1.0), (-1.0, 0.5), (3.0, 0.5));
        assert_eq!(through, Some((0.25, 0.5)));
    }
}
