//! The energy ledger: what the striker loses and where it goes, and the work of a sampled force.
//!
//! Energy is relative to the kinetic energy before, time and force are in collision units.
//!
//! Theory: `docs/theory.md` (T56, T57).

use crate::disc::FixedDisc;
use crate::disc::edge::{RESOLVED, Relaxation};
use crate::disc::history::History;
use crate::disc::response::DiscResponse;
use crate::disc::weights::Weights;
use crate::resample::Resampler;
use halfspace::Deflection;
use std::borrow::Cow;

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
    let step = history.step.min(duration / SAMPLES);
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

/// int p dw over each cell.
///
/// The trapezoid of Stieltjes with its next correction, (p' w'' - p'' w') h^3/12 a cell, where the
/// force is smooth; of second order because of the cells in which contact begins and ends.
fn cells<'a>(force: &'a [f64], deflection: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
    let (p, w) = (force, deflection);
    (1..p.len().min(w.len())).map(move |i| {
        let (rise, moved) = (p[i] - p[i - 1], w[i] - w[i - 1]);
        let total = p[i] + p[i - 1];
        if total == 0.0 {
            return 0.0;
        }
        let mut sum = 0.5 * total * moved;
        if i >= 2 && i + 1 < p.len() && p[i] != 0.0 {
            // twice the mean of the second differences at both ends of the cell
            let bend = |x: &[f64]| x[i + 1] - x[i] - x[i - 1] + x[i - 2];
            sum += (rise * bend(w) - bend(p) * moved) / 24.0;
        }
        sum
    })
}

/// int p dw over the kinetic energy before, of a contact in collision units.
pub(crate) fn work(force: &[f64], deflection: &[f64]) -> f64 {
    // force times length is 5/2 of the kinetic energy
    2.5 * cells(force, deflection).sum::<f64>()
}

/// int P dw in J from the first sample to each, of forces in N and deflections in m.
pub fn work_until_j(force_n: &[f64], deflection_m: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let first = force_n.first().map(|_| 0.0);
    let all = first.into_iter().chain(cells(force_n, deflection_m));
    let until = all.map(|cell| {
        sum += cell;
        sum
    });
    until.collect()
}
