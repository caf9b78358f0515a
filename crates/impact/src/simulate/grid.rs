//! Times of the output.

use super::ImpactError;
use crate::convolve::KernelSource;
use crate::scene::Scene;
use crate::units::KernelUnits;
use halfspace::Medium;

/// Samples of the output at most.
const MOST_SAMPLES: usize = 4_000_000;

/// Times of the output.
pub(super) struct Grid {
    pub(super) step_s: f64,
    pub(super) coarsening: u32,
    pub(super) count: usize,
    pub(super) pulse_s: f64,
}

/// Samples of the output that a scene will need, before its step is rounded.
pub(super) fn cells(
    scene: &Scene,
    units: &KernelUnits,
    medium: &Medium,
    load_end_s: f64,
    pulse_s: f64,
) -> f64 {
    let (duration_s, wanted_s) = wanted(scene, units, medium, load_end_s, pulse_s);
    duration_s / wanted_s
}

/// Duration and largest step of the output in s.
fn wanted(
    scene: &Scene,
    units: &KernelUnits,
    medium: &Medium,
    load_end_s: f64,
    pulse_s: f64,
) -> (f64, f64) {
    // linear between samples: relative error about (1.07 step/duration * pi)^2/8
    let samples = (1.1 / scene.contact.tolerance.sqrt()).clamp(100.0, 4000.0);
    let duration_s = scene
        .duration_s
        .unwrap_or_else(|| default_duration(scene, units, medium, load_end_s));
    let mut wanted_s = scene.contact.step_s.unwrap_or(pulse_s / samples);
    if let Some(map) = scene.map {
        // at least one sample for each frame
        wanted_s = wanted_s.min(duration_s / (map.frames as f64 - 1.0).max(1.0));
    }
    (duration_s, wanted_s)
}

impl Grid {
    pub(super) fn new(
        scene: &Scene,
        source: Option<&KernelSource>,
        units: &KernelUnits,
        medium: &Medium,
        load_end_s: f64,
        pulse_s: f64,
    ) -> Result<Self, ImpactError> {
        let (duration_s, wanted_s) = wanted(scene, units, medium, load_end_s, pulse_s);
        let (step_s, coarsening) = match source {
            Some(source) => {
                let (step, coarsening) =
                    source.step(medium.poisson_ratio(), wanted_s / units.time_s());
                (step * units.time_s(), coarsening)
            }
            None => (wanted_s, 0),
        };
        let samples = (duration_s / step_s).ceil() + 1.0;
        if samples > MOST_SAMPLES as f64 {
            return Err(ImpactError::TooManySamples {
                samples,
                step_s,
                limit: MOST_SAMPLES,
            });
        }
        Ok(Self {
            step_s,
            coarsening,
            count: samples as usize,
            pulse_s,
        })
    }
}

/// The load and a tenth, or until its last Rayleigh wave has passed the farthest point.
fn default_duration(scene: &Scene, units: &KernelUnits, medium: &Medium, load_end_s: f64) -> f64 {
    let slowest = medium.rayleigh_speed() * units.longitudinal_speed_m_s;
    let probes = scene.probes.iter().map(|probe| probe.r_m.hypot(probe.z_m));
    let corner = scene.map.iter().map(|map| map.r_max_m.hypot(map.z_max_m));
    let farthest = probes
        .chain(corner)
        .map(|distance_m| (distance_m + units.disc_radius_m) / slowest)
        .fold(0.0, f64::max);
    1.1 * load_end_s + 1.05 * farthest
}
