//! Traces at receivers by superposition, tile by tile.
//!
//! A tile has the waves of all impacts in an interval of time, in the frequency domain:
//!
//! ```text
//! V(f) = 2 pi i f sum_b G(r_b, f) e^{i omega r_b/c} sum_i w_bi F_i(f) e^{-i omega (t_i + r_i/c)}
//! ```
//!
//! with cubic weights w_bi between nodes r_b in distance and c the speed of the Rayleigh wave, without which the response is
//! smooth. Tiles overlap by the time that waves need, and are added. A tile depends on its number alone: not on threads, and not on
//! the other tiles.

use crate::error::NoiseError;
use crate::ground::Sheet;
use crate::source::{Bins, Noise, Source, distance_m};
use halfspace::random::{Stream, mix};
use num_complex::Complex64;
use rayon::prelude::*;
use realfft::RealFftPlanner;
use std::f64::consts::TAU;

/// How traces are recorded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recording {
    /// Duration in s.
    pub duration_s: f64,
    /// Time between samples in s. There is no motion above half of its inverse: the samples are those behind an ideal
    /// anti-alias filter.
    pub step_s: f64,
    /// Seed of times, places and bodies of impacts at random.
    pub seed: u64,
}

/// Samples before a tile's first impact, for the ringing of the anti-alias filter before each arrival.
const GUARD: usize = 64;

/// Time after the slowest Rayleigh wave at which the motion has died away, over its time of travel and in samples: the ringing of
/// the filter, and the creep of a damped half-space.
const AFTER: f64 = 1.25;
const AFTER_SAMPLES: f64 = 128.0;

/// Length of a tile over the part in which its waves fade, at least.
const TILE: usize = 4;

/// Largest number of samples of a tile, and of all traces.
const MOST_OF_TILE: usize = 1 << 22;
const MOST_SAMPLES: f64 = 1e8;

/// Most impacts of a tile, which are held in memory: 1.2 GB.
const MOST_IMPACTS: f64 = 3e7;

/// Frequencies that are summed together.
const CHUNK: usize = 64;

/// The tiles of some traces.
#[derive(Debug)]
pub struct Tiles<'a> {
    noise: &'a Noise,
    recording: Recording,
    /// Samples of a trace.
    samples: usize,
    /// Samples of a tile, and those of them in which its impacts are.
    length: usize,
    own: usize,
    /// Number of tiles.
    count: usize,
    /// Tiles before the first sample.
    before: usize,
    sheets: Vec<Sheet>,
    bins: Vec<Bins>,
    /// c in m/s.
    speed_m_s: f64,
}

/// An impact in a tile: its body, the time of its middle from the first sample of the tile, its place.
struct Event {
    blow: usize,
    time_s: f64,
    place_m: [f64; 2],
}

impl<'a> Tiles<'a> {
    /// For a recording.
    ///
    /// # Errors
    /// [`NoiseError`] for a recording that is too long or too coarse, and for an impact too close to a receiver.
    pub fn new(noise: &'a Noise, recording: Recording) -> Result<Self, NoiseError> {
        let Recording {
            duration_s, step_s, ..
        } = recording;
        let count = duration_s / step_s * noise.receivers.len() as f64;
        NoiseError::unless(
            (1.0..=MOST_SAMPLES).contains(&count),
            "the number of samples of all traces",
            count,
            "[1, 1e8]",
            ": change duration_s or step_s",
        )?;
        let samples = (duration_s / step_s).round().max(1.0) as usize;
        let ends_m = noise.receivers.iter().map(|one| noise.distances_m(one));
        let ends_m: Vec<[f64; 2]> = ends_m.collect::<Result<_, _>>()?;
        let farthest = noise
            .receivers
            .iter()
            .zip(&ends_m)
            .map(|(one, ends)| ends[1].hypot(one.depth_m));
        let highest_hz = 0.5 / step_s;
        let speed_m_s = noise.ground.rayleigh_speed_m_s(highest_hz);
        // with attenuation the lowest frequencies are the slowest
        let slowest = noise
            .ground
            .rayleigh_speed_m_s(1.0 / duration_s.max(step_s))
            .min(speed_m_s);
        let travel = farthest.fold(0.0, f64::max) / slowest / step_s;
        let fading = GUARD as f64 + AFTER_SAMPLES + AFTER * travel;
        NoiseError::unless(
            fading * (TILE as f64) < MOST_OF_TILE as f64,
            "the travel time in samples",
            travel,
            "[0, 8e5]",
            ": use a larger step_s or a smaller area",
        )?;
        let length = (TILE * fading.ceil() as usize).next_power_of_two();
        let own = length - fading.ceil() as usize;
        let before = (fading / own as f64).ceil() as usize;
        let lowest_hz = 1.0 / (length as f64 * step_s);
        let impacts = noise.rate_per_s() * own as f64 * step_s;
        NoiseError::unless(
            impacts <= MOST_IMPACTS,
            "the number of impacts in a tile",
            impacts,
            "[0, 3e7]",
            ": use a lower rate, a smaller step_s or a smaller area",
        )?;
        Ok(Self {
            sheets: noise.sheets([lowest_hz, highest_hz])?,
            bins: noise.bins(highest_hz, CHUNK)?,
            count: before + samples.div_ceil(own),
            noise,
            recording,
            samples,
            length,
            own,
            before,
            speed_m_s,
        })
    }

    /// Number of tiles.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Samples of a trace.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Samples of a tile of one receiver.
    pub fn length(&self) -> usize {
        self.length
    }

    /// Adds a tile, with all receivers one after the other, to traces with all receivers one after the other.
    pub fn add(&self, tile: usize, velocity_m_s: &[f64], traces: &mut [f64]) {
        let pairs = velocity_m_s
            .chunks_exact(self.length)
            .zip(traces.chunks_exact_mut(self.samples));
        let start = self.start(tile) - GUARD as i64;
        for (tile, trace) in pairs {
            for (sample, value) in (start..).zip(tile) {
                if let Some(sum) = usize::try_from(sample).ok().and_then(|i| trace.get_mut(i)) {
                    *sum += value;
                }
            }
        }
    }

    /// First sample of a tile's impacts.
    fn start(&self, tile: usize) -> i64 {
        (tile as i64 - self.before as i64) * self.own as i64
    }

    /// The vertical velocity in m/s of a tile, all receivers one after the other.
    ///
    /// # Errors
    /// [`NoiseError`] of a response.
    pub fn tile(&self, tile: usize) -> Result<Vec<f64>, NoiseError> {
        let events = self.events(tile);
        let half = self.length / 2;
        let chunks = (1..half).step_by(CHUNK).collect::<Vec<_>>().into_par_iter();
        let chunks = chunks.map(|from| self.chunk(&events, from, (from + CHUNK).min(half)));
        let chunks: Vec<Vec<Complex64>> = chunks.collect::<Result<_, _>>()?;
        let inverse = RealFftPlanner::<f64>::new().plan_fft_inverse(self.length);
        let period_s = self.length as f64 * self.recording.step_s;
        let receivers = (0..self.noise.receivers.len()).into_par_iter().map(|i| {
            let mut spectrum = vec![Complex64::default(); half + 1];
            let mut place = 1;
            for chunk in &chunks {
                let width = chunk.len() / self.noise.receivers.len();
                for value in &chunk[i * width..(i + 1) * width] {
                    spectrum[place] = value / period_s;
                    place += 1;
                }
            }
            let mut samples = inverse.make_output_vec();
            // the lengths are those of the plan, and the ends of the spectrum are zero
            let _ = inverse.process(&mut spectrum, &mut samples);
            samples
        });
        Ok(receivers.collect::<Vec<_>>().concat())
    }

    /// The impacts of a tile.
    fn events(&self, tile: usize) -> Vec<Event> {
        let (noise, step_s) = (self.noise, self.recording.step_s);
        let start_s = self.start(tile) as f64 * step_s;
        let own_s = self.own as f64 * step_s;
        let of = |blow: usize, time_s: f64, place_m: [f64; 2]| Event {
            blow,
            time_s: time_s + GUARD as f64 * step_s + 0.5 * noise.blows[blow].contact_time_s,
            place_m,
        };
        match &noise.source {
            Source::Poisson { area, .. } => {
                let mut random = Stream::new(mix(mix(self.recording.seed) ^ tile as u64));
                let (mut events, mut time_s) = (Vec::new(), 0.0);
                loop {
                    time_s -= (1.0 - random.next()).ln() / noise.rate_per_s();
                    if time_s >= own_s {
                        return events;
                    }
                    let place_m = area.place_m([random.next(), random.next()]);
                    let blow = (random.next() * noise.blows.len() as f64) as usize;
                    events.push(of(blow.min(noise.blows.len() - 1), time_s, place_m));
                }
            }
            Source::Listed {
                times_s, places_m, ..
            } => {
                let own = times_s.iter().enumerate().map(|(i, t)| (i, t - start_s));
                let own = own.filter(|(_, t)| (0.0..own_s).contains(t));
                own.map(|(i, t)| of(i, t, places_m[i])).collect()
            }
        }
    }

    /// The spectrum of the velocity at the frequencies from one number to another, all receivers one after the other.
    fn chunk(
        &self,
        events: &[Event],
        from: usize,
        to: usize,
    ) -> Result<Vec<Complex64>, NoiseError> {
        let (noise, width) = (self.noise, to - from);
        let unit_hz = 1.0 / (self.length as f64 * self.recording.step_s);
        let sizes = self.bins.iter().map(|bins| bins.spacing.count * width);
        let mut sums: Vec<Vec<Complex64>> =
            sizes.map(|size| vec![Complex64::default(); size]).collect();
        let (mut force, mut wave) = (
            vec![Complex64::default(); width],
            vec![Complex64::default(); width],
        );
        for event in events {
            for (j, force) in force.iter_mut().enumerate() {
                *force = noise.pulses.force(
                    event.blow,
                    &noise.blows[event.blow],
                    unit_hz * (from + j) as f64,
                );
            }
            for ((receiver, bins), sums) in noise.receivers.iter().zip(&self.bins).zip(&mut sums) {
                let distance_m = distance_m(event.place_m, receiver.place_m);
                if distance_m < noise.nearest_m {
                    continue;
                }
                let angle = -TAU * unit_hz * (event.time_s + distance_m / self.speed_m_s);
                let step = Complex64::from_polar(1.0, angle);
                let mut phase = Complex64::from_polar(1.0, angle * from as f64);
                for (wave, force) in wave.iter_mut().zip(&force) {
                    *wave = force * phase;
                    phase *= step;
                }
                bins.add(sums, distance_m, &wave);
            }
        }
        let mut found = Vec::with_capacity(width * noise.receivers.len());
        for (i, sums) in sums.iter().enumerate() {
            for j in 0..width {
                let frequency_hz = unit_hz * (from + j) as f64;
                let omega = TAU * frequency_hz;
                let at = noise.at(&self.sheets, i, frequency_hz);
                let nodes = sums.iter().skip(j).step_by(width).enumerate();
                let nodes = nodes.filter(|(_, sum)| **sum != Complex64::default());
                let displacement: Complex64 = nodes
                    .map(|(node, sum)| {
                        let r_m = self.bins[i].node_m(node as f64);
                        at.value(r_m)[1]
                            * Complex64::from_polar(1.0, omega * r_m / self.speed_m_s)
                            * sum
                    })
                    .sum();
                found.push(displacement * Complex64::new(0.0, omega));
            }
        }
        Ok(found)
    }
}
