//! Many contacts, without histories or fields: what a sweep computes.

use contact::{Collision, ContactError, Model, Results, Settings, Solver, Tabulated};
use rayon::prelude::*;
use std::ops::Range;

/// A contact of many: its results and the model that gave them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collided {
    /// The model, never [`Model::Auto`].
    pub model: Model,
    /// Results in SI units.
    pub results: Results,
}

/// The contact of two bodies with a thread's solver.
///
/// # Errors
/// [`ContactError`].
pub fn collide(
    solver: &mut Solver<'_, Tabulated>,
    collision: &Collision,
    settings: &Settings,
) -> Result<Collided, ContactError> {
    collision.check_step(settings)?;
    let solved = solver.solve(collision, settings)?;
    let radiated = solver.radiated(collision, settings, &solved)?;
    Ok(Collided {
        model: solved.plan.model,
        results: Results::new(collision, settings, &solved, radiated).checked()?,
    })
}

/// Rows that one thread takes at a time, at most.
const GRAIN: usize = 256;
/// Such portions for each thread at least, where there are rows enough: none waits long for the last one.
const PORTIONS: usize = 4;

/// Results of consecutive rows, in parallel; a row that fails has its reason.
///
/// `row` gives the bodies of a row with the help of what the thread remembers of the row before.
pub fn collide_rows<M: Default, E: ToString>(
    rows: Range<usize>,
    responses: &Tabulated,
    row: impl Fn(usize, &mut M) -> Result<(Collision, Settings), E> + Sync,
) -> Vec<Result<Collided, String>> {
    let end = rows.end;
    let grain = (rows.len() / (PORTIONS * rayon::current_num_threads())).clamp(1, GRAIN);
    let grains: Vec<Vec<Result<Collided, String>>> = rows
        .into_par_iter()
        .step_by(grain)
        .map(|from| {
            let (mut solver, mut memory) = (Solver::new(responses), M::default());
            (from..(from + grain).min(end))
                .map(|index| {
                    let (collision, settings) =
                        row(index, &mut memory).map_err(|error| error.to_string())?;
                    collide(&mut solver, &collision, &settings).map_err(|error| error.to_string())
                })
                .collect()
        })
        .collect();
    grains.into_iter().flatten().collect()
}
