//! Fields as seen through a low pass of zero phase.
//!
//! It acts on the outputs, since the pressure of a growing contact is not a multiple of its force: the waves of both are linear, so
//! that under a force record it is the same as a low pass of the force. Velocities and accelerations are rates of the displacement
//! that is seen.
//!
//! Theory: `docs/theory.md` (T75).

use super::Trace;
use crate::grid::Grid;
use crate::quantity::Derivative;
use crate::record::low_pass::{GROWTH, filtered};
use crate::sampled::projection::largest;

/// The low pass of a grid.
pub(crate) struct LowPassed<'a> {
    time_s: Vec<f64>,
    /// Samples that are shown.
    wanted: &'a [usize],
    cutoff_hz: f64,
}

impl<'a> LowPassed<'a> {
    /// For outputs at all samples of a grid, of which some are wanted.
    pub(crate) fn new(grid: &Grid<'_>, wanted: &'a [usize], cutoff_hz: f64) -> Self {
        Self {
            time_s: grid.all_s().collect(),
            wanted,
            cutoff_hz,
        }
    }

    /// An output or a rate of it. Between samples it is a straight line; its error falls as the square of the step, and so follows
    /// from that of every second sample.
    pub(crate) fn of(&self, trace: &Trace, derivative: Derivative) -> Trace {
        let order = match derivative {
            Derivative::Field => 0,
            Derivative::First => 1,
            Derivative::Second => 2,
        };
        let seen = |values: &[f64]| filtered(&self.time_s, values, self.cutoff_hz, order);
        let (fine, coarse) = (seen(&trace.samples), seen(&self.thinned(&trace.samples)));
        let pairs = || {
            self.wanted
                .iter()
                .map(|&n| (fine[n], (fine[n] - coarse[n]) / 3.0))
        };
        let changes: Vec<f64> = pairs().map(|(_, change)| change).collect();
        let grown = GROWTH[order as usize] * self.cutoff_hz.powi(order);
        Trace {
            samples: pairs().map(|(fine, change)| fine + change).collect(),
            error: grown * trace.error + largest(&changes),
        }
    }

    /// The samples with every second one on the straight line between its neighbours.
    fn thinned(&self, samples: &[f64]) -> Vec<f64> {
        let mut found = samples.to_vec();
        for i in (1..samples.len().saturating_sub(1)).step_by(2) {
            let [before_s, at_s, after_s] = [i - 1, i, i + 1].map(|k| self.time_s[k]);
            let x = (at_s - before_s) / (after_s - before_s);
            found[i] = samples[i - 1] + x * (samples[i + 1] - samples[i - 1]);
        }
        found
    }
}
