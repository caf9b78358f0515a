//! A sampled history as seen through a low pass of zero phase.
//!
//! It acts on the outputs, since the pressure of a growing contact is not a multiple of its force. The waves of any load are linear,
//! so that under a force record it is the same as a low pass of the force. Velocities and accelerations are rates of the
//! displacement that is seen.
//!
//! Theory: `docs/theory.md` (T75).

use super::low_pass::{GROWTH, filtered};
use super::projection::largest;

/// A low pass of outputs at some times.
pub(crate) struct LowPassed {
    time_s: Vec<f64>,
    cutoff_hz: f64,
}

impl LowPassed {
    /// With a cutoff in Hz, of outputs at all these times in s.
    pub(crate) fn new(time_s: Vec<f64>, cutoff_hz: f64) -> Self {
        Self { time_s, cutoff_hz }
    }

    /// An output, or its rate of an order up to two, at some of the samples, and its error; `error` is that of every sample.
    ///
    /// Between samples the output is a straight line; the error of that falls as the square of the step, and so follows from
    /// the result of every second sample.
    pub(crate) fn of(
        &self,
        (samples, error): (&[f64], f64),
        order: usize,
        wanted: &[usize],
    ) -> (Vec<f64>, f64) {
        let seen = |values: &[f64]| filtered(&self.time_s, values, self.cutoff_hz, order as i32);
        let (fine, coarse) = (seen(samples), seen(&self.thinned(samples)));
        let change = |n: usize| (fine[n] - coarse[n]) / 3.0;
        let changes: Vec<f64> = wanted.iter().map(|&n| change(n)).collect();
        let grown = GROWTH[order] * self.cutoff_hz.powi(order as i32) * error;
        let found = wanted.iter().map(|&n| fine[n] + change(n)).collect();
        (found, grown + largest(&changes))
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
