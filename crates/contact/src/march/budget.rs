//! The work that a march may take.

use super::error::MarchError;
use crate::law::hertz::CONTACT_TIME;

/// A contact lasts at least this part of Hertz's.
const SHORTEST: f64 = 0.5;

/// Bounds the work of one march.
#[derive(Debug)]
pub(crate) struct Budget {
    cells: usize,
    ratio: f64,
}

impl Budget {
    const STEPS: usize = 400_000;
    const WORK: usize = 4_000_000_000;

    pub(crate) fn new(cells: usize, ratio: f64) -> Self {
        Self { cells, ratio }
    }

    /// For a memory and a step; refuses one that is out of bounds by itself.
    pub(crate) fn of_memory(memory: f64, step: f64) -> Result<Self, MarchError> {
        let cells = (memory / step).min(1e9) as usize;
        let budget = Self::new(cells, memory);
        budget.check(cells)?;
        Ok(budget)
    }

    /// Refuses a march before it begins.
    pub(crate) fn before(&self, step: f64) -> Result<(), MarchError> {
        self.check((SHORTEST * CONTACT_TIME / step).min(1e9) as usize)
    }

    pub(crate) fn check(&self, steps: usize) -> Result<(), MarchError> {
        let work = steps.saturating_mul(self.cells.min(steps));
        if steps > Self::STEPS || work > Self::WORK {
            return Err(MarchError::TooLong {
                steps,
                cells: self.cells,
                ratio: self.ratio,
            });
        }
        Ok(())
    }
}
