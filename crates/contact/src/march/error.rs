//! Why a march could not be carried through.

use thiserror::Error;

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
        /// Static compliance of the half-space over Hertz's, see [`FixedDisc`](crate::disc::FixedDisc).
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
