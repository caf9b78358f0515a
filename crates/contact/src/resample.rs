//! A march read at any time: between samples, and after the striker has left.

use crate::force_balance::force_root;
use crate::march::history::History;
use crate::quadrature::Local;

/// The state of an impact at one instant, in collision units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instant {
    /// Contact force.
    pub force: f64,
    /// Its rate.
    pub rate: f64,
    /// Displacement of the striker.
    pub displacement: f64,
    /// Velocity of the striker.
    pub velocity: f64,
    /// Deflection that enters the contact law.
    pub deflection: f64,
}

/// Cubic interpolation of a history.
///
/// The force is interpolated through b = d - w + A p, which stays smooth where contact begins and
/// ends while p has the power 3/2 there.
#[derive(Debug, Clone)]
pub struct Resampler {
    history: History,
    velocity: Vec<f64>,
    smooth: Vec<f64>,
}

impl Resampler {
    /// Of a history.
    #[must_use]
    pub fn new(history: History) -> Self {
        let smooth = (0..history.force.len())
            .map(|i| {
                history.displacement[i] - history.deflection[i]
                    + history.compliance * history.force[i]
            })
            .collect();
        Self {
            velocity: history.velocities(),
            history,
            smooth,
        }
    }

    /// The first sample after all contacts, in collision units.
    #[must_use]
    pub fn end(&self) -> f64 {
        let force = &self.history.force;
        let last = force.iter().rposition(|&p| p > 0.0).unwrap_or(0);
        (last + 1) as f64 * self.history.step
    }

    /// The state at a time in collision units, from the touch on.
    #[must_use]
    pub fn at(&self, time: f64) -> Instant {
        let n = self.smooth.len();
        let place = (time / self.history.step).max(0.0);
        let last = (n - 1) as f64;
        if place >= last || n < 4 {
            let velocity = self.velocity[n - 1];
            let since = time - last * self.history.step;
            return Instant {
                force: 0.0,
                rate: 0.0,
                displacement: self.history.displacement[n - 1] + velocity * since,
                velocity,
                deflection: 0.0,
            };
        }
        let from = (place as usize).saturating_sub(1).min(n - 4);
        let x = place - from as f64;
        let read = |samples: &[f64]| Local::<4>::at(samples, from).value(x);
        let cell = place as usize;
        let touching = self.history.force[cell] > 0.0 || self.history.force[cell + 1] > 0.0;
        let (force, rate) = if touching {
            // a y^3 + y^2 = b, p = y^3
            let a = self.history.compliance;
            let (b, slope) = Local::<4>::at(&self.smooth, from).value_and_slope(x);
            match force_root(a, b, 0.0) {
                Some(y) => (
                    y * y * y,
                    3.0 * y * slope / (self.history.step * (3.0 * a * y + 2.0)),
                ),
                None => (self.history.force[cell], 0.0),
            }
        } else {
            (0.0, 0.0)
        };
        let displacement = read(&self.history.displacement);
        Instant {
            force,
            rate,
            displacement,
            velocity: read(&self.velocity),
            // in contact by the law itself, which needs no smoothness of the deflection
            deflection: if force > 0.0 {
                displacement - force.cbrt().powi(2)
            } else {
                read(&self.history.deflection)
            },
        }
    }
}
