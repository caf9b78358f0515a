//! The force pulse of a contact law.

use crate::error::{InverseError, check, finite, positive};
use contact::law::hertz::CONTACT_TIME;

/// Intervals of the table of a pulse. Its error is 1e-5 of the peak, at the ends, where Hertz's pulse rises as t^1.5.
const INTERVALS: usize = 512;

/// A force pulse over the duration 1 with the peak 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Pulse {
    /// Values and slopes at equidistant times.
    nodes: Vec<[f64; 2]>,
}

impl Pulse {
    /// Hertz's pulse: d'' = -(5/4) d^1.5, p = d^1.5, in collision units (T38).
    pub fn hertz() -> Self {
        let half = INTERVALS / 2;
        // steps for each node by half a kick, a drift and half a kick: 1e-8
        const STEPS: usize = 32;
        let step = 0.5 * CONTACT_TIME / (half * STEPS) as f64;
        let kick = |d: f64| -0.625 * step * d.max(0.0).powf(1.5);
        let (mut d, mut v) = (0.0, 1.0);
        let mut nodes = vec![[0.0; 2]; INTERVALS + 1];
        for i in 0..=half {
            let slope = 1.5 * f64::sqrt(d) * v * CONTACT_TIME;
            nodes[i] = [d.powf(1.5), slope];
            nodes[INTERVALS - i] = [nodes[i][0], -slope];
            for _ in 0..STEPS {
                v += kick(d);
                d += step * v;
                v += kick(d);
            }
        }
        Self { nodes }
    }

    /// The pulse through equidistant samples of a force, from the beginning of a contact to its end.
    ///
    /// # Errors
    /// [`InverseError`] for fewer than five samples, for one that is not finite, and for a force that is not positive.
    pub fn sampled(force: &[f64]) -> Result<Self, InverseError> {
        let (key, count) = ("the number of samples of the pulse", force.len());
        check(count >= 5, key, count as f64, "[5, inf)")?;
        finite("the pulse", force)?;
        let peak = force.iter().fold(0.0, |a: f64, b| a.max(*b));
        positive("the peak of the pulse", peak)?;
        let scale = (count - 1) as f64 / peak;
        let node = |i: usize| {
            let (before, after) = (i.saturating_sub(1), (i + 1).min(count - 1));
            let slope = (force[after] - force[before]) / (after - before) as f64;
            [force[i] / peak, scale * slope]
        };
        let nodes = (0..count).map(node);
        Ok(Self {
            nodes: nodes.collect(),
        })
    }

    /// Value and slope at a fraction of the duration; zero outside [0, 1].
    pub fn at(&self, fraction: f64) -> [f64; 2] {
        let cells = (self.nodes.len() - 1) as f64;
        if !(0.0..1.0).contains(&fraction) {
            return [0.0; 2];
        }
        let place = fraction * cells;
        let (i, s) = (place.floor() as usize, place.fract());
        let ([a, slope_a], [b, slope_b]) = (self.nodes[i], self.nodes[i + 1]);
        let (slope_a, slope_b) = (slope_a / cells, slope_b / cells);
        let (bend, twist) = (b - a - slope_a, slope_a + slope_b - 2.0 * (b - a));
        let value = a + s * (slope_a + s * (bend - twist + s * twist));
        let slope = slope_a + s * (2.0 * (bend - twist) + 3.0 * s * twist);
        [value, slope * cells]
    }

    /// Impulse over peak and duration: 0.5436 of Hertz's pulse.
    pub fn mean(&self) -> f64 {
        let cells = (self.nodes.len() - 1) as f64;
        let each = self.nodes.windows(2).map(|pair| {
            let ([a, slope_a], [b, slope_b]) = (pair[0], pair[1]);
            0.5 * (a + b) + (slope_a - slope_b) / (12.0 * cells)
        });
        each.sum::<f64>() / cells
    }
}
