//! Responses and bands as factors of the spectrum of a record, and the response of a digital filter.

use super::{ResponseError, counted, history, within};
use fault::{number, rounded};
use num_complex::Complex64;
use realfft::RealFftPlanner;
use std::f64::consts::{PI, TAU};

/// A digital filter: output k is the sum of its coefficients times the inputs before.
#[derive(Debug, Clone, PartialEq)]
pub struct Fir {
    coefficients: Vec<f64>,
    rate_hz: f64,
}

/// Largest number of coefficients.
const MOST_COEFFICIENTS: usize = 1 << 16;
/// Largest length of a filter in steps of a history: the transform of so many needs 1 GB.
const MOST_STEPS: f64 = 16_777_216.0;
/// Length of a transform relative to its record: what a response spreads over three records does not come round to the
/// first. Twice would be enough for a filter; the slow decay of a table that ends abruptly is halved by each doubling.
const PADDING: usize = 4;
/// Part of a step of frequency by which a frequency may exceed a limit because of rounding.
const ROUNDED: f64 = 1e-9;

impl Fir {
    /// A filter of coefficients at times 0, 1, 2, .. over the rate in Hz.
    ///
    /// # Errors
    /// [`ResponseError`] without coefficients, or for numbers out of range.
    pub fn new(coefficients: Vec<f64>, rate_hz: f64) -> Result<Self, ResponseError> {
        let count = coefficients.len();
        let fits = (1..=MOST_COEFFICIENTS).contains(&count);
        let needed = format!("1 to {MOST_COEFFICIENTS}");
        counted("response.coefficients", count, fits, &needed)?;
        let finite = f64::is_finite;
        within(
            "response.coefficients",
            coefficients.iter().copied(),
            finite,
            "(-inf, inf)",
        )?;
        let positive = |x: f64| x > 0.0 && x.is_finite();
        within("response.rate_hz", [rate_hz], positive, "(0, inf)")?;
        Ok(Self {
            coefficients,
            rate_hz,
        })
    }

    /// The coefficients.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// The rate in Hz.
    pub fn rate_hz(&self) -> f64 {
        self.rate_hz
    }

    /// Its length in steps.
    pub(super) fn steps(&self, step_s: f64) -> Result<usize, ResponseError> {
        let length_s = self.coefficients.len() as f64 / self.rate_hz;
        let least_s = length_s / MOST_STEPS;
        if step_s >= least_s {
            return Ok((length_s / step_s) as usize);
        }
        let [step, length, least] = [step_s, length_s, least_s].map(rounded);
        let sentence = format!(
            "step_s = {step} is too small for a filter of {length} s: use at least {least} s, or resample the filter"
        );
        Err(ResponseError::new("step_s", step_s, sentence))
    }

    /// sum_k c_k e^{-2 pi i f k/rate} up to half the rate.
    pub(super) fn at(&self, frequency_hz: f64) -> Complex64 {
        if frequency_hz.abs() > 0.5 * self.rate_hz * (1.0 + ROUNDED) {
            return Complex64::default();
        }
        let turn = Complex64::from_polar(1.0, -TAU * frequency_hz / self.rate_hz);
        let coefficients = self.coefficients.iter().rev();
        coefficients.fold(Complex64::default(), |sum, c| sum * turn + c)
    }
}

/// Samples of a history in a band of frequencies, without a change of phase: zero below f1 and above f4, a cosine taper from
/// f1 to f2 and from f3 to f4, one between, in Hz.
///
/// The record has zeros before and after it, at least three times its length; no other taper and no mean removed.
///
/// # Errors
/// [`ResponseError`] about the band, the step or a sample.
pub fn band_pass(
    step_s: f64,
    samples: &[f64],
    band_hz: [f64; 4],
) -> Result<Vec<f64>, ResponseError> {
    history(step_s, samples)?;
    check_band(step_s, band_hz, [0.0, f64::INFINITY])?;
    Ok(in_band(step_s, samples, band_hz))
}

/// Rejects a band that does not ascend, or that is not within the samples' and the response's frequencies.
pub(super) fn check_band(
    step_s: f64,
    band_hz: [f64; 4],
    [least, most]: [f64; 2],
) -> Result<(), ResponseError> {
    let most = most.min(0.5 / step_s);
    let ascends = band_hz.windows(2).all(|pair| pair[0] < pair[1]);
    if ascends && band_hz[0] >= least && band_hz[3] <= most * (1.0 + ROUNDED) {
        return Ok(());
    }
    let (band, [least, most]) = (band_hz.map(number).join(", "), [least, most].map(rounded));
    let sentence = format!(
        "band = [{band}] Hz must ascend within [{least}, {most}]: half the sampling rate is the highest frequency of the samples, and a response has nothing outside its table or above half its rate"
    );
    Err(ResponseError::new("band", None, sentence))
}

/// The factor of a band at a frequency.
fn taper([f1, f2, f3, f4]: [f64; 4], f: f64) -> f64 {
    let cosine = |part: f64| 0.5 - 0.5 * (PI * part.clamp(0.0, 1.0)).cos();
    cosine((f - f1) / (f2 - f1)) * cosine((f4 - f) / (f4 - f3))
}

/// [`band_pass`] of a checked band.
pub(super) fn in_band(step_s: f64, samples: &[f64], band_hz: [f64; 4]) -> Vec<f64> {
    let mut all = filtered(step_s, samples, 0, |f| taper(band_hz, f).into());
    all.truncate(samples.len());
    all
}

/// The output at the samples, the largest magnitude before the first, and the largest gain.
pub(super) fn output(
    step_s: f64,
    samples: &[f64],
    more: usize,
    at: impl Fn(f64) -> Complex64,
) -> (Vec<f64>, f64, f64) {
    let count = samples.len();
    let mut all = filtered(step_s, samples, more, &at);
    let largest = |part: &[f64]| part.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    // the last quarter of the transform comes before the record
    let before = largest(&all[all.len() - all.len() / 4..]);
    let mut impulse = vec![0.0; count];
    impulse.iter_mut().take(1).for_each(|x| *x = 1.0);
    let gain = filtered(step_s, &impulse, more, &at)
        .iter()
        .map(|x| x.abs())
        .sum();
    all.truncate(count);
    (all, before, gain)
}

/// The spectrum of the samples divided by a response inside a band.
pub(super) fn divided(
    step_s: f64,
    samples: &[f64],
    more: usize,
    band_hz: [f64; 4],
    at: impl Fn(f64) -> Complex64,
) -> Result<Vec<f64>, ResponseError> {
    let mut zero = None;
    let mut all = filtered(step_s, samples, more, |f| {
        let part = taper(band_hz, f);
        let factor = at(f);
        if part == 0.0 {
            return Complex64::default();
        }
        if factor.norm() == 0.0 {
            zero = Some(f);
        }
        part / factor
    });
    all.truncate(samples.len());
    match zero {
        None => Ok(all),
        Some(frequency_hz) => {
            let sentence = format!(
                "the response is zero at {} Hz and cannot be removed there: use a band without this frequency",
                rounded(frequency_hz)
            );
            Err(ResponseError::new("band", frequency_hz, sentence))
        }
    }
}

/// Fraction of the energy of samples outside two frequencies.
pub(super) fn outside(step_s: f64, samples: &[f64], [least, most]: [f64; 2]) -> f64 {
    let energy = |samples: Vec<f64>| samples.iter().map(|x| x * x).sum::<f64>();
    let all = energy(filtered(step_s, samples, 0, |_| 1.0.into()));
    let is_outside = |f: f64| f < least || f > most * (1.0 + ROUNDED);
    let part = |f: f64| Complex64::from(f64::from(u8::from(is_outside(f))));
    if all == 0.0 {
        return 0.0;
    }
    (energy(filtered(step_s, samples, 0, part)) / all).min(1.0)
}

/// The samples with zeros after them, `more` at least and three times their number, times a factor of each frequency.
fn filtered(
    step_s: f64,
    samples: &[f64],
    more: usize,
    mut factor: impl FnMut(f64) -> Complex64,
) -> Vec<f64> {
    let size = (PADDING * samples.len() + 2 * more)
        .next_power_of_two()
        .max(2);
    let mut planner = RealFftPlanner::new();
    let forward = planner.plan_fft_forward(size);
    let backward = planner.plan_fft_inverse(size);
    let mut time = forward.make_input_vec();
    time[..samples.len()].copy_from_slice(samples);
    let mut values = forward.make_output_vec();
    // the lengths are those of the plan
    let done = forward.process(&mut time, &mut values);
    debug_assert!(done.is_ok());
    let last = values.len() - 1;
    for (k, value) in values.iter_mut().enumerate() {
        *value *= factor(k as f64 / (size as f64 * step_s)) / size as f64;
        // the spectrum of real samples is real there
        if k == 0 || k == last {
            value.im = 0.0;
        }
    }
    // a spectrum that is not finite is all that can be wrong
    let _ = backward.process(&mut values, &mut time);
    time
}
