//! Step control: halve the step until the results stand still.

use super::{History, MarchError, Summary};

/// A march whose step meets the tolerance.
#[derive(Debug, Clone)]
pub struct Refined {
    /// The finest march.
    pub history: History,
    /// Its results.
    pub summary: Summary,
    /// Estimated relative error of the results.
    pub error: f64,
}

/// Least decrease of the error when the step is halved: observed orders lie between 2 and 4.
const DECREASE: f64 = 4.0;

/// Steps are halved at most so often.
const HALVINGS: usize = 14;

/// Marches with `step`, halves it until the change over the last halving is within `tolerance`.
///
/// # Errors
/// Those of the march; [`MarchError::NotConverged`] when the finest step does not meet the tolerance.
pub fn refine(
    march: impl Fn(f64) -> Result<History, MarchError>,
    step: f64,
    tolerance: f64,
) -> Result<Refined, MarchError> {
    let mut step = step;
    let mut coarse: Option<Summary> = None;
    let mut error = f64::INFINITY;
    for _ in 0..HALVINGS {
        let history = march(step)?;
        step *= 0.5;
        let summary = match Summary::new(&history) {
            Ok(summary) => summary,
            Err(MarchError::StepTooLong { .. }) => continue,
            Err(other) => return Err(other),
        };
        if let Some(coarse) = coarse {
            error = summary.distance(&coarse) / (DECREASE - 1.0);
            if error <= tolerance {
                return Ok(Refined {
                    history,
                    summary,
                    error,
                });
            }
        }
        coarse = Some(summary);
    }
    Err(MarchError::NotConverged {
        tolerance,
        change: error,
    })
}
