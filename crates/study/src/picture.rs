//! A picture of the chart: one panel with a name, a caption, and the numbers that chart.h5 keeps.

use figure::{
    Axis, Classes, Figure, Interval, LabelledPoint, Layer, Legend, Line, Mark, Panel, Style,
};

/// A picture of the chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Name of its files.
    pub name: &'static str,
    /// Title.
    pub title: String,
    /// Axes and layers.
    pub panel: Panel,
    /// Sentences for the report.
    pub caption: String,
}

/// Width of a picture in pixels.
const WIDTH: f64 = 1020.0;

/// Height of its plot.
const HEIGHT: f64 = 478.0;

impl Picture {
    /// An empty picture; both axes have a range.
    pub(crate) fn new(name: &'static str, title: &str, x: Axis, y: Axis) -> Self {
        Self {
            name,
            title: title.to_owned(),
            panel: Panel::new(x, y).height(HEIGHT).legend(Legend::Outside),
            caption: String::new(),
        }
    }

    /// Adds a curve.
    pub(crate) fn curve(&mut self, name: &str, style: Style, points: Vec<(f64, f64)>) {
        let line = Line::new(name, style, points);
        self.panel.layers.push(Layer::Line(line));
    }

    /// Adds a map: the class of each cell of a plane from its centre.
    pub(crate) fn map(
        &mut self,
        plane: [Interval; 2],
        shape: [usize; 2],
        names: &[&str],
        class: impl FnMut(f64, f64) -> usize,
    ) {
        let classes = Classes::of(plane, shape, names, class);
        self.panel.layers.push(Layer::Classes(classes));
    }

    /// Adds a vertical line.
    pub(crate) fn mark(&mut self, x: f64, label: &str) {
        self.panel.layers.push(Layer::Mark(Mark::new(x, label)));
    }

    /// Adds a point with a label.
    pub(crate) fn point(&mut self, (x, y): (f64, f64), label: &str) {
        let point = LabelledPoint::new(x, y, label);
        self.panel.layers.push(Layer::Point(point));
    }

    /// What is drawn.
    #[must_use]
    pub fn figure(&self) -> Figure {
        Figure::new(&self.title)
            .width(WIDTH)
            .panel(self.panel.clone())
    }

    /// Its map of classes, if it has one.
    #[must_use]
    pub fn classes(&self) -> Option<&Classes> {
        self.panel.layers.iter().find_map(|layer| match layer {
            Layer::Classes(classes) => Some(classes),
            Layer::Line(_)
            | Layer::Band(_)
            | Layer::Histogram(_)
            | Layer::Image(_)
            | Layer::Mark(_)
            | Layer::Point(_) => None,
        })
    }

    /// Its curves, in order.
    pub fn curves(&self) -> impl Iterator<Item = &Line> {
        self.panel.layers.iter().filter_map(|layer| match layer {
            Layer::Line(line) => Some(line),
            Layer::Classes(_)
            | Layer::Band(_)
            | Layer::Histogram(_)
            | Layer::Image(_)
            | Layer::Mark(_)
            | Layer::Point(_) => None,
        })
    }
}
