//! Work-precision diagrams: error against cost, one curve a method, the Pareto front drawn.

use crate::picture::Picture;
use crate::record::{Question, Record, distinct, pareto_front};
use figure::{Axis, Style};

/// File names of the diagrams, in the order in which the scenes appear.
const NAMES: [(Question, &[&str]); 4] = [
    (
        Question::Kernels,
        &[
            "kernels-interior",
            "kernels-late",
            "kernels-axis",
            "kernels-surface",
        ],
    ),
    (Question::Force, &["force-disc", "force-growing"]),
    (
        Question::Fields,
        &[
            "fields-pulse-10",
            "fields-interpolation-10",
            "fields-pulse-40",
            "fields-interpolation-40",
            "fields-edge",
            "fields-interpolation-edge",
        ],
    ),
    (
        Question::Impacts,
        &[
            "impacts-disc-near",
            "impacts-disc-far",
            "impacts-growing-near",
            "impacts-growing-far",
        ],
    ),
];

/// One diagram a scene.
pub(crate) fn figures(records: &[Record]) -> Vec<Picture> {
    let mut figures = Vec::new();
    for (question, names) in NAMES {
        let mine: Vec<&Record> = records.iter().filter(|r| r.question == question).collect();
        let scenes = distinct(mine.iter().map(|r| r.scene));
        for (scene, name) in scenes.into_iter().zip(names) {
            let rows: Vec<&Record> = mine.iter().filter(|r| r.scene == scene).copied().collect();
            figures.push(diagram(question, scene, name, &rows));
        }
    }
    figures
}

/// Errors smaller than this are drawn here.
const FLOOR: f64 = 1e-16;

fn diagram(question: Question, scene: &str, name: &'static str, rows: &[&Record]) -> Picture {
    let shown = || {
        rows.iter()
            .filter(|r| r.error.max < 2.0)
            .map(|r| (r.cost.median_ns, r.error.max.max(FLOOR)))
    };
    // half a marker of room around the outermost points
    let low = shown().map(|p| p.0).fold(f64::INFINITY, f64::min);
    let high = shown().map(|p| p.0).fold(0.0, f64::max);
    let lowest = shown().map(|p| p.1).fold(1.0, f64::min);
    let decade = |x: f64, up: f64| 10.0_f64.powf((x.log10() + up).floor());
    let down = decade(lowest, -0.2);
    let mut figure = Picture::new(
        name,
        &format!("{}: {scene}", question.name()),
        Axis::logarithmic("cost")
            .unit(&format!("ns per value: {}", question.value()))
            .range(decade(low, -0.1), decade(high, 1.1)),
        Axis::logarithmic("largest error over the largest value").range(down, 2.0),
    );
    figure.caption = caption(question, scene).to_owned();
    // settings of fields vary in several ways at once: no line orders them
    let style = match question {
        Question::Kernels | Question::Force | Question::Impacts => Style::Marked,
        Question::Fields => Style::Points,
    };
    for method in distinct(rows.iter().map(|r| r.method)) {
        let own: Vec<&&Record> = rows.iter().filter(|r| r.method == method).collect();
        let failed = own.iter().filter(|r| r.failed()).count();
        let points: Vec<(f64, f64)> = own
            .iter()
            .filter(|r| r.error.max < 2.0)
            .map(|r| (r.cost.median_ns, r.error.max.max(FLOOR)))
            .collect();
        let default = if own.iter().any(|r| r.default_path) {
            " [default]"
        } else {
            ""
        };
        let failures = match failed {
            0 => String::new(),
            n if n == own.len() => " (fails)".to_owned(),
            n => format!(" ({n} of {} fail)", own.len()),
        };
        // nor those of tables
        let style = if method == "table" {
            Style::Points
        } else {
            style
        };
        figure.curve(&format!("{method}{default}{failures}"), style, points);
    }
    let front = pareto_front(rows, |r| Some(r.cost.median_ns));
    figure.curve("Pareto front", Style::HeavyDashed, staircase(rows, &front));
    figure
}

/// What a diagram needs to be read.
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

/// The border of what the front dominates.
fn staircase(rows: &[&Record], front: &[usize]) -> Vec<(f64, f64)> {
    let mut points = Vec::new();
    let mut before: Option<f64> = None;
    for &i in front {
        let (cost, error) = (rows[i].cost.median_ns, rows[i].error.max.max(FLOOR));
        if let Some(error) = before {
            points.push((cost, error));
        }
        points.push((cost, error));
        before = Some(error);
    }
    points
}
