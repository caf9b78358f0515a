//! Step control: halve the step until the results stand still.

use super::{History, MarchError, Summary};
use crate::units::INVERSE_MASS;

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
    /// Relative change of the contact time.
    pub(crate) time_change: f64,
}

/// Least decrease of the error when the step is halved: observed orders lie between 2 and 4.
const DECREASE: f64 = 4.0;

/// Share of the contact time's last change that is taken as its error at least, however fast it falls.
const LEAST_REST: f64 = 1.0;

/// Share of the last change that is added to the loss: an order of 2.6.
const EXTRAPOLATION: f64 = 0.2;

/// Share of the last change that is taken as the error of the loss so extrapolated.
const LOSS_REST: f64 = 0.25;

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
    ///
    /// `before` is the change of the contact time over the halving before, where there was one: two changes tell
    /// the order of its error, which lies anywhere between a half and four.
    pub(crate) fn judge(&self, coarse: &Summary, fine: &Summary, before: Option<f64>) -> Judged {
        let rest = 1.0 / (DECREASE - 1.0);
        let time_change = fine.contact_time_distance(coarse);
        let (most, stays) = fine.end.rest();
        let share = match before {
            Some(before) if before > time_change => {
                (time_change / (before - time_change)).clamp(LEAST_REST.min(most), most)
            }
            Some(_) | None => most,
        };
        let error = (rest * fine.distance(coarse)).max(share * time_change + stays);
        let parts = [
            Some(error / self.tolerance),
            self.loss
                .map(|t| LOSS_REST * fine.loss_distance(coarse) / t),
            self.deflection
                .map(|t| rest * fine.deflection_distance(coarse) / t),
        ];
        Judged {
            ratio: parts.into_iter().flatten().fold(0.0, f64::max),
            error,
            time_change,
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
            impulse: (1.0 + restitution) / INVERSE_MASS,
            ..*fine
        }
    }

    /// Steps of the first march over a contact: the coarser of two that are expected to agree.
    #[must_use]
    pub fn first_steps(&self) -> f64 {
        let contact = 16.0 * (1e-4 / self.tolerance).max(1.0).powf(0.4);
        let loss = self
            .loss
            .map_or(0.0, |t| 24.0 * (1e-3 / t).max(1.0).powf(0.4));
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
pub(crate) const HALVINGS: usize = 14;

/// Whether an error of the march may be that of a coarse step.
///
/// Coarse weights of the dynamic share overstate the part of the newest force, which can cost it its solution.
pub(crate) fn may_pass(error: &MarchError, attempt: usize) -> bool {
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
    let mut step = step;
    let mut before = None;
    let mut coarse: Option<Summary> = None;
    let mut error = f64::INFINITY;
    for attempt in 0..HALVINGS {
        let history = match march(step) {
            Err(error) if may_pass(&error, attempt) => {
                step *= 0.5;
                continue;
            }
            done => done?,
        };
        step *= 0.5;
        let summary = match Summary::new(&history) {
            Ok(summary) => summary,
            Err(MarchError::StepTooLong { .. }) => continue,
            Err(other) => return Err(other),
        };
        if let Some(coarse) = coarse {
            let judged = accuracy.judge(&coarse, &summary, before);
            error = judged.error;
            before = Some(judged.time_change);
            if judged.ratio <= 1.0 {
                return Ok(Refined {
                    history,
                    summary: Accuracy::extrapolated(&coarse, &summary),
                    error,
                });
            }
        }
        coarse = Some(summary);
    }
    Err(MarchError::NotConverged {
        tolerance: accuracy.tolerance,
        change: error,
    })
}
