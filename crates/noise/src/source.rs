//! Impacts and receivers.

use crate::area::Area;
use crate::error::NoiseError;
use crate::ground::{Curve, FAR_STEP, Ground, STEP};
use crate::pulses::{Blow, Pulses};
use crate::spacing::Spacing;
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

    /// The table of surface responses for all receivers there, up to a frequency.
    pub(crate) fn surface(&self, frequencies_hz: [f64; 2]) -> Result<Option<Curve>, NoiseError> {
        let mut ends: Option<[f64; 2]> = None;
        for receiver in self.receivers.iter().filter(|one| one.depth_m == 0.0) {
            let [low, high] = self.distances_m(receiver)?;
            let known = ends.unwrap_or([low, high]);
            ends = Some([known[0].min(low), known[1].max(high)]);
        }
        let [from, to] = frequencies_hz.map(|f| self.ground.wave_number(f));
        ends.map(|[low, high]| Curve::new(&self.ground, 0.0, [low * from, high * to]))
            .transpose()
    }
}

/// Nodes in distance between which impacts are interpolated, for one receiver.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bins {
    pub(crate) spacing: Spacing,
    per_m: f64,
}

impl Bins {
    /// For a receiver whose nearest and farthest impact are given, up to a wave number in 1/m.
    pub(crate) fn new(ends_m: [f64; 2], wave_number: f64) -> Self {
        let spacing = Spacing::new(ends_m.map(|r| r * wave_number), STEP, STEP / FAR_STEP);
        Self {
            spacing,
            per_m: wave_number,
        }
    }

    /// Distance of a node in m.
    pub(crate) fn node_m(&self, i: usize) -> f64 {
        self.spacing.node(i as f64) / self.per_m
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
