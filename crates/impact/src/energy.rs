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
    let coupling = impact.coupling * mean.static_compliance() / impact.response.static_compliance();
    if let Some(work) = history.work_on(mean, coupling, impact.wave_time) {
        return work;
    }
    let weights = Weights::of(impact, mean, history.step);
    let force = &history.force;
    let deflection: Vec<f64> = (0..force.len())
        .map(|n| -coupling * weights.lagging(&force[..=n]))
        .collect();
    work(force, &deflection)
}

/// int p dw over the kinetic energy before.
///
/// The trapezoid of Stieltjes with its next correction, (p' w'' - p'' w') h^3/12 a cell, where the
/// force is smooth; of second order because of the cells in which contact begins and ends.
#[must_use]
pub fn work(force: &[f64], deflection: &[f64]) -> f64 {
    let (p, w) = (force, deflection);
    let mut sum = 0.0;
    for i in 1..p.len().min(w.len()) {
        let (rise, moved) = (p[i] - p[i - 1], w[i] - w[i - 1]);
        let total = p[i] + p[i - 1];
        if total == 0.0 {
            continue;
        }
        sum += 0.5 * total * moved;
        if i >= 2 && i + 1 < p.len() && p[i] != 0.0 {
            // twice the mean of the second differences at both ends of the cell
            let bend = |x: &[f64]| x[i + 1] - x[i] - x[i - 1] + x[i - 2];
            sum += (rise * bend(w) - bend(p) * moved) / 24.0;
        }
    }
    // force times length is 5/2 of the kinetic energy
    2.5 * sum
}
