//! The whole chart: measured, drawn, written.

use crate::StudyError;
use crate::draw::{to_png, to_svg};
use crate::effort::Effort;
use crate::figure::Figure;
use crate::machine::Machine;
use crate::map::{inversions, kernels, lookups, marches, models};
use crate::question;
use crate::record::Record;
use crate::standing::{Measure, Standing, standings};
use crate::tables::{Density, Spacing};
use crate::{csv_file, hdf_file, report, work_precision};
use formats::{Existing, OutputError, write_whole};
use std::path::{Path, PathBuf};
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
    pub diagrams: Vec<Figure>,
    /// Stability maps and errors over time.
    pub maps: Vec<Figure>,
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
        progress.total("inversions", 21);
        let mut maps = inversions::figures(effort, &advance)?;
        progress.total("marches", 3);
        maps.extend(marches::figures(effort, &advance)?);
        progress.total("kernel maps", 1);
        maps.extend(kernels::figures(effort, &advance)?);
        maps.extend(lookups::figures(&densities, effort)?);
        progress.total("models", models::rows(effort) + 1);
        maps.extend(models::figures(effort, &advance)?);
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
            .filter(|standing| standing.is_unexplained())
            .filter_map(Standing::ahead)
            .collect()
    }

    /// Writes chart.csv, chart.h5, report.md and the pictures into a folder.
    ///
    /// # Errors
    /// [`StudyError::Unwritable`] with the file and the reason.
    pub fn write(&self, folder: &Path) -> Result<(), StudyError> {
        csv_file::write(&folder.join("chart.csv"), &self.records)?;
        hdf_file::write(&folder.join("chart.h5"), self)?;
        for figure in self.diagrams.iter().chain(&self.maps) {
            let svg = to_svg(figure);
            let path = folder.join(format!("{}.svg", figure.name));
            whole(&path, |part| {
                std::fs::write(part, &svg).map_err(|e| e.to_string())
            })?;
            let path = folder.join(format!("{}.png", figure.name));
            whole(&path, |part| {
                std::fs::write(part, to_png(&svg)?).map_err(|e| e.to_string())
            })?;
        }
        let text = report::markdown(self);
        whole(&folder.join("report.md"), |part| {
            std::fs::write(part, text).map_err(|e| e.to_string())
        })
    }
}

/// Makes sure, before any work, that a chart can be written into a folder.
///
/// # Errors
/// [`StudyError::Exists`] when the folder holds anything and that is to be kept, [`StudyError::Unwritable`]
/// when it cannot be made.
pub fn prepare_folder(folder: &Path, existing: Existing) -> Result<(), StudyError> {
    let unwritable = |error: std::io::Error| StudyError::Unwritable {
        path: folder.to_owned(),
        reason: error.to_string(),
    };
    if folder.exists() && !folder.is_dir() {
        return Err(StudyError::Unwritable {
            path: folder.to_owned(),
            reason: "it is not a folder".to_owned(),
        });
    }
    std::fs::create_dir_all(folder).map_err(unwritable)?;
    let mut names: Vec<PathBuf> = std::fs::read_dir(folder)
        .map_err(unwritable)?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .collect();
    names.sort();
    match (existing, names.first()) {
        (Existing::Keep, Some(path)) => Err(StudyError::Exists { path: path.clone() }),
        (Existing::Keep, None) | (Existing::Replace, _) => {
            // a folder that takes no files is found now, not after minutes
            let probe = folder.join("chart.csv");
            formats::check(&probe, Existing::Replace).map_err(|error| output(&probe, error))
        }
    }
}

/// Writes a file as a whole or not at all.
pub(crate) fn whole(
    path: &Path,
    write: impl FnOnce(&Path) -> Result<(), String>,
) -> Result<(), StudyError> {
    write_whole(path, Existing::Replace, write).map_err(|error| output(path, error))
}

fn output(path: &Path, error: OutputError) -> StudyError {
    match error {
        OutputError::Exists { path } => StudyError::Exists { path },
        OutputError::Unwritable { reason, .. } => StudyError::Unwritable {
            path: path.to_owned(),
            reason,
        },
    }
}
