//! Factors of the spectrum of a record, and bands.

use super::{ResponseError, history};
use fault::{number, rounded};
use num_complex::Complex64;
use realfft::RealFftPlanner;
use std::f64::consts::PI;

/// Length of a transform relative to its record: what a response spreads over three records does not come round to the
/// first. Twice would be enough for a filter; the slow decay of a table that ends abruptly is halved by each doubling.
const PADDING: usize = 4;
/// Part of a step of frequency by which a frequency may exceed a limit because of rounding.
pub(super) const ROUNDED: f64 = 1e-9;

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
pub(super) fn taper([f1, f2, f3, f4]: [f64; 4], f: f64) -> f64 {
    let cosine = |part: f64| 0.5 - 0.5 * (PI * part.clamp(0.0, 1.0)).cos();
    cosine((f - f1) / (f2 - f1)) * cosine((f4 - f) / (f4 - f3))
}

/// [`band_pass`] of a checked band.
pub(super) fn in_band(step_s: f64, samples: &[f64], band_hz: [f64; 4]) -> Vec<f64> {
    let mut all = filtered(step_s, samples, 0, |f| taper(band_hz, f).into());
    all.truncate(samples.len());
    all
}

/// The samples times a factor of each frequency, with zeros after them: three times their number, and twice the length of a
/// filter in steps.
pub(super) fn filtered(
    step_s: f64,
    samples: &[f64],
    length: usize,
    mut factor: impl FnMut(f64) -> Complex64,
) -> Vec<f64> {
    let size = (PADDING * samples.len() + 2 * length)
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
