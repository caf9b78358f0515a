//! Step control: halve the step until the results stand still.

use super::error::MarchError;
use super::history::History;
use crate::summary::Summary;

/// What the results have to meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy {
    /// Relative tolerance on peak force, contact time, restitution and largest displacement.
    pub tolerance: f64,
    /// Relative tolerance on the loss 1 - e^2, where it is asked for.
    pub loss: Option<f64>,
    /// Relative tolerance on the largest deflection, where it is asked for.
    pub deflection: Option<f64>,
}

impl From<f64> for Accuracy {
    /// A tolerance on the contact's results and on the largest deflection.
    fn from(tolerance: f64) -> Self {
        Self {
            tolerance,
            loss: None,
            deflection: Some(tolerance),
        }
    }
}

/// What two summaries a halving apart tell of the finer one.
pub(crate) struct Judged {
    /// Estimated error in units of what is allowed: enough where it is one or less.
    pub(crate) ratio: f64,
    /// Estimated relative error of the contact's results.
    pub(crate) error: f64,
}

/// Fraction of the last change of force, restitution and displacement that is taken as the error.
///
/// Chosen so that the estimates hold: `tests/estimates.rs`.
const REST: f64 = 0.7;

/// Fraction of the last change that is added to the loss.
const EXTRAPOLATION: f64 = 0.2;

/// Fraction of the last change that is taken as the error of the loss so extrapolated.
const LOSS_REST: f64 = 0.35;

impl Accuracy {
    /// Of the contact's results only: what a sweep asks.
    #[must_use]
    pub fn of_contact(tolerance: f64, loss: Option<f64>) -> Self {
        Self {
            tolerance,
            loss,
            deflection: None,
        }
    }

    /// Judges the finer of two summaries a halving apart.
    pub(crate) fn judge(&self, coarse: &Summary, fine: &Summary) -> Judged {
        let (fraction, stays) = fine.end.rest();
        let error = (REST * fine.motion_distance(coarse))
            .max(fraction * fine.contact_time_distance(coarse) + stays);
        let parts = [
            Some(error / self.tolerance),
            self.loss
                .map(|t| LOSS_REST * fine.loss_distance(coarse) / t),
            self.deflection
                .map(|t| REST * fine.deflection_distance(coarse) / t),
        ];
        Judged {
            ratio: parts.into_iter().flatten().fold(0.0, f64::max),
            error,
        }
    }

    /// The finer summary with its loss extrapolated from both, where restitution stays far from zero.
    pub(crate) fn extrapolated(coarse: &Summary, fine: &Summary) -> Summary {
        let loss = fine.loss + EXTRAPOLATION * (fine.loss - coarse.loss);
        if fine.restitution < 0.5 || !(0.0..1.0).contains(&loss) {
            return *fine;
        }
        let restitution = (1.0 - loss).sqrt();
        Summary {
            restitution,
            loss,
            ..*fine
        }
    }

    /// Steps of the first march over a contact: the coarser of two that are expected to agree.
    #[must_use]
    pub fn first_steps(&self) -> f64 {
        let contact = 12.0 * (1e-4 / self.tolerance).max(1.0).powf(0.4);
        let loss = self
            .loss
            .map_or(0.0, |t| 13.0 * (1e-3 / t).max(1.0).powf(0.5));
        contact.max(loss)
    }
}

/// A march whose step meets the tolerance.
#[derive(Debug, Clone)]
pub struct Refined {
    /// The finest march.
    pub history: History,
    /// Its results.
    pub summary: Summary,
    /// Estimated relative error of the contact's results.
    pub error: f64,
}

/// Steps are halved at most so often.
const HALVINGS: usize = 14;

/// Whether an error of the march may be that of a coarse step.
///
/// Coarse weights of the dynamic share overstate the part of the newest force, which can cost it its solution.
fn may_pass(error: &MarchError, attempt: usize) -> bool {
    match error {
        MarchError::StepTooLong { .. } => true,
        MarchError::NoSolution { .. } => attempt < 8,
        MarchError::TooLong { .. }
        | MarchError::NotConverged { .. }
        | MarchError::Unstable { .. } => false,
    }
}

/// Marches with `step`, halves it until the change over the last halving is within `accuracy`.
///
/// # Errors
/// Those of the march; [`MarchError::NotConverged`] when the finest step does not meet the tolerance.
pub fn refine(
    march: impl Fn(f64) -> Result<History, MarchError>,
    step: f64,
    accuracy: impl Into<Accuracy>,
) -> Result<Refined, MarchError> {
    let accuracy = accuracy.into();
    let found = halve(
        |step| {
            let history = march(step)?;
            let summary = Summary::new(&history)?;
            Ok((summary, history))
        },
        step,
        &accuracy,
        1.0,
    )?;
    Ok(Refined {
        history: found.finest,
        summary: found.summary,
        error: found.error,
    })
}

/// The finest of some marches, and what it gives.
pub(crate) struct Halved<T> {
    /// What the finest march returned beside its results.
    pub(crate) finest: T,
    /// Its results, extrapolated.
    pub(crate) summary: Summary,
    /// Estimated relative error of the contact's results.
    pub(crate) error: f64,
    /// Step of the finest march.
    pub(crate) step: f64,
}

/// Error over what is allowed up to which the last march counts where a finer one needs too much work.
///
/// A memory that is very short beside the contact asks for steps of its own length before the end of contact is known
/// to the last digits.
const LENIENT: f64 = 100.0;

/// Times the error by which the step is judged that is reported: 99 of 100 marches leave less.
///
/// It is no more than the tolerance, which 99 of 100 meet.
const REPORTED: f64 = 3.0;

/// Halves the step of a march until its results meet `accuracy`; with `caution` the last change counts so many times.
pub(crate) fn halve<T>(
    mut march: impl FnMut(f64) -> Result<(Summary, T), MarchError>,
    mut step: f64,
    accuracy: &Accuracy,
    caution: f64,
) -> Result<Halved<T>, MarchError> {
    let mut coarse: Option<Summary> = None;
    let (mut error, mut ratio, mut last) = (f64::INFINITY, f64::INFINITY, step);
    for attempt in 0..HALVINGS {
        match march(step) {
            // strongly coupled discs: the scheme itself feeds energy at some steps of a fraction of the memory
            Ok((summary, _)) if summary.restitution > 1.0 => {}
            Ok((summary, finest)) => {
                if let Some(coarse) = &coarse {
                    let judged = accuracy.judge(coarse, &summary);
                    (error, ratio) = (caution * judged.error, caution * judged.ratio);
                    if ratio <= 1.0 {
                        return Ok(Halved {
                            finest,
                            summary: Accuracy::extrapolated(coarse, &summary),
                            error: (REPORTED * error).min(accuracy.tolerance).max(error),
                            step,
                        });
                    }
                }
                (coarse, last) = (Some(summary), step);
            }
            Err(error) if may_pass(&error, attempt) => {}
            Err(MarchError::TooLong { .. }) if ratio <= LENIENT => {
                // once more, since what the caller keeps is that of the march that failed
                let (summary, finest) = march(last)?;
                return Ok(Halved {
                    finest,
                    summary,
                    error: REPORTED * error,
                    step: last,
                });
            }
            Err(other) => return Err(other),
        }
        step *= 0.5;
    }
    Err(MarchError::NotConverged {
        tolerance: accuracy.tolerance,
        change: error,
    })
}
