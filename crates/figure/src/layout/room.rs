//! Where a plot is empty.

use crate::figure::Panel;
use crate::geometry::{Frame, Point, Rect};

/// Points along everything that is drawn in a plot, in pixels, at most four apart.
pub(super) fn occupied(panel: &Panel, frame: &Frame) -> Vec<Point> {
    let mut found = Vec::new();
    for curve in panel
        .layers
        .iter()
        .flat_map(|layer| layer.kind().curves(frame))
    {
        for side in frame.sides(&curve) {
            trace(&side, frame, &mut found);
        }
    }
    found
}

fn trace(curve: &[Point], frame: &Frame, found: &mut Vec<Point>) {
    const STEP: f64 = 4.0;
    let near = frame.area.grown(STEP);
    for run in frame.runs(curve) {
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
fn inside(area: Rect, (ax, ay): Point, (bx, by): Point) -> Option<Point> {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    let across = (ax, bx - ax, area.left, area.right);
    for (a, d, low, high) in [across, (ay, by - ay, area.top, area.bottom)] {
        if d != 0.0 {
            let (s, t) = ((low - a) / d, (high - a) / d);
            from = from.max(s.min(t));
            to = to.min(s.max(t));
        } else if !(low..=high).contains(&a) {
            return None;
        }
    }
    (from <= to).then_some((from, to))
}

/// A place for a box of a size in a plot that no curve enters: corners first, then along the sides.
pub(super) fn free(area: Rect, (width, height): Point, air: f64, taken: &[Point]) -> Option<Rect> {
    let wide = area.width() - width - 2.0 * air;
    let high = area.height() - height - 2.0 * air;
    if wide < 0.0 || high < 0.0 {
        return None;
    }
    let corners = [(1.0, 0.0), (0.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let sides = [(0.5, 0.0), (0.5, 1.0), (1.0, 0.5), (0.0, 0.5)];
    let boxes = corners.into_iter().chain(sides).map(|(x, y)| {
        let (left, top) = (area.left + air + x * wide, area.top + air + y * high);
        Rect::new(left, top, width, height)
    });
    let is_clear = |found: &Rect| {
        let reach = found.grown(air);
        !taken.iter().any(|&point| reach.has(point))
    };
    boxes.into_iter().find(is_clear)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::{Axis, Direction, Interval, Mirror};
    use crate::look::Style;

    fn frame() -> Frame {
        Frame {
            area: Rect::new(0.0, 0.0, 100.0, 100.0),
            x: Interval::linear(0.0, 1.0),
            y: Interval::linear(0.0, 1.0),
            directions: [Direction::Usual; 2],
            mirror: Mirror::Off,
        }
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
