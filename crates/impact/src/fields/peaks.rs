//! Largest values over time at the probes of a scene, without the histories: what a row of a sweep has of its fields.

use crate::cost::forecast::{Forecast, TooMuch};
use crate::evaluator::{Asked, Evaluator};
use crate::excitation::Excitation;
use crate::fields::probes::Peaks;
use crate::grid::{Grid, Wanted};
use crate::kernels::KernelSource;
use crate::kernels::source::{KernelChoice, choose_source};
use crate::scene::Scene;
use crate::simulate::ImpactError;
use crate::watch::Unwatched;

/// Fields at the probes of a scene, each by its peak.
#[derive(Debug, Clone, PartialEq)]
pub struct ProbePeaks {
    /// Whether the kernels were looked up rather than computed.
    pub looked_up: bool,
    /// Of each probe each of the six fields and then each quantity of the scene.
    pub peaks: Vec<Peak>,
}

/// The largest value over time of a field, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// The value of largest magnitude over the samples, with its sign.
    pub value: f64,
    /// When, in s.
    pub time_s: f64,
    /// Estimated absolute error of the field.
    pub error: f64,
}

/// Memory in bytes that the fields of one row may take.
const MOST_BYTES: f64 = 1e9;

/// The peaks of the fields of an excitation at the probes of a scene.
///
/// # Errors
/// [`ImpactError`].
pub(crate) fn at_probes(
    scene: &Scene,
    kernels: &KernelChoice,
    excitation: &Excitation,
) -> Result<ProbePeaks, ImpactError> {
    let mut found = ProbePeaks {
        looked_up: false,
        peaks: Vec::new(),
    };
    let Some(chosen) = choose_source(scene, kernels, excitation)? else {
        return Ok(found);
    };
    let source = &chosen.source;
    found.looked_up = matches!(source, KernelSource::Table(_));
    let grid = Grid::new(&Wanted::of(scene), excitation, Some(source))?;
    // on its own thread: whether a row fails depends on the row alone
    Forecast::new(scene, excitation, &grid, Some(source), 1)?
        .check(scene, MOST_BYTES)
        .map_err(TooMuch::Memory)?;
    let time_s: Vec<f64> = grid.times_s().collect();
    let wanted: Vec<usize> = (0..time_s.len()).collect();
    let material = scene.target.material();
    let evaluator = Evaluator::new(Asked {
        excitation,
        source,
        grid: &grid,
        wanted: &wanted,
        quantities: &scene.quantities,
        elastic: [material.youngs_modulus_pa, material.poisson_ratio],
        tolerance: scene.settings.tolerance,
        watch: &Unwatched,
    })?;
    for probe in &scene.probes {
        let at_point = evaluator.at(probe.r_m, probe.z_m)?;
        for (samples, error) in at_point.values.iter().zip(at_point.errors) {
            let mut peaks = Peaks::default();
            peaks.push(&time_s, samples);
            found.peaks.push(Peak {
                value: peaks.values[0],
                time_s: peaks.time_s[0],
                error,
            });
        }
    }
    Ok(found)
}
