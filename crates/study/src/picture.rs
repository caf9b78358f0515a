//! Pictures of the chart: one panel with a name, a caption and its data; and the work-precision diagrams, which show
//! error over cost with a curve for each method and the Pareto front.

use crate::method::ComparedMethod;
use crate::record::{Question, Record, by_scene, distinct, pareto_front};
use contact::Choice;
use figure::{Axis, Figure, Layer, Legend, Panel, Style};

/// A picture of the chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Name of its files.
    pub name: &'static str,
    /// Figure with one panel and a title.
    pub figure: Figure,
    /// Sentences for the report.
    pub caption: String,
}

/// Height of a picture's plot in pixels.
const HEIGHT: f64 = 478.0;

/// Width of a picture in pixels.
const WIDTH: f64 = 1020.0;

impl Picture {
    /// An empty picture; both axes have a range.
    pub(crate) fn new(name: &'static str, title: &str, x: Axis, y: Axis) -> Self {
        let panel = Panel::new(x, y).height(HEIGHT).legend(Legend::Outside);
        Self {
            name,
            figure: Figure::new(title).width(WIDTH).panel(panel),
            caption: String::new(),
        }
    }

    /// Adds a curve.
    pub(crate) fn line(&mut self, name: &str, style: Style, points: Vec<(f64, f64)>) {
        self.add(Layer::line(name, style, points));
    }

    /// Adds a layer.
    pub(crate) fn add(&mut self, layer: Layer) {
        self.figure.panels[0].layers.push(layer);
    }

    /// Data of the picture: the points of its curves, and the centres of the cells of its map under their classes.
    pub(crate) fn points(&self) -> Vec<(&str, f64, f64)> {
        let mut points = Vec::new();
        let panel = &self.figure.panels[0];
        for layer in &panel.layers {
            match layer {
                Layer::Line(line) => {
                    points.extend(line.points.iter().map(|&(x, y)| (&*line.name, x, y)));
                }
                Layer::Classes(map) => {
                    let axes = [&panel.x, &panel.y].map(Axis::interval);
                    let [x, y] = [0, 1].map(|k| axes[k].map(|axis| axis.cells(map.shape[k])));
                    let (x, y) = x.zip(y).unwrap_or_default();
                    let cells = y.iter().flat_map(|&y| x.iter().map(move |&x| (x, y)));
                    let names = map.class.iter().map(|&class| &*map.names[class]);
                    points.extend(names.zip(cells).map(|(name, (x, y))| (name, x, y)));
                }
                Layer::Image(_) | Layer::Mark { .. } | Layer::Point { .. } => {}
            }
        }
        points
    }
}

/// One diagram for each scene.
pub(crate) fn diagrams(records: &[Record]) -> Vec<Picture> {
    let scenes = by_scene(records).into_iter();
    let drawn = scenes.filter_map(|(question, place, rows)| {
        let [.., names] = question.words();
        Some(diagram(question, names.split(' ').nth(place)?, &rows))
    });
    drawn.collect()
}

/// Cost and error of a record as drawn; errors below 1e-16 are drawn at 1e-16.
fn place(record: &Record) -> (f64, f64) {
    (record.cost_ns, record.error_max.max(1e-16))
}

/// The places within the frame.
fn places(rows: &[&Record]) -> Vec<(f64, f64)> {
    let shown = rows.iter().filter(|r| r.error_max < 2.0);
    shown.map(|r| place(r)).collect()
}

fn diagram(question: Question, name: &'static str, rows: &[&Record]) -> Picture {
    let scene = rows[0].scene;
    let shown = places(rows);
    // a margin of half a marker around the outermost points
    let low = shown.iter().fold(f64::INFINITY, |low, p| low.min(p.0));
    let high = shown.iter().fold(0.0, |high, p| p.0.max(high));
    let lowest = shown.iter().fold(1.0, |low, p| p.1.min(low));
    let decade = |x: f64, up: f64| 10.0_f64.powf((x.log10() + up).floor());
    let (asks, [value, ..]) = (question.name(), question.words());
    let mut figure = Picture::new(
        name,
        &format!("{asks}: {scene}"),
        Axis::logarithmic("cost")
            .unit(&format!("ns per value: {value}"))
            .range(decade(low, -0.1), decade(high, 1.1)),
        Axis::logarithmic("largest error over the largest value").range(decade(lowest, -0.2), 2.0),
    );
    figure.caption = caption(question, scene).to_owned();
    for method in distinct(rows.iter().map(|r| r.method)) {
        let own = rows.iter().filter(|r| r.method == method);
        let own: Vec<&Record> = own.copied().collect();
        let is_default = own.iter().any(|r| r.default_path);
        let default = if is_default { " [default]" } else { "" };
        let failures = match own.iter().filter(|r| r.failed()).count() {
            0 => String::new(),
            n if n == own.len() => " (fails)".to_owned(),
            n => format!(" ({n} of {} fail)", own.len()),
        };
        // settings of fields and tables vary in several ways at once, so that no line can connect them
        let cloud = question == Question::Fields || method == ComparedMethod::TableOfKernels;
        let style = if cloud { Style::Points } else { Style::Marked };
        let name = format!("{}{default}{failures}", method.name());
        figure.line(&name, style, places(&own));
    }
    figure.line("Pareto front", Style::HeavyDashed, staircase(rows));
    figure
}

/// Explanation of a diagram.
fn caption(question: Question, scene: &str) -> &'static str {
    match question {
        Question::Kernels if scene.starts_with("interior point, across") => {
            "Times are even in the logarithm, with more at one hundredth before and after every front. \
             The table holds averages over time cells, and its error here is that of single cells, which a front that \
             passes between two nodes makes large; it is made for sums with a force, as in the diagrams of fields, where \
             the fronts cancel."
        }
        Question::Kernels if scene.starts_with("surface") => {
            "The closed form is the reference here: its error is zero by definition and drawn at the bottom."
        }
        Question::Kernels => "",
        Question::Force => {
            "The marches at a given number of steps are the scheme alone; those with a tolerance halve the step until the \
             results stand still, and pay for the coarser marches as well."
        }
        Question::Impacts => {
            "The contact is solved anew for each value, to the same tolerance as its fields. The reference is an integral over \
             the past of a force solved to 1e-9. Cells alone do not integrate the ends of the contact apart."
        }
        Question::Fields if scene.starts_with("whole") => {
            "Both by the same stencils over the same exact kernels in double precision: the static part, which is exact and \
             steep near the disc, is worth interpolating around."
        }
        Question::Fields => {
            "A value is the six fields at a point over a unit of time, so that a method with longer steps has fewer samples \
             to make. Steps of the table are powers of two of its cells."
        }
    }
}

/// Border of the region that the front dominates.
fn staircase(rows: &[&Record]) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = Vec::new();
    for (cost, error) in pareto_front(rows).into_iter().map(place) {
        let before = points.last().map(|&(_, before)| (cost, before));
        points.extend(before.into_iter().chain([(cost, error)]));
    }
    points
}
