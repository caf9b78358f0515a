//! The marches with their step control: a step that is given, or one that gives what is asked.

use crate::disc::FixedDisc;
use crate::law::quasi_static::expected_contact_time;
use crate::march::error::MarchError;
use crate::march::explicit::march_explicit;
use crate::march::implicit::march_into;
use crate::march::refine::{Accuracy, halve};
use crate::march::workspace::Workspace;
use crate::plan::ClosedForm;
use crate::response::disc::DiscResponse;
use crate::settings::StaticShare;
use crate::summary::Summary;
use halfspace::SurfaceResponse;

/// Steps over a contact of the explicit scheme when none is given.
const EXPLICIT_STEPS: f64 = 200.0;

/// Times that the last change over a halving counts for the dynamic share.
const DYNAMIC_CAUTION: f64 = 3.0;

/// Results of a scheme, in collision units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Results.
    pub summary: Summary,
    /// Estimated relative error of peak force, contact time, restitution and displacement.
    pub error: f64,
    /// Step of the finest march; none without a march.
    pub step: Option<f64>,
}

impl From<ClosedForm> for Found {
    fn from(closed: ClosedForm) -> Self {
        Self {
            summary: closed.summary,
            error: closed.error,
            step: None,
        }
    }
}

/// An impact on a disc by the implicit scheme: with a step that is given, or halved until the results are as accurate
/// as asked.
///
/// # Errors
/// [`MarchError`].
pub fn solve_disc(
    workspace: &mut Workspace,
    impact: &FixedDisc<'_, impl DiscResponse>,
    step: Option<f64>,
    asked: Accuracy,
) -> Result<Found, MarchError> {
    let duration = expected_contact_time(impact.static_coupling());
    let caution = match impact.share {
        StaticShare::Full => 1.0,
        // the newest force is only just held by the contact law, and errors grow with it
        StaticShare::Dynamic => DYNAMIC_CAUTION,
    };
    let begin = (duration, caution);
    stepped(workspace, step, begin, asked, |step, workspace| {
        march_into(impact, step, &mut workspace.weights, &mut workspace.history)
    })
}

/// A march with a step that is given, judged by one with half of it, or halved until the results are as accurate as asked.
///
/// `duration` and `caution`: of the contact, roughly, and how many times the last change counts.
///
/// The workspace keeps the history of the step that counts.
pub(crate) fn stepped(
    workspace: &mut Workspace,
    step: Option<f64>,
    (duration, caution): (f64, f64),
    asked: Accuracy,
    march: impl Fn(f64, &mut Workspace) -> Result<(), MarchError>,
) -> Result<Found, MarchError> {
    let mut run = |step: f64| {
        march(step, workspace)?;
        Summary::new(&workspace.history)
    };
    if let Some(step) = step {
        let finer = run(0.5 * step)?;
        let summary = run(step)?;
        return Ok(Found {
            summary,
            error: summary.distance(&finer) * 4.0 / 3.0,
            step: Some(step),
        });
    }
    let found = halve(
        |step| Ok((run(step)?, ())),
        duration / asked.first_steps(),
        &asked,
        caution,
    )?;
    Ok(Found {
        summary: found.summary,
        error: found.error,
        step: Some(found.step),
    })
}

/// The explicit scheme and its error.
pub(crate) fn explicit(
    workspace: &mut Workspace,
    impact: &FixedDisc<'_, SurfaceResponse>,
    step: Option<f64>,
) -> Result<Found, MarchError> {
    let step =
        step.unwrap_or_else(|| expected_contact_time(impact.static_coupling()) / EXPLICIT_STEPS);
    let (history, summary) = march_explicit(impact, step)?;
    let (_, finer) = march_explicit(impact, 0.5 * step)?;
    workspace.history = history;
    Ok(Found {
        summary,
        // first order: the rest is as large as the change over one halving
        error: 2.0 * summary.distance(&finer),
        step: Some(step),
    })
}
