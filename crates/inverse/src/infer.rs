//! From traces to the force: a fit, a force history, and what they rest on.

use crate::deconvolve::{ForceHistory, Normal, deconvolve};
use crate::error::InverseError;
use crate::fit::{PulseFit, fit};
use crate::problem::{Noise, Problem, Rows, Trace, last_shown};
use crate::several::{Jackknife, jackknife};
use std::ops::Range;

/// How the noise of a trace was found.
#[derive(Debug, Clone, PartialEq)]
pub struct NoiseFound {
    /// Standard deviation in the unit of the trace.
    pub sigma: f64,
    /// Order of the autoregressive model that whitens it; 0 is white.
    pub order: usize,
    /// Quiet samples it was measured from; none if it was given.
    pub quiet: Option<Range<usize>>,
    /// Peak of the trace of the force history over the standard deviation.
    pub signal_to_noise: f64,
}

/// The force of a blow.
#[derive(Debug, Clone, PartialEq)]
pub struct Inferred {
    /// Fit of the contact law's pulse: peak, duration, start. The most accurate if the pulse is the right one.
    pub fit: PulseFit,
    /// Force history without a law.
    pub history: ForceHistory,
    /// The traces that the force history explains, in their units.
    pub predicted: Vec<Vec<f64>>,
    /// Noise of each trace.
    pub noise: Vec<NoiseFound>,
    /// The force without each of the traces; none of a single one.
    pub jackknife: Option<Jackknife>,
}

/// Windows before the fitted start and after the fitted end, in fitted durations.
///
/// The first is the default. The others are tried in turn if no force in it explains the traces: a double blow, or a pulse
/// of another shape. `tests/shapes.rs` (`a_double_blow_is_found_whole`) fails without them.
const MARGINS: [f64; 3] = [0.15, 0.6, 1.5];

/// Force samples in a window at most: the solution takes half a minute.
const MOST_SAMPLES: usize = 2000;

/// The force behind traces of one blow.
///
/// First the pulse of the contact law is fitted, then a force history of any shape is found; see [`ForceHistory`].
///
/// Accuracy: see the table in the README; `tests/back.rs` checks it.
///
/// # Errors
/// [`InverseError`] for input that does not determine a force.
pub fn infer(problem: &Problem) -> Result<Inferred, InverseError> {
    let rows = problem.rows()?;
    let fit = fit(problem, &rows)?;
    let (normal, history) = match problem.window_s {
        Some(window) => {
            problem.shown(&rows, window[1])?;
            over(problem, &rows, &fit, window)?
        }
        None => default_window(problem, &rows, &fit)?,
    };
    let (mut predicted, mut noise) = (Vec::new(), Vec::new());
    for ((trace, rows), gain) in problem.traces.iter().zip(&rows).zip(&history.gains) {
        let own = predict(problem, trace, normal.start, &history.force_n);
        let own: Vec<f64> = own.iter().map(|x| gain.value * x).collect();
        let peak = own.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        noise.push(NoiseFound {
            sigma: rows.whitening.sigma,
            order: rows.whitening.order(),
            quiet: match &trace.noise {
                Noise::Quiet(range) => Some(range.clone()),
                Noise::White(_) => None,
            },
            signal_to_noise: peak / rows.whitening.sigma,
        });
        predicted.push(own);
    }
    Ok(Inferred {
        jackknife: jackknife(&normal, &history)?,
        fit,
        history,
        predicted,
        noise,
    })
}

/// The force history over the first window that explains the traces, or else over the smallest.
fn default_window(
    problem: &Problem,
    rows: &[Rows],
    fit: &PulseFit,
) -> Result<(Normal, ForceHistory), InverseError> {
    let (start, duration) = (fit.start_s.value, fit.duration_s.value);
    let windows =
        MARGINS.map(|margin| [start - margin * duration, start + (1.0 + margin) * duration]);
    let explains = |(_, history): &(Normal, ForceHistory)| history.error_factor == 1.0;
    let first = over(problem, rows, fit, windows[0])?;
    if explains(&first) {
        return Ok(first);
    }
    let others = windows[1..]
        .iter()
        .filter_map(|window| over(problem, rows, fit, *window).ok());
    Ok(others.into_iter().find(explains).unwrap_or(first))
}

/// The force history over a window in s, as far as the traces show it.
fn over(
    problem: &Problem,
    rows: &[Rows],
    fit: &PulseFit,
    window: [f64; 2],
) -> Result<(Normal, ForceHistory), InverseError> {
    let [start, end] = window.map(|t| problem.force_place(t).max(0.0));
    let start = start.ceil() as usize;
    let end = (end as usize).min(last_shown(rows)).max(start + 2);
    let size = end + 1 - start;
    if size > MOST_SAMPLES {
        let key = "the number of force samples in the window";
        let range = format!("[3, {MOST_SAMPLES}]");
        let remedy =
            ": shorten the window, or resample the traces to about a hundred samples in a contact";
        return Err(InverseError::outside(key, size as f64, &range, remedy));
    }
    let normal = Normal::new(rows, start, size);
    let history = deconvolve(problem, rows, fit, &normal)?;
    Ok((normal, history))
}

/// The trace of a force for a gain of one, in its own unit.
fn predict(problem: &Problem, trace: &Trace, start: usize, force: &[f64]) -> Vec<f64> {
    let value = |sample: usize| {
        let time = sample
            .saturating_mul(problem.oversampling)
            .saturating_add(problem.lead);
        let lag = |j: usize| time.checked_sub(start + j);
        let terms = force.iter().enumerate();
        let terms = terms.filter_map(|(j, p)| Some(p * trace.response.get(lag(j)?)?));
        terms.sum()
    };
    (0..trace.samples.len()).map(value).collect()
}
