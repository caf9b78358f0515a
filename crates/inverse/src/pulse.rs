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
        // thirty-two steps of Runge and Kutta for each node: 1e-9
        const STEPS: usize = 32;
        let step = 0.5 * CONTACT_TIME / (half * STEPS) as f64;
        let rate = |d: f64| -1.25 * d.max(0.0).powf(1.5);
        let (mut d, mut v) = (0.0, 1.0);
        let mut nodes = vec![[0.0; 2]; INTERVALS + 1];
        for i in 0..=half {
            let slope = 1.5 * f64::sqrt(d) * v * CONTACT_TIME;
            nodes[i] = [d.powf(1.5), slope];
            nodes[INTERVALS - i] = [nodes[i][0], -slope];
            for _ in 0..STEPS {
                let (d1, v1) = (v, rate(d));
                let (d2, v2) = (v + 0.5 * step * v1, rate(d + 0.5 * step * d1));
                let (d3, v3) = (v + 0.5 * step * v2, rate(d + 0.5 * step * d2));
                let (d4, v4) = (v + step * v3, rate(d + step * d3));
                d += step / 6.0 * (d1 + 2.0 * (d2 + d3) + d4);
                v += step / 6.0 * (v1 + 2.0 * (v2 + v3) + v4);
            }
        }
        Self { nodes }
    }

    /// The pulse through equidistant samples of a force, from the beginning of a contact to its end.
    ///
    /// # Errors
    /// [`InverseError`] for fewer than five samples, for one that is not finite, and for a force that is not positive.
    pub fn sampled(force: &[f64]) -> Result<Self, InverseError> {
        let count = force.len();
        check(
            count >= 5,
            "the number of samples of the pulse",
            count as f64,
            "[5, inf)",
        )?;
        finite("the pulse", force)?;
        let peak = force.iter().fold(0.0, |a: f64, b| a.max(*b));
        positive("the peak of the pulse", peak)?;
        let (last, scale) = (force.len() - 1, (force.len() - 1) as f64 / peak);
        let slope = |i: usize| match i {
            0 => force[1] - force[0],
            i if i == last => force[last] - force[last - 1],
            i => 0.5 * (force[i + 1] - force[i - 1]),
        };
        let nodes = (0..=last).map(|i| [force[i] / peak, slope(i) * scale]);
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
        let cells = self.nodes.windows(2).map(|pair| {
            let ([a, slope_a], [b, slope_b]) = (pair[0], pair[1]);
            0.5 * (a + b) + (slope_a - slope_b) / (12 * (self.nodes.len() - 1)) as f64
        });
        cells.sum::<f64>() / (self.nodes.len() - 1) as f64
    }
}
