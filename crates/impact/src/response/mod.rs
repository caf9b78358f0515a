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

mod poles;
mod section;
mod spectrum;
mod table;

pub use poles::PolesZeros;
pub use spectrum::{Fir, band_pass};
pub use table::{MOST_ROWS, Tabulated};

use fault::{Class, Culprit, Fault, number};
use num_complex::Complex64;
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
    numbers: impl IntoIterator<Item = f64>,
    fits: impl Fn(f64) -> bool,
    range: &'static str,
) -> Result<(), ResponseError> {
    match numbers.into_iter().find(|&x| !fits(x)) {
        None => Ok(()),
        Some(value) => {
            let sentence = format!("{key} = {} is outside {range}", number(value));
            Err(ResponseError::new(key, value, sentence))
        }
    }
}

/// Rejects a list with a wrong number of elements.
fn counted(key: &'static str, count: usize, fits: bool, needed: &str) -> Result<(), ResponseError> {
    if fits {
        return Ok(());
    }
    let sentence = format!("{key} has {count} elements, but {needed} are required");
    Err(ResponseError::new(key, count as f64, sentence))
}

/// Checks the step and the samples of a history.
fn history(step_s: f64, samples: &[f64]) -> Result<(), ResponseError> {
    let is_step = |x: f64| x > 0.0 && x.is_finite();
    within("step_s", [step_s], is_step, "(0, inf)")?;
    let finite = f64::is_finite;
    within("samples", samples.iter().copied(), finite, "(-inf, inf)")
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
        Ok(spectrum::outside(step_s, samples, self.limits_hz()))
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
        let (samples_out, before, largest_gain) = self.output(step_s, samples)?;
        let mut differences = vec![0.0_f64; samples_out.len()];
        for (stride, factor) in DIFFERENCES {
            for first in 0..stride {
                let few: Vec<f64> = samples
                    .iter()
                    .copied()
                    .skip(first)
                    .step_by(stride)
                    .collect();
                // too coarse for these only: the estimate is then the output itself
                let coarse = self.output(stride as f64 * step_s, &few).ok();
                for (i, n) in (first..samples_out.len()).step_by(stride).enumerate() {
                    let of_few = coarse.as_ref().map_or(0.0, |(few, ..)| few[i]);
                    let difference = factor * (samples_out[n] - of_few).abs();
                    differences[n] = differences[n].max(difference);
                }
            }
        }
        let mut largest = before;
        let error = (0..samples_out.len()).map(|n| {
            let near = &differences[n..(n + NEAR).min(differences.len())];
            largest = near.iter().fold(largest, |a, &b| a.max(b));
            largest
        });
        Ok(Output {
            error: error.collect(),
            samples: samples_out,
            largest_gain,
        })
    }

    /// Samples of the output, the largest one before the first, and the largest gain.
    fn output(&self, step_s: f64, samples: &[f64]) -> Result<(Vec<f64>, f64, f64), ResponseError> {
        match self {
            Self::PolesZeros(rational) => {
                let (output, gain) = rational.output(step_s, samples)?;
                Ok((output, 0.0, gain))
            }
            Self::Tabulated(table) => Ok(spectrum::output(step_s, samples, 0, |f| table.at(f))),
            Self::Fir(filter) => {
                let steps = filter.steps(step_s)?;
                Ok(spectrum::output(step_s, samples, steps, |f| filter.at(f)))
            }
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
        spectrum::check_band(step_s, band_hz, self.limits_hz())?;
        match self {
            Self::PolesZeros(rational) => {
                let input = rational.input(step_s, samples)?;
                Ok(spectrum::in_band(step_s, &input, band_hz))
            }
            Self::Tabulated(table) => {
                spectrum::divided(step_s, samples, 0, band_hz, |f| table.at(f))
            }
            Self::Fir(filter) => {
                let steps = filter.steps(step_s)?;
                spectrum::divided(step_s, samples, steps, band_hz, |f| filter.at(f))
            }
        }
    }
}
