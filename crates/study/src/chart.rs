//! The whole chart: what is measured and drawn.

use crate::StudyError;
use crate::machine::Machine;
use crate::map::{disc_models, dynamic, inversions, kernels, lookups, marches, models};
use crate::measure::Effort;
use crate::picture::Picture;
use crate::question;
use crate::record::Record;
use crate::standing::{Measure, Standing, standings};
use crate::tables::{Density, Spacing};
use crate::work_precision;
use std::time::Instant;
use tabulator::Progress;

/// Everything that a chart holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// How much was computed.
    pub effort: Effort,
    /// On which machine.
    pub machine: Machine,
    /// Rows.
    pub records: Vec<Record>,
    /// Work-precision diagrams.
    pub diagrams: Vec<Picture>,
    /// Stability maps and errors over time.
    pub maps: Vec<Picture>,
    /// Time taken.
    pub wall_s: f64,
}

impl Chart {
    /// Measures everything.
    ///
    /// # Errors
    /// [`StudyError`] where a part that must work does not; failures of the methods compared are results.
    pub fn run(effort: Effort, progress: &dyn Progress) -> Result<Self, StudyError> {
        let started = Instant::now();
        let uniform = effort.pick(vec![], vec![0.25, 0.125, 0.0625]);
        let mut spacings = vec![Spacing::Own];
        spacings.extend(uniform.into_iter().map(Spacing::Uniform));
        progress.total("tables", spacings.len() as u64);
        let mut densities = Vec::new();
        for spacing in spacings {
            densities.push(Density::build(question::kernels::POISSON_RATIO, spacing)?);
            progress.advance(1);
        }
        let advance = || progress.advance(1);
        let mut records = question::kernels::measure(effort, &densities, progress)?;
        progress.total("force", 2);
        records.extend(question::force::measure(effort, &advance)?);
        progress.total("fields", effort.pick(3, 9));
        records.extend(question::fields::measure(effort, &densities, &advance)?);
        progress.total("impacts", 4);
        records.extend(question::impacts::measure(effort, &densities, &advance)?);
        progress.total("inversions", 21);
        let mut maps = inversions::figures(effort, &advance)?;
        progress.total("marches", 3);
        maps.extend(marches::figures(effort, &advance)?);
        maps.push(dynamic::figure(effort)?);
        advance();
        progress.total("kernel maps", 1);
        maps.extend(kernels::figures(effort, &advance)?);
        maps.extend(lookups::figures(&densities, effort)?);
        progress.total("models", models::rows(effort) + 1);
        maps.extend(models::figures(effort, &advance)?);
        maps.extend(disc_models::figures(effort)?);
        advance();
        Ok(Self {
            effort,
            machine: Machine::here(),
            diagrams: work_precision::figures(&records),
            records,
            maps,
            wall_s: started.elapsed().as_secs_f64(),
        })
    }

    /// What is ahead of the default path at 1e-3 to 1e-8 without a reason, in words; empty as it should be.
    #[must_use]
    pub fn unexplained(&self) -> Vec<String> {
        standings(&self.records, Measure::Time)
            .iter()
            .filter_map(Standing::unexplained)
            .collect()
    }
}
