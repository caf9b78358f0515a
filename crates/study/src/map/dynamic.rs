//! The `dynamic` share at strong coupling: where it has no solution, and where a coarse step hides that.

use super::marches::{Converged, MarchPlane, Outcome, linear_growth, paper_disc, paper_response};
use crate::StudyError;
use crate::measure::Effort;
use crate::picture::Picture;
use contact::{ExactDisc, MarchError, StaticShare, march_implicit, memory_weights};
use figure::{Interval, Style};

/// A disc of another coupling under the `dynamic` share.
fn dynamic<'a>(disc: &ExactDisc<'a>, coupling: f64) -> ExactDisc<'a> {
    ExactDisc {
        coupling,
        share: StaticShare::Dynamic,
        ..*disc
    }
}

/// What the `dynamic` share makes of an impact at a step: whether it has a solution.
#[must_use]
pub fn dynamic_is_solved(disc: &ExactDisc<'_>, step: f64) -> bool {
    let march = march_implicit(&dynamic(disc, disc.coupling), step);
    !matches!(march, Err(MarchError::NoSolution { .. }))
}

/// Largest coupling for which the `dynamic` share has a solution at a step, up to a force of Hertz's peak.
#[must_use]
pub fn dynamic_limit(disc: &ExactDisc<'_>, step: f64) -> f64 {
    // Numerov's weight of the newest force
    let allowed = 2.0 / 3.0 + 1.25 * step * step / 12.0;
    bisected(0.0, 1e6, |coupling| {
        coupling * memory_weights(&dynamic(disc, coupling), step)[0] < allowed
    })
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
    let grows = |coupling: f64| linear_growth(&dynamic(disc, coupling), 1.5, step) > 1.0;
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
    let plane = MarchPlane::new(Interval::logarithmic(0.05, 5.0), effort, |coupling| {
        let disc = dynamic(paper, coupling);
        Ok((disc, Converged::new(disc).ok()))
    })?;
    let mut figure = plane.map(
        "march-dynamic",
        "Dynamic share (static part of the deflection taken out)",
        "static deflection over indentation (coupling)",
        &CLASSES,
        |(disc, exact), step| match (exact, dynamic_is_solved(disc, step)) {
            (_, false) => 3,
            (None, true) => 2,
            (Some(exact), true) => match exact.implicit(step) {
                Outcome::Accurate => 0,
                Outcome::Lossy | Outcome::GainsEnergy | Outcome::Oscillates | Outcome::BlownUp => 1,
            },
        },
    );
    let count = effort.pick(30, 80);
    figure.curve(
        "theory: newest weight times coupling = 2/3, the law folds back",
        Style::Heavy,
        plane.limit(count, |step| dynamic_limit(paper, step)),
    );
    figure.curve(
        "theory: a root of the weights beyond 1, the samples grow",
        Style::HeavyDashed,
        plane.limit(count, |step| dynamic_growth_limit(paper, step)),
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
