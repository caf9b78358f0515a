//! Times of the output.

use crate::error::ImpactError;
use crate::excitation::{Excitation, Samples};
use crate::kernels::KernelSource;
use crate::scene::Scene;
use contact::law::hertz::CONTACT_TIME;
use contact::{Collision, StaticShare};
use halfspace::Deflection;

/// Largest number of samples of the output.
const MOST_SAMPLES: usize = 4_000_000;

/// Requirements on the times of the output in addition to the excitation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wanted {
    /// Relative tolerance on the results.
    pub(crate) tolerance: f64,
    /// Largest step in s, if requested.
    pub(crate) step_s: Option<f64>,
    /// Duration in s, if requested.
    pub(crate) duration_s: Option<f64>,
    /// Frames of a section, at least one sample each.
    pub(crate) frames: Option<usize>,
    /// Distance in m of the farthest point from the load's centre, if there are points.
    pub(crate) farthest_m: Option<f64>,
    /// When the echoes of a plate stop being exact at a point, and when they cannot be computed any longer, in s after the load
    /// begins; where fields of a plate are asked for.
    pub(crate) plate_s: Option<[f64; 2]>,
    /// Cutoff in Hz of the low pass of the fields, if there is one.
    pub(crate) low_pass_hz: Option<f64>,
}

impl Wanted {
    /// The requirements of a scene.
    pub(crate) fn of(scene: &Scene) -> Self {
        Self {
            tolerance: scene.settings.tolerance,
            step_s: scene.settings.step_s,
            duration_s: scene.duration_s,
            frames: scene.section.as_ref().map(|section| section.frames),
            farthest_m: (scene.points() > 0).then(|| scene.farthest_m()),
            plate_s: (scene.points() > 0).then(|| scene.plate_s()).flatten(),
            low_pass_hz: scene.low_pass_hz,
        }
    }

    /// Rejects, before the contact is solved, an output step that is too fine for any possible contact.
    ///
    /// The output lasts at least half of Hertz's contact time and the travel time of a Rayleigh wave to the farthest point.
    ///
    /// # Errors
    /// [`ImpactError::TooManySamples`].
    pub(crate) fn check_step(
        &self,
        collision: &Collision,
        rayleigh_m_s: f64,
    ) -> Result<(), ImpactError> {
        let Some(step_s) = self.step_s else {
            return Ok(());
        };
        let contact_s = 0.5 * CONTACT_TIME * collision.units().time_s;
        let least_s = || contact_s + self.farthest_m.unwrap_or(0.0) / rayleigh_m_s;
        let samples = self.duration_s.unwrap_or_else(least_s) / step_s;
        if samples > MOST_SAMPLES as f64 {
            return Err(ImpactError::TooManySamples {
                samples,
                step_s,
                limit: MOST_SAMPLES,
            });
        }
        Ok(())
    }

    /// Duration and largest step in s.
    pub(crate) fn duration_and_step_s(&self, excitation: &Excitation) -> (f64, f64) {
        let fitting_s = || self.fitting_step_s(excitation);
        let mut step_s = self.step_s.unwrap_or_else(fitting_s);
        let passed_s = || {
            let pressed_s = 1.1 * excitation.end_s();
            match self
                .plate_s
                .map(|limits_s| limits_s.map(|t| excitation.start_s() + t))
            {
                None => pressed_s + self.passing_s(excitation),
                // the last sample is up to a step later
                Some([exact_s, latest_s]) => (exact_s - step_s).max(pressed_s).min(latest_s),
            }
        };
        let duration_s = self.duration_s.unwrap_or_else(passed_s);
        if let Some(frames) = self.frames {
            step_s = step_s.min(duration_s / (frames as f64 - 1.0).max(1.0));
        }
        (duration_s, step_s)
    }

    /// Step in s that the tolerance requires: over a contact the force is approximated to third order between samples,
    /// except at its ends, where the power 3/2 is integrated.
    fn fitting_step_s(&self, excitation: &Excitation) -> f64 {
        match excitation.record() {
            None => {
                let samples = (1.5 / self.tolerance.sqrt()).clamp(100.0, 10_000.0);
                excitation.end_s() / samples
            }
            Some(record) => {
                let stretches = record.stretches(self.settling_s(excitation), self.tolerance);
                let unit_s = excitation.units().time_s();
                record.step_s(&stretches, self.tolerance, unit_s, MOST_RECORD)
            }
        }
    }

    /// Time in s that the last Rayleigh wave takes to pass the farthest point.
    fn passing_s(&self, excitation: &Excitation) -> f64 {
        let radius_m = excitation.units().disc_radius_m;
        let travel = |distance_m: f64| (distance_m + radius_m) / excitation.speeds().rayleigh;
        1.05 * self.farthest_m.map_or(0.0, travel)
    }

    /// Time in s after which the fields of a constant force count as static.
    ///
    /// The remainder at later times is omitted: up to 2e-4 of the peak was observed after a lasting change of force,
    /// far less after a pulse. The errors of the fields include it. With attenuation they never do.
    fn settling_s(&self, excitation: &Excitation) -> f64 {
        if excitation.attenuation.is_some() {
            return f64::INFINITY;
        }
        let crossing_s = excitation.units().disc_radius_m / excitation.speeds().rayleigh;
        SETTLED * (self.passing_s(excitation) + crossing_s)
    }

    /// The runs of samples: there are none while a record is constant for a long time.
    fn runs(&self, excitation: &Excitation, duration_s: f64, step_s: f64) -> Vec<Samples> {
        let run = |from_s: f64, to_s: f64, base_n: f64| Samples {
            start_s: from_s,
            base_n,
            // more than any memory, or the largest number of 32 bits in a browser: rejected by its number
            count: (((to_s - from_s) / step_s).ceil().min(1e15) as usize).saturating_add(1),
        };
        let settling_s = self.settling_s(excitation);
        let stretches = excitation.record().map_or_else(Vec::new, |record| {
            record.stretches(settling_s, self.tolerance)
        });
        let begins_s = |i: usize| match stretches.get(i) {
            // a short lead is kept, so that a record that begins at once is sampled from 0
            Some(stretch) if i > 0 || stretch.span_s[0] > settling_s => stretch.span_s[0],
            Some(_) => 0.0,
            None => f64::INFINITY,
        };
        if stretches.is_empty() {
            return vec![run(0.0, duration_s, 0.0)];
        }
        let mut runs = Vec::new();
        for (i, stretch) in stretches.iter().enumerate() {
            let settled_s = stretch.span_s[1] + settling_s;
            let to_s = settled_s.min(begins_s(i + 1)).min(duration_s);
            if begins_s(i) < to_s {
                runs.push(run(begins_s(i), to_s, stretch.base_n));
            }
        }
        if runs.is_empty() {
            // the output ends before the record begins to change
            runs.push(run(0.0, step_s, 0.0));
        }
        runs
    }
}

/// Largest number of samples of a record when the step is chosen; jumps alone would have no limit.
const MOST_RECORD: f64 = 262_144.0;

/// Time for which the fields are computed before they count as static, relative to the passing of the waves.
const SETTLED: f64 = 20.0;

/// Cutoff periods after the output whose samples a low pass sees: 1e-5 of a step is seen 4 periods before it.
const BEYOND_PERIODS: f64 = 5.0;

/// Rejects a cutoff that the output does not resolve.
fn check_low_pass(cutoff_hz: f64, [duration_s, step_s]: [f64; 2]) -> Result<(), ImpactError> {
    let limits = [1.0 / duration_s, 0.5 / step_s];
    match limits[0] < cutoff_hz && cutoff_hz < limits[1] {
        true => Ok(()),
        false => Err(ImpactError::LowPass { cutoff_hz, limits }),
    }
}

/// Times of the output: equidistant samples, in one run from 0, or in several for a record with long constant parts.
#[derive(Debug, Clone)]
pub(crate) struct Grid<'a> {
    /// The excitation.
    pub(crate) excitation: &'a Excitation,
    /// Relative tolerance on the results.
    pub(crate) tolerance: f64,
    /// Step in s.
    pub(crate) step_s: f64,
    /// Consecutive samples, in the order of time.
    pub(crate) runs: Vec<Samples>,
    /// Largest requested step in s.
    pub(crate) wanted_s: f64,
    /// Time in s after which fields are taken as static between runs.
    settling_s: f64,
    /// Cutoff in Hz of the low pass of the fields, if there is one, and samples at the end that it alone needs.
    pub(crate) low_pass_hz: Option<f64>,
    beyond: usize,
}

impl<'a> Grid<'a> {
    /// The times for the requirements, on steps that the source of the kernels supports.
    pub(crate) fn new(
        wanted: &Wanted,
        excitation: &'a Excitation,
        source: Option<&KernelSource>,
    ) -> Result<Self, ImpactError> {
        let (duration_s, wanted_s) = wanted.duration_and_step_s(excitation);
        let latest_s = wanted
            .plate_s
            .map(|[_, latest_s]| excitation.start_s() + latest_s);
        if let Some(latest_s) = latest_s.filter(|&latest_s| duration_s > (1.0 + 1e-9) * latest_s) {
            return Err(ImpactError::LateEchoes {
                duration_s,
                latest_s,
            });
        }
        let unit_s = excitation.units().time_s();
        let ratio = excitation.medium().poisson_ratio();
        let step_s = source.map_or(wanted_s, |source| {
            source.step(ratio, wanted_s / unit_s) * unit_s
        });
        let mut runs = wanted.runs(excitation, duration_s, step_s);
        let beyond = match wanted.low_pass_hz {
            None => 0,
            Some(cutoff_hz) => {
                check_low_pass(cutoff_hz, [duration_s, step_s])?;
                let limit_s = latest_s.map_or(f64::INFINITY, |latest_s| latest_s - duration_s);
                let beyond_s = (BEYOND_PERIODS / cutoff_hz).min(limit_s.max(0.0));
                (beyond_s / step_s) as usize
            }
        };
        if let Some(last) = runs.last_mut() {
            last.count += beyond;
        }
        let samples: f64 = runs.iter().map(|run| run.count as f64).sum();
        if samples > MOST_SAMPLES as f64 {
            return Err(ImpactError::TooManySamples {
                samples,
                step_s,
                limit: MOST_SAMPLES,
            });
        }
        Ok(Self {
            excitation,
            tolerance: wanted.tolerance,
            step_s,
            runs,
            wanted_s,
            settling_s: wanted.settling_s(excitation),
            low_pass_hz: wanted.low_pass_hz,
            beyond,
        })
    }

    /// Number of samples of the output.
    pub(crate) fn count(&self) -> usize {
        self.all() - self.beyond
    }

    /// Number of all samples: of a low pass also those after the output.
    pub(crate) fn all(&self) -> usize {
        self.runs.iter().map(|run| run.count).sum()
    }

    /// The cell from which on runs omit the permanent changes of an earlier run, and the sum of these changes in N.
    pub(crate) fn left_out(&self) -> (usize, f64) {
        let cell = (self.settling_s / self.step_s) as usize;
        let pairs = self.runs.windows(2);
        let changed_n = pairs.map(|r| (r[1].base_n - r[0].base_n).abs()).sum();
        (cell.min(self.longest().saturating_sub(1)), changed_n)
    }

    /// Samples of the longest run.
    pub(crate) fn longest(&self) -> usize {
        self.runs.iter().map(|run| run.count).max().unwrap_or(0)
    }

    /// Times of the samples of the output in s.
    pub(crate) fn times_s(&self) -> impl Iterator<Item = f64> + '_ {
        self.all_s().take(self.count())
    }

    /// Times of all samples in s.
    pub(crate) fn all_s(&self) -> impl Iterator<Item = f64> + '_ {
        self.runs
            .iter()
            .flat_map(|run| (0..run.count).map(|i| run.start_s + i as f64 * self.step_s))
    }

    /// The grid of one run moved so that a sample is at an instant in s inside that run, and ending there; the number of this
    /// sample.
    pub(crate) fn ending_at(&self, time_s: f64) -> (Self, usize) {
        let after = self.runs.partition_point(|run| run.start_s <= time_s);
        let run = self.runs[after.saturating_sub(1)];
        let last = ((time_s - run.start_s) / self.step_s).ceil().max(0.0) as usize;
        let moved = Samples {
            start_s: time_s - last as f64 * self.step_s,
            count: last + 1,
            ..run
        };
        let own = Self {
            runs: vec![moved],
            ..self.clone()
        };
        (own, last)
    }

    /// Deflection of the disc in m at all samples of the force, with a share of its static part.
    pub(crate) fn deflection_m(
        &self,
        deflection: Deflection,
        share: StaticShare,
        force_n: &[f64],
    ) -> Vec<f64> {
        let excitation = self.excitation;
        let of = |(run, force_n): (Samples, Vec<f64>)| {
            excitation.deflection_m(deflection, share, self.step_s, run.base_n, &force_n)
        };
        let mut found: Vec<f64> = self.continuous(force_n).into_iter().flat_map(of).collect();
        if excitation.jumps().is_empty() {
            return found;
        }
        let after_jump_m = excitation.deflection_after_jump_m(deflection, share);
        for jump in excitation.jumps() {
            for (time_s, deflection_m) in self.times_s().zip(&mut found) {
                if jump.is_past(time_s) {
                    *deflection_m += jump.rise_n * after_jump_m((time_s - jump.time_s).max(0.0));
                }
            }
        }
        found
    }

    /// The samples of each run without the jumps of the force, relative to the base of the run long before.
    pub(crate) fn continuous(&self, force_n: &[f64]) -> Vec<(Samples, Vec<f64>)> {
        let of = |(run, force_n): (Samples, &[f64])| {
            let time_s = |i: usize| run.start_s + i as f64 * self.step_s;
            let samples = force_n.iter().enumerate();
            let samples = samples.map(|(i, force)| force - self.excitation.jumped_n(time_s(i)));
            let base_n = self.excitation.continuous_base_n(&run);
            (Samples { base_n, ..run }, samples.collect())
        };
        self.split(force_n).into_iter().map(of).collect()
    }

    /// The samples of each run, out of all samples.
    pub(crate) fn split<'s>(&self, mut samples: &'s [f64]) -> Vec<(Samples, &'s [f64])> {
        let cut = |&run: &Samples| {
            let (own, rest) = samples.split_at(run.count.min(samples.len()));
            samples = rest;
            let count = own.len();
            (Samples { count, ..run }, own)
        };
        self.runs.iter().map(cut).collect()
    }
}
