//! Labels in and above a plot: vertical lines with labels side by side above the panel, and single points with labels
//! in empty places nearby.

use super::plan::PanelPlan;
use crate::colour::{MARK, WHITE};
use crate::drawing::{Drawing, DrawnPath, END, MIDDLE, START, Stroke, Text};
use crate::figure::Panel;
use crate::geometry::{Frame, Point, Rect};
use crate::layers::Layer;
use crate::look::star;
use crate::text::{LINE, Typeface, width as width_of, wrap};

/// The label of a vertical line.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Label {
    /// The line, measured from the left side of the plot.
    line: f64,
    /// Middle of the label.
    centre: f64,
    /// Row of the label, 0 next to the plot.
    row: usize,
    /// One line of text.
    text: String,
}

/// The vertical lines of a panel with their labels.
fn lines<'a>(plan: &PanelPlan<'a>) -> impl Iterator<Item = (f64, &'a str)> {
    let interval = plan.intervals[0];
    let layers = plan.panel.layers.iter();
    layers.filter_map(move |layer| match layer {
        Layer::Mark { x, label } => interval.contains(*x).then_some((*x, label.as_str())),
        Layer::Line(_) | Layer::Image(_) | Layer::Classes(_) | Layer::Point { .. } => None,
    })
}

/// Number of rows of labels.
pub(super) fn rows(labels: &[Label]) -> usize {
    labels.iter().map(|label| label.row + 1).max().unwrap_or(0)
}

/// Places labels over a plot at 0, 0, in as few rows as possible and without overlap.
pub(super) fn of_marks(plan: &PanelPlan<'_>, frame: &Frame, faces: &Typeface) -> Vec<Label> {
    let named = lines(plan).filter(|(_, label)| !label.trim().is_empty());
    let mut found: Vec<_> = named.map(|(x, label)| (frame.across(x), label)).collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    placed(&found, frame.area.width(), faces)
}

/// Labels of lines, ascending from the left side.
///
/// A label without space above its line is moved aside; one that is wider than the plot is broken into lines.
fn placed(marks: &[(f64, &str)], width: f64, faces: &Typeface) -> Vec<Label> {
    let gap = 0.7 * faces.mark;
    let size = |label: &str| width_of(label, faces.mark) + gap;
    if marks.iter().any(|(_, label)| size(label) > width) {
        return stacked(marks, width - gap, faces);
    }
    // labels alternate between the rows
    let row = |row: usize, rows: usize| marks.iter().skip(row).step_by(rows);
    let boxes = |i: usize, rows: usize| -> Vec<Point> {
        let row = row(i, rows);
        row.map(|&(line, label)| (line, size(label))).collect()
    };
    let mut rows = 1;
    while (0..rows).any(|i| boxes(i, rows).iter().map(|b| b.1).sum::<f64>() > width) {
        rows += 1;
    }
    let mut placed = Vec::with_capacity(marks.len());
    for i in 0..rows {
        let labels = row(i, rows).zip(spread(&boxes(i, rows), width));
        placed.extend(labels.map(|(&(line, label), centre)| Label {
            line,
            centre,
            row: i,
            text: label.to_owned(),
        }));
    }
    placed
}

/// Labels below one another, each broken to the width of the plot.
fn stacked(marks: &[(f64, &str)], width: f64, faces: &Typeface) -> Vec<Label> {
    let mut placed = Vec::new();
    for (line, label) in marks.iter().rev() {
        for text in wrap(label, faces.mark, width).into_iter().rev() {
            placed.push(Label {
                line: *line,
                centre: 0.5 * width,
                row: placed.len(),
                text,
            });
        }
    }
    placed
}

/// Draws the lines of a panel and their labels.
pub(super) fn draw_marks(
    drawing: &mut Drawing,
    (plan, frame): (&PanelPlan<'_>, &Frame),
    labels: &[Label],
    faces: &Typeface,
) {
    let area = frame.area;
    for (x, _) in lines(plan) {
        let x = frame.across(x);
        let line = DrawnPath::polyline(&[(x, area.bottom), (x, area.top)]);
        if plan.panel.is_filled() {
            drawing.shape(line.clone().stroked(Stroke::solid(WHITE, 2.2)));
        }
        drawing.shape(line.stroked(Stroke::new(MARK, 1.0, &[3.0, 3.0])));
    }
    for label in labels {
        let rise = faces.gap() + (label.row as f64 + 0.2) * LINE * faces.mark;
        let at = (area.left + label.centre, area.top - rise);
        drawing.text(Text::new(&label.text, at, faces.mark, MIDDLE));
        if label.row == 0 {
            // from the line to its label, which may have moved aside
            let from = (area.left + label.line, area.top);
            let foot = (at.0, area.top - 0.8 * faces.gap());
            drawing.shape(DrawnPath::polyline(&[from, foot]).stroked(Stroke::solid(MARK, 1.0)));
        }
    }
}

/// Centres of boxes side by side within 0 to `width`, as close as possible to the desired centres. Each input has a
/// desired centre and a width.
fn spread(boxes: &[Point], width: f64) -> Vec<f64> {
    // groups of touching boxes: members, sum of the desired left sides of the group, width
    let mut groups: Vec<(usize, f64, f64)> = Vec::new();
    let left = |&(count, sum, size): &(usize, f64, f64)| {
        (sum / count as f64).clamp(0.0, (width - size).max(0.0))
    };
    for &(wish, size) in boxes {
        let mut group = (1, wish - 0.5 * size, size);
        while let Some(before) = groups.last() {
            if left(before) + before.2 <= left(&group) {
                break;
            }
            // each member's desired left side of the group is reduced by the width before it
            let shifted = group.1 - group.0 as f64 * before.2;
            group = (before.0 + group.0, before.1 + shifted, before.2 + group.2);
            groups.pop();
        }
        groups.push(group);
    }
    let mut centres = Vec::with_capacity(boxes.len());
    for group in &groups {
        let mut at = left(group);
        for (_, size) in &boxes[centres.len()..][..group.0] {
            centres.push(at + 0.5 * size);
            at += size;
        }
    }
    centres
}

/// Half of a star's width.
const STAR: f64 = 7.0;

/// Draws the points of a panel. Each label is placed where it covers least, and not over the legend or other labels.
pub(super) fn draw_points(
    drawing: &mut Drawing,
    (plan, frame): (&PanelPlan<'_>, &Frame),
    taken: Option<Rect>,
    size: f64,
) {
    let mut points: Vec<(&str, bool, Point)> = Vec::new();
    for layer in &plan.panel.layers {
        if let Layer::Point {
            at,
            label,
            is_starred,
        } = layer
            && frame.x.contains(at.0)
            && frame.y.contains(at.1)
            && let Some(place) = frame.place(*at)
        {
            points.push((label, *is_starred, place));
        }
    }
    if points.is_empty() {
        return;
    }
    let curves = occupied(plan.panel, frame);
    let stars = points.iter().filter(|(_, is_starred, _)| *is_starred);
    let stars: Vec<Point> = stars.map(|(.., place)| *place).collect();
    for &at in &stars {
        star(drawing, at, STAR);
    }
    let mut written: Vec<Rect> = taken.into_iter().collect();
    for point in points {
        let cost = |lines: &Vec<Text>| {
            let bounds = bounds(lines);
            let hidden = stars.iter().filter(|&&s| bounds.grown(STAR - 1.0).has(s));
            let crossed = curves.iter().filter(|&&c| bounds.has(c));
            100 * hidden.count() + crossed.count()
        };
        let is_free = |lines: &Vec<Text>| {
            let bounds = bounds(lines);
            frame.area.holds(&bounds) && !written.iter().any(|b| b.grown(1.0).overlaps(&bounds))
        };
        let candidates = candidates(point, frame.area, size).into_iter();
        let best = candidates.filter(is_free).min_by_key(cost);
        // a plot too small for all labels shows only the stars
        for mut text in best.into_iter().flatten() {
            written.push(text.bounds());
            text.has_rim = true;
            drawing.text(text);
        }
    }
}

/// Candidate labels around a point, the nearest first, moved into the plot and broken to its width.
fn candidates(point: (&str, bool, Point), area: Rect, size: f64) -> Vec<Vec<Text>> {
    let (label, is_starred, (x, y)) = point;
    let lines = wrap(label, size, area.width() - 4.0);
    let mut found = Vec::new();
    let rises = [0.0, -1.2, 1.2, -2.4, 2.4, -4.0, 4.0, -6.0, 6.0, -9.0, 9.0];
    let (side, near) = match is_starred {
        true => (STAR + 0.35 * size, rises.len()),
        // a name that has moved away from its curve would name another one
        false => (0.5 * size, 3),
    };
    for rise in rises.into_iter().take(near) {
        let above = (x, MIDDLE);
        let beside = [(x + side, START), (x - side, END)];
        let places = match is_starred {
            true if rise == 0.0 => beside.to_vec(),
            true => vec![beside[0], beside[1], above],
            // further aside if its curve is steep
            false => {
                let aside = [(x + 2.0 * side, START), (x - 2.0 * side, END)];
                [&[above], beside.as_slice(), &aside].concat()
            }
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

/// Points along everything that is drawn in a plot, in pixels, at most four pixels apart.
pub(super) fn occupied(panel: &Panel, frame: &Frame) -> Vec<Point> {
    const OCCUPIED_SPACING: f64 = 4.0;
    let near = frame.area.grown(OCCUPIED_SPACING);
    let mut found = Vec::new();
    let curves = panel.layers.iter().flat_map(|layer| layer.curves(frame));
    let sides = curves.flat_map(|curve| frame.sides(&curve));
    for run in sides.flat_map(|side| frame.runs(&side)) {
        if run.len() == 1 && near.has(run[0]) {
            found.push(run[0]);
        }
        for pair in run.windows(2) {
            let ((ax, ay), (bx, by)) = (pair[0], pair[1]);
            let Some((from, to)) = inside(near, pair[0], pair[1]) else {
                continue;
            };
            let length = (to - from) * (bx - ax).hypot(by - ay);
            let parts = (length / OCCUPIED_SPACING).ceil().max(1.0) as usize;
            for i in 0..=parts {
                let s = from + (to - from) * i as f64 / parts as f64;
                found.push((ax + s * (bx - ax), ay + s * (by - ay)));
            }
        }
    }
    found
}

/// The part of a segment inside a rectangle, as fractions of the segment.
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

/// A position for a box in a plot that no curve enters: corners first, then along the sides.
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
    use crate::axis::{Axis, Interval};
    use crate::look::Style;

    fn boxes(marks: &[(f64, &str)], width: f64) -> Vec<Label> {
        placed(marks, width, &Typeface::new(12.0))
    }

    #[test]
    fn labels_with_room_stand_above_their_lines() {
        let placed = boxes(&[(50.0, "P"), (150.0, "S"), (250.0, "R")], 300.0);
        assert_eq!(rows(&placed), 1);
        assert!(placed.iter().all(|m| (m.centre - m.line).abs() < 1e-9));
    }

    #[test]
    fn labels_never_overlap_nor_leave_the_plot() {
        let near = [
            (1.0, "first front"),
            (2.0, "S"),
            (3.0, "Rayleigh"),
            (299.0, "end"),
        ];
        for width in [300.0, 120.0, 70.0, 30.0] {
            let placed = boxes(&near, width);
            assert!(rows(&placed) >= 1);
            for (i, a) in placed.iter().enumerate() {
                let half = |m: &Label| 0.5 * width_of(&m.text, 0.95 * 12.0);
                assert!(a.centre - half(a) > -1e-9 && a.centre + half(a) < width + 1e-9);
                for b in &placed[..i] {
                    let apart = (a.centre - b.centre).abs() >= half(a) + half(b);
                    assert!(a.row != b.row || apart, "{width}: {a:?} {b:?}");
                }
            }
        }
        assert_eq!(rows(&boxes(&[], 100.0)), 0);
    }

    fn frame() -> Frame {
        Frame {
            area: Rect::new(0.0, 0.0, 100.0, 100.0),
            x: Interval::linear(0.0, 1.0),
            y: Interval::linear(0.0, 1.0),
            reversed: [false; 2],
            is_mirrored: false,
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
