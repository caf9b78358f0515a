//! Many contacts without histories, as sweeps compute them, with the peaks at the probes of a scene.

use crate::cost::Forecast;
use crate::fields::probes::{ProbePeaks, peaks_at_probes};
use crate::grid::{Grid, Wanted};
use crate::impact::solve;
use crate::kernels::KernelSource;
use crate::scene::{Load, Scene};
use crate::source::KernelChoice;
use contact::{Collision, ContactError, Model, Outcomes, Results, Settings, Solver, Tabulated};

/// A contact out of many: its results, its model, and the peaks at the probes.
#[derive(Debug, Clone, PartialEq)]
pub struct Observed {
    /// The model, never [`Model::Auto`].
    pub model: Model,
    /// Results in SI units.
    pub results: Results,
    /// The peaks at the probes, or why there are none; nothing where nobody asks for them.
    pub peaks: Option<Result<ProbePeaks, String>>,
}

/// The contact of two bodies with a thread's solver.
#[inline]
pub fn collide(
    solver: &mut Solver<'_, Tabulated>,
    collision: &Collision,
    settings: &Settings,
) -> Result<Observed, ContactError> {
    collision.check_step(settings)?;
    let solved = solver.solve(collision, settings)?;
    Ok(Observed {
        model: solved.chosen.model,
        results: Results::new(collision, settings, &solved).checked()?,
        peaks: None,
    })
}

/// The contact of a scene as [`crate::simulate()`] solves it, with the peaks of the fields at its probes.
///
/// # Errors
/// The reason why the contact failed, in one sentence; a failure of the fields alone is part of the returned value.
pub fn observe(
    solver: &mut Solver<'_, Tabulated>,
    scene: &Scene,
    kernels: &KernelChoice,
) -> Result<Observed, String> {
    let Load::Strike(strike) = &scene.load else {
        return Err("a force record has no contact".to_owned());
    };
    let (target, settings) = (&scene.target, &scene.settings);
    let collision = Collision::new(target, &strike.striker, strike.velocity_m_s);
    let run = solve(solver, target, &collision, settings).map_err(|error| error.to_string())?;
    let peaks = peaks_at_probes(scene, kernels, run.excitation());
    Ok(Observed {
        model: run.solved.chosen.model,
        results: run.results,
        peaks: Some(peaks.map_err(|error| error.to_string())),
    })
}

/// Forecast memory in bytes of the fields at the probes of a scene, on one thread with computed kernels; none where the contact
/// fails.
pub fn fields_bytes(solver: &mut Solver<'_, Tabulated>, scene: &Scene) -> Option<f64> {
    let strike = scene.strike()?;
    let (target, settings) = (&scene.target, &scene.settings);
    let collision = Collision::new(target, &strike.striker, strike.velocity_m_s);
    let run = solve(solver, target, &collision, settings).ok()?;
    let excitation = run.excitation();
    let source = KernelSource::direct(excitation.medium(), settings.tolerance).ok()?;
    let grid = Grid::new(&Wanted::of(scene), excitation, Some(&source)).ok()?;
    Some(Forecast::new(scene, &grid, Some(&source), 1.0).memory_bytes)
}

/// Rows from which it is told where all of them lie, at most.
const SAMPLE: usize = 1024;

/// The series of outcomes that rows from 0 to `rows` share, whichever of them are computed together.
pub fn outcomes<M: Default, E>(
    rows: usize,
    responses: &Tabulated,
    row: impl Fn(usize, &mut M) -> Result<(Collision, Settings), E>,
) -> Outcomes {
    // equidistributed along every axis, whose strides it does not follow
    let golden = |k: usize| (k as f64 * 0.618_033_988_749_895).fract();
    let index = |k: usize| match rows <= SAMPLE {
        true => k,
        false => (golden(k) * rows as f64) as usize,
    };
    let mut memory = M::default();
    let some = (0..rows.min(SAMPLE)).filter_map(|k| row(index(k), &mut memory).ok());
    Solver::new(responses).outcomes(rows, some)
}
