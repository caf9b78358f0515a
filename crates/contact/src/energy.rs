//! The energy ledger: what the striker loses and where it goes.
//!
//! Energy is relative to the kinetic energy before, time and force are in collision units.
//!
//! Theory: `docs/theory.md` (T56, T57).

use crate::disc::FixedDisc;
use crate::march::history::History;
use crate::march::weights::Weights;
use crate::response::disc::DiscResponse;
use crate::work::work;
use halfspace::Deflection;

/// Where the energy went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ledger {
    /// Kinetic energy of the striker after, relative to before: e^2.
    pub rebound: f64,
    /// Work that the load left in the half-space as waves, relative.
    pub radiated: f64,
    /// What is missing: 1 - rebound - radiated.
    pub residual: f64,
}

impl Ledger {
    /// From the restitution and the radiated work.
    #[must_use]
    pub fn new(restitution: f64, radiated: f64) -> Self {
        let rebound = restitution * restitution;
        Self {
            rebound,
            radiated,
            residual: 1.0 - rebound - radiated,
        }
    }
}

/// Work left in the half-space by a force on a fixed disc: int p dw with the pressure-weighted mean of w.
///
/// The static part of w gives back what it takes, so only the dynamic part is integrated.
/// With [`Deflection::Mean`] in the contact law this equals the striker's loss; with
/// [`Deflection::Centre`] the contact law does another work than the pressure, and the ledger shows
/// the difference as its residual.
#[must_use]
pub fn radiated<R: DiscResponse>(impact: &FixedDisc<'_, R>, mean: &R, history: &History) -> f64 {
    debug_assert_eq!(mean.deflection(), Deflection::Mean);
    let coupling = impact.coupling * mean.static_compliance() / impact.response.static_compliance();
    if let Some(work) = history.work_on(mean, coupling, impact.wave_time) {
        return work;
    }
    let weights = Weights::of(impact, mean, history.step);
    let force = &history.force;
    let deflection: Vec<f64> = (0..force.len())
        .map(|n| -coupling * weights.delayed(&force[..=n]))
        .collect();
    work(force, &deflection)
}
