//! Step control: halve the step until the results stand still.

use crate::accuracy::{Accuracy, Found};
use crate::disc::FixedDisc;
use crate::disc::explicit::march_explicit;
use crate::disc::implicit::{march_implicit, march_into};
use crate::error::MarchError;
use crate::history::History;
use crate::law::quasi_static::expected_contact_time;
use crate::numeric::quadrature::LocalPolynomial;
use crate::settings::StaticShare;
use crate::summary::{Summary, relative};
use crate::waves::response::DiscResponse;
use halfspace::SurfaceResponse;

/// Fraction of the last change of force, restitution and displacement that is taken as the error by which the step is
/// judged: 1/(2^p - 1) for an order p of 1.3, the least that is seen. `tests/estimates.rs` fails at half of it.
const LEFT_AFTER_HALVING: f64 = 0.7;

/// Fraction of the last change that is added to the loss: 1/(2^p - 1) for an order p of 2.6. `tests/disc.rs` fails
/// at 0.6.
const EXTRAPOLATED_LOSS: f64 = 0.2;

/// Fraction of the last change that is taken as the error of the loss so extrapolated.
const LEFT_OF_LOSS: f64 = 0.35;

impl Accuracy {
    /// Judges the finer of two summaries a halving apart: the estimated error in units of the allowed one, enough where
    /// it is one or less, and that of the contact's results, relative.
    fn judge(
        &self,
        coarse: &Summary,
        (fine, [fraction, stays]): (&Summary, [f64; 2]),
    ) -> (f64, f64) {
        let change = |of: fn(&Summary) -> f64| relative(of(fine), of(coarse));
        let error = (LEFT_AFTER_HALVING * fine.motion_distance(coarse))
            .max(fraction * change(|summary| summary.contact_time) + stays);
        let loss = LEFT_OF_LOSS * change(|summary| summary.loss);
        let deflection = LEFT_AFTER_HALVING * change(|summary| summary.peak_deflection);
        (self.excess(error / self.tolerance, loss, deflection), error)
    }

    /// The finer summary with its loss extrapolated from both, where restitution stays far from zero.
    fn extrapolated(coarse: &Summary, fine: &Summary) -> Summary {
        let loss = fine.loss + EXTRAPOLATED_LOSS * (fine.loss - coarse.loss);
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
    pub fn first_steps(&self) -> f64 {
        let contact = 12.0 * (1e-4 / self.tolerance).max(1.0).powf(0.4);
        let of_loss = |asked: f64| 13.0 * (1e-3 / asked).max(1.0).powf(0.5);
        contact.max(self.loss.map_or(0.0, of_loss))
    }
}

/// Steps are halved at most so often.
const MOST_HALVINGS: usize = 14;

/// Marches with `step`, halves it until the change over the last halving is within `accuracy`.
///
/// # Errors
/// Those of the march; [`MarchError::NotConverged`] when the finest step does not meet the tolerance.
pub fn refine(
    march: impl Fn(f64) -> Result<History, MarchError>,
    step: f64,
    accuracy: impl Into<Accuracy>,
) -> Result<Found, MarchError> {
    let measured = |step| Summary::measured(&march(step)?);
    halve(measured, step, &accuracy.into(), 1.0)
}

/// Error, over the allowed one, up to which the last march counts if a finer one needs too much work.
///
/// A memory that is very short compared with the contact needs steps of its own length before the end of contact is known
/// to the last digits.
const LENIENT: f64 = 100.0;

/// Reported error over that by which the step is judged: 99 of 100 marches leave less; it is no more than the tolerance,
/// which 99 of 100 meet. `tests/estimates.rs` fails at 1, with 4 of 100 above.
const REPORTED: f64 = 3.0;

/// Halves the step of a march until its results meet `accuracy`; with `caution` the last change counts so many times.
fn halve(
    mut march: impl FnMut(f64) -> Result<(Summary, [f64; 2]), MarchError>,
    mut step: f64,
    accuracy: &Accuracy,
    caution: f64,
) -> Result<Found, MarchError> {
    let mut coarse: Option<Summary> = None;
    let (mut error, mut ratio, mut last) = (f64::INFINITY, f64::INFINITY, step);
    for attempt in 0..MOST_HALVINGS {
        match march(step) {
            // strongly coupled discs: the scheme itself feeds energy at some steps of a fraction of the memory
            Ok((summary, _)) if summary.restitution > 1.0 => {}
            Ok((summary, end)) => {
                if let Some(coarse) = &coarse {
                    (ratio, error) = accuracy.judge(coarse, (&summary, end));
                    (ratio, error) = (caution * ratio, caution * error);
                    if ratio <= 1.0 {
                        let summary = Accuracy::extrapolated(coarse, &summary);
                        let reported = (REPORTED * error).min(accuracy.tolerance).max(error);
                        return Ok(Found::new(summary, reported, Some(step)));
                    }
                }
                (coarse, last) = (Some(summary), step);
            }
            // what a coarse step may cause: weights of the dynamic share that overstate the part of the newest force can
            // cost it its solution
            Err(MarchError::StepTooLong { .. }) => {}
            Err(MarchError::NoSolution { .. }) if attempt < 8 => {}
            Err(MarchError::TooLong { .. }) if ratio <= LENIENT => {
                // once more, since what the caller keeps is that of the march that failed
                return Ok(Found::new(march(last)?.0, REPORTED * error, Some(last)));
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

/// Steps over a contact of the explicit scheme when none is given.
const EXPLICIT_STEPS: f64 = 200.0;

/// Factor of the last change over a halving for the dynamic share, whose force is only just held by the contact law.
/// `tests/estimates.rs` fails at 1, with 2 of 100 above.
const DYNAMIC_CAUTION: f64 = 3.0;

/// An impact on a disc by the implicit scheme: with a step that is given, judged by a march with half of it, or halved until
/// the results meet the tolerances.
///
/// The history is left as that of the step that counts.
///
/// # Errors
/// [`MarchError`].
pub fn solve_disc(
    history: &mut History,
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
    let mut run = |step: f64| {
        march_into(history, impact, step)?;
        Summary::measured(history)
    };
    if let Some(step) = step {
        let (finer, _) = run(0.5 * step)?;
        let (summary, _) = run(step)?;
        let error = summary.distance(&finer) * 4.0 / 3.0;
        return Ok(Found::new(summary, error, Some(step)));
    }
    halve(run, duration / asked.first_steps(), &asked, caution)
}

/// The explicit scheme and its error.
pub(crate) fn explicit(
    history: &mut History,
    impact: &FixedDisc<'_, SurfaceResponse>,
    step: Option<f64>,
) -> Result<Found, MarchError> {
    let step =
        step.unwrap_or_else(|| expected_contact_time(impact.static_coupling()) / EXPLICIT_STEPS);
    let (marched, summary) = march_explicit(impact, step)?;
    let (_, finer) = march_explicit(impact, 0.5 * step)?;
    *history = marched;
    // first order: the rest is as large as the change over one halving
    let error = 2.0 * summary.distance(&finer);
    Ok(Found::new(summary, error, Some(step)))
}

/// Steps over the contact for a history: of the first march, and of the last at most.
const FIRST_STEPS: f64 = 200.0;
const MOST_STEPS: f64 = 30_000.0;

/// Error of the force over the tolerance: that of its rate is up to a thousand times as large next to the touch.
/// `tests/history.rs` fails at 0.03.
const ENOUGH_FOR_RATES: f64 = 1e-2;

/// A march over a contact of about this `duration` with its error at any instant: the change over the last halving,
/// of which a third to a fifth is left, except next to a front.
///
/// Results converge faster than the history they are taken from: steps that give the largest force to 1e-4 miss
/// the force by twice that in the first percents of the contact.
/// While the memory is short, work grows with the steps alone: 1,400 of them take 0.2 ms.
///
/// # Errors
/// [`MarchError`] of the march.
pub(crate) fn march_finely(
    impact: &FixedDisc<'_, impl DiscResponse>,
    duration: f64,
    tolerance: f64,
) -> Result<History, MarchError> {
    let mut step = duration / FIRST_STEPS;
    let mut coarse = march_implicit(impact, step)?;
    loop {
        step *= 0.5;
        let mut fine = march_implicit(impact, step)?;
        fine.error = distance(&coarse, &fine);
        if fine.error <= ENOUGH_FOR_RATES * tolerance || duration > 0.5 * MOST_STEPS * step {
            return Ok(fine);
        }
        coarse = fine;
    }
}

/// Largest difference of the force at the samples of the finer of two histories a halving apart, relative; in the middle
/// between samples the indentation of the coarser is the polynomial through the six around.
fn distance(coarse: &History, fine: &History) -> f64 {
    const WEIGHTS_OF_MIDDLE: [f64; 6] = [3.0, -25.0, 150.0, 150.0, -25.0, 3.0];
    let parts = coarse.displacement.iter().zip(&coarse.deflection);
    let indentation: Vec<f64> = parts.map(|(d, w)| d - w).collect();
    let Some(last) = indentation.len().checked_sub(WEIGHTS_OF_MIDDLE.len()) else {
        return f64::INFINITY;
    };
    let middle = |cell: usize| {
        let from = cell.saturating_sub(2).min(last);
        let u = if from + 2 == cell {
            let around = indentation[from..].iter().zip(WEIGHTS_OF_MIDDLE);
            around.map(|(u, weight)| weight * u).sum::<f64>() / 256.0
        } else {
            LocalPolynomial::<6>::at(&indentation, from).value((cell - from) as f64 + 0.5)
        };
        u.max(0.0) * u.max(0.0).sqrt()
    };
    let differences = fine.force.iter().enumerate().map(|(i, p)| {
        let cell = i / 2;
        let other = match coarse.force.get(cell) {
            Some(q) if i % 2 == 0 => *q,
            Some(_) if cell + 1 < indentation.len() => middle(cell),
            Some(_) | None => 0.0,
        };
        (other - p).abs()
    });
    let largest = fine.force.iter().copied().fold(0.0, f64::max);
    differences.fold(0.0, f64::max) / largest
}
