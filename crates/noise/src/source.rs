//! Impacts and receivers.

use crate::area::Area;
use crate::error::NoiseError;
use crate::ground::{ABOVE, AtFrequency, Ground, Sheet};
use crate::pulses::{Blow, Pulses};
use crate::spacing::Spacing;
use std::f64::consts::TAU;
use std::ops::{AddAssign, Mul};

/// A place at which the motion is computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Receiver {
    /// Name.
    pub name: String,
    /// Place on the surface in m.
    pub place_m: [f64; 2],
    /// Depth in m.
    pub depth_m: f64,
}

/// When and where the impacts are.
#[derive(Debug, Clone, PartialEq)]
pub enum Source {
    /// A Poisson process: the bodies are drawn from those of the impacts.
    Poisson {
        /// Area.
        area: Area,
        /// Mean number of impacts per m^2 and s.
        rate_per_m2_s: f64,
    },
    /// Each impact once.
    Listed {
        /// Times in s.
        times_s: Vec<f64>,
        /// Places in m.
        places_m: Vec<[f64; 2]>,
        /// Time in s over which the power is a mean.
        duration_s: f64,
    },
}

/// Impacts on a half-space and the receivers of their noise.
#[derive(Debug)]
pub struct Noise {
    /// Half-space.
    pub ground: Ground,
    /// Times and places.
    pub source: Source,
    /// Distance in m from a receiver within which impacts do not count.
    pub nearest_m: f64,
    /// Receivers.
    pub receivers: Vec<Receiver>,
    /// Bodies of the impacts.
    pub blows: Vec<Blow>,
    /// Their force spectra.
    pub pulses: Pulses,
}

/// Distance from a point force in contact radii from which on its displacement is that of the contact, to 1 %.
const APART: f64 = 5.0;

impl Noise {
    /// Mean number of impacts in 1/s.
    pub fn rate_per_s(&self) -> f64 {
        match &self.source {
            Source::Poisson {
                area,
                rate_per_m2_s,
            } => area.size_m2() * rate_per_m2_s,
            Source::Listed {
                times_s,
                duration_s,
                ..
            } => times_s.len() as f64 / duration_s,
        }
    }

    /// Mean power in W that impacts radiate as waves.
    pub fn radiated_w(&self) -> f64 {
        let sum: f64 = self.blows.iter().map(|blow| blow.radiated_energy_j).sum();
        self.rate_per_s() * sum / self.blows.len() as f64
    }

    /// Nearest and farthest impact of a receiver in m.
    ///
    /// # Errors
    /// [`NoiseError`] if the contact of an impact is too close to be a point force.
    pub(crate) fn distances_m(&self, receiver: &Receiver) -> Result<[f64; 2], NoiseError> {
        let [low, high] = match &self.source {
            Source::Poisson { area, .. } => {
                let breaks = area.breaks(receiver.place_m);
                [breaks[0], breaks[breaks.len() - 1]]
            }
            Source::Listed { places_m, .. } => {
                let distances = places_m
                    .iter()
                    .map(|place| distance_m(*place, receiver.place_m));
                let counted = distances.filter(|r| *r >= self.nearest_m);
                counted.fold([f64::INFINITY, 0.0], |[low, high], r| {
                    [low.min(r), high.max(r)]
                })
            }
        };
        let ends = [low.max(self.nearest_m), high.max(self.nearest_m)];
        let largest = self
            .blows
            .iter()
            .map(|blow| blow.contact_radius_m)
            .fold(0.0, f64::max);
        let nearest = ends[0].hypot(receiver.depth_m);
        NoiseError::unless(
            nearest >= APART * largest && nearest > 0.0 && nearest.is_finite(),
            format!(
                "the distance of {} in m from the nearest impact",
                receiver.name
            ),
            nearest,
            &format!("[{:.3e}, inf), from 5 contact radii on", APART * largest),
            ": the motion at a point force is infinite; set nearest_m, or bury the receiver",
        )?;
        Ok(ends)
    }

    /// The responses at the depths of the receivers, each once, between two frequencies in Hz.
    pub(crate) fn sheets(&self, frequencies_hz: [f64; 2]) -> Result<Vec<Sheet>, NoiseError> {
        let mut depths: Vec<(f64, [f64; 2])> = Vec::new();
        for receiver in &self.receivers {
            let [low, high] = self.distances_m(receiver)?;
            match depths
                .iter_mut()
                .find(|(depth, _)| *depth == receiver.depth_m)
            {
                Some((_, ends)) => *ends = [ends[0].min(low), ends[1].max(high)],
                None => depths.push((receiver.depth_m, [low, high])),
            }
        }
        let most = depths.iter().map(|(_, ends)| ends[1]).fold(0.0, f64::max);
        let waves = most * self.ground.wave_number(frequencies_hz[1]) / TAU;
        NoiseError::unless(
            waves <= MOST_WAVES,
            "the largest distance in wavelengths of shear waves",
            waves,
            "[0, 8000]",
            ": use lower frequencies, or a smaller area",
        )?;
        // the nodes of bins lie beyond the impacts by up to two steps
        let wave_number = self.ground.wave_number(frequencies_hz[1]);
        let most_m = 2.5 * FAR_BIN_STEP / wave_number;
        let beyond = |[low, high]: [f64; 2]| [0.75 * low, high + most_m.min(0.3 * high)];
        let made = depths
            .into_iter()
            .map(|(depth_m, ends)| (depth_m, beyond(ends)));
        let made =
            made.map(|(depth_m, ends)| Sheet::new(&self.ground, depth_m, frequencies_hz, ends));
        made.collect()
    }

    /// The nodes in distance of all receivers, up to a frequency in Hz; at each there are sums at `together` frequencies.
    pub(crate) fn bins(&self, highest_hz: f64, together: usize) -> Result<Vec<Bins>, NoiseError> {
        let wave_number = self.ground.wave_number(highest_hz);
        let bins = self.receivers.iter().map(|one| {
            let ends_m = self.distances_m(one)?;
            Ok(Bins::new(one.depth_m, ends_m, wave_number))
        });
        let bins: Vec<Bins> = bins.collect::<Result<_, NoiseError>>()?;
        let sums = together * bins.iter().map(|one| one.spacing.count).sum::<usize>();
        NoiseError::unless(
            sums as f64 <= MOST_SUMS,
            "the number of sums over impacts",
            sums as f64,
            "[0, 3e7]",
            ": use lower frequencies, a larger step_s, fewer receivers or a smaller area",
        )?;
        Ok(bins)
    }

    /// The responses for a receiver at a frequency in Hz.
    pub(crate) fn at<'s>(
        &self,
        sheets: &'s [Sheet],
        receiver: usize,
        frequency_hz: f64,
    ) -> AtFrequency<'s> {
        let depth_m = self.receivers[receiver].depth_m;
        let place = sheets.iter().position(|sheet| sheet.depth_m == depth_m);
        sheets[place.unwrap_or(0)].at_frequency(&self.ground, frequency_hz)
    }
}

/// Steps of nodes in distance, as those of responses in x at the highest frequency. With [0.15, 0.75] the power of listed impacts is
/// off by 3e-3 (`listed_impacts_add_their_powers`).
const BIN_STEP: f64 = 0.1;
const FAR_BIN_STEP: f64 = 0.5;

/// Largest distance in wavelengths of shear waves: a spectrum takes a second there.
const MOST_WAVES: f64 = 8000.0;

/// Most sums that are held in memory for each thread: 480 MB.
const MOST_SUMS: f64 = 3e7;

/// Nodes in distance between which impacts are interpolated, for one receiver.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bins {
    pub(crate) spacing: Spacing,
    per_m: f64,
}

impl Bins {
    /// For a receiver at a depth whose nearest and farthest impact are given in m, up to a wave number in 1/m.
    pub(crate) fn new(depth_m: f64, [low, high]: [f64; 2], wave_number: f64) -> Self {
        let ends = [low.max(ABOVE * depth_m), high].map(|r| r * wave_number);
        let spacing = Spacing::new(ends, BIN_STEP, BIN_STEP / FAR_BIN_STEP);
        Self {
            spacing,
            per_m: wave_number,
        }
    }

    /// Distance of a node in m; between nodes for a fraction.
    pub(crate) fn node_m(&self, place: f64) -> f64 {
        self.spacing.node(place) / self.per_m
    }

    /// Adds values for an impact at a distance in m to sums with as many values a node.
    pub(crate) fn add<T: Copy + AddAssign + Mul<f64, Output = T>>(
        &self,
        sums: &mut [T],
        distance_m: f64,
        values: &[T],
    ) {
        let (first, weights) = self.spacing.at(distance_m * self.per_m);
        let nodes = sums[first * values.len()..].chunks_exact_mut(values.len());
        for (node, weight) in nodes.zip(weights) {
            for (sum, &value) in node.iter_mut().zip(values) {
                *sum += value * weight;
            }
        }
    }
}

/// Distance of two places.
pub(crate) fn distance_m(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
