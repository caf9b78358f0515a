//! How far a history differs from a reference.
//!
//! Both are read at common times by cubic interpolation. The shift s and the amplitude A minimise the distance of
//! `theirs(t + s)` from `A ours(t)`: the correlation of the rates of both has a peak near s, and Gauss and Newton's steps find it
//! between the samples.

use crate::error::OracleError;
use realfft::RealFftPlanner;
use realfft::num_complex::Complex64;

/// Samples in the common span that both histories need.
const FEWEST: usize = 16;

/// Largest number of samples that are compared: 64 MB for each spectrum.
const MOST_COMPARED: usize = 1 << 22;

/// Largest shift, as a part of the common span.
const LARGEST_SHIFT: f64 = 0.25;

/// Parts of the energy below and above the band whose spectra are compared.
const OUTSIDE_BAND: f64 = 0.05;

/// Gauss and Newton's steps; two are enough for smooth histories (`a_shift_between_samples_is_found`).
const STEPS: usize = 6;

/// A history: ascending times in s, and values.
#[derive(Debug, Clone, Copy)]
pub struct Record<'a> {
    /// Times in s.
    pub time_s: &'a [f64],
    /// Values in any unit.
    pub values: &'a [f64],
}

/// Limits of a comparison.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest relative L2 error.
    pub tolerance: f64,
    /// Largest shift in s, if histories are compared after the shift is removed.
    pub time_tolerance_s: Option<f64>,
}

/// A comparison of two histories.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// |theirs - ours|/|ours|, root mean squares over the common span.
    pub error: f64,
    /// Amplitude of theirs over ours after the shift, by least squares; negative for opposite signs.
    pub amplitude: f64,
    /// Delay of theirs in s.
    pub shift_s: f64,
    /// The error after the shift is removed.
    pub shifted_error: f64,
    /// The error of the amplitude spectrum in the band.
    pub spectral_error: f64,
    /// Frequencies in Hz between which the energy of ours is, without 5 % at each end.
    pub band_hz: [f64; 2],
    /// Whether the limits hold.
    pub passed: bool,
    /// Times in s that both were read at.
    pub time_s: Vec<f64>,
    /// Values of theirs and ours.
    pub values: [Vec<f64>; 2],
}

/// Compares theirs with ours, the reference.
///
/// ```
/// let time: Vec<f64> = (0..200).map(|i| f64::from(i) * 0.1).collect();
/// let at = |delay: f64| time.iter().map(|t| (-(t - delay) * (t - delay)).exp()).collect::<Vec<_>>();
/// let (late, own) = (at(8.03), at(8.0));
/// let record = |values| oracle::Record { time_s: &time, values };
/// let limits = oracle::Limits { tolerance: 0.05, time_tolerance_s: None };
/// let found = oracle::compare(record(&late), record(&own), limits)?;
/// assert!((found.shift_s - 0.03).abs() < 1e-4 && (found.amplitude - 1.0).abs() < 1e-4);
/// # Ok::<(), oracle::OracleError>(())
/// ```
///
/// # Errors
/// [`OracleError`] for too few samples in the common span, a constant history and numbers that are not finite.
pub fn compare(
    theirs: Record<'_>,
    ours: Record<'_>,
    limits: Limits,
) -> Result<Comparison, OracleError> {
    let both = [theirs, ours];
    for (record, whose) in both.into_iter().zip(["theirs", "ours"]) {
        record.check(whose)?;
    }
    let from_s = both
        .map(Record::start_s)
        .into_iter()
        .fold(f64::NEG_INFINITY, f64::max);
    let to_s = both
        .map(Record::end_s)
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    let counts = both.map(|record| {
        record
            .time_s
            .iter()
            .filter(|&&t| t >= from_s && t <= to_s)
            .count()
    });
    let count = counts[0].min(counts[1]);
    if count < FEWEST {
        let spans = both.map(|record| format!("{:e} to {:e} s", record.start_s(), record.end_s()));
        let sentence = format!(
            "only {count} samples in the common time, but {FEWEST} are needed: theirs is from {}, ours from {}",
            spans[0], spans[1]
        );
        return Err(OracleError::new("time", sentence));
    }
    let step_s = (to_s - from_s) / (count.min(MOST_COMPARED) - 1) as f64;
    let time_s: Vec<f64> = (0..count.min(MOST_COMPARED))
        .map(|i| (from_s + i as f64 * step_s).min(to_s))
        .collect();
    let values = both.map(|record| time_s.iter().map(|&t| record.at(t)).collect::<Vec<f64>>());
    let [a, b] = &values;
    let (shift_s, amplitude) = shift(theirs, a, b, (from_s, step_s));
    let inside: Vec<usize> = (0..time_s.len())
        .filter(|&i| theirs.contains(time_s[i] + shift_s))
        .collect();
    let shifted: Vec<f64> = inside
        .iter()
        .map(|&i| theirs.at(time_s[i] + shift_s))
        .collect();
    let own: Vec<f64> = inside.iter().map(|&i| b[i]).collect();
    let (error, shifted_error) = (distance(a, b), distance(&shifted, &own));
    let (spectral_error, band_hz) = spectral(a, b, step_s);
    let passed = match limits.time_tolerance_s {
        None => error <= limits.tolerance,
        Some(most_s) => shifted_error <= limits.tolerance && shift_s.abs() <= most_s,
    };
    Ok(Comparison {
        error,
        amplitude,
        shift_s,
        shifted_error,
        spectral_error,
        band_hz,
        passed,
        time_s,
        values,
    })
}

impl Record<'_> {
    fn start_s(self) -> f64 {
        self.time_s[0]
    }

    fn end_s(self) -> f64 {
        self.time_s[self.time_s.len() - 1]
    }

    fn contains(self, t: f64) -> bool {
        t >= self.start_s() && t <= self.end_s()
    }

    /// Rejects histories without a change, and samples that are not numbers at ascending times.
    fn check(self, whose: &str) -> Result<(), OracleError> {
        let fault = |sentence: String| Err(OracleError::new(whose, sentence));
        if self.time_s.len() != self.values.len() || self.time_s.len() < FEWEST {
            return fault(format!(
                "{whose} has {} samples, but {FEWEST} are needed",
                self.values.len()
            ));
        }
        if let Some(i) = self.values.iter().position(|x| !x.is_finite()) {
            return fault(format!(
                "{whose} is {} at {:e} s: cut or interpolate such samples",
                self.values[i], self.time_s[i]
            ));
        }
        // not a number fails as well
        if let Some(pair) = self
            .time_s
            .windows(2)
            .find(|pair| !(pair[1] > pair[0] && pair[1].is_finite()))
        {
            return fault(format!(
                "the times of {whose} must ascend, but {:e} s follows {:e} s",
                pair[1], pair[0]
            ));
        }
        if self.values.iter().all(|x| *x == self.values[0]) {
            return fault(format!(
                "{whose} is {} at all times: a constant cannot be compared",
                self.values[0]
            ));
        }
        Ok(())
    }

    /// The value at a time in its span, of the cubic through the four samples around it.
    fn at(self, t: f64) -> f64 {
        let count = self.time_s.len();
        let first = self.time_s.partition_point(|&x| x <= t).clamp(2, count - 2) - 2;
        let nodes = &self.time_s[first..first + 4];
        let weight = |i: usize| -> f64 {
            let others = (0..4).filter(|&j| j != i);
            others
                .map(|j| (t - nodes[j]) / (nodes[i] - nodes[j]))
                .product()
        };
        (0..4).map(|i| weight(i) * self.values[first + i]).sum()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// |a - b|/|b|.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let off: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    (dot(&off, &off) / dot(b, b)).sqrt()
}

/// The delay of theirs and its amplitude; a and b are theirs and ours at times from `from_s` on.
fn shift(theirs: Record<'_>, a: &[f64], b: &[f64], (from_s, step_s): (f64, f64)) -> (f64, f64) {
    let rates = [a, b].map(|x| {
        x.windows(2)
            .map(|pair| pair[1] - pair[0])
            .collect::<Vec<f64>>()
    });
    let length = (2 * a.len()).next_power_of_two();
    let [of_a, of_b] = rates.map(|rates| spectrum(rates, length));
    let mut product: Vec<Complex64> = of_a.iter().zip(&of_b).map(|(a, b)| a * b.conj()).collect();
    // numbers that rounding left at both ends
    product[0].im = 0.0;
    product[length / 2].im = 0.0;
    let inverse = RealFftPlanner::new().plan_fft_inverse(length);
    let mut correlation = inverse.make_output_vec();
    if inverse.process(&mut product, &mut correlation).is_err() {
        return (0.0, 1.0);
    }
    let most = (LARGEST_SHIFT * a.len() as f64) as isize;
    let at = |lag: isize| correlation[lag.rem_euclid(length as isize) as usize];
    let best = (-most..=most)
        .max_by(|x, y| at(*x).abs().total_cmp(&at(*y).abs()))
        .unwrap_or(0);
    let (mut shift_s, mut amplitude) = (best as f64 * step_s, 1.0);
    for _ in 0..STEPS {
        let (mut moved, mut slope, mut own) = (Vec::new(), Vec::new(), Vec::new());
        for (i, b) in b.iter().enumerate() {
            let t = from_s + i as f64 * step_s + shift_s;
            if theirs.contains(t - 0.5 * step_s) && theirs.contains(t + 0.5 * step_s) {
                moved.push(theirs.at(t));
                slope.push((theirs.at(t + 0.5 * step_s) - theirs.at(t - 0.5 * step_s)) / step_s);
                own.push(*b);
            }
        }
        let size = dot(&own, &own);
        amplitude = dot(&moved, &own) / size;
        let along = dot(&slope, &own) / size;
        let across: Vec<f64> = slope
            .iter()
            .zip(&own)
            .map(|(slope, own)| slope - along * own)
            .collect();
        let change_s = dot(&moved, &across) / dot(&across, &across);
        if change_s.is_nan() || change_s.abs() > step_s {
            break;
        }
        shift_s -= change_s;
    }
    (shift_s, amplitude)
}

/// The spectrum of samples, followed by zeros up to a length.
fn spectrum(mut samples: Vec<f64>, length: usize) -> Vec<Complex64> {
    samples.resize(length, 0.0);
    let forward = RealFftPlanner::new().plan_fft_forward(length);
    let mut found = forward.make_output_vec();
    match forward.process(&mut samples, &mut found) {
        Ok(()) => found,
        Err(_) => vec![Complex64::default(); length / 2 + 1],
    }
}

/// Error of the amplitude spectrum of a in the band of b, and that band in Hz. The line between the ends of b is subtracted from
/// both, so that a history that does not return to zero has no step at its end.
fn spectral(a: &[f64], b: &[f64], step_s: f64) -> (f64, [f64; 2]) {
    let last = b.len() - 1;
    let line = |i: usize| b[0] + (b[last] - b[0]) * i as f64 / last as f64;
    let length = (2 * b.len()).next_power_of_two();
    let [a, b] = [a, b].map(|x| {
        let bent = x.iter().enumerate().map(|(i, x)| x - line(i)).collect();
        spectrum(bent, length)
            .iter()
            .map(|c| c.norm())
            .collect::<Vec<f64>>()
    });
    let total = dot(&b, &b);
    let mut until = 0.0;
    let within = |x: &f64| {
        until += x * x;
        (OUTSIDE_BAND * total..=(1.0 - OUTSIDE_BAND) * total).contains(&until)
    };
    let inside: Vec<bool> = b.iter().map(within).collect();
    let peak = (0..b.len())
        .max_by(|&i, &j| b[i].total_cmp(&b[j]))
        .unwrap_or(0);
    let first = inside.iter().position(|&is| is).unwrap_or(peak);
    let end = inside.iter().rposition(|&is| is).unwrap_or(peak) + 1;
    let band_hz = [first, end - 1].map(|k| k as f64 / (length as f64 * step_s));
    (distance(&a[first..end], &b[first..end]), band_hz)
}
