//! The energy ledger: what the striker loses and where it goes.
//!
//! Energy is relative to the kinetic energy before, time and force are in collision units.

use crate::march::Weights;
use crate::march::{FixedDisc, History};
use halfspace::{Deflection, SurfaceResponse};

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
pub fn radiated(impact: &FixedDisc<'_>, mean: &SurfaceResponse, history: &History) -> f64 {
    debug_assert_eq!(mean.deflection(), Deflection::Mean);
    let weights = Weights::new(mean, history.step, impact.wave_time);
    let coupling = impact.coupling * mean.static_compliance() / impact.response.static_compliance();
    let force = &history.force;
    let deflection: Vec<f64> = (0..force.len())
        .map(|n| -coupling * weights.lagging(&force[..=n]))
        .collect();
    work(force, &deflection)
}

/// int p dw over the kinetic energy before.
#[must_use]
pub fn work(force: &[f64], deflection: &[f64]) -> f64 {
    let sum: f64 = force
        .windows(2)
        .zip(deflection.windows(2))
        .map(|(p, w)| 0.5 * (p[0] + p[1]) * (w[1] - w[0]))
        .sum();
    // force times length is 5/2 of the kinetic energy
    2.5 * sum
}
