//! The results of an impact, and its state at an instant.

use crate::units::INVERSE_MASS;

/// Loss below which it is taken from the work on the half-space, not from the momentum.
pub(crate) const SMALL_LOSS: f64 = 0.03;

/// The scalar results of an impact in collision units.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
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
    /// int p dt over all contacts, from the force alone: the change of the striker's momentum, whichever route
    /// gave the restitution. Closed forms have no other than that of their restitution.
    pub impulse: f64,
    /// Number of contacts: 1 unless the surface strikes again.
    pub contacts: usize,
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
    /// Of the largest deflection; infinite if there is no estimate.
    pub peak_deflection: f64,
    /// Of the force at any time, over the largest.
    pub force: f64,
}

impl Estimates {
    /// The largest of those with a tolerance: peak force, contact time, restitution, displacement.
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
    /// Displacement of the striker.
    pub displacement: f64,
    /// Velocity of the striker.
    pub velocity: f64,
    /// Deflection that enters the contact law.
    pub deflection: f64,
}

impl Summary {
    /// Of one contact with a restitution: loss and impulse follow from it, the rest is for the caller to fill in.
    pub(crate) fn rebound(restitution: f64) -> Self {
        Self {
            restitution,
            loss: (1.0 - restitution) * (1.0 + restitution),
            impulse: (1.0 + restitution) / INVERSE_MASS,
            contacts: 1,
            ..Self::default()
        }
    }

    /// The largest difference of the results with a tolerance, relative (restitution: of the velocity
    /// of approach): peak force, contact time, restitution, largest displacement.
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
