//! What is asked of a history: peaks, the end of contact, the rebound.
//!
//! None of them lies on a sample.
//! Peaks are interpolated through five samples.
//! The contact ends where b = d - w + A p reaches zero: b is smooth there while p goes to zero with
//! the power 3/2 (A is the compliance of the newest sample), so b is extrapolated from the last five
//! samples in contact and the force of the last cells is integrated from it.

use super::flight::impulse_until;
use super::implicit::solve;
use super::{History, MarchError};
use crate::quadrature::{GAUSS_8, Local, find_root, peak};
use crate::units::INVERSE_MASS;

/// The scalar results of an impact in collision units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Summary {
    /// Largest force.
    pub peak_force: f64,
    /// When it is reached.
    pub peak_force_time: f64,
    /// Duration of the first contact.
    pub contact_time: f64,
    /// Velocity of departure over velocity of approach.
    pub restitution: f64,
    /// Kinetic energy lost over kinetic energy before: 1 - restitution^2.
    pub loss: f64,
    /// Largest displacement of the striker.
    pub peak_displacement: f64,
    /// Largest deflection that enters the contact law.
    pub peak_deflection: f64,
    /// int p dt.
    pub impulse: f64,
    /// Number of contacts: 1 unless the surface strikes again.
    pub contacts: usize,
}

/// Samples in contact that the interpolation needs.
const NEEDED: usize = 8;

impl Summary {
    /// Of a history made by the implicit or the growing march.
    ///
    /// # Errors
    /// [`MarchError::StepTooLong`] when the contact has too few samples to interpolate.
    pub fn new(history: &History) -> Result<Self, MarchError> {
        let step = history.step;
        let force = &history.force;
        let end = first_separation(force);
        if end < NEEDED {
            return Err(MarchError::StepTooLong {
                samples: end,
                needed: NEEDED,
            });
        }
        let (contact_time, impulse) = end_of_contact(history, end);
        let (place, peak_force) = peak(force);
        let contacts = count_contacts(force, peak_force);
        let velocity = if contacts == 1 {
            1.0 - INVERSE_MASS * impulse
        } else {
            history.last_velocity()
        };
        Ok(Self {
            peak_force,
            peak_force_time: place * step,
            contact_time,
            restitution: -velocity,
            loss: (1.0 - velocity) * (1.0 + velocity),
            peak_displacement: peak(&history.displacement).1,
            peak_deflection: peak(&history.deflection).1,
            impulse: (1.0 - velocity) / INVERSE_MASS,
            contacts,
        })
    }

    /// The largest difference from another summary, relative (restitution: of the velocity of approach).
    #[must_use]
    pub fn distance(&self, other: &Self) -> f64 {
        let relative = |a: f64, b: f64| {
            let size = a.abs().max(b.abs());
            if size > 0.0 {
                (a - b).abs() / size
            } else {
                0.0
            }
        };
        [
            relative(self.peak_force, other.peak_force),
            relative(self.contact_time, other.contact_time),
            (self.restitution - other.restitution).abs(),
            relative(self.peak_displacement, other.peak_displacement),
            relative(self.peak_deflection, other.peak_deflection),
        ]
        .into_iter()
        .fold(0.0, f64::max)
    }
}

/// Index of the first sample without force after the touch.
fn first_separation(force: &[f64]) -> usize {
    let free = force.iter().skip(1).position(|&p| p <= 0.0);
    free.map_or(force.len(), |i| i + 1)
}

/// Contacts whose force exceeds 1e-6 of the largest.
fn count_contacts(force: &[f64], peak_force: f64) -> usize {
    let mut contacts = 0;
    let mut counted = false;
    for &p in force {
        if p <= 0.0 {
            counted = false;
        } else if !counted && p > 1e-6 * peak_force {
            counted = true;
            contacts += 1;
        }
    }
    contacts
}

/// End of the first contact and the impulse until then; `end` is the first free sample.
fn end_of_contact(history: &History, end: usize) -> (f64, f64) {
    let step = history.step;
    let a = history.compliance;
    let b = |i: usize| history.displacement[i] - history.deflection[i] + a * history.force[i];
    let from = end - 5;
    let local = Local::<5>::new(std::array::from_fn(|i| b(from + i)));
    // Place of zero in steps from `from`: beyond the fifth sample and before the first free one.
    let place = if local.value(4.0) > 0.0 && local.value(5.0) <= 0.0 {
        local.root(4.0, 5.0)
    } else {
        let (inside, outside) = (b(end - 1), b(end).min(0.0));
        4.0 + inside / (inside - outside).max(f64::MIN_POSITIVE)
    };
    let contact_time = (from as f64 + place) * step;
    // Samples 0..=k by Euler-Maclaurin, the rest from b with x^2 the time before the end.
    let k = end - 3;
    let rest = place - (k - from) as f64;
    let root = rest.sqrt();
    let tail: f64 = GAUSS_8
        .iter()
        .map(|&(x, weight)| {
            let before = (root * x) * (root * x);
            let y = solve(a, local.value(place - before), 0.0).unwrap_or(0.0);
            weight * root * 2.0 * root * x * y * y * y
        })
        .sum();
    (
        contact_time,
        impulse_until(&history.force, step, k) + tail * step,
    )
}

/// Time at which a linearly interpolated decreasing quantity passes zero after sample `i`.
pub(crate) fn linear_crossing(before: f64, after: f64) -> f64 {
    find_root(
        |x| (before + x * (after - before), after - before),
        0.0,
        1.0,
    )
}
