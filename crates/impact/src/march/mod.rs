//! Marching schemes: from the impact equation to a force history.
//!
//! All of them work in [`CollisionUnits`](crate::units::CollisionUnits) and fill a [`History`].

mod dissipation;
mod edge;
mod explicit;
mod flight;
mod growing;
mod implicit;
mod lag;
mod punch;
mod quick;
mod refine;
mod separation;
mod spectral;
mod summary;
mod tabulated;
mod weights;

pub use explicit::march_explicit;
pub use growing::{GrowingDisc, march_growing};
pub use implicit::{FixedDisc, march_implicit};
pub use punch::PunchResponse;
pub use quick::{Found, TabulatedDisc, Workspace};
pub use refine::{Accuracy, Refined, refine};
pub use spectral::{
    Estimates, GrowingContact, GrowingError, Instant, PunchWaves, SolvedContact, solve_growing,
};
pub use summary::{EndOfContact, Summary};
pub use tabulated::ResponseTable;
pub use weights::memory_weights;

pub(crate) use implicit::solve;
pub(crate) use separation::Separation;
pub(crate) use weights::Weights;

use thiserror::Error;

/// Which part of the half-space's deflection is added to Hertz's indentation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StaticShare {
    /// All of it: the paper, whose K already holds the static compliance of the half-space.
    Full,
    /// Only what differs from the static deflection: nothing is counted twice.
    Dynamic,
}

impl StaticShare {
    pub(crate) fn factor(self) -> f64 {
        match self {
            Self::Full => 1.0,
            Self::Dynamic => 0.0,
        }
    }
}

/// Why a march could not be carried through.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MarchError {
    /// The step is too coarse to see the contact.
    #[error(
        "the contact lasts only {samples} steps (at least {needed} are needed): ask for a smaller step_s"
    )]
    StepTooLong {
        /// Samples in contact.
        samples: usize,
        /// Samples needed.
        needed: usize,
    },
    /// The contact law has no solution at this instant.
    #[error(
        "the dynamic static share has no solution after {time:.4} collision times: it exists only while the coupling of the disc, {coupling:.4}, times the cube root of the force over Hertz's stays below 2/3; use static_share \"full\", a larger disc_radius_m or model \"growing\""
    )]
    NoSolution {
        /// Time in collision units.
        time: f64,
        /// Static compliance of the half-space over Hertz's, see [`FixedDisc::coupling`].
        coupling: f64,
    },
    /// The march would need more work than allowed.
    #[error(
        "the march needs more than {steps} steps of {cells} memory cells, more than allowed: the half-space remembers {ratio:.3e} collision times; ask for a larger tolerance or step_s, or for a smaller disc_radius_m if there is one"
    )]
    TooLong {
        /// Steps taken.
        steps: usize,
        /// Cells of memory each.
        cells: usize,
        /// Memory of the half-space in collision units.
        ratio: f64,
    },
    /// The tolerance is not reached with the finest step allowed.
    #[error(
        "relative tolerance {tolerance:e} is not reached: the last halving of the step still changed the result by {change:e}"
    )]
    NotConverged {
        /// The tolerance asked for.
        tolerance: f64,
        /// The estimate reached.
        change: f64,
    },
    /// A scheme that has left the numbers.
    #[error(
        "the {scheme} march is unstable: the force is {force:e} times Hertz's after {steps} steps; ask for a smaller step_s or the implicit scheme"
    )]
    Unstable {
        /// Name of the scheme.
        scheme: &'static str,
        /// Force over Hertz's largest force.
        force: f64,
        /// Steps taken.
        steps: usize,
    },
}

/// Samples of a march, a step apart, from the first touch until the striker has left for good.
///
/// In collision units.
#[derive(Debug, Clone, PartialEq)]
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
    /// Layer at the end of a contact that shrinks.
    pub(crate) end_layer: EndLayer,
}

/// The last instants of a contact whose radius goes to zero, too short for the step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct EndLayer {
    /// Whether the contact's radius goes to zero at all.
    pub(crate) shrinks: bool,
    /// Displacement of the striker at the end of contact over the square of its velocity there.
    pub(crate) depth: f64,
    /// Duration of the layer over the velocity; zero where there is none.
    pub(crate) width: f64,
}

impl History {
    pub(crate) fn at_touch(step: f64, capacity: usize) -> Self {
        let start = || {
            let mut samples = Vec::with_capacity(capacity);
            samples.push(0.0);
            samples
        };
        Self {
            step,
            force: start(),
            displacement: start(),
            deflection: start(),
            start: 0.0,
            velocity: Vec::new(),
            compliance: 0.0,
            elastic: 0.0,
            separation: None,
            dissipated: None,
            end_layer: EndLayer::default(),
        }
    }

    /// Forgets everything but the room that it takes.
    pub(crate) fn restart(&mut self, step: f64) {
        self.step = step;
        self.velocity.clear();
        self.separation = None;
        self.dissipated = None;
        for samples in [
            &mut self.force,
            &mut self.displacement,
            &mut self.deflection,
        ] {
            samples.clear();
            samples.push(0.0);
        }
    }

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
