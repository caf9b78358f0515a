//! Draws a [`Figure`] as SVG, and as PNG with a font that comes with the program.
//!
//! Curves differ by colour, dash and marker, classes of a map by lightness: all of it reads in print and in grey.

mod axes;
mod legend;
mod marker;
mod png;

use crate::figure::{Axis, Cells, Curve, Figure, Style};
use axes::{draw_axes, draw_grid, place};
use legend::Entry;
use svg::Document;
use svg::node::element::{ClipPath, Definitions, Group, Line, Polyline, Rectangle, Text};

pub use png::to_png;

/// Size of a picture in pixels.
pub(crate) const SIZE: (f64, f64) = (1020.0, 600.0);

/// Area of the plot: left, top, right, bottom.
pub(crate) const AREA: [f64; 4] = [86.0, 52.0, 700.0, 530.0];

/// Colours of curves, of different lightness.
const COLOURS: [&str; 10] = [
    "#0b5394", "#c1272d", "#e69f00", "#1b7f5c", "#7a3b9a", "#56b4e9", "#8c564b", "#7f7f7f",
    "#d55e8e", "#3b3b00",
];

const DASHES: [&str; 5] = ["none", "8 3", "2 3", "10 3 2 3", "5 2"];

/// Number of a plain dot among the markers: beyond those of curves.
const DOT: usize = 700;

const BLACK: &str = "#111111";

/// Fills of the classes of a map, from light to dark.
const FILLS: [&[&str]; 5] = [
    &["#ffffff"],
    &["#f4f6f8", "#8299ad"],
    &["#f7f8f9", "#bccad6", "#708aa1"],
    &["#f7f8f9", "#c9d4dd", "#8ea4b7", "#4c6377"],
    &["#f7f8f9", "#d3dce4", "#a9bac9", "#7089a0", "#3d5265"],
];

/// How the n-th curve looks.
#[derive(Debug, Clone, Copy)]
struct Look {
    colour: &'static str,
    dash: &'static str,
    width: f64,
    /// Index of the marker, if any.
    marker: Option<usize>,
    line: bool,
}

fn look(index: usize, style: Style) -> Look {
    let coloured = Look {
        colour: COLOURS[index % COLOURS.len()],
        dash: "none",
        width: 1.6,
        marker: Some(index),
        line: true,
    };
    match style {
        Style::Marked => coloured,
        Style::Plain => Look {
            dash: DASHES[index % DASHES.len()],
            marker: None,
            ..coloured
        },
        Style::Points => Look {
            line: false,
            ..coloured
        },
        Style::Heavy => Look {
            colour: BLACK,
            dash: "none",
            width: 2.6,
            marker: None,
            line: true,
        },
        Style::HeavyDashed => Look {
            colour: BLACK,
            dash: "9 5",
            width: 2.2,
            marker: None,
            line: true,
        },
        Style::Dotted => Look {
            colour: BLACK,
            dash: "2 4",
            width: 2.2,
            marker: None,
            line: true,
        },
        Style::Dots => Look {
            colour: BLACK,
            dash: "none",
            width: 1.0,
            marker: Some(DOT),
            line: false,
        },
    }
}

/// The picture as SVG.
#[must_use]
pub fn to_svg(figure: &Figure) -> String {
    let [left, top, right, bottom] = AREA;
    let clip = ClipPath::new().set("id", "plot").add(
        Rectangle::new()
            .set("x", left)
            .set("y", top)
            .set("width", right - left)
            .set("height", bottom - top),
    );
    let mut inside = Group::new().set("clip-path", "url(#plot)");
    let mut entries = Vec::new();
    if let Some(cells) = &figure.cells {
        inside = inside.add(map(cells));
        let fills = FILLS[cells.names.len().clamp(1, 5) - 1];
        for (name, fill) in cells.names.iter().zip(fills) {
            entries.push(Entry::Fill(name.clone(), fill));
        }
    }
    let mut frame = draw_axes(Group::new(), figure);
    let inside_range = |x: f64| (0.0..=1.0).contains(&figure.x.share(x));
    for (x, label) in figure.marks.iter().filter(|(x, _)| inside_range(*x)) {
        let at = place(figure, *x, figure.y.range.0).0;
        inside = inside.add(
            Line::new()
                .set("x1", at)
                .set("x2", at)
                .set("y1", top)
                .set("y2", bottom)
                .set("stroke", "#555555")
                .set("stroke-width", 1.0)
                .set("stroke-dasharray", "3 3"),
        );
        frame = frame.add(text(label, at, top - 5.0, 11.0, "middle"));
    }
    let mut index = 0;
    for curve in &figure.curves {
        let look = look(index, curve.style);
        let coloured = matches!(curve.style, Style::Marked | Style::Plain | Style::Points);
        if coloured {
            index += 1;
        }
        inside = inside.add(draw_curve(figure, curve, look));
        entries.push(Entry::Curve(curve.name.clone(), look));
    }
    let mut labels = Group::new();
    for (i, (x, y, label)) in figure.labelled.iter().enumerate() {
        let (at_x, at_y) = place(figure, *x, *y);
        labels = marker::draw(labels, 6, at_x, at_y, 7.0, BLACK, "#ffffff");
        // alternate sides, so that labels of neighbours stay apart
        let to_left = figure.x.share(*x) > 0.6;
        let (shift, anchor) = if to_left {
            (-11.0, "end")
        } else {
            (11.0, "start")
        };
        let rise = if i.is_multiple_of(2) { 4.0 } else { 6.0 };
        labels = labels.add(
            text(label, at_x + shift, at_y + rise, 12.0, anchor)
                .set("stroke", "#ffffff")
                .set("stroke-width", 3.0)
                .set("paint-order", "stroke")
                .set("stroke-linejoin", "round"),
        );
    }
    let document = Document::new()
        .set("viewBox", (0.0, 0.0, SIZE.0, SIZE.1))
        .set("width", SIZE.0)
        .set("height", SIZE.1)
        .set("font-family", "Ubuntu, sans-serif")
        .add(Definitions::new().add(clip))
        .add(
            Rectangle::new()
                .set("width", "100%")
                .set("height", "100%")
                .set("fill", "#ffffff"),
        )
        .add(text(&figure.title, left, 26.0, 17.0, "start"))
        .add(draw_grid(figure))
        .add(inside)
        .add(frame)
        .add(labels)
        .add(legend::draw(&entries));
    document.to_string()
}

/// A text in black.
fn text(content: &str, x: f64, y: f64, size: f64, anchor: &str) -> Text {
    Text::new(content)
        .set("x", x)
        .set("y", y)
        .set("font-size", size)
        .set("text-anchor", anchor)
        .set("fill", BLACK)
}

/// Rectangles of equal class along each row.
fn map(cells: &Cells) -> Group {
    let [left, top, right, bottom] = AREA;
    let [columns, rows] = cells.shape;
    let (width, height) = (
        (right - left) / columns as f64,
        (bottom - top) / rows as f64,
    );
    let fills = FILLS[cells.names.len().clamp(1, 5) - 1];
    let mut group = Group::new().set("shape-rendering", "crispEdges");
    for (row, classes) in cells.class.chunks(columns).enumerate() {
        let mut start = 0;
        for run in classes.chunk_by(|a, b| a == b) {
            let fill = fills[run[0].min(fills.len() - 1)];
            group = group.add(
                Rectangle::new()
                    .set("x", left + width * start as f64)
                    .set("y", bottom - height * (row + 1) as f64)
                    .set("width", width * run.len() as f64 + 0.3)
                    .set("height", height + 0.3)
                    .set("fill", fill),
            );
            start += run.len();
        }
    }
    group
}

fn draw_curve(figure: &Figure, curve: &Curve, look: Look) -> Group {
    let shown: Vec<(f64, f64)> = curve
        .points
        .iter()
        .filter(|(x, y)| {
            let good = |axis: &Axis, v: f64| v.is_finite() && (!axis.logarithmic || v > 0.0);
            good(&figure.x, *x) && good(&figure.y, *y)
        })
        .map(|&(x, y)| place(figure, x, y))
        .collect();
    let mut group = Group::new();
    if look.line {
        let points: Vec<String> = shown
            .iter()
            .map(|(x, y)| format!("{x:.2},{y:.2}"))
            .collect();
        group = group.add(
            Polyline::new()
                .set("points", points.join(" "))
                .set("fill", "none")
                .set("stroke", look.colour)
                .set("stroke-width", look.width)
                .set("stroke-dasharray", look.dash),
        );
    }
    if let Some(index) = look.marker {
        for (x, y) in shown {
            let size = if index == DOT { 1.6 } else { 4.2 };
            group = marker::draw(group, index % DOT, x, y, size, look.colour, "#ffffff");
        }
    }
    group
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure() -> Figure {
        let mut figure = Figure::new(
            "test",
            "A < B & C",
            Axis::logarithmic("cost", 1.0, 1e6),
            Axis::logarithmic("error", 1e-9, 1.0),
        );
        figure.curve(
            "falling",
            Style::Marked,
            vec![(1.0, 1.0), (1e6, 1e-9), (f64::NAN, 1.0), (2.0, 0.0)],
        );
        figure.map([4, 2], &["good", "bad"], |x, _| usize::from(x > 1e3));
        figure.labelled.push((1e5, 1e-2, "here".to_owned()));
        figure
    }

    #[test]
    fn a_figure_becomes_well_formed_svg_and_a_png() {
        let svg = to_svg(&figure());
        assert!(svg.contains("A &lt; B &amp; C") && svg.contains("falling"));
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        let png = to_png(&svg).unwrap();
        assert_eq!(&png[..4], b"\x89PNG");
    }

    #[test]
    fn text_is_drawn_without_fonts_of_the_system() {
        let mut blank = figure();
        blank.title.clear();
        let (with, without) = (to_png(&to_svg(&figure())), to_png(&to_svg(&blank)));
        assert_ne!(with.unwrap(), without.unwrap());
    }

    #[test]
    fn places_run_over_the_area() {
        let figure = figure();
        let [left, top, right, bottom] = AREA;
        let (x, y) = place(&figure, 1.0, 1e-9);
        assert!((x - left).abs() < 1e-9 && (y - bottom).abs() < 1e-9);
        let (x, y) = place(&figure, 1e6, 1.0);
        assert!((x - right).abs() < 1e-9 && (y - top).abs() < 1e-9);
    }
}
