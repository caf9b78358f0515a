//! Axes with ticks and labels.

use super::{AREA, BLACK, text};
use crate::figure::{Axis, Figure};
use svg::node::element::{Group, Line, Rectangle};

/// Pixels of a point.
pub(super) fn place(figure: &Figure, x: f64, y: f64) -> (f64, f64) {
    let [left, top, right, bottom] = AREA;
    (
        left + figure.x.share(x) * (right - left),
        bottom - figure.y.share(y) * (bottom - top),
    )
}

/// Lines at the ticks, below everything else; none under a map.
pub(super) fn draw_grid(figure: &Figure) -> Group {
    let [left, top, right, bottom] = AREA;
    let mut group = Group::new();
    if figure.cells.is_some() {
        return group;
    }
    for value in ticks(&figure.x) {
        let x = place(figure, value, figure.y.range.0).0;
        group = group.add(line([x, top, x, bottom], "#e3e3e3"));
    }
    for value in ticks(&figure.y) {
        let y = place(figure, figure.x.range.0, value).1;
        group = group.add(line([left, y, right, y], "#e3e3e3"));
    }
    group
}

/// Frame, ticks and labels of both axes.
pub(super) fn draw_axes(mut group: Group, figure: &Figure) -> Group {
    let [left, top, right, bottom] = AREA;
    for value in ticks(&figure.x) {
        let x = place(figure, value, figure.y.range.0).0;
        group = group
            .add(line([x, bottom, x, bottom + 5.0], BLACK))
            .add(text(
                &name(&figure.x, value),
                x,
                bottom + 20.0,
                12.0,
                "middle",
            ));
    }
    for value in ticks(&figure.y) {
        let y = place(figure, figure.x.range.0, value).1;
        group = group.add(line([left - 5.0, y, left, y], BLACK)).add(text(
            &name(&figure.y, value),
            left - 9.0,
            y + 4.0,
            12.0,
            "end",
        ));
    }
    let middle = 0.5 * (top + bottom);
    group
        .add(
            Rectangle::new()
                .set("x", left)
                .set("y", top)
                .set("width", right - left)
                .set("height", bottom - top)
                .set("fill", "none")
                .set("stroke", BLACK)
                .set("stroke-width", 1.0),
        )
        .add(text(
            &figure.x.label,
            0.5 * (left + right),
            bottom + 48.0,
            14.0,
            "middle",
        ))
        .add(
            text(&figure.y.label, 24.0, middle, 14.0, "middle")
                .set("transform", format!("rotate(-90 24 {middle})")),
        )
}

fn line([x1, y1, x2, y2]: [f64; 4], colour: &str) -> Line {
    Line::new()
        .set("x1", x1)
        .set("y1", y1)
        .set("x2", x2)
        .set("y2", y2)
        .set("stroke", colour)
        .set("stroke-width", 1.0)
}

/// Round values, about four to ten of them.
fn ticks(axis: &Axis) -> Vec<f64> {
    let (low, high) = axis.range;
    if axis.logarithmic {
        let (first, last) = (
            (low.log10() - 1e-9).ceil() as i32,
            (high.log10() + 1e-9).floor() as i32,
        );
        if last - first < 2 {
            let decades = first - 1..=last;
            return decades
                .flat_map(|k| [1.0, 2.0, 5.0].map(|m| m * 10.0_f64.powi(k)))
                .filter(|v| (low * (1.0 - 1e-9)..=high * (1.0 + 1e-9)).contains(v))
                .collect();
        }
        let stride = ((last - first) / 9 + 1).max(1);
        return (first..=last)
            .filter(|k| k % stride == 0)
            .map(|k| 10.0_f64.powi(k))
            .collect();
    }
    let rough = (high - low) / 6.0;
    let decade = 10.0_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|m| m * decade)
        .find(|&s| s >= rough)
        .unwrap_or(rough);
    let first = (low / step).ceil() as i64;
    (first..)
        .map(|i| i as f64 * step)
        .take_while(|&v| v <= high + 1e-9 * step)
        .collect()
}

/// A short name of a tick.
fn name(axis: &Axis, value: f64) -> String {
    let size = value.abs();
    if axis.logarithmic && !(0.009..2000.0).contains(&size) {
        format!("{value:.0e}")
    } else {
        let text = format!("{value:.3}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        for (low, high) in [
            (1e-16, 10.0),
            (1.0, 100.0),
            (3.0, 1e6),
            (0.4, 30.0),
            (1e-3, 0.2),
        ] {
            let axis = Axis::logarithmic("", low, high);
            let found = ticks(&axis);
            assert!((2..=10).contains(&found.len()), "{low} {high}: {found:?}");
            assert!(
                found
                    .iter()
                    .all(|v| (-1e-6..=1.0 + 1e-6).contains(&axis.share(*v)))
            );
        }
        let found = ticks(&Axis::linear("", 0.0, 2.0));
        assert_eq!(found.len(), 5);
        assert_eq!(name(&Axis::linear("", 0.0, 2.0), 0.5), "0.5");
        assert_eq!(name(&Axis::logarithmic("", 1e-9, 2.0), 1e-6), "1e-6");
    }
}
