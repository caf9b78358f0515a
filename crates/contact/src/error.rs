//! Errors of contacts and marches.

use halfspace::DomainError;
use thiserror::Error;

/// A contact that has no results.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ContactError {
    /// The march failed.
    #[error(transparent)]
    March(#[from] MarchError),
    /// An approach that no wave of the surface outruns.
    #[error(
        "the approach at velocity_m_s = {} is not below the Rayleigh wave speed of the half-space, {} m/s, above which contact laws do not apply: check the velocity or the height of the fall, and the constants of the target",
        fault::rounded(*velocity_m_s),
        fault::rounded(*limit_m_s)
    )]
    TooFast {
        /// Velocity of approach in m/s.
        velocity_m_s: f64,
        /// Speed of the Rayleigh wave in m/s.
        limit_m_s: f64,
    },
    /// A number that no body has, and whose powers would leave the range of numbers.
    #[error("{quantity} = {} is outside [1e-30, 1e30]", fault::number(*value))]
    OutOfRange {
        /// The quantity, with its unit.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// A material is outside the physics.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// The deflection of the disc's centre feeds energy back.
    #[error(
        "the disc is {coupling:.1} times as compliant as the contact, and the deflection of its centre, which is not conjugate to the pressure, feeds energy back{}; use the mean deflection or a larger disc",
        found.map_or_else(String::new, |(e, n)| format!(": restitution {e:.4}, {n} contacts"))
    )]
    EnergyFed {
        /// Coupling of the disc.
        coupling: f64,
        /// Restitution and contacts, where a march has found them.
        found: Option<(f64, usize)>,
    },
    /// The radiated loss is not small.
    #[error(
        "model \"radiation\" is a first-order law: its loss of {loss:.3} of the kinetic energy is outside [0, 0.5]; use model \"growing\" or \"wave\""
    )]
    LossTooLarge {
        /// The loss 1 - e^2 of the law.
        loss: f64,
    },
    /// The memory is too long for an expansion in it.
    #[error(
        "model \"area_dashpot\" is an expansion in the memory of the half-space: its lag {lag:.3} and its memory {memory:.3} collision times are outside [0, 0.2] and [0, 0.5]; use model \"growing\""
    )]
    BeyondDashpot {
        /// Lag c in collision times.
        lag: f64,
        /// Memory in collision times.
        memory: f64,
    },
    /// The echo of a plate comes back to a contact that does not know it.
    #[error(
        "the echo from thickness_m returns after {echo_s:.3e} s, before the contact ends at {contact_s:.3e} s, and the contact {reason}; or remove echoes (until_s) for a half-space"
    )]
    EchoReturns {
        /// When the echo returns in s.
        echo_s: f64,
        /// When the contact ends in s.
        contact_s: f64,
        /// What stands against it.
        reason: String,
    },
    /// Nothing says when a body yields.
    #[error(
        "plasticity = \"{law}\" requires a yield_strength_pa of the striker or the target{}", if *law == "jackson_green" { "" } else { ", or yield_pressure_pa" }
    )]
    NoStrength {
        /// Name of the law.
        law: &'static str,
    },
    /// A yielding contact that could not be followed.
    #[error(
        "the yielding contact could not be computed: its yield_pressure_pa or yield strength is too far from the contact pressure"
    )]
    NotFollowed,
    /// A fit that gives nothing back of so deep an indentation.
    #[error(
        "velocity_m_s = {} leaves a dent as deep as the indentation with plasticity = \"jackson_green\", which is valid up to {} m/s: use \"thornton\" or \"recovery\", a lower velocity or a higher yield strength",
        fault::rounded(*velocity_m_s),
        fault::rounded(*trusted_m_s)
    )]
    NoRebound {
        /// Velocity of approach in m/s.
        velocity_m_s: f64,
        /// The largest for which the law is trusted, in m/s.
        trusted_m_s: f64,
    },
    /// A number that floating-point arithmetic does not hold.
    #[error(
        "the {quantity} is {value:e}: the numbers of the scene exceed the range of floating-point numbers; check their units"
    )]
    NotFinite {
        /// Name of the number.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// A step that no march can have.
    #[error(
        "step_s = {} is outside [1e-9, 1000] times Hertz's contact time, {hertz_s:.3e} s",
        fault::number(*step_s)
    )]
    Step {
        /// The step in s.
        step_s: f64,
        /// Hertz's contact time in s.
        hertz_s: f64,
    },
    /// An estimated error that is as large as the results.
    #[error(
        "the estimated relative error of the results is {error:.2}, above 0.5, so the results are meaningless; use {change}"
    )]
    Unreliable {
        /// The estimate.
        error: f64,
        /// Change that helps.
        change: &'static str,
    },
}

/// Why a march could not be carried through.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MarchError {
    /// The step is too coarse to see the contact.
    #[error(
        "the contact lasts only {samples} steps (at least {needed} are required): use a smaller step_s"
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
        /// Static compliance of the half-space over Hertz's, see [`FixedDisc`](crate::FixedDisc).
        coupling: f64,
    },
    /// The march would need more work than allowed.
    #[error(
        "the solution needs more than {steps} time steps with {cells} memory cells, which exceeds the limit: the memory of the half-space is {ratio:.3e} collision times; use a larger tolerance or step_s, or a smaller disc_radius_m if there is one"
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
        "relative tolerance {tolerance:e} is not reached: the last halving of the step changed the result by {change:.1e}"
    )]
    NotConverged {
        /// Required tolerance.
        tolerance: f64,
        /// The estimate reached.
        change: f64,
    },
    /// A scheme that has left the numbers.
    #[error(
        "the {scheme} scheme is unstable: the force is {force:.1e} times Hertz's after {steps} steps; use a smaller step_s or the implicit scheme"
    )]
    Unstable {
        /// Name of the scheme.
        scheme: &'static str,
        /// Force over Hertz's largest force.
        force: f64,
        /// Steps taken.
        steps: usize,
    },
    /// A group of a contact that follows the load outside its range.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// The contact could not be followed.
    #[error(
        "the growing contact could not be computed beyond {time:.4} collision times at a tolerance of {tolerance:e} (target share {target_share}, wave time {wave_time})"
    )]
    NotFollowed {
        /// Time in collision units.
        time: f64,
        /// Tolerance of the attempt.
        tolerance: f64,
        /// phi.
        target_share: f64,
        /// tau.
        wave_time: f64,
    },
    /// The results do not meet the tolerance by their estimates.
    #[error(
        "relative tolerance {tolerance:e} is not reached: the estimated error is {estimate:.1e}"
    )]
    NotReached {
        /// Required tolerance.
        tolerance: f64,
        /// Estimated error.
        estimate: f64,
    },
    /// The surface comes back and strikes the striker once more.
    #[error(
        "the surface meets the striker again {time:.4} collision times after the first touch, which this model does not support: use model \"area_dashpot\", which has a single contact"
    )]
    StrikesAgain {
        /// Time in collision units.
        time: f64,
    },
    /// The contact shrinks faster than its waves.
    #[error(
        "waves that left the contact at {time:.4} collision times are overtaken by later ones: the memory of the half-space is too long for this model; use model \"area_dashpot\", which has no memory"
    )]
    Overtaken {
        /// Time in collision units.
        time: f64,
    },
}
