//! The traces of a blow, their rows in units of the noise.

use crate::error::{Estimate, InverseError, check, finite, positive};
use crate::nnls::dot;
use crate::noise::{FEWEST_QUIET, Whitening, mean_square};
use crate::pulse::Pulse;
use fault::rounded;
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
    /// Whitened response on the force step.
    pub(crate) kernel: Vec<f64>,
    /// Force steps from the middle of a hat to its first response.
    pub(crate) arrival: usize,
    /// Force sample at the time of the first row.
    pub(crate) first: usize,
    /// Force samples between two rows.
    pub(crate) stride: usize,
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

    /// Time of a force sample in s.
    pub(crate) fn force_time_s(&self, index: f64) -> f64 {
        (index - self.lead as f64) * self.force_step_s()
    }

    /// Place of a time in s among the force samples.
    pub(crate) fn force_place(&self, time_s: f64) -> f64 {
        time_s / self.force_step_s() + self.lead as f64
    }

    /// Rejects a force whose end in s has no wave in any trace.
    pub(crate) fn shown(&self, rows: &[Rows], end_s: f64) -> Result<(), InverseError> {
        let shown_s = self.force_time_s(last_shown(rows) as f64);
        if end_s <= shown_s {
            return Ok(());
        }
        let last = rows.iter().map(Rows::last).max().unwrap_or(0);
        let valid_s = self.force_time_s(last as f64);
        let sentence = format!(
            "the force until {} s is not in the traces: they are valid until {} s, which shows forces until {} s; shorten the window, or move the sensor closer",
            rounded(end_s),
            rounded(valid_s),
            rounded(shown_s)
        );
        Err(InverseError::new("window_s", end_s, sentence))
    }

    /// The factor of a force from the products of its prediction with the rows and with itself, one pair a trace: from the
    /// traces of known gain, or else from its impulse in N s. With its relative variance for rows of the variance `noise`.
    pub(crate) fn scale(
        &self,
        rows: &[Rows],
        sums: &[[f64; 2]],
        impulse: f64,
        noise: f64,
    ) -> [f64; 2] {
        let (mut product, mut square) = (0.0, 0.0);
        for (rows, sums) in rows.iter().zip(sums) {
            if let Gain::Known(gain) = rows.gain {
                product += gain * sums[0];
                square += gain * gain * sums[1];
            }
        }
        match self.impulse_n_s {
            Some(known) if square == 0.0 => {
                [known.value / impulse, (known.sd / known.value).powi(2)]
            }
            Some(_) | None => [product / square, noise / square],
        }
    }

    /// Checks all that can be checked before a fit, and whitens the traces.
    pub(crate) fn rows(&self) -> Result<Vec<Rows>, InverseError> {
        positive("step_s", self.step_s)?;
        positive("oversampling", self.oversampling as f64)?;
        let confidence = self.confidence;
        let good = (0.5..1.0).contains(&confidence);
        check(good, "confidence", confidence, "[0.5, 1)")?;
        if let Some(lambda) = self.lambda {
            positive("lambda", lambda)?;
        }
        if let Some(impulse) = self.impulse_n_s {
            positive("impulse_n_s", impulse.value)?;
            positive("the error of impulse_n_s", impulse.sd)?;
        }
        if let Some([from, to]) = self.window_s {
            let range = "(its start and that of the traces, inf)";
            let good = to > from && to > self.force_time_s(0.0) && to.is_finite();
            check(good, "the end of window_s", to, range)?;
        }
        let count = self.traces.len() as f64;
        check(count > 0.0, "the number of traces", count, "[1, inf)")?;
        if self.impulse_n_s.is_none() && self.traces.iter().all(|own| own.gain == Gain::Unknown) {
            let sentence = "no gain is known, so only the shape of the force could be found: pass the gain of one trace or the impulse";
            return Err(InverseError::new("gain", None, sentence.to_owned()));
        }
        let traces = self.traces.iter().enumerate();
        traces.map(|(i, trace)| self.rows_of(i, trace)).collect()
    }

    fn rows_of(&self, index: usize, trace: &Trace) -> Result<Rows, InverseError> {
        finite(&format!("trace {}", index + 1), &trace.samples)?;
        finite(&format!("response {}", index + 1), &trace.response)?;
        if let Gain::Known(gain) = trace.gain {
            let good = gain != 0.0 && gain.is_finite();
            check(good, "gain", gain, "(-inf, inf) without 0")?;
        }
        let mut used = trace.samples.len();
        if let Some(valid) = trace.valid_until_s {
            positive("valid_until_s", valid)?;
            used = used.min(((valid / self.step_s) as usize).saturating_add(1));
        }
        let steps = self.oversampling.saturating_mul(used.max(1) - 1);
        let needed = steps.saturating_add(self.lead).saturating_add(1);
        let response = trace.response.get(..needed).ok_or_else(|| {
            let key = format!("the number of samples of response {}", index + 1);
            let (found, range) = (trace.response.len() as f64, format!("[{needed}, inf)"));
            let remedy = ": compute it on the force step until the end of the trace";
            InverseError::outside(&key, found, &range, remedy)
        })?;
        let largest = response.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
        let arrival = response.iter().position(|x| x.abs() > ARRIVED * largest);
        let arrival = arrival.ok_or_else(|| {
            let key = format!("the largest value of response {}", index + 1);
            let remedy =
                ": no wave reaches the sensor before the end of the trace; check its place";
            InverseError::outside(&key, largest, "(0, inf)", remedy)
        })?;
        let whitening = self.whitening(index, trace)?;
        let order = whitening.order();
        let range = [order + FEWEST_QUIET, MOST_FORCE_STEPS / self.oversampling];
        if !(range[0]..=range[1]).contains(&used) {
            let key = format!("the number of valid samples of trace {}", index + 1);
            let remedy = ": cut the trace around the blow, or resample it to about a hundred samples in a contact";
            return Err(InverseError::outside(
                &key,
                used as f64,
                &format!("{range:?}"),
                remedy,
            ));
        }
        Ok(Rows {
            data: whitening.apply(&trace.samples[..used], 1).split_off(order),
            kernel: whitening.apply(response, self.oversampling),
            arrival,
            first: self.lead + self.oversampling * order,
            stride: self.oversampling,
            whitening,
            gain: trace.gain,
        })
    }

    /// The whitening of a trace that begins at rest.
    fn whitening(&self, index: usize, trace: &Trace) -> Result<Whitening, InverseError> {
        let (whitening, ratio, most) = match &trace.noise {
            Noise::White(sigma) => {
                positive("noise", *sigma)?;
                let first = trace.samples.first().map_or(0.0, |x| x.abs());
                (Whitening::white(*sigma), first / sigma, OFFSET)
            }
            Noise::Quiet(range) => {
                let found = range.len();
                let quiet = trace.samples.get(range.clone());
                let quiet = quiet.filter(|quiet| quiet.len() >= FEWEST_QUIET).ok_or_else(|| {
                    let key = format!("the number of quiet samples of trace {}", index + 1);
                    let range = format!("[{FEWEST_QUIET}, {}]", trace.samples.len());
                    let remedy = ": record more before the trigger, or pass the standard deviation of the noise";
                    InverseError::outside(&key, found as f64, &range, remedy)
                })?;
                let mean = quiet.iter().sum::<f64>() / found as f64;
                let centred: Vec<f64> = quiet.iter().map(|x| x - mean).collect();
                let sigma = mean_square(&centred).sqrt();
                // rounding alone
                if sigma <= 1e-14 * mean.abs() {
                    let key = format!("the noise of the quiet part of trace {}", index + 1);
                    let remedy =
                        ": pass a standard deviation, at least 0.29 of a digit of the recorder";
                    return Err(InverseError::outside(&key, sigma, "(0, inf)", remedy));
                }
                let error = Whitening::of_quiet(&centred).error_of_mean(found);
                let most = (OFFSET * error / sigma).max(0.5);
                (Whitening::of_quiet(quiet), mean.abs() / sigma, most)
            }
        };
        if ratio <= most {
            return Ok(whitening);
        }
        let sentence = format!(
            "trace {} begins under load: its first samples are {} times the noise; begin before the blow, or subtract the offset of the quiet part",
            index + 1,
            rounded(ratio)
        );
        Err(InverseError::new("trace", ratio, sentence))
    }
}

/// The last force sample that has a wave in a trace.
pub(crate) fn last_shown(rows: &[Rows]) -> usize {
    let shown = rows
        .iter()
        .map(|rows| rows.last().saturating_sub(rows.arrival));
    shown.max().unwrap_or(0)
}

impl Rows {
    /// Force sample at the time of the last row.
    fn last(&self) -> usize {
        self.first + self.stride * (self.data.len() - 1)
    }

    /// The whitened trace of a force whose first sample is `start`, for a gain of one.
    pub(crate) fn predict(&self, start: usize, force: &[f64]) -> Vec<f64> {
        let times = (self.first..=self.last()).step_by(self.stride);
        self.respond(times.map(|time| (time + 1).saturating_sub(start)), force)
    }

    /// The whitened response to a force, so many force steps after the one before its first sample.
    pub(crate) fn respond(&self, times: impl Iterator<Item = usize>, force: &[f64]) -> Vec<f64> {
        let turned: Vec<f64> = force.iter().rev().copied().collect();
        let at = |end: usize| {
            let count = force.len().min(end.saturating_sub(self.arrival));
            dot(
                &self.kernel[end - count..end],
                &turned[force.len() - count..],
            )
        };
        times.map(at).collect()
    }
}
