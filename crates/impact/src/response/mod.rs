//! Response of a sensor: from the history of its input to the history of its output.
//!
//! A [`Response`] is linear and constant in time: poles and zeros, a table over frequency, or the coefficients of a digital
//! filter. Its time factor is e^{i w t}, w = 2 pi f, as in numpy's `rfft` and in SEED.
//! Any unit of input and output is allowed; the response converts one into the other.
//!
//! ```
//! use impact::response::{PolesZeros, Response};
//!
//! // a second-order high pass at 1 kHz, as ObsPy's cornFreq2Paz(1000, 0.707)
//! let pole = num_complex::Complex64::new(-0.707, -(1.0 - 0.707_f64.powi(2)).sqrt()) * 2e3 * std::f64::consts::PI;
//! let high_pass = PolesZeros::new(vec![pole, pole.conj()], vec![0.0.into(); 2], 1.0)?;
//! let response = Response::PolesZeros(high_pass);
//! assert!((response.at(1e3).norm() - 1.0 / (2.0 * 0.707)).abs() < 1e-12);
//! # Ok::<(), impact::response::ResponseError>(())
//! ```
//!
//! Theory: `docs/theory.md` (T72).

mod fir;
mod poles;
mod section;
mod spectrum;
mod table;

pub use fir::Fir;
pub use poles::PolesZeros;
pub use spectrum::band_pass;
pub use table::Tabulated;

use fault::{Class, Culprit, Fault, number, rounded};
use num_complex::Complex64;
use spectrum::{ROUNDED, check_band, filtered, in_band, taper};
use std::ops::RangeInclusive;
use thiserror::Error;

/// A linear response that is constant in time.
#[derive(Debug, Clone, PartialEq)]
pub enum Response {
    /// A rational function of s = i w.
    PolesZeros(PolesZeros),
    /// Values at frequencies.
    Tabulated(Tabulated),
    /// A digital filter.
    Fir(Fir),
}

/// Output of a response at the times of its input.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// The output, in the unit of the response.
    pub samples: Vec<f64>,
    /// Estimated error of each sample that comes from the sampling of the input; it never falls with time.
    pub error: Vec<f64>,
    /// Largest possible ratio of an error of the output to the largest error of the input.
    pub largest_gain: f64,
}

/// A response that is impossible, or a history that it does not fit.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{sentence}")]
pub struct ResponseError {
    /// Scene key or argument at fault.
    pub key: &'static str,
    /// Its value, if it is one number.
    pub value: Option<f64>,
    /// The key, the value, the allowed range and a way out.
    sentence: String,
}

impl ResponseError {
    fn new(key: &'static str, value: impl Into<Option<f64>>, sentence: String) -> Self {
        let value = value.into();
        Self {
            key,
            value,
            sentence,
        }
    }
}

impl Fault for ResponseError {
    fn culprit(&self) -> Culprit<'_> {
        Culprit {
            number: self.value,
            ..Culprit::of(Class::Scene).key(self.key)
        }
    }
}

/// The first number that does not fit its range, as an error.
fn within(
    key: &'static str,
    numbers: &[f64],
    fits: impl Fn(f64) -> bool,
    range: &'static str,
) -> Result<(), ResponseError> {
    let Some(&value) = numbers.iter().find(|x| !fits(**x)) else {
        return Ok(());
    };
    let sentence = format!("{key} = {} is outside {range}", number(value));
    Err(ResponseError::new(key, value, sentence))
}

/// Rejects numbers that are not finite.
fn finite(key: &'static str, numbers: &[f64]) -> Result<(), ResponseError> {
    within(key, numbers, f64::is_finite, "(-inf, inf)")
}

/// Rejects a number that is not positive and finite.
fn positive(key: &'static str, value: f64) -> Result<(), ResponseError> {
    within(key, &[value], |x| x > 0.0 && x.is_finite(), "(0, inf)")
}

/// Rejects a list with a wrong number of elements.
fn counted(
    key: &'static str,
    count: usize,
    needed: RangeInclusive<usize>,
) -> Result<(), ResponseError> {
    if needed.contains(&count) {
        return Ok(());
    }
    let (least, most) = needed.into_inner();
    let sentence = format!("{key} has {count} elements, but {least} to {most} are required");
    Err(ResponseError::new(key, count as f64, sentence))
}

/// Checks the step and the samples of a history.
fn history(step_s: f64, samples: &[f64]) -> Result<(), ResponseError> {
    positive("step_s", step_s)?;
    finite("samples", samples)
}

/// Strides of samples whose output is compared with that of all, from each sample that they can begin with, and factors of
/// the differences.
///
/// A jump of a derivative has an error that depends on its place between two samples. Those of all beginnings of a stride
/// have the error of the output as their mean, so that at some places they do not differ for one stride, but for another.
/// With one stride alone or half the factors the test `the_estimate_holds` fails; with twice the factors its median is too
/// large.
const DIFFERENCES: [(usize, f64); 2] = [(2, 2.5), (3, 0.8)];

/// Samples from here on whose differences count for the error of one: the output looks ahead so far, and differences pass
/// zero. With one sample the test `the_estimate_holds` fails.
const NEAR: usize = 8;

impl Response {
    /// H(f): a complex amplitude of the input's e^{i 2 pi f t} becomes one of the output by this factor.
    ///
    /// Zero outside a table, and above half the rate of a digital filter.
    pub fn at(&self, frequency_hz: f64) -> Complex64 {
        match self {
            Self::PolesZeros(rational) => rational.at(frequency_hz),
            Self::Tabulated(table) => table.at(frequency_hz),
            Self::Fir(filter) => filter.at(frequency_hz),
        }
    }

    /// Whether the phase was computed from the amplitudes as that of a minimum-phase response.
    pub fn is_minimum_phase(&self) -> bool {
        matches!(self, Self::Tabulated(table) if table.is_minimum_phase())
    }

    /// Frequencies in Hz outside which the response is zero.
    pub fn limits_hz(&self) -> [f64; 2] {
        match self {
            Self::PolesZeros(_) => [0.0, f64::INFINITY],
            Self::Tabulated(table) => table.limits_hz(),
            Self::Fir(filter) => [0.0, 0.5 * filter.rate_hz()],
        }
    }

    /// Fraction in [0, 1] of the energy (sum of squares) of a history at frequencies outside [`Response::limits_hz`].
    ///
    /// # Errors
    /// [`ResponseError`] for a step or a sample that is not a number.
    pub fn outside(&self, step_s: f64, samples: &[f64]) -> Result<f64, ResponseError> {
        history(step_s, samples)?;
        let [least, most] = self.limits_hz();
        let energy = |of: &dyn Fn(f64) -> f64| {
            let all = filtered(step_s, samples, 0, |f| of(f).into());
            all.iter().map(|x| x * x).sum::<f64>()
        };
        let is_outside = |f: f64| f < least || f > most * (1.0 + ROUNDED);
        Ok(match energy(&|_| 1.0) {
            0.0 => 0.0,
            all => (energy(&|f| f64::from(u8::from(is_outside(f)))) / all).min(1.0),
        })
    }

    /// The output for equidistant samples of an input that was zero before the first sample.
    ///
    /// Poles and zeros use no Fourier transform: nothing comes round from the end of the record, and an output depends on
    /// later inputs only by the polynomial through the samples at most two steps away for each pole. The order of
    /// accuracy is four to five for a smooth input, three at a jump of its second derivative, two at one of its slope.
    /// A jump of the input is taken half a step before its first sample.
    /// A table and a digital filter multiply the spectrum of the record with at least three times as many zeros after it.
    /// Their error counts the output before the first sample, where that of a causal response is zero.
    ///
    /// Nothing is done to the samples before: no taper, no mean removed.
    ///
    /// # Errors
    /// [`ResponseError`] for such numbers, and for a step that is too large for a resonance or too small for a filter.
    pub fn apply(&self, step_s: f64, samples: &[f64]) -> Result<Output, ResponseError> {
        history(step_s, samples)?;
        let (output, before, largest_gain) = self.output(step_s, samples)?;
        let mut differences = vec![0.0_f64; output.len()];
        for (stride, factor) in DIFFERENCES {
            for first in 0..stride {
                let few = samples.iter().skip(first).step_by(stride);
                let few: Vec<f64> = few.copied().collect();
                // too coarse for these only: the estimate is then the output itself
                let coarse = self.output(stride as f64 * step_s, &few);
                let coarse = coarse.map_or(vec![0.0; few.len()], |(coarse, ..)| coarse);
                for (n, of_few) in (first..).step_by(stride).zip(coarse) {
                    let difference = factor * (output[n] - of_few).abs();
                    differences[n] = differences[n].max(difference);
                }
            }
        }
        let mut error = before;
        let error = (0..output.len()).map(|n| {
            let near = differences[n..].iter().take(NEAR);
            error = near.fold(error, |a, &b| a.max(b));
            error
        });
        Ok(Output {
            error: error.collect(),
            samples: output,
            largest_gain,
        })
    }

    /// Samples of the output, the largest one before the first, and the largest gain.
    fn output(&self, step_s: f64, samples: &[f64]) -> Result<(Vec<f64>, f64, f64), ResponseError> {
        if let Self::PolesZeros(rational) = self {
            let (output, gain) = rational.output(step_s, samples)?;
            return Ok((output, 0.0, gain));
        }
        let length = self.length(step_s)?;
        let mut output = filtered(step_s, samples, length, |f| self.at(f));
        // the last quarter of the transform comes before the record
        let before = output[output.len() - output.len() / 4..].iter();
        let before = before.fold(0.0, |a: f64, b| a.max(b.abs()));
        output.truncate(samples.len());
        let mut impulse = vec![0.0; samples.len()];
        impulse.iter_mut().take(1).for_each(|x| *x = 1.0);
        let gain = filtered(step_s, &impulse, length, |f| self.at(f));
        Ok((output, before, gain.iter().map(|x| x.abs()).sum()))
    }

    /// Steps by which a digital filter makes a record longer.
    fn length(&self, step_s: f64) -> Result<usize, ResponseError> {
        match self {
            Self::PolesZeros(_) | Self::Tabulated(_) => Ok(0),
            Self::Fir(filter) => filter.length(step_s),
        }
    }

    /// The input whose output the samples are, in a band: cosine tapers from f1 to f2 and from f3 to f4 in Hz.
    ///
    /// Order of operations:
    ///
    /// 1. no taper of the record, no mean removed, no water level;
    /// 2. for poles and zeros, the exact inverse of [`Response::apply`] on the same samples: the input from the first sample
    ///    to the last; it is zero after the last;
    /// 3. the band, by [`band_pass`].
    ///
    /// The result is therefore [`band_pass`] of the input also if the record ends before the output has decayed.
    /// Step 2 amplifies noise that the response suppresses, and the end of the record makes part of it leak into the band
    /// near the end: noise of 1e-3 in the output of two resonances became 9e-4 in the first half of 2,000 samples and 7e-2 in
    /// the last 50. Division of the spectrum, as for a table, keeps 9e-4 everywhere, but its error is 0.2 where the record ends
    /// before the output has decayed. For a noisy record that has decayed, tabulate the response.
    ///
    /// A table or a digital filter has no causal inverse: its spectrum is divided inside the band, which assumes that the
    /// output is zero before the first and after the last sample.
    ///
    /// # Errors
    /// [`ResponseError`] about the band, about a zero of the response in it, or about samples that are too coarse.
    pub fn remove(
        &self,
        step_s: f64,
        samples: &[f64],
        band_hz: [f64; 4],
    ) -> Result<Vec<f64>, ResponseError> {
        history(step_s, samples)?;
        check_band(step_s, band_hz, self.limits_hz())?;
        if let Self::PolesZeros(rational) = self {
            let input = rational.input(step_s, samples)?;
            return Ok(in_band(step_s, &input, band_hz));
        }
        let mut zero = None;
        let mut input = filtered(step_s, samples, self.length(step_s)?, |f| {
            let (part, factor) = (taper(band_hz, f), self.at(f));
            if part == 0.0 {
                return part.into();
            }
            zero = zero.or((factor.norm() == 0.0).then_some(f));
            part / factor
        });
        if let Some(frequency_hz) = zero {
            let sentence = format!(
                "the response is zero at {} Hz and cannot be removed there: use a band without this frequency",
                rounded(frequency_hz)
            );
            return Err(ResponseError::new("band", frequency_hz, sentence));
        }
        input.truncate(samples.len());
        Ok(input)
    }
}
