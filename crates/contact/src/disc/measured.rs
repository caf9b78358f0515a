//! Results of the samples of a march: peaks, the end of contact, the rebound.
//!
//! None of them lies on a sample.
//! Peaks are interpolated through five samples.
//! The contact ends where b = d - w + A p reaches zero: b is smooth there while p goes to zero with
//! the power 3/2 (A is the compliance of the newest sample), so b is extrapolated from the last five
//! samples in contact and the force of the last cells is integrated from it.

use crate::error::MarchError;
use crate::history::History;
use crate::numeric::cubic::force_root;
use crate::numeric::quadrature::{GAUSS_8, LocalPolynomial, peak};
use crate::numeric::work::work;
use crate::summary::{SMALL_LOSS, Summary};
use crate::units::INVERSE_MASS;

/// Samples in contact that the interpolation needs.
const NEEDED_SAMPLES: usize = 8;

/// Fraction of the last change of the contact time that is its error, chosen so that the estimates hold
/// (`tests/estimates.rs`), and what stays of it at any step: of an end found by extrapolation of what is smooth there.
const SMOOTH_END: [f64; 2] = [1.0, 0.0];

/// The same fraction of an end that comes from the residual deflection; its uncertainty stays at any step.
const KEPT_END: f64 = 0.5;

impl Summary {
    /// Of a history made by the implicit march.
    ///
    /// # Errors
    /// [`MarchError::StepTooLong`] when the contact has too few samples to interpolate.
    pub fn new(history: &History) -> Result<Self, MarchError> {
        Self::measured(history).map(|(summary, _)| summary)
    }

    /// The same, with the fraction of the last change of the contact time that is its error, and the error that stays at any
    /// step.
    pub(crate) fn measured(history: &History) -> Result<(Self, [f64; 2]), MarchError> {
        let step = history.step;
        let force = &history.force;
        let end = first_separation(force);
        if end < NEEDED_SAMPLES {
            return Err(MarchError::StepTooLong {
                samples: end,
                needed: NEEDED_SAMPLES,
            });
        }
        let (contact_time, impulse) = end_of_contact(history, end);
        let how = match &history.separation {
            None => SMOOTH_END,
            Some(found) => [KEPT_END, found.uncertainty / found.time],
        };
        let (place, peak_force) = peak(force);
        // those whose force exceeds 1e-6 of the largest
        let counts = |contact: &&[f64]| contact.iter().any(|p| *p > 1e-6 * peak_force);
        let contacts = force.split(|p| *p <= 0.0).filter(counts).count();
        let (by_momentum, (velocity, loss)) = if contacts == 1 {
            let v = 1.0 - INVERSE_MASS * impulse;
            (v, departure(v, history))
        } else {
            let v = history.last_velocity();
            (v, (v, (1.0 - v) * (1.0 + v)))
        };
        let summary = Self {
            peak_force,
            peak_force_time: place * step,
            contact_time,
            restitution: -velocity,
            loss,
            peak_displacement: peak(&history.displacement).1,
            peak_deflection: peak(&history.deflection).1,
            impulse: (1.0 - by_momentum) / INVERSE_MASS,
            contacts,
        };
        Ok((summary, how))
    }
}

/// Velocity of departure and loss.
///
/// Hertz's spring returns its work, so the loss is the work int p dw: an error of this sum
/// is relative to the loss however small it is, that of the momentum is relative to all energy.
fn departure(velocity: f64, history: &History) -> (f64, f64) {
    let loss = (1.0 - velocity) * (1.0 + velocity);
    let small = |work: &f64| *work < SMALL_LOSS && loss < 2.0 * SMALL_LOSS;
    let work = history
        .dissipated
        .or_else(|| Some(work(&history.force, &history.deflection)).filter(small))
        .filter(|work| velocity < 0.0 && *work < 1.0);
    match work {
        Some(work) => (-(1.0 - work).sqrt(), work),
        None => (velocity, loss),
    }
}

/// Index of the first sample without force after the touch.
pub(crate) fn first_separation(force: &[f64]) -> usize {
    let free = force.iter().skip(1).position(|&p| p <= 0.0);
    free.map_or(force.len(), |i| i + 1)
}

/// End of the first contact and the impulse until then; `end` is the first free sample.
fn end_of_contact(history: &History, end: usize) -> (f64, f64) {
    let step = history.step;
    let k = end - 3;
    if let Some(found) = history.separation {
        return (found.time, history.impulse_until(k) + found.impulse);
    }
    let a = history.compliance;
    let b = |i: usize| history.displacement[i] - history.deflection[i] + a * history.force[i];
    let from = end - 5;
    let local = LocalPolynomial::<5>::new(std::array::from_fn(|i| b(from + i)));
    // Place of zero in steps from `from`: beyond the fifth sample and before the first free one.
    let place = if local.value(4.0) > 0.0 && local.value(5.0) <= 0.0 {
        local.root(4.0, 5.0)
    } else {
        let (inside, outside) = (b(end - 1), b(end).min(0.0));
        4.0 + inside / (inside - outside).max(f64::MIN_POSITIVE)
    };
    let contact_time = (from as f64 + place) * step;
    // Samples 0..=k by Euler-Maclaurin, the rest from b with x^2 the time before the end.
    let rest = place - (k - from) as f64;
    let root = rest.sqrt();
    let part = |&(x, weight): &(f64, f64)| {
        let before = (root * x) * (root * x);
        let y = force_root(a, local.value(place - before), 0.0).unwrap_or(0.0);
        weight * root * 2.0 * root * x * y * y * y
    };
    let tail: f64 = GAUSS_8.iter().map(part).sum();
    (contact_time, history.impulse_until(k) + tail * step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disc::FixedDisc;
    use crate::disc::implicit::march_implicit;
    use crate::settings::StaticShare;
    use halfspace::{Deflection, Medium, SurfaceResponse};

    /// Where the loss is taken from the work, the impulse is still that of the force: the ledger's two sides are two.
    #[test]
    fn the_impulse_knows_nothing_of_the_work() {
        let response = SurfaceResponse::new(&Medium::new(0.3).unwrap(), Deflection::Mean);
        let impact = FixedDisc {
            response: &response,
            coupling: 0.1,
            wave_time: 0.01,
            share: StaticShare::Full,
        };
        let mut history = march_implicit(&impact, 0.03).unwrap();
        let found = Summary::new(&history).unwrap();
        let work = history.dissipated.unwrap();
        assert!(found.loss == work && work < SMALL_LOSS);
        let momentum = 1.0 - (1.0 - INVERSE_MASS * found.impulse).powi(2);
        assert!((momentum / work - 1.0).abs() < 1e-3, "{momentum} {work}");
        history.dissipated = Some(1.01 * work);
        let other = Summary::new(&history).unwrap();
        assert!(other.loss > found.loss && other.impulse == found.impulse);
        for force in &mut history.force {
            *force *= 1.001;
        }
        assert!(Summary::new(&history).unwrap().impulse > 1.0005 * found.impulse);
    }
}
