//! Samples of a march, and the work that it may take.

use crate::error::MarchError;
use crate::growing::solved::SolvedContact;
use crate::law::hertz::CONTACT_TIME;
use std::sync::Arc;

/// The end of the first contact, as the last samples in contact tell it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Separation {
    /// When the force is zero.
    pub(crate) time: f64,
    /// Uncertainty of `time` for steps longer than the memory.
    pub(crate) uncertainty: f64,
    /// Impulse from the third sample before the first free one until then.
    pub(crate) impulse: f64,
}

/// Samples of a march, a step apart, from the first touch until the striker has left for good, or a contact solved by pieces.
///
/// In collision units.
#[derive(Debug, Clone, Default)]
pub struct History {
    /// Time between samples.
    pub step: f64,
    /// Contact force.
    pub force: Vec<f64>,
    /// Displacement of the striker.
    pub displacement: Vec<f64>,
    /// Deflection of the half-space that enters the contact law.
    pub deflection: Vec<f64>,
    /// What the trapezoidal rule misses of the impulse at the touch.
    pub(crate) start: f64,
    /// Velocity where the scheme computes it itself; empty otherwise.
    pub(crate) velocity: Vec<f64>,
    /// Compliance of the newest sample: d - w + compliance * p is smooth through the end of contact.
    pub(crate) compliance: f64,
    /// The surface's part of it.
    pub(crate) elastic: f64,
    /// End of the first contact where the march finds it itself.
    pub(crate) separation: Option<Separation>,
    /// Work left in the half-space where the march finds it itself.
    pub(crate) dissipated: Option<f64>,
    /// The contact itself where it was solved by pieces; there are no samples then.
    pub pieces: Option<Arc<SolvedContact>>,
    /// Estimated error of the force at any instant, over the largest; infinite where nobody has estimated it.
    pub error: f64,
}

impl History {
    /// At the touch.
    pub(crate) fn at_touch(step: f64) -> Self {
        let mut history = Self::default();
        history.restart(step);
        history
    }

    /// Forgets everything but the room that it takes.
    pub(crate) fn restart(&mut self, step: f64) {
        let begun = |samples: &mut Vec<f64>| {
            samples.clear();
            samples.push(0.0);
            std::mem::take(samples)
        };
        *self = Self {
            step,
            force: begun(&mut self.force),
            displacement: begun(&mut self.displacement),
            deflection: begun(&mut self.deflection),
            error: f64::INFINITY,
            ..Self::default()
        };
    }

    /// A contact that was solved by pieces: no samples, which [`Resampler`](crate::Resampler) reads of it at any time.
    pub fn of_pieces(solved: &SolvedContact) -> Self {
        Self {
            error: solved.estimates.force,
            pieces: Some(Arc::new(solved.clone())),
            ..Self::default()
        }
    }

    #[inline]
    pub(crate) fn push(&mut self, force: f64, displacement: f64, deflection: f64) {
        self.force.push(force);
        self.displacement.push(displacement);
        self.deflection.push(deflection);
    }

    /// Mean velocity over the last step.
    pub(crate) fn last_velocity(&self) -> f64 {
        match self.displacement[..] {
            [.., before, last] => (last - before) / self.step,
            _ => 1.0,
        }
    }
}

/// A contact lasts at least this part of Hertz's.
const SHORTEST: f64 = 0.5;

/// Steps of a march, and products of steps and cells of the memory, at most: one takes 1 to 2 ns, a march 2 s at most.
const STEPS: usize = 400_000;
const WORK: usize = 1_000_000_000;

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
    (SHORTEST * CONTACT_TIME / step).min(1e9) as usize
}

/// Whether so many steps with so many cells of a `memory` each are within bounds.
///
/// # Errors
/// [`MarchError::TooLong`].
pub(crate) fn affordable(steps: usize, cells: usize, memory: f64) -> Result<(), MarchError> {
    let work = steps.saturating_mul(cells.min(steps));
    if steps > STEPS || work > WORK {
        return Err(MarchError::TooLong {
            steps,
            cells,
            ratio: memory,
        });
    }
    Ok(())
}
