//! A picture of the chart: one panel with a name, a caption, and the numbers behind it.

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

    /// What it is made of: the points of its curves, and the centres of the cells of its map under their classes.
    pub(crate) fn points(&self) -> Vec<(&str, f64, f64)> {
        let mut points = Vec::new();
        for layer in &self.panel.layers {
            match layer {
                Layer::Line(line) => {
                    points.extend(line.points.iter().map(|&(x, y)| (&*line.name, x, y)));
                }
                Layer::Classes(map) => {
                    let centres = |axis: &Axis, count| {
                        let (low, high) = axis.range.unwrap_or((0.0, count as f64));
                        let scale = axis.scale;
                        Interval { scale, low, high }.cells(count)
                    };
                    let x = centres(&self.panel.x, map.shape[0]);
                    let y = centres(&self.panel.y, map.shape[1]);
                    let cells = y.iter().flat_map(|&y| x.iter().map(move |&x| (x, y)));
                    let names = map.class.iter().map(|&class| &*map.names[class]);
                    points.extend(names.zip(cells).map(|(name, (x, y))| (name, x, y)));
                }
                Layer::Band(_)
                | Layer::Histogram(_)
                | Layer::Image(_)
                | Layer::Mark(_)
                | Layer::Point(_) => {}
            }
        }
        points
    }
}
