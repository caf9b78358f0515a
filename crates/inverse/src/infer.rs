//! From traces to the force: a fit, a force history, and what they rest on.

use crate::deconvolve::{ForceHistory, Normal, deconvolve};
use crate::error::{Estimate, InverseError, outside};
use crate::fit::{PulseFit, fit};
use crate::problem::{Noise, Problem, Rows, Trace};
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
            problem.shown(
                &rows,
                window[1] / problem.force_step_s() + problem.lead as f64,
            )?;
            over(problem, &rows, &fit, window)?
        }
        None => default_window(problem, &rows, &fit)?,
    };
    let predicted: Vec<Vec<f64>> = predicted(problem, &history, normal.start);
    let noise = problem.traces.iter().zip(&rows).zip(&predicted);
    let noise = noise.map(|((trace, rows), predicted)| {
        let peak = predicted.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        NoiseFound {
            sigma: rows.whitening.sigma,
            order: rows.whitening.order(),
            quiet: match &trace.noise {
                Noise::Quiet(range) => Some(range.clone()),
                Noise::White(_) => None,
            },
            signal_to_noise: peak / rows.whitening.sigma,
        }
    });
    Ok(Inferred {
        noise: noise.collect(),
        jackknife: jackknife(&normal, &history)?,
        fit,
        history,
        predicted,
    })
}

/// The force history over the first window that explains the traces, or else over the smallest.
fn default_window(
    problem: &Problem,
    rows: &[Rows],
    fit: &PulseFit,
) -> Result<(Normal, ForceHistory), InverseError> {
    let (start, duration) = (fit.start_s.value, fit.duration_s.value);
    let mut first = None;
    for margin in MARGINS {
        let window = [start - margin * duration, start + (1.0 + margin) * duration];
        let samples = (window[1] - window[0]) / problem.force_step_s();
        if first.is_some() && samples > MOST_SAMPLES as f64 {
            break;
        }
        let found = over(problem, rows, fit, window)?;
        let history = &found.1;
        if history.error_factor == 1.0 {
            return Ok(found);
        }
        first.get_or_insert(found);
    }
    first.ok_or(InverseError::NotSolved)
}

/// The force history over a window in s, as far as the traces show it.
fn over(
    problem: &Problem,
    rows: &[Rows],
    fit: &PulseFit,
    window: [f64; 2],
) -> Result<(Normal, ForceHistory), InverseError> {
    let [start, end] = window.map(|t| (t / problem.force_step_s() + problem.lead as f64).max(0.0));
    let last = rows
        .iter()
        .filter_map(|rows| rows.last_shown(problem))
        .max()
        .unwrap_or(0);
    let start = start.ceil() as usize;
    let end = (end as usize).min(last).max(start + 2);
    let size = end + 1 - start;
    if size > MOST_SAMPLES {
        let key = "the number of force samples in the window";
        let remedy =
            ": shorten the window, or resample the traces to about a hundred samples in a contact";
        return Err(outside(
            key,
            size as f64,
            format!("[3, {MOST_SAMPLES}]"),
            remedy,
        ));
    }
    let normal = Normal::new(problem, rows, [start, end]);
    let history = deconvolve(problem, rows, fit, &normal)?;
    Ok((normal, history))
}

/// The traces of a force history in their own units.
fn predicted(problem: &Problem, history: &ForceHistory, start: usize) -> Vec<Vec<f64>> {
    let of = |(trace, gain): (&Trace, &Estimate)| {
        let force = history.force_n.iter().enumerate();
        let value = |sample: usize| {
            let lag = |j| problem.force_index(sample).checked_sub(start + j);
            let terms = force
                .clone()
                .filter_map(|(j, p)| Some(p * trace.response.get(lag(j)?)?));
            gain.value * terms.sum::<f64>()
        };
        (0..trace.samples.len()).map(value).collect()
    };
    problem.traces.iter().zip(&history.gains).map(of).collect()
}
