//! Traces by a route that the inversion does not use: Pekeris's closed form for a point force on a half-space with a
//! Poisson ratio of 1/4, convolved with a force sampled forty times as finely as the trace.
#![allow(dead_code, unreachable_pub)]

use halfspace::random::Stream;
use halfspace::{Field, Kernel, Medium, Profile};
use inverse::{ForceHistory, Gain, Noise, Problem, Pulse, Trace};

/// Samples of the trace in a contact.
pub const SAMPLES: usize = 25;
/// Start of the blow in contact durations, which is no sample.
pub const START: f64 = 0.313;
const FINER: usize = 40;

/// int S dt, S the vertical displacement over F/(mu r) at the surface, t in r/c2 (Pekeris 1955, nu = 1/4).
pub fn pekeris(t: f64) -> f64 {
    let root3 = 3.0_f64.sqrt();
    let (a, b, c, d) = (
        3.0 * root3 + 5.0,
        (3.0 + root3) / 4.0,
        3.0 * root3 - 5.0,
        (3.0 - root3) / 4.0,
    );
    let ray = |x: f64| a.sqrt() * (x / b.sqrt()).min(1.0).asin();
    let first = |x: f64| {
        (6.0 * x - root3 * (x + (x * x - 0.25).sqrt()).ln() - ray(x)
            + c.sqrt() * (x + (x * x - d).sqrt()).ln())
            / (32.0 * std::f64::consts::PI)
    };
    let second = |x: f64| (6.0 * x - ray(x)) / (16.0 * std::f64::consts::PI);
    let (onset, gamma) = (1.0 / root3, 0.5 * (3.0 + root3).sqrt());
    first(t.clamp(onset, 1.0)) - first(onset) + second(t.clamp(1.0, gamma)) - second(1.0)
        + 3.0 / (8.0 * std::f64::consts::PI) * (t - gamma).max(0.0)
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    Displacement,
    /// Its mean over a sampling interval, as instruments show it.
    Velocity,
}

/// Response at k steps to a hat of force of this half width, in contact durations; c2 = mu = 1.
pub fn hat(
    integral: impl Fn(f64) -> f64,
    quantity: Quantity,
    width: f64,
    count: usize,
) -> Vec<f64> {
    let displacement =
        |t: f64| (integral(t + width) - 2.0 * integral(t) + integral(t - width)) / width;
    let step = 1.0 / SAMPLES as f64;
    let at = |k: usize| {
        let t = k as f64 * width;
        match quantity {
            Quantity::Displacement => displacement(t),
            Quantity::Velocity => {
                (displacement(t + 0.5 * step) - displacement(t - 0.5 * step)) / step
            }
        }
    };
    (0..count).map(at).collect()
}

/// A sensor at a distance in c2 tc.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    pub quantity: Quantity,
    pub distance: f64,
    /// Durations until the blow.
    pub start: f64,
}

impl Place {
    /// Force samples in a sample of the trace: near the blow fronts are sharp.
    pub fn oversampling(self) -> usize {
        if self.distance < 1.0 { 8 } else { 4 }
    }

    /// Samples until 1.7 durations after the Rayleigh wave of the start.
    pub fn samples(self) -> usize {
        ((1.0877 * self.distance + 1.7 + self.start) * SAMPLES as f64) as usize
    }

    /// The trace of a force over time in contact durations.
    pub fn clean(self, force: &dyn Fn(f64) -> f64) -> Vec<f64> {
        let width = 1.0 / (SAMPLES * FINER) as f64;
        let count = self.samples() * FINER;
        let response = hat(|t| pekeris(t / self.distance), self.quantity, width, count);
        let force: Vec<f64> = (0..count).map(|j| force(j as f64 * width)).collect();
        let from = force.iter().position(|p| *p != 0.0).unwrap_or(0);
        let to = force.iter().rposition(|p| *p != 0.0).unwrap_or(0);
        (0..self.samples())
            .map(|i| {
                (from..=to.min(i * FINER))
                    .map(|j| force[j] * response[i * FINER - j])
                    .sum()
            })
            .collect()
    }

    /// The response by the integrals of `halfspace`.
    pub fn response(self) -> Vec<f64> {
        let medium = Medium::new(0.25).expect("a Poisson ratio");
        let kernel = Kernel::new(&medium, Profile::Point, 1e-10).expect("a tolerance");
        let w = Field::DisplacementZ.index();
        // lengths in the distance, times in the distance over c1, displacements in P/(mu distance)
        let faster = 3.0_f64.sqrt();
        let rest = kernel.static_field(1.0, 0.0).expect("a place")[w];
        let base = kernel.step_integral(1.0, 0.0, 0.0).expect("a time").value[w];
        let integral = |t: f64| match t > 0.0 {
            true => {
                let t = t * faster / self.distance;
                let moved = kernel.step_integral(1.0, 0.0, t).expect("a time").value[w] - base;
                (rest * t + moved) / faster
            }
            false => 0.0,
        };
        let width = 1.0 / (SAMPLES * self.oversampling()) as f64;
        hat(
            integral,
            self.quantity,
            width,
            self.samples() * self.oversampling(),
        )
    }
}

/// Normal numbers of a seed by Box and Muller.
pub fn normal(seed: u64, count: usize) -> Vec<f64> {
    let mut stream = Stream::new(seed.wrapping_mul(7919).wrapping_add(11));
    let mut draw = || {
        (-2.0 * (1.0 - stream.next()).ln()).sqrt() * (std::f64::consts::TAU * stream.next()).cos()
    };
    (0..count).map(|_| draw()).collect()
}

pub fn peak(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |a: f64, x| a.max(x.abs()))
}

/// A trace with white noise of a seed.
pub fn noisy(clean: &[f64], response: &[f64], snr: f64, seed: u64) -> Trace {
    let sigma = peak(clean) / snr;
    let noise = normal(seed, clean.len());
    Trace {
        samples: clean
            .iter()
            .zip(noise)
            .map(|(x, n)| x + sigma * n)
            .collect(),
        response: response.to_vec(),
        noise: Noise::White(sigma),
        gain: Gain::Known(1.0),
        valid_until_s: None,
    }
}

pub fn problem(pulse: &Pulse, place: Place, traces: Vec<Trace>) -> Problem<'_> {
    Problem {
        oversampling: place.oversampling(),
        ..Problem::new(1.0 / SAMPLES as f64, traces, pulse)
    }
}

/// True samples within the band of a history, and all samples: those of the contact, and those of the window.
pub fn held(history: &ForceHistory, force: &dyn Fn(f64) -> f64) -> [[f64; 2]; 2] {
    let mut counts = [[0.0; 2]; 2];
    for (j, (low, high)) in history.low_n.iter().zip(&history.high_n).enumerate() {
        let exact = force(history.start_s + j as f64 * history.step_s);
        let holds = f64::from(u8::from((low - 1e-12..=high + 1e-12).contains(&exact)));
        for (count, counted) in counts.iter_mut().zip([exact > 0.0, true]) {
            if counted {
                *count = [count[0] + holds, count[1] + 1.0];
            }
        }
    }
    counts
}

/// The value below which a part of the values is.
pub fn quantile(values: &[f64], part: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[((sorted.len() - 1) as f64 * part).round() as usize]
}
