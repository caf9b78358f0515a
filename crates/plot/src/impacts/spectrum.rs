//! Amplitude spectra of a force and of the histories that it causes.

use crate::error::{PlotError, chosen};
use crate::impacts::histories::{FEW_PROBES, place, sensor_words};
use crate::request::Request;
use crate::series::loaded;
use crate::words::{component, of_quantity, with_unit};
use figure::{Axis, Layer, Panel, Style};
use formats::quantities::Described;
use formats::stored::StoredImpact;
use halfspace::bisected;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Number of frequencies of a spectrum.
const FREQUENCIES: usize = 1200;

/// Largest number of samples from which a spectrum is computed.
const MOST_SPECTRUM_SAMPLES: usize = 20_000;

/// Decades of amplitude below the largest that a spectrum shows.
const SHOWN: f64 = 1e-5;

/// The spectrum of the force, and of a single impact next to it those of the first probes: the quantities that a picture of
/// probes shows.
pub(super) fn spectra(
    impacts: &[StoredImpact],
    labels: &[String],
    request: &Request,
) -> Result<Vec<Panel>, PlotError> {
    let (force, source) = of_forces(impacts, labels)?;
    let [impact] = impacts else {
        return Ok(vec![force]);
    };
    let mut panels = vec![force];
    for sensor in impact.sensors()?.into_iter().take(FEW_PROBES) {
        let words = sensor_words(&sensor);
        let curves = [(String::new(), sensor.output)];
        let labels = (words.as_str(), sensor.unit.as_str());
        let panel = of_histories(labels, &impact.series.time_s, &curves, &source);
        let title = place(sensor.r_m, sensor.z_m);
        panels.extend(panel.map(|panel| panel.title(&title)));
    }
    let Some(probes) = impact.probes()? else {
        return Ok(panels);
    };
    let known = probes.quantities();
    let usual = ["displacement_z", "displacement_r"];
    let shown = chosen(impact.path(), &known, &request.quantities, &usual)?;
    for probe in 0..probes.r_m.len().min(FEW_PROBES) {
        let mut by_unit: Vec<Vec<&Described>> = Vec::new();
        for quantity in shown.iter().map(|&number| &known[number]) {
            match by_unit.iter_mut().find(|of| of[0].unit == quantity.unit) {
                Some(of_unit) => of_unit.push(quantity),
                None => by_unit.push(vec![quantity]),
            }
        }
        for of_unit in by_unit {
            let mut curves = Vec::new();
            for quantity in &of_unit {
                let samples = probes.trace(&quantity.name, probe)?;
                curves.push((component(&quantity.name), samples));
            }
            let name = match &of_unit[..] {
                [single] => of_quantity(&single.name),
                several => several[0].name.split('_').take(1).collect(),
            };
            let labels = (name.as_str(), of_unit[0].unit.as_str());
            let panel = of_histories(labels, &impact.series.time_s, &curves, &source);
            let title = place(probes.r_m[probe], probes.z_m[probe]);
            panels.extend(panel.map(|panel| panel.title(&title)));
        }
    }
    Ok(panels)
}

/// The part of a spectrum that its source decides: the limits of the frequency axis in Hz, the corner (-3 dB) if there is one, and
/// the first zeros.
pub(super) struct Source {
    limits_hz: [f64; 2],
    corner_hz: Option<f64>,
    zeros_hz: Vec<f64>,
}

/// A panel with the spectra of some histories, each with its name, over the frequencies of their source, whose corner and zeros are
/// marked; none if all are zero. `quantity` has a name and a unit.
pub(super) fn of_histories(
    (quantity, unit): (&str, &str),
    time_s: &[f64],
    curves: &[(String, Vec<f64>)],
    source: &Source,
) -> Option<Panel> {
    let spectra = curves.iter().filter_map(|(name, samples)| {
        let history = History::new(time_s, samples);
        (history.squares_s > 0.0).then(|| (name, history.spectrum(source.limits_hz)))
    });
    let spectra: Vec<_> = spectra.collect();
    let all = spectra.iter().flat_map(|(_, points)| points);
    let largest = all.map(|point| point.1).fold(0.0, f64::max);
    let unit = match unit {
        "1" => "s".to_owned(),
        unit => format!("{unit} s"),
    };
    let mut panel = empty(&format!("amplitude of the {quantity}"), &unit, largest);
    for (name, points) in &spectra {
        let name = if curves.len() == 1 { "" } else { name };
        panel = panel.line(name, Style::Plain, points.clone());
    }
    if let Some(corner_hz) = source.corner_hz {
        panel = panel.mark(corner_hz, "corner of the force");
    }
    for (i, zero_hz) in source.zeros_hz.iter().enumerate() {
        panel = panel.mark(*zero_hz, if i == 0 { "zero" } else { "" });
    }
    (!spectra.is_empty()).then_some(panel)
}

fn empty(quantity: &str, unit: &str, largest: f64) -> Panel {
    let (frequency, amplitude) = (
        Axis::logarithmic("frequency").si("Hz"),
        Axis::logarithmic(quantity).si(unit),
    );
    let mut panel = Panel::new(frequency, amplitude).height(380.0);
    panel.y = panel.y.range(SHOWN * largest, 2.0 * largest);
    panel
}

/// Spectra of forces, one curve per impact; a single one with its corner frequency and zeros.
fn of_forces(impacts: &[StoredImpact], labels: &[String]) -> Result<(Panel, Source), PlotError> {
    let mut pulses = Vec::new();
    for impact in impacts {
        let pulse = History::new(&impact.series.time_s, &impact.series.force_n);
        let Some(limits) = pulse.frequencies() else {
            let hint = "it is zero throughout";
            return Err(PlotError::absent(impact.path(), "force", hint));
        };
        pulses.push((pulse, limits));
    }
    // several curves begin at the same frequency
    let lows = pulses.iter().map(|(_, [low, _])| *low);
    let low = lows.fold(f64::INFINITY, f64::min);
    let mut source = Source {
        limits_hz: [low, pulses[0].1[1]],
        corner_hz: None,
        zeros_hz: Vec::new(),
    };
    let spectra = pulses
        .iter()
        .map(|(pulse, [_, high])| pulse.spectrum([low, *high]));
    let spectra: Vec<_> = spectra.collect();
    let all = spectra.iter().flatten();
    let plateau = all.map(|point| point.1).fold(0.0, f64::max);
    let mut panel = empty("amplitude of the force", "N s", plateau);
    for (points, label) in spectra.iter().zip(labels) {
        let name = if impacts.len() == 1 { "" } else { label };
        panel = panel.line(name, Style::Plain, points.clone());
    }
    if let ([(pulse, _)], [points]) = (&pulses[..], &spectra[..]) {
        if let Some((corner, amplitude)) = pulse.corner(points) {
            let text = format!("corner {} (\u{2212}3 dB)", with_unit(corner, "Hz"));
            panel = panel.layer(Layer::star((corner, amplitude), &text));
            source.corner_hz = Some(corner);
        }
        source.zeros_hz = pulse.zeros(points);
        source.zeros_hz.truncate(4);
        for (i, &zero) in source.zeros_hz.iter().enumerate() {
            let word = if i == 0 { "zero " } else { "" };
            panel = panel.mark(zero, &format!("{word}{}", with_unit(zero, "Hz")));
        }
    }
    Ok((panel, source))
}

/// A force or another history that is linear between samples, from its first to its last nonzero sample.
struct History {
    time_s: Vec<f64>,
    values: Vec<f64>,
    /// Integral of the squared values divided by the square of the largest, in s; 0 if all are zero.
    squares_s: f64,
    /// Mean step in s of all samples, weighted by their share of that integral.
    step_s: f64,
}

impl History {
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
            values: with_their_area(time_s, force_n, &kept),
            squares_s: if largest > 0.0 { squares_s } else { 0.0 },
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
        for (t, p) in self.time_s.windows(2).zip(self.values.windows(2)) {
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

    /// Limits of the frequency axis: far below the corner, and up to six over the length of the pulse, beyond its first zeros.
    ///
    /// The length of the pulse determines both, not the length of its record. It is the length of Hertz's pulse with the same
    /// largest force and the same integral of the squared force. A record of few samples in a pulse shows less.
    fn frequencies(&self) -> Option<[f64; 2]> {
        /// Length of Hertz's pulse divided by the integral of its squared force in units of the largest force: 3 pi/4.
        const HERTZ_LENGTH: f64 = 0.75 * PI;
        const LIMITS: [f64; 2] = [0.02, 6.0];
        let whole_s = self.time_s[self.time_s.len() - 1] - self.time_s[0];
        if !(whole_s > 0.0 && self.squares_s > 0.0) {
            return None;
        }
        let length_s = (HERTZ_LENGTH * self.squares_s).min(whole_s);
        let samples = length_s / self.step_s;
        Some([
            LIMITS[0] / length_s,
            LIMITS[1].min(0.5 * samples) / length_s,
        ])
    }

    /// Amplitudes over a range of frequencies.
    fn spectrum(&self, [low, high]: [f64; 2]) -> Vec<(f64, f64)> {
        let last = (FREQUENCIES - 1) as f64;
        (0..FREQUENCIES)
            .map(|i| low * (high / low).powf(i as f64 / last))
            .map(|frequency| (frequency, self.amplitude(frequency)))
            .collect()
    }

    /// The frequency at which the energy is half of that at 0 Hz, and the amplitude there.
    fn corner(&self, points: &[(f64, f64)]) -> Option<(f64, f64)> {
        let part = FRAC_1_SQRT_2 * self.amplitude(0.0);
        let below = points.iter().position(|p| p.1 < part)?;
        let (low, high) = (points[below.checked_sub(1)?].0, points[below].0);
        let corner = bisected(low, high, |frequency| self.amplitude(frequency) >= part);
        Some((corner, part))
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

    fn pulse(force: impl Fn(f64) -> f64, samples: usize) -> History {
        let time_s: Vec<f64> = (0..=samples)
            .map(|i| 5e-6 * i as f64 / samples as f64)
            .collect();
        let force_n: Vec<f64> = time_s.iter().map(|t| force(t / 5e-6)).collect();
        History::new(&time_s, &force_n)
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
    fn a_sine_to_the_power_of_one_and_a_half_has_its_zeros_at_seven_quarters_and_on() {
        // sin^1.5: 1/(Gamma(7/4 + x) Gamma(7/4 - x)) with x = f tc vanishes at 7/4, 11/4, ...
        let pulse = pulse(|x| (PI * x).sin().max(0.0).powf(1.5), 2000);
        let points = pulse.spectrum(pulse.frequencies().unwrap());
        let zeros = pulse.zeros(&points);
        for (zero, exact) in zeros.iter().zip([1.75, 2.75, 3.75]) {
            assert!((zero * 5e-6 / exact - 1.0).abs() < 1e-3, "{zero}");
        }
        assert!(zeros.len() >= 3);
        // -3 dB by Gamma functions: states of a pulse sin^1.5
        let corner = pulse.corner(&points).map_or(0.0, |c| c.0);
        assert!(
            (corner * 5e-6 / 0.659_927_21 - 1.0).abs() < 1e-4,
            "{corner}"
        );
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
        let long = History::new(&time_s, &force_n);
        assert!(long.time_s.len() <= MOST_SPECTRUM_SAMPLES);
        let [high, same] = [&long, &alone].map(|pulse| pulse.frequencies().unwrap()[1]);
        assert!((high / same - 1.0).abs() < 0.02, "{high} {same}");
        let corner = |pulse: &History| {
            let points = pulse.spectrum(pulse.frequencies().unwrap());
            pulse.corner(&points).unwrap().0
        };
        let [found, known] = [&long, &alone].map(corner);
        assert!((found / known - 1.0).abs() < 0.02, "{found} {known}");
    }
}
