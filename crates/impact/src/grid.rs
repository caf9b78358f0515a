//! Times of the output.

use crate::excitation::Excitation;
use crate::kernels::KernelSource;
use crate::scene::Scene;
use thiserror::Error;

/// Samples of the output at most.
const MOST_SAMPLES: usize = 4_000_000;

/// More samples than memory should hold.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "the output needs {samples:.3e} samples of {step_s:.3e} s, more than {limit}: give a larger step_s or a smaller duration_s"
)]
pub struct TooManySamples {
    /// Samples needed.
    pub samples: f64,
    /// Their step in s.
    pub step_s: f64,
    /// Samples allowed.
    pub limit: usize,
}

/// What the times of the output depend on beside the excitation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted {
    /// Relative tolerance on the results.
    pub tolerance: f64,
    /// Largest step in s, if one is asked for.
    pub step_s: Option<f64>,
    /// Time in s to be covered, if one is asked for.
    pub duration_s: Option<f64>,
    /// Frames of a section, at least one sample each.
    pub frames: Option<usize>,
    /// Distance in m of the farthest point from the load's centre, where there are points.
    pub farthest_m: Option<f64>,
}

impl Wanted {
    /// What a scene asks.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        Self {
            tolerance: scene.settings.tolerance,
            step_s: scene.settings.step_s,
            duration_s: scene.duration_s,
            frames: scene.section.map(|section| section.frames),
            farthest_m: (scene.points() > 0).then(|| scene.farthest_m()),
        }
    }

    /// Samples that will be needed, before the step is rounded.
    #[must_use]
    pub fn cells(&self, excitation: &Excitation) -> f64 {
        let (duration_s, step_s) = self.duration_and_step_s(excitation);
        duration_s / step_s
    }

    /// Duration and largest step in s.
    fn duration_and_step_s(&self, excitation: &Excitation) -> (f64, f64) {
        // linear between samples: relative error about (1.07 step/duration * pi)^2/8
        let samples = (1.1 / self.tolerance.sqrt()).clamp(100.0, 4000.0);
        let duration_s = self
            .duration_s
            .unwrap_or_else(|| self.default_duration_s(excitation));
        let mut step_s = self.step_s.unwrap_or(excitation.pulse_s() / samples);
        if let Some(frames) = self.frames {
            step_s = step_s.min(duration_s / (frames as f64 - 1.0).max(1.0));
        }
        (duration_s, step_s)
    }

    /// The load and a tenth, or until its last Rayleigh wave has passed the farthest point.
    fn default_duration_s(&self, excitation: &Excitation) -> f64 {
        let units = excitation.units();
        let slowest = excitation.medium().rayleigh_speed() * units.longitudinal_speed_m_s;
        let passed = self.farthest_m.map_or(0.0, |distance_m| {
            (distance_m + units.disc_radius_m) / slowest
        });
        1.1 * excitation.end_s() + 1.05 * passed
    }
}

/// Times of the output: `count` samples a step apart, from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Step in s.
    pub step_s: f64,
    /// The step is 2^coarsening cells of a table.
    pub(crate) coarsening: u32,
    /// Number of samples.
    pub count: usize,
}

impl Grid {
    /// The times for what is wanted of an excitation, on steps that the source of the kernels can give.
    ///
    /// # Errors
    /// [`TooManySamples`].
    pub fn new(
        wanted: &Wanted,
        excitation: &Excitation,
        source: Option<&KernelSource>,
    ) -> Result<Self, TooManySamples> {
        let (duration_s, wanted_s) = wanted.duration_and_step_s(excitation);
        let unit_s = excitation.units().time_s();
        let (step_s, coarsening) = match source {
            Some(source) => {
                let ratio = excitation.medium().poisson_ratio();
                let (step, coarsening) = source.step(ratio, wanted_s / unit_s);
                (step * unit_s, coarsening)
            }
            None => (wanted_s, 0),
        };
        let samples = (duration_s / step_s).ceil() + 1.0;
        if samples > MOST_SAMPLES as f64 {
            return Err(TooManySamples {
                samples,
                step_s,
                limit: MOST_SAMPLES,
            });
        }
        Ok(Self {
            step_s,
            coarsening,
            count: samples as usize,
        })
    }

    /// Time of a sample in s.
    #[must_use]
    pub fn time_s(&self, sample: usize) -> f64 {
        sample as f64 * self.step_s
    }
}
