//! The amplitude spectrum of a force.

use crate::error::PlotError;
use crate::series::loaded;
use crate::words::with_unit;
use figure::{Axis, Layer, Panel, Style};
use formats::stored::StoredImpact;
use halfspace::bisected;
use std::f64::consts::PI;

/// Number of frequencies of a spectrum.
const FREQUENCIES: usize = 1200;

/// Largest number of samples from which a spectrum is computed.
const MOST_SPECTRUM_SAMPLES: usize = 20_000;

/// Spectra of forces, one curve per impact; a single one with its corner frequency and zeros.
pub(super) fn spectrum(impacts: &[StoredImpact], labels: &[String]) -> Result<Panel, PlotError> {
    let mut panel = Panel::new(
        Axis::logarithmic("frequency").si("Hz"),
        Axis::logarithmic("amplitude of the force").si("N s"),
    )
    .height(380.0);
    let mut plateau = 0.0_f64;
    let pulses = impacts.iter().map(|impact| {
        let pulse = ForcePulse::new(&impact.series.time_s, &impact.series.force_n);
        let found = pulse.frequencies();
        found.map(|frequencies| (pulse, frequencies))
    });
    let pulses: Vec<_> = pulses.collect();
    // several curves begin at the same frequency
    let lows = pulses.iter().flatten().map(|(_, [low, _])| *low);
    let low = lows.fold(f64::INFINITY, f64::min);
    for ((impact, label), pulse) in impacts.iter().zip(labels).zip(&pulses) {
        let Some((pulse, [_, high])) = pulse else {
            let hint = "it is zero throughout";
            return Err(PlotError::absent(impact.path(), "force", hint));
        };
        let points = pulse.spectrum([low, *high]);
        plateau = points.iter().map(|p| p.1).fold(plateau, f64::max);
        let name = if impacts.len() == 1 { "" } else { label };
        panel = panel.line(name, Style::Plain, points.clone());
        if impacts.len() > 1 {
            continue;
        }
        if let Some((corner, amplitude)) = pulse.corner(&points) {
            let text = format!("corner {}", with_unit(corner, "Hz"));
            panel = panel.layer(Layer::star((corner, amplitude), &text));
        }
        for (i, zero) in pulse.zeros(&points).into_iter().take(4).enumerate() {
            let word = if i == 0 { "zero " } else { "" };
            panel = panel.mark(zero, &format!("{word}{}", with_unit(zero, "Hz")));
        }
    }
    panel.y = panel.y.range(1e-5 * plateau, 2.0 * plateau);
    Ok(panel)
}

/// A force that is linear between samples, from its first to its last nonzero sample.
struct ForcePulse {
    time_s: Vec<f64>,
    force_n: Vec<f64>,
    /// Integral of the squared force divided by the square of the largest force, in s.
    squares_s: f64,
    /// Mean step in s of all samples, weighted by their share of that integral; 0 for zero force.
    step_s: f64,
}

impl ForcePulse {
    /// Selects the samples: of more than [`MOST_SPECTRUM_SAMPLES`], those with the largest deviation from straight
    /// lines.
    fn new(time_s: &[f64], force_n: &[f64]) -> Self {
        let range = loaded(force_n);
        let (time_s, force_n) = (&time_s[range.clone()], &force_n[range]);
        let largest = force_n.iter().fold(0.0_f64, |m, p| m.max(p.abs()));
        let (mut squares_s, mut weights) = (0.0, 0.0);
        for (t, p) in time_s.windows(2).zip(force_n.windows(2)) {
            let square = (p[0] * p[0] + p[0] * p[1] + p[1] * p[1]) / (3.0 * largest * largest);
            squares_s += (t[1] - t[0]) * square;
            weights += square;
        }
        let mut kept: Vec<usize> = (0..force_n.len()).collect();
        let mut missed_n = 1e-6 * largest;
        while kept.len() > MOST_SPECTRUM_SAMPLES && largest > 0.0 {
            kept = needed(time_s, force_n, missed_n);
            missed_n *= 2.0;
        }
        Self {
            time_s: kept.iter().map(|&i| time_s[i]).collect(),
            force_n: with_their_area(time_s, force_n, &kept),
            squares_s,
            step_s: squares_s / weights,
        }
    }

    /// |int P(t) exp(-2 pi i f t) dt|, exact for a piecewise linear force.
    ///
    /// ```text
    /// over a step from t of length h, with x = pi f h:  h exp(-2 pi i f (t + h/2)) [mean sinc x + i change/2 (cos x - sinc x)/x]
    /// ```
    fn amplitude(&self, frequency: f64) -> f64 {
        let (mut re, mut im) = (0.0, 0.0);
        for (t, p) in self.time_s.windows(2).zip(self.force_n.windows(2)) {
            let h = t[1] - t[0];
            let x = PI * frequency * h;
            let (mean, half) = (0.5 * (p[0] + p[1]), 0.5 * (p[1] - p[0]));
            let (sinc, odd) = if x < 1e-3 {
                (1.0 - x * x / 6.0, -x / 3.0)
            } else {
                (x.sin() / x, (x.cos() - x.sin() / x) / x)
            };
            let (sine, cosine) =
                (2.0 * PI * frequency * (t[0] - self.time_s[0] + 0.5 * h)).sin_cos();
            let (a, b) = (h * mean * sinc, h * half * odd);
            re += a * cosine + b * sine;
            im += b * cosine - a * sine;
        }
        re.hypot(im)
    }

    /// Limits of the frequency axis: far below the corner, and up to the resolution of the samples.
    ///
    /// The length of the pulse determines the upper end, not the length of its record. It is the length of Hertz's
    /// pulse with the same largest force and the same integral of the squared force.
    fn frequencies(&self) -> Option<[f64; 2]> {
        /// Length of Hertz's pulse divided by the integral of its squared force in units of the largest force: 3 pi/4.
        const HERTZ_LENGTH: f64 = 0.75 * PI;
        let whole_s = self.time_s[self.time_s.len() - 1] - self.time_s[0];
        if !(whole_s > 0.0 && self.squares_s > 0.0) {
            return None;
        }
        let length_s = (HERTZ_LENGTH * self.squares_s).min(whole_s);
        let samples = length_s / self.step_s;
        Some([0.02 / whole_s, (0.1 * samples).clamp(4.0, 20.0) / length_s])
    }

    /// Amplitudes over a range of frequencies.
    fn spectrum(&self, [low, high]: [f64; 2]) -> Vec<(f64, f64)> {
        let last = (FREQUENCIES - 1) as f64;
        (0..FREQUENCIES)
            .map(|i| low * (high / low).powf(i as f64 / last))
            .map(|frequency| (frequency, self.amplitude(frequency)))
            .collect()
    }

    /// The frequency at which the amplitude is half of the impulse.
    fn corner(&self, points: &[(f64, f64)]) -> Option<(f64, f64)> {
        let half = 0.5 * points.first()?.1;
        let below = points.iter().position(|p| p.1 < half)?;
        let (low, high) = (points[below.checked_sub(1)?].0, points[below].0);
        let corner = bisected(low, high, |frequency| self.amplitude(frequency) >= half);
        Some((corner, half))
    }

    /// Frequencies of minima that are deep enough to look like zeros in a picture.
    fn zeros(&self, points: &[(f64, f64)]) -> Vec<f64> {
        let is_least = |p: &&[(f64, f64)]| p[1].1 < p[0].1 && p[1].1 < p[2].1;
        let triples = points.windows(3).filter(is_least);
        let refined = triples.filter_map(|p| {
            let (mut low, mut high) = (p[0].0, p[2].0);
            for _ in 0..60 {
                let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
                if self.amplitude(a) < self.amplitude(b) {
                    high = b;
                } else {
                    low = a;
                }
            }
            let side = points.iter().filter(|q| q.0 > p[2].0 && q.0 < 1.5 * p[2].0);
            let lobe = side.map(|q| q.1).fold(0.0, f64::max);
            (self.amplitude(low) < 0.2 * lobe).then_some(low)
        });
        refined.collect()
    }
}

/// The samples that keep the error of straight lines between them below a force.
///
/// From each sample the line is extended as long as one slope fits all samples in between, which narrow the range of
/// slopes.
fn needed(time_s: &[f64], force_n: &[f64], missed_n: f64) -> Vec<usize> {
    let mut kept = vec![0];
    let (mut from, mut slopes) = (0, (f64::NEG_INFINITY, f64::INFINITY));
    for next in 1..force_n.len() {
        let length_s = time_s[next] - time_s[from];
        let slope = (force_n[next] - force_n[from]) / length_s;
        if !(slopes.0..=slopes.1).contains(&slope) {
            from = next - 1;
            kept.push(from);
            slopes = (f64::NEG_INFINITY, f64::INFINITY);
        }
        let length_s = time_s[next] - time_s[from];
        let slope = (force_n[next] - force_n[from]) / length_s;
        let reach = missed_n / length_s;
        slopes = (slopes.0.max(slope - reach), slopes.1.min(slope + reach));
    }
    kept.push(force_n.len() - 1);
    kept.dedup();
    kept
}

/// The selected samples, shifted such that the straight lines between them keep the integral over all samples.
/// Otherwise omitted noise would accumulate over a long record.
fn with_their_area(time_s: &[f64], force_n: &[f64], kept: &[usize]) -> Vec<f64> {
    let area = |i: usize, k: usize| 0.5 * (force_n[i] + force_n[k]) * (time_s[k] - time_s[i]);
    let mut missing = vec![0.0; kept.len()];
    let mut lengths_s = vec![0.0; kept.len()];
    for (i, ends) in kept.windows(2).enumerate() {
        let [from, to] = [ends[0], ends[1]];
        let all: f64 = (from..to).map(|k| area(k, k + 1)).sum();
        for end in [i, i + 1] {
            missing[end] += all - area(from, to);
            lengths_s[end] += time_s[to] - time_s[from];
        }
    }
    let parts = kept.iter().zip(missing.iter().zip(&lengths_s));
    let moved = parts
        .map(|(&i, (missing, length_s))| force_n[i] + missing / length_s.max(f64::MIN_POSITIVE));
    moved.collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
    use super::*;

    fn pulse(force: impl Fn(f64) -> f64, samples: usize) -> ForcePulse {
        let time_s: Vec<f64> = (0..=samples)
            .map(|i| 5e-6 * i as f64 / samples as f64)
            .collect();
        let force_n: Vec<f64> = time_s.iter().map(|t| force(t / 5e-6)).collect();
        ForcePulse::new(&time_s, &force_n)
    }

    #[test]
    fn a_triangle_has_the_spectrum_of_a_triangle() {
        // 10 N high: impulse times sinc^2 of half its length
        let triangle = pulse(|x| 10.0 * (1.0 - (2.0 * x - 1.0).abs()), 2);
        for frequency in [1.0, 3e4, 2e5, 7.3e5] {
            let x = PI * frequency * 2.5e-6;
            let exact = 2.5e-5 * (x.sin() / x).powi(2);
            assert!(
                (triangle.amplitude(frequency) - exact).abs() < 1e-14,
                "{frequency}"
            );
        }
    }

    #[test]
    fn hertz_pulse_has_its_zeros_at_seven_quarters_and_on() {
        // sin^1.5: 1/(Gamma(7/4 + x) Gamma(7/4 - x)) with x = f tc vanishes at 7/4, 11/4, ...
        let pulse = pulse(|x| (PI * x).sin().max(0.0).powf(1.5), 2000);
        let points = pulse.spectrum(pulse.frequencies().unwrap());
        let zeros = pulse.zeros(&points);
        for (zero, exact) in zeros.iter().zip([1.75, 2.75, 3.75]) {
            assert!((zero * 5e-6 / exact - 1.0).abs() < 1e-3, "{zero}");
        }
        assert!(zeros.len() >= 3);
        // where Gamma(7/4)^2/(Gamma(7/4 + x) Gamma(7/4 - x)) is one half
        let corner = pulse.corner(&points).map_or(0.0, |c| c.0);
        let gamma = |x: f64| stirling(x);
        let x = corner * 5e-6;
        let share = gamma(1.75).powi(2) / (gamma(1.75 + x) * gamma(1.75 - x));
        assert!((share - 0.5).abs() < 1e-3, "{x}: {share}");
    }

    #[test]
    fn a_long_record_is_as_its_pulse() {
        // the pulse at the end of a record 4000 times its length, with more samples than are used
        let force = |x: f64| (PI * x).sin().max(0.0).powf(1.5);
        let alone = pulse(force, 400);
        let step_s = 5e-6 / 400.0;
        let noise = |i: usize| 1e-4 * (1.7 * i as f64).sin();
        let time_s: Vec<f64> = (0..=400_000).map(|i| step_s * f64::from(i)).collect();
        let of = |(i, t): (usize, &f64)| {
            noise(i)
                + force((t - 4.9e-3) / 5e-6) * f64::from(u8::from((4.9e-3..4.905e-3).contains(t)))
        };
        let force_n: Vec<f64> = time_s.iter().enumerate().map(of).collect();
        let long = ForcePulse::new(&time_s, &force_n);
        assert!(long.time_s.len() <= MOST_SPECTRUM_SAMPLES);
        let [high, same] = [&long, &alone].map(|pulse| pulse.frequencies().unwrap()[1]);
        assert!((high / same - 1.0).abs() < 0.02, "{high} {same}");
        let corner = |pulse: &ForcePulse| {
            let points = pulse.spectrum(pulse.frequencies().unwrap());
            pulse.corner(&points).unwrap().0
        };
        let [found, known] = [&long, &alone].map(corner);
        assert!((found / known - 1.0).abs() < 0.02, "{found} {known}");
    }

    /// Gamma(x) for x > 0.5 to 1e-9, by recurrence and Stirling's series.
    fn stirling(x: f64) -> f64 {
        let mut product = 1.0;
        let mut x = x;
        while x < 10.0 {
            product *= x;
            x += 1.0;
        }
        let series = 1.0 / (12.0 * x) - 1.0 / (360.0 * x.powi(3)) + 1.0 / (1260.0 * x.powi(5));
        ((x - 0.5) * x.ln() - x + 0.5 * (2.0 * PI).ln() + series).exp() / product
    }
}
