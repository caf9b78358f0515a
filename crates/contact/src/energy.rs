//! The energy ledger: what the striker loses and where it goes.
//!
//! Energy is relative to the kinetic energy before, time and force are in collision units.
//!
//! Theory: `docs/theory.md` (T56, T57).

use crate::disc::FixedDisc;
use crate::march::history::History;
use crate::march::weights::Weights;
use crate::resample::Resampler;
use crate::response::disc::DiscResponse;
use crate::units::INVERSE_MASS;
use crate::work::work;
use halfspace::Deflection;

/// Where the energy went, by two routes that share nothing but the force.
///
/// What the striker keeps follows from its momentum, what the half-space takes from the work of the force on the
/// deflection that lags behind it; a force that does not belong to its deflection, or an integral of either that is
/// wrong, leaves a residual.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ledger {
    /// Kinetic energy of the striker after, relative to before, by its momentum: (1 - (5/4) int p dt)^2.
    pub rebound: f64,
    /// Work that the load left in the half-space as waves, relative.
    pub radiated: f64,
    /// What is missing: 1 - rebound - radiated.
    pub residual: f64,
}

impl Ledger {
    /// From the impulse and the radiated work.
    #[must_use]
    pub fn new(impulse: f64, radiated: f64) -> Self {
        let rebound = (1.0 - INVERSE_MASS * impulse).powi(2);
        Self {
            rebound,
            radiated,
            residual: 1.0 - rebound - radiated,
        }
    }
}

/// Samples over a contact with which the work on a memory of several steps is taken.
const SAMPLES: f64 = 256.0;

/// Work left in the half-space by a force on a fixed disc: int p dw with the pressure-weighted mean of w.
///
/// The static part of w gives back what it takes, so only the dynamic part is integrated.
/// With [`Deflection::Mean`] in the contact law this equals the striker's loss; with
/// [`Deflection::Centre`] the contact law does another work than the pressure, and the ledger shows
/// the difference as its residual.
/// Within 1e-3 of itself under a force to a tolerance of 1e-4, within 2e-5 at 1e-6, for memories from a fiftieth of the
/// contact to all of it; measured against the spectrum of the force (`tests/reference/disc.csv`).
///
/// `duration` is that of the first contact.
#[must_use]
pub fn radiated<R: DiscResponse>(
    impact: &FixedDisc<'_, R>,
    mean: &R,
    history: &History,
    duration: f64,
) -> f64 {
    debug_assert_eq!(mean.deflection(), Deflection::Mean);
    let coupling = impact.coupling * mean.static_compliance() / impact.response.static_compliance();
    if let Some(work) = history.work_on(mean, coupling, impact.wave_time) {
        return work;
    }
    let fine;
    let step = history.step.min(duration / SAMPLES);
    let force = if step < history.step {
        let samples = Resampler::new(history.clone());
        let last = (samples.end() / step).ceil() as usize + 1;
        fine = (0..=last)
            .map(|i| samples.at(i as f64 * step).force)
            .collect::<Vec<f64>>();
        &fine
    } else {
        &history.force
    };
    let weights = Weights::of(impact, mean, step);
    let deflection: Vec<f64> = (0..force.len())
        .map(|n| -coupling * weights.delayed(&force[..=n]))
        .collect();
    work(force, &deflection)
}
