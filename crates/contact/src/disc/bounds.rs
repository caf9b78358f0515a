//! Bounds of the work that a march may take.

use crate::error::MarchError;
use crate::law::hertz::CONTACT_TIME;

/// A contact lasts at least this part of Hertz's.
const SHORTEST_CONTACT: f64 = 0.5;

/// Steps of a march, and products of steps and cells of the memory, at most: one takes 1 to 2 ns, a march 2 s at most.
const MOST_STEPS: usize = 400_000;
const MOST_WORK: usize = 1_000_000_000;

/// Cells of a memory at a step, both in collision units.
///
/// # Errors
/// [`MarchError::TooLong`], before a march begins whose work is out of bounds.
pub(crate) fn memory_cells(memory: f64, step: f64) -> Result<usize, MarchError> {
    let cells = (memory / step).min(1e9) as usize;
    affordable(cells, cells, memory)?;
    affordable(least_steps(step), cells, memory)?;
    Ok(cells)
}

/// Steps over a contact at least.
pub(crate) fn least_steps(step: f64) -> usize {
    (SHORTEST_CONTACT * CONTACT_TIME / step).min(1e9) as usize
}

/// Whether so many steps with so many cells of a `memory` each are within bounds.
///
/// # Errors
/// [`MarchError::TooLong`].
pub(crate) fn affordable(steps: usize, cells: usize, memory: f64) -> Result<(), MarchError> {
    let work = steps.saturating_mul(cells.min(steps));
    if steps > MOST_STEPS || work > MOST_WORK {
        return Err(MarchError::TooLong {
            steps,
            cells,
            ratio: memory,
        });
    }
    Ok(())
}
