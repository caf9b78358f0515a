//! The traces of a blow, their rows in units of the noise.

use crate::error::{Estimate, InverseError, check, finite, outside, positive};
use crate::nnls::dot;
use crate::noise::{FEWEST_QUIET, Whitening, mean_square};
use crate::pulse::Pulse;
use std::ops::Range;

/// Noise of a trace.
#[derive(Debug, Clone, PartialEq)]
pub enum Noise {
    /// Measured from these samples, all before the first arrival; it may be coloured.
    Quiet(Range<usize>),
    /// White with this standard deviation, in the unit of the trace.
    White(f64),
}

/// Factor between the response and the trace of a sensor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Gain {
    /// This factor; 1 for a calibrated sensor.
    Known(f64),
    /// Any factor of either sign.
    Unknown,
}

/// The trace of one sensor, its first sample at time zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Samples on the problem's step.
    pub samples: Vec<f64>,
    /// Response of the sensor to a hat of force: linear from 0 N to 1 N and back, a force step on either side of its
    /// middle. Sample k is k force steps after the middle. At least as long as the trace and the lead.
    pub response: Vec<f64>,
    /// Noise.
    pub noise: Noise,
    /// Factor between response and trace.
    pub gain: Gain,
    /// Time in s after which the response does not describe the trace, such as the first echo.
    pub valid_until_s: Option<f64>,
}

/// Traces of one blow.
#[derive(Debug, Clone)]
pub struct Problem<'a> {
    /// Time between samples of the traces in s.
    pub step_s: f64,
    /// Force samples for each sample of a trace. A contact needs about a hundred force samples: with fewer, the corners at
    /// its ends are visible where a front is sharp.
    pub oversampling: usize,
    /// Force samples before the first sample of the traces; without them the blow begins after that sample.
    pub lead: usize,
    /// The traces, all of the same clock.
    pub traces: Vec<Trace>,
    /// Pulse of the contact law.
    pub pulse: &'a Pulse,
    /// Times in s between which the force may differ from zero. Default: 1.3 fitted durations, from 0.15 before the fitted
    /// start, and more if a pulse of that length does not explain the traces.
    pub window_s: Option<[f64; 2]>,
    /// Impulse in N s, known from mass and velocities.
    pub impulse_n_s: Option<Estimate>,
    /// Weight of the squared second differences in 1/N^2. Default: that of the largest likelihood of the traces, whose bands
    /// hold 90 to 98 % of the true samples; the L-curve of a result shows others.
    pub lambda: Option<f64>,
    /// Probability of the bands.
    pub confidence: f64,
}

/// The rows of one trace in units of its noise, which is white in them.
#[derive(Debug, Clone)]
pub(crate) struct Rows {
    /// Whitened samples, those that the filter needs before it is complete left out.
    pub(crate) data: Vec<f64>,
    /// Sample of the trace of the first row.
    pub(crate) first: usize,
    /// Whitened response on the force step.
    pub(crate) kernel: Vec<f64>,
    /// Force steps from the middle of a hat to its first response.
    pub(crate) arrival: usize,
    pub(crate) whitening: Whitening,
    pub(crate) gain: Gain,
}

/// Response below which nothing has arrived, over the largest; instruments have tails.
const ARRIVED: f64 = 1e-6;

/// Force steps in a trace at most: the net of durations and starts takes a second.
const MOST_FORCE_STEPS: usize = 40_000;

/// Standard errors by which the mean of a quiet beginning may differ from zero.
const OFFSET: f64 = 5.0;

impl<'a> Problem<'a> {
    /// The problem with the default of everything else: no oversampling, no lead, the default window, bands of 95 %.
    pub fn new(step_s: f64, traces: Vec<Trace>, pulse: &'a Pulse) -> Self {
        Self {
            step_s,
            oversampling: 1,
            lead: 0,
            traces,
            pulse,
            window_s: None,
            impulse_n_s: None,
            lambda: None,
            confidence: 0.95,
        }
    }

    /// Time between force samples in s.
    pub fn force_step_s(&self) -> f64 {
        self.step_s / self.oversampling as f64
    }

    /// Force sample at the time of a sample of the traces.
    pub(crate) fn force_index(&self, sample: usize) -> usize {
        sample
            .saturating_mul(self.oversampling)
            .saturating_add(self.lead)
    }

    /// Time of a force sample in s.
    pub(crate) fn force_time_s(&self, index: f64) -> f64 {
        (index - self.lead as f64) * self.force_step_s()
    }

    /// Rejects a force whose last sample, a force index, has no wave in any trace.
    pub(crate) fn shown(&self, rows: &[Rows], last: f64) -> Result<(), InverseError> {
        let shown = rows
            .iter()
            .filter_map(|rows| rows.last_shown(self))
            .max()
            .unwrap_or(0) as f64;
        if last <= shown {
            return Ok(());
        }
        let ends = rows
            .iter()
            .map(|rows| rows.first + rows.data.len() - 1)
            .max()
            .unwrap_or(0);
        Err(InverseError::NotShown {
            wanted_s: self.force_time_s(last),
            valid_s: ends as f64 * self.step_s,
            shown_s: self.force_time_s(shown),
        })
    }

    /// Checks all that can be checked before a fit, and whitens the traces.
    pub(crate) fn rows(&self) -> Result<Vec<Rows>, InverseError> {
        positive("step_s", self.step_s)?;
        positive("oversampling", self.oversampling as f64)?;
        check(
            (0.5..1.0).contains(&self.confidence),
            "confidence",
            self.confidence,
            "[0.5, 1)",
        )?;
        self.lambda
            .map_or(Ok(()), |lambda| positive("lambda", lambda))?;
        if let Some(impulse) = self.impulse_n_s {
            positive("impulse_n_s", impulse.value)?;
            positive("the error of impulse_n_s", impulse.sd)?;
        }
        if let Some([from, to]) = self.window_s {
            check(
                from.is_finite(),
                "the start of window_s",
                from,
                "(-inf, inf)",
            )?;
            let least = from.max(self.force_time_s(0.0));
            let range = "(its start and that of the traces, inf)";
            check(
                to > least && to.is_finite(),
                "the end of window_s",
                to,
                range,
            )?;
        }
        check(
            !self.traces.is_empty(),
            "the number of traces",
            0.0,
            "[1, inf)",
        )?;
        let known = |trace: &Trace| matches!(trace.gain, Gain::Known(_));
        if self.impulse_n_s.is_none() && !self.traces.iter().any(known) {
            return Err(InverseError::NoScale);
        }
        self.traces
            .iter()
            .enumerate()
            .map(|(i, trace)| self.rows_of(i, trace))
            .collect()
    }

    fn rows_of(&self, index: usize, trace: &Trace) -> Result<Rows, InverseError> {
        finite(&format!("trace {}", index + 1), &trace.samples)?;
        finite(&format!("response {}", index + 1), &trace.response)?;
        if let Gain::Known(gain) = trace.gain {
            check(
                gain != 0.0 && gain.is_finite(),
                "gain",
                gain,
                "(-inf, inf) without 0",
            )?;
        }
        let mut used = trace.samples.len();
        if let Some(valid) = trace.valid_until_s {
            positive("valid_until_s", valid)?;
            used = used.min(((valid / self.step_s) as usize).saturating_add(1));
        }
        let (found, needed) = (
            trace.response.len(),
            self.force_index(used.max(1) - 1).saturating_add(1),
        );
        let response = trace.response.get(..needed).ok_or_else(|| {
            let key = format!("the number of samples of response {}", index + 1);
            let remedy = ": compute it on the force step until the end of the trace";
            outside(key, found as f64, format!("[{needed}, inf)"), remedy)
        })?;
        let whitening = self.whitening(index, trace)?;
        let kernel = whitening.apply(response, self.oversampling);
        let largest = response.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        let arrival = response.iter().position(|x| x.abs() > ARRIVED * largest);
        let arrival = arrival.ok_or_else(|| {
            let key = format!("the largest value of response {}", index + 1);
            let remedy =
                ": no wave reaches the sensor before the end of the trace; check its place";
            outside(key, largest, "(0, inf)", remedy)
        })?;
        let first = whitening.order();
        let range = [first + FEWEST_QUIET, MOST_FORCE_STEPS / self.oversampling];
        if !(range[0]..=range[1]).contains(&used) {
            let key = format!("the number of valid samples of trace {}", index + 1);
            let remedy = ": cut the trace around the blow, or resample it to about a hundred samples in a contact";
            return Err(outside(key, used as f64, format!("{range:?}"), remedy));
        }
        let data = whitening.apply(&trace.samples[..used], 1).split_off(first);
        Ok(Rows {
            data,
            first,
            kernel,
            arrival,
            whitening,
            gain: trace.gain,
        })
    }

    fn whitening(&self, index: usize, trace: &Trace) -> Result<Whitening, InverseError> {
        let under_load = |ratio| Err(InverseError::UnderLoad { index, ratio });
        match &trace.noise {
            Noise::White(sigma) => {
                positive("noise", *sigma)?;
                match trace.samples.first().map(|x| x.abs() / sigma) {
                    Some(ratio) if ratio > OFFSET => under_load(ratio),
                    Some(_) | None => Ok(Whitening::white(*sigma)),
                }
            }
            Noise::Quiet(range) => {
                let found = range.len();
                let quiet = trace.samples.get(range.clone());
                let quiet = quiet.filter(|quiet| quiet.len() >= FEWEST_QUIET).ok_or_else(|| {
                    let key = format!("the number of quiet samples of trace {}", index + 1);
                    let range = format!("[{FEWEST_QUIET}, {}]", trace.samples.len());
                    let remedy = ": record more before the trigger, or pass the standard deviation of the noise";
                    outside(key, found as f64, range, remedy)
                })?;
                let mean = quiet.iter().sum::<f64>() / found as f64;
                let sigma = (mean_square(quiet) - mean * mean).max(0.0).sqrt();
                if sigma <= 0.0 {
                    let key = format!("the noise of the quiet part of trace {}", index + 1);
                    let remedy =
                        ": pass a standard deviation, at least 0.29 of a digit of the recorder";
                    return Err(outside(key, sigma, "(0, inf)", remedy));
                }
                let centred: Vec<f64> = quiet.iter().map(|x| x - mean).collect();
                let error = Whitening::of_quiet(&centred).error_of_mean(found);
                if mean.abs() > (OFFSET * error).max(0.5 * sigma) {
                    return under_load(mean.abs() / sigma);
                }
                Ok(Whitening::of_quiet(quiet))
            }
        }
    }
}

impl Rows {
    /// Force sample at the time of a row.
    pub(crate) fn force_index(&self, problem: &Problem, row: usize) -> usize {
        problem.force_index(self.first + row)
    }

    /// The last force sample that has a wave in the rows.
    pub(crate) fn last_shown(&self, problem: &Problem) -> Option<usize> {
        self.force_index(problem, self.data.len() - 1)
            .checked_sub(self.arrival)
    }

    /// The whitened trace of a force whose first sample is `start`, for a gain of one.
    pub(crate) fn predict(&self, problem: &Problem, start: usize, force: &[f64]) -> Vec<f64> {
        let place = |row| self.force_index(problem, row).checked_sub(start);
        self.respond((0..self.data.len()).map(place), force)
    }

    /// The whitened response to a force at times in force steps after its first sample, if they are.
    pub(crate) fn respond(
        &self,
        times: impl Iterator<Item = Option<usize>>,
        force: &[f64],
    ) -> Vec<f64> {
        let turned: Vec<f64> = force.iter().rev().copied().collect();
        let at = |time: Option<usize>| {
            let end = time.map_or(0, |time| time + 1);
            let count = force.len().min(end.saturating_sub(self.arrival));
            dot(
                &self.kernel[end - count..end],
                &turned[force.len() - count..],
            )
        };
        times.map(at).collect()
    }
}
