//! The `dynamic` share at strong coupling: where it has no solution, and where a coarse step hides that.

use super::marches::{
    Converged, Fate, converged, implicit_fate, map_shape, paper_disc, paper_response,
};
use super::recurrence::linear_growth;
use crate::StudyError;
use crate::measure::Effort;
use crate::picture::Picture;
use contact::law::hertz::CONTACT_TIME;
use contact::{ExactDisc, MarchError, StaticShare, march_implicit, memory_weights};
use figure::{Axis, Interval, Style};

/// What the `dynamic` share makes of an impact at a step: whether it has a solution.
#[must_use]
pub fn dynamic_is_solved(disc: &ExactDisc<'_>, step: f64) -> bool {
    let disc = ExactDisc {
        share: StaticShare::Dynamic,
        ..*disc
    };
    !matches!(
        march_implicit(&disc, step),
        Err(MarchError::NoSolution { .. })
    )
}

/// Largest coupling for which the `dynamic` share has a solution at a step, up to a force of Hertz's peak.
#[must_use]
pub fn dynamic_limit(disc: &ExactDisc<'_>, step: f64) -> f64 {
    // Numerov's weight of the newest force
    let allowed = 2.0 / 3.0 + 1.25 * step * step / 12.0;
    let is_solved = |coupling: f64| {
        let disc = ExactDisc {
            coupling,
            share: StaticShare::Dynamic,
            ..*disc
        };
        coupling * memory_weights(&disc, step)[0] < allowed
    };
    bisected(0.0, 1e6, is_solved)
}

/// The largest argument that a condition allows, which it does below and not above; relative to 1e-9.
fn bisected(low: f64, high: f64, allows: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (low, high);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if allows(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Largest coupling for which the newest samples of the `dynamic` share settle, up to a force of Hertz's peak.
#[must_use]
pub fn dynamic_growth_limit(disc: &ExactDisc<'_>, step: f64) -> f64 {
    let grows = |coupling: f64| {
        let disc = ExactDisc {
            coupling,
            share: StaticShare::Dynamic,
            ..*disc
        };
        linear_growth(&disc, 1.5, step) > 1.0
    };
    bisected(0.0, dynamic_limit(disc, step), |coupling| !grows(coupling))
}

const CLASSES: [&str; 4] = [
    "restitution within 1e-3",
    "solved, off by more",
    "solved only because the step is coarse",
    "refused: no solution",
];

/// The plane of coupling and step.
pub(crate) fn figure(effort: Effort) -> Result<Picture, StudyError> {
    let response = paper_response()?;
    let paper = &paper_disc(&response)?;
    let shape = map_shape(effort);
    let x = Interval::logarithmic(0.05, 5.0);
    let y = Interval::logarithmic(1e-3, 0.2);
    let mut figure = Picture::new(
        "march-dynamic",
        "Dynamic share (static part of the deflection taken out)",
        Axis::over(x, "static deflection over indentation (coupling)"),
        Axis::over(y, "step over Hertz's contact time"),
    );
    let at = |coupling: f64| ExactDisc {
        coupling,
        share: StaticShare::Dynamic,
        ..*paper
    };
    let columns: Vec<Option<Converged>> = x
        .cells(shape[0])
        .into_iter()
        .map(|coupling| converged(&at(coupling)).ok())
        .collect();
    figure.map([x, y], shape, &CLASSES, |coupling, step| {
        let column = (x.fraction(coupling) * shape[0] as f64) as usize;
        let (disc, step) = (at(coupling), step * CONTACT_TIME);
        match (
            &columns[column.min(shape[0] - 1)],
            dynamic_is_solved(&disc, step),
        ) {
            (_, false) => 3,
            (None, true) => 2,
            (Some(exact), true) => match implicit_fate(&disc, exact, step) {
                Fate::Accurate => 0,
                Fate::Lossy | Fate::GainsEnergy | Fate::Oscillates | Fate::BlownUp => 1,
            },
        }
    });
    let steps = y.cells(effort.pick(30, 80));
    let line = |limit: &dyn Fn(f64) -> f64| -> Vec<(f64, f64)> {
        let points = steps.iter().map(|&y| (limit(y * CONTACT_TIME), y));
        points.filter(|(x, _)| *x < 5.0).collect()
    };
    figure.curve(
        "theory: newest weight times coupling = 2/3, the law folds back",
        Style::Heavy,
        line(&|step| dynamic_limit(paper, step)),
    );
    figure.curve(
        "theory: a root of the weights beyond 1, the samples grow",
        Style::HeavyDashed,
        line(&|step| dynamic_growth_limit(paper, step)),
    );
    figure.point((paper.coupling, 1.0 / 137.0), "paper's case, 137 steps");
    figure.caption = "Without its static part the newest weight of the deflection is negative: the contact law \
        folds back, and beyond a coupling of 2/3 it has no solution. At steps near the memory and beyond \
        the samples alternate and grow from the dashed line on, until they reach the fold. \
        A coarse step can hide that there is no solution; the march refuses with a sentence as soon as the step is \
        halved, which step control does."
        .to_owned();
    Ok(figure)
}
