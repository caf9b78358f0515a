//! Energy that a contact on a fixed disc radiates: the work of its force on the mean deflection of the disc.
//!
//! Energy is relative to the kinetic energy before, time and force are in collision units.
//!
//! Theory: `docs/theory.md` (T56, T57).

use crate::disc::FixedDisc;
use crate::disc::edge::{RESOLVED, Relaxation};
use crate::disc::weights::Weights;
use crate::history::History;
use crate::history::resample::Resampler;
use crate::numeric::work::work;
use crate::waves::response::DiscResponse;
use halfspace::Deflection;
use std::borrow::Cow;

/// Samples over a contact with which the work on a memory of several steps is taken.
const SAMPLES_OF_WORK: f64 = 256.0;

/// Work left in the half-space by a force on a fixed disc: int p dw with the pressure-weighted mean of w.
///
/// The static part of w returns its work, so only the dynamic part is integrated.
/// With [`Deflection::Mean`] in the contact law this equals the striker's loss; with
/// [`Deflection::Centre`] the contact law does another work than the pressure, and the ledger shows
/// the difference as its residual.
/// Within 1e-3 of itself under a force to a tolerance of 1e-4, within 2e-5 at 1e-6, for memories from a fiftieth of the
/// contact to all of it; measured against the spectrum of the force (`tests/reference/disc.csv`).
///
/// `duration` is that of the first contact.
pub(crate) fn radiated<R: DiscResponse>(
    impact: &FixedDisc<'_, R>,
    mean: &R,
    history: &History,
    duration: f64,
) -> f64 {
    debug_assert_eq!(mean.disc().deflection, Deflection::Mean);
    let coupling =
        impact.coupling * mean.disc().static_compliance / impact.response.disc().static_compliance;
    let relaxation = Relaxation::of(mean, coupling, impact.wave_time / history.step);
    // beyond that it knows no more than its memory
    if relaxation.memory <= RESOLVED
        && let Some(work) = history.work_on(&relaxation)
    {
        return work;
    }
    let step = history.step.min(duration / SAMPLES_OF_WORK);
    let mut force = Cow::from(&history.force);
    if step < history.step {
        let samples = Resampler::new(history.clone());
        let last = (samples.end() / step).ceil() as usize + 1;
        force = (0..=last)
            .map(|i| samples.force(i as f64 * step)[0])
            .collect();
    }
    let weights = Weights::of(impact, mean, step);
    let deflected = |n: usize| -coupling * weights.delayed(&force[..=n]);
    let deflection: Vec<f64> = (0..force.len()).map(deflected).collect();
    work(&force, &deflection)
}
