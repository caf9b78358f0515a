//! What is asked of a history: peaks, the end of contact, the rebound.
//!
//! None of them lies on a sample.
//! Peaks are interpolated through five samples.
//! The contact ends where b = d - w + A p reaches zero: b is smooth there while p goes to zero with
//! the power 3/2 (A is the compliance of the newest sample), so b is extrapolated from the last five
//! samples in contact and the force of the last cells is integrated from it.

use crate::disc::history::History;
use crate::energy::work;
use crate::error::MarchError;
use crate::numeric::cubic::force_root;
use crate::numeric::quadrature::{GAUSS_8, Local, peak};
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
    /// int p dt over all contacts, from the force alone: what the momentum of the striker changes by, whatever route
    /// gave the restitution. Closed forms have no other than that of their restitution.
    pub impulse: f64,
    /// Number of contacts: 1 unless the surface strikes again.
    pub contacts: usize,
    /// How well the end of contact is known.
    pub end: EndOfContact,
}

/// Estimated errors of the results: relative, but that of the restitution, which is absolute.
///
/// Each is true in 99 of 100 random scenes; see `tests/growing.rs`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimates {
    /// Of the largest force.
    pub peak_force: f64,
    /// Of its time, over the contact time.
    pub peak_force_time: f64,
    /// Of the contact time.
    pub contact_time: f64,
    /// Of the restitution, of the velocity of approach.
    pub restitution: f64,
    /// Of the loss.
    pub loss: f64,
    /// Of the largest displacement.
    pub peak_displacement: f64,
    /// Of the largest deflection; infinite where nobody has estimated it.
    pub peak_deflection: f64,
    /// Of the force at any time, over the largest.
    pub force: f64,
}

impl Estimates {
    /// The largest of what a tolerance is asked on: peak force, contact time, restitution, displacement.
    #[must_use]
    pub fn contact(&self) -> f64 {
        self.peak_force
            .max(self.contact_time)
            .max(self.restitution)
            .max(self.peak_displacement)
    }
}

/// The state of an impact at one instant, in collision units.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Instant {
    /// Contact force.
    pub force: f64,
    /// Its rate.
    pub rate: f64,
    /// The rate's rate; zero at the very ends of a contact, where it has no bound.
    pub second_rate: f64,
    /// Displacement of the striker.
    pub displacement: f64,
    /// Velocity of the striker.
    pub velocity: f64,
    /// Deflection that enters the contact law.
    pub deflection: f64,
}

/// How the end of the first contact was found, and so what the contact time's error does with the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EndOfContact {
    /// By extrapolation of what is smooth there.
    Smooth,
    /// From what the surface keeps of the force, of this relative uncertainty at any step longer than its memory.
    Kept(f64),
    /// In a contact whose radius goes to zero, its last instants resolved: of first order.
    Singular,
    /// In such a contact with its last instants in closed form, of this relative uncertainty.
    Layer(f64),
}

impl EndOfContact {
    /// Fraction of the last change of the contact time that is taken as its error, and what stays at any step.
    ///
    /// Chosen so that the estimates hold: `tests/estimates.rs`.
    pub(crate) fn rest(self) -> (f64, f64) {
        match self {
            Self::Smooth => (1.0, 0.0),
            Self::Kept(uncertainty) => (0.5, uncertainty),
            Self::Singular => (1.5, 0.0),
            Self::Layer(uncertainty) => (1.0 / 3.0, uncertainty),
        }
    }
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
        let (mut contact_time, impulse) = end_of_contact(history, end);
        let mut how = history.separation.map_or(EndOfContact::Smooth, |found| {
            EndOfContact::Kept(found.uncertainty / found.time)
        });
        if let Some(layer) = history.end_layer {
            how = EndOfContact::Singular;
            if let Some((time, uncertainty)) = end_of_layer(history, end, layer) {
                contact_time = time;
                how = EndOfContact::Layer(uncertainty / time);
            }
        }
        let (place, peak_force) = peak(force);
        let contacts = count_contacts(force, peak_force);
        let by_momentum = if contacts == 1 {
            1.0 - INVERSE_MASS * impulse
        } else {
            history.last_velocity()
        };
        let (velocity, loss) = if contacts == 1 {
            departure(by_momentum, history)
        } else {
            (by_momentum, (1.0 - by_momentum) * (1.0 + by_momentum))
        };
        Ok(Self {
            peak_force,
            peak_force_time: place * step,
            contact_time,
            restitution: -velocity,
            loss,
            peak_displacement: peak(&history.displacement).1,
            peak_deflection: peak(&history.deflection).1,
            impulse: (1.0 - by_momentum) / INVERSE_MASS,
            contacts,
            end: how,
        })
    }

    /// The largest difference of what a tolerance is asked on, relative (restitution: of the velocity
    /// of approach): peak force, contact time, restitution, largest displacement.
    #[must_use]
    pub fn distance(&self, other: &Self) -> f64 {
        self.motion_distance(other)
            .max(relative(self.contact_time, other.contact_time))
    }

    /// The same without the contact time.
    pub(crate) fn motion_distance(&self, other: &Self) -> f64 {
        relative(self.peak_force, other.peak_force)
            .max((self.restitution - other.restitution).abs())
            .max(relative(self.peak_displacement, other.peak_displacement))
    }

    /// The relative difference of the loss.
    #[must_use]
    pub fn loss_distance(&self, other: &Self) -> f64 {
        relative(self.loss, other.loss)
    }
}

/// The difference over the larger of two numbers.
pub(crate) fn relative(a: f64, b: f64) -> f64 {
    let size = a.abs().max(b.abs());
    if size > 0.0 {
        (a - b).abs() / size
    } else {
        0.0
    }
}

/// Loss below which it is taken from the work on the half-space, not from the momentum.
const SMALL_LOSS: f64 = 0.03;

/// Velocity of departure and loss.
///
/// Hertz's spring gives back what it takes, so the loss is the work int p dw: an error of this sum
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

/// Uncertainty of the time spent in the end layer.
const LAYER_UNCERTAINTY: f64 = 0.05;

/// End of a contact with a layer that the step does not resolve, and its uncertainty.
///
/// The displacement is smooth there, so the place where it reaches the layer's depth is known well.
fn end_of_layer(history: &History, end: usize, [depth, width]: [f64; 2]) -> Option<(f64, f64)> {
    let (step, d) = (history.step, &history.displacement);
    let from = end.checked_sub(3)?;
    if width == 0.0 || end + 1 >= d.len() {
        return None;
    }
    let velocity = (d[end - 1] - d[end]) / step;
    if velocity <= 0.0 || 4.0 * step < width * velocity {
        return None;
    }
    let depth = depth * velocity * velocity;
    let local = Local::<5>::new(std::array::from_fn(|i| d[from + i] - depth));
    if local.value(0.0) <= 0.0 || local.value(4.0) >= 0.0 {
        return None;
    }
    let time = (from as f64 + local.root(0.0, 4.0)) * step;
    Some((time, LAYER_UNCERTAINTY * depth / velocity))
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
    let rest = place - (k - from) as f64;
    let root = rest.sqrt();
    let tail: f64 = GAUSS_8
        .iter()
        .map(|&(x, weight)| {
            let before = (root * x) * (root * x);
            let y = force_root(a, local.value(place - before), 0.0).unwrap_or(0.0);
            weight * root * 2.0 * root * x * y * y * y
        })
        .sum();
    (contact_time, history.impulse_until(k) + tail * step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disc::FixedDisc;
    use crate::disc::implicit::march_implicit;
    use crate::model::StaticShare;
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
