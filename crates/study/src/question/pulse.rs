//! The exact response to a smooth pulse: the convolution integral by Gauss rules between the arrivals.
//!
//! ```text
//! u(t) = P(t) static + int_0^t P'(t - x) R(x) dx,     P = sin^4(pi t/T)
//! ```
//!
//! No cells, no samples of the force: it shares only R with what it judges.

use crate::StudyError;
use crate::measure::{Candidate, Effort, Scene};
use crate::record::{Question, Record};
use halfspace::gauss::Rule;
use halfspace::{Arrivals, Kernel, Medium, Profile, Six};
use lookup::PulseSum;
use std::f64::consts::PI;

/// A pulse at a point and its exact response at a few times.
#[derive(Debug)]
pub(crate) struct PulseReference {
    pub(crate) place: [f64; 2],
    pub(crate) length: f64,
    pub(crate) times: Vec<f64>,
    exact: Vec<Six>,
    peak: Six,
}

impl PulseReference {
    /// At `count` multiples of `every` until a while after pulse and waves have passed.
    pub(crate) fn new(
        medium: &Medium,
        [r, z]: [f64; 2],
        length: f64,
        every: f64,
        count: usize,
    ) -> Result<Self, StudyError> {
        let kernel = Kernel::new(medium, Profile::Hertz, 1e-12)?;
        let arrivals = Arrivals::new(medium, Profile::Hertz, r, z)?;
        let rest = kernel.static_field(r, z)?;
        let last = (0.5 * length).max(arrivals.last()) + 0.7 * length;
        let stride = (last / every / count as f64).ceil().max(1.0);
        let times: Vec<f64> = (1..=count).map(|i| i as f64 * stride * every).collect();
        let end = times.last().copied().unwrap_or(0.0);
        let mut cuts = arrivals.sorted();
        cuts.extend([0.0, end]);
        // panels no longer than a sixteenth of the pulse
        cuts.extend(
            (1..)
                .map(|i| f64::from(i) * length / 16.0)
                .take_while(|&x| x < end),
        );
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
        cuts.retain(|&x| x <= end);
        let rule = Rule::new(14);
        let mut exact: Vec<Six> = times
            .iter()
            .map(|&t| rest.map(|s| force(t, length) * s))
            .collect();
        for pair in cuts.windows(2) {
            let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
            for (x, weight) in rule.on(-1.0, 1.0) {
                // absorbs square roots at the arrivals
                let place = middle + half * 0.5 * x * (3.0 - x * x);
                let weight = weight * half * 1.5 * (1.0 - x * x);
                let value = kernel.remainder(r, z, place)?.value;
                for (u, &t) in exact.iter_mut().zip(&times) {
                    let slope = weight * slope(t - place, length);
                    for f in 0..6 {
                        u[f] += slope * value[f];
                    }
                }
            }
        }
        let peak = std::array::from_fn(|f| exact.iter().fold(0.0_f64, |a, u| a.max(u[f].abs())));
        Ok(Self {
            place: [r, z],
            length,
            times,
            exact,
            peak,
        })
    }

    /// The last of the times.
    pub(crate) fn end(&self) -> f64 {
        self.times.last().copied().unwrap_or(1.0)
    }

    /// Samples that are needed at a width.
    pub(crate) fn count(&self, width: f64) -> usize {
        (self.end() / width).round() as usize + 1
    }

    /// Whether samples `width` apart meet the times.
    pub(crate) fn meets(&self, width: f64) -> bool {
        let off = |t: &f64| ((t / width).round() * width - t).abs();
        self.times.iter().all(|t| off(t) <= 1e-9 * t)
    }

    /// Relative errors of samples `width` apart.
    pub(crate) fn errors(&self, samples: &[Six], width: f64) -> Vec<f64> {
        let pairs = self.exact.iter().zip(&self.times);
        pairs
            .flat_map(|(exact, t)| {
                let value = samples[(t / width).round() as usize];
                (0..6).map(move |f| (value[f] - exact[f]) / self.peak[f])
            })
            .collect()
    }
}

/// What is compared under a pulse.
pub(super) struct Compared<'a> {
    pub(super) effort: Effort,
    pub(super) scene: &'static str,
    pub(super) pulse: &'a PulseReference,
    pub(super) records: &'a mut Vec<Record>,
}

impl Compared<'_> {
    /// Adds a method whose samples are `width` apart, where they meet the times of the reference.
    pub(super) fn add(
        &mut self,
        method: &'static str,
        setting: String,
        default_path: bool,
        width: f64,
        run: impl Fn() -> Result<Vec<Six>, StudyError>,
    ) -> Result<(), StudyError> {
        if !self.pulse.meets(width) {
            return Ok(());
        }
        let scene = Scene {
            question: Question::Fields,
            name: self.scene,
            values: self.pulse.end(),
            errors: &|samples: &Vec<Six>| Ok(self.pulse.errors(samples, width)),
        };
        let counted = || {
            let samples = run()?;
            let count = samples.len() as u64;
            Ok((samples, Some(count)))
        };
        let candidate = Candidate::new(method, setting, counted).default_path(default_path);
        self.records.push(scene.measure(self.effort, &candidate)?);
        Ok(())
    }

    /// Samples of the pulse.
    pub(super) fn force(&self, width: f64) -> Vec<f64> {
        let pulse = PulseSum::new(self.pulse.length, width);
        (0..self.pulse.count(width))
            .map(|n| pulse.force(n))
            .collect()
    }
}

/// sin^4(pi t/T) on [0, T].
fn force(t: f64, length: f64) -> f64 {
    if (0.0..=length).contains(&t) {
        (PI * t / length).sin().powi(4)
    } else {
        0.0
    }
}

fn slope(t: f64, length: f64) -> f64 {
    if (0.0..=length).contains(&t) {
        let (sine, cosine) = (PI * t / length).sin_cos();
        4.0 * PI / length * sine.powi(3) * cosine
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_independent_reference() {
        // tests/golden/fields.csv: Durbin inversion with direct Hankel quadrature, 1e-10 absolute
        let golden = include_str!("../../../../tests/golden/fields.csv");
        let mut seen = 0;
        for line in golden.lines().skip(1) {
            let row: Vec<f64> = line.split(',').filter_map(|x| x.parse().ok()).collect();
            let [nu, r, z, length, t] = row[..5] else {
                continue;
            };
            if z < 0.2 || length > 20.0 || seen >= 12 {
                continue;
            }
            // the first of many times is the row's own
            let found =
                PulseReference::new(&Medium::new(nu).unwrap(), [r, z], length, t, 100).unwrap();
            assert_eq!(found.times[0], t);
            seen += 1;
            // w, u, szz, srz, srr, stt there
            for (column, field) in [(5, 1), (6, 0), (7, 4), (8, 5), (9, 2), (10, 3)] {
                let error = (found.exact[0][field] - row[column]).abs();
                assert!(error < 1e-9, "{line}: {field} off by {error:e}");
            }
        }
        assert_eq!(seen, 12);
    }
}
