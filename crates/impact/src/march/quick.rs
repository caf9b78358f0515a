//! Many impacts on a fixed disc: the implicit scheme on tabulated responses, without its history.
//!
//! Nothing is allocated once the workspace is warm, the weights are read from a
//! [`ResponseTable`], and the step is halved until the results meet the accuracy asked for: what is
//! returned has the same verified error as a march with [`refine`](super::refine).

use super::implicit::advance;
use super::lag::tabulated_lag;
use super::refine::halve;
use super::tabulated::ResponseTable;
use super::weights::{Weights, slack};
use super::{Accuracy, Budget, History, MarchError, StaticShare, Summary};

/// An impact on a disc of fixed radius in dimensionless groups, with a tabulated response.
#[derive(Debug, Clone, Copy)]
pub struct TabulatedDisc<'a> {
    /// Response of the disc.
    pub table: &'a ResponseTable,
    /// Static deflection of the disc under Hertz's largest force over Hertz's largest approach.
    pub coupling: f64,
    /// r0/c1 in collision times.
    pub wave_time: f64,
    /// Which part of the deflection enters.
    pub share: StaticShare,
}

/// Results with their step and estimated error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Results in collision units.
    pub summary: Summary,
    /// Estimated relative error of peak force, contact time, restitution and displacement.
    pub error: f64,
    /// Step of the finest march in collision units.
    pub step: f64,
}

/// Room for the marches of one thread.
#[derive(Debug, Clone)]
pub struct Workspace {
    weights: Weights,
    history: History,
}

impl Default for Workspace {
    fn default() -> Self {
        Self {
            weights: Weights::default(),
            history: History::at_touch(1.0, 512),
        }
    }
}

impl Workspace {
    /// Marches with `step`, halved until the results meet `accuracy`.
    ///
    /// # Errors
    /// Those of [`march_implicit`](super::march_implicit) and of [`refine`](super::refine).
    pub fn solve(
        &mut self,
        impact: &TabulatedDisc<'_>,
        step: f64,
        accuracy: &Accuracy,
    ) -> Result<Found, MarchError> {
        let march = |step| {
            self.march(impact, step)?;
            Ok((Summary::new(&self.history)?, ()))
        };
        let found = halve(march, step, accuracy)?;
        Ok(Found {
            summary: found.summary,
            error: found.error,
            step: found.step,
        })
    }

    /// One march with a fixed step (collision units) into the workspace's history.
    fn march(&mut self, impact: &TabulatedDisc<'_>, step: f64) -> Result<(), MarchError> {
        let memory = impact.table.memory() * impact.wave_time;
        let budget = Budget::of_memory(memory, step)?;
        let slack = slack(impact.coupling, impact.share);
        self.weights
            .read(impact.table, step, impact.wave_time, slack);
        self.history.restart(step);
        let lag = tabulated_lag(impact.table, impact.coupling, impact.wave_time / step);
        advance(
            &lag,
            impact.share,
            &self.weights,
            &budget,
            &mut self.history,
        )?;
        self.history.separate(&lag);
        Ok(())
    }
}
