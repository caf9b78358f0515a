//! A contact read at any time: between samples, within the pieces of a growing contact, after the striker has left.

use crate::history::History;
use crate::numeric::quadrature::{LocalPolynomial, find_root, hermite, quintic};
use crate::summary::Instant;
use crate::units::INVERSE_MASS;
use std::sync::OnceLock;

/// A history at any time: the pieces of a growing contact, or samples joined by polynomials of the fifth degree.
///
/// Interpolated is the indentation d - w, which is smooth where contact begins and ends while the force has the power
/// 3/2 there; force, rate and second rate are those of one function.
#[derive(Debug, Clone, Default)]
pub struct Resampler {
    /// The history that is read.
    pub history: History,
    /// Indentation with its slope and curvature over a step, at each sample.
    indentation: Vec<[f64; 3]>,
    /// Velocity at each sample, computed with the first state.
    velocity: OnceLock<Vec<f64>>,
    /// Where each contact begins and ends, in collision units, ascending.
    pub breaks: Vec<f64>,
}

/// Samples through which slopes and curvatures are taken.
const SAMPLES_OF_SLOPE: usize = 5;

impl Resampler {
    /// Of a history.
    pub fn new(history: History) -> Self {
        let mut made = Self {
            history,
            ..Self::default()
        };
        if let Some(solved) = &made.history.pieces {
            made.breaks = vec![0.0, solved.summary.contact_time];
            return made;
        }
        let (d, w) = (&made.history.displacement, &made.history.deflection);
        let values: Vec<f64> = d.iter().zip(w).map(|(d, w)| d - w).collect();
        let most = values.len().saturating_sub(SAMPLES_OF_SLOPE);
        let jet = |i: usize| {
            let from = i.saturating_sub(SAMPLES_OF_SLOPE / 2).min(most);
            let [_, slope, half] =
                LocalPolynomial::<SAMPLES_OF_SLOPE>::at(&values, from).jet((i - from) as f64);
            [values[i], slope, 2.0 * half]
        };
        let enough = values.len() >= SAMPLES_OF_SLOPE;
        made.indentation = (0..values.len()).filter(|_| enough).map(jet).collect();
        made.breaks = made.crossings();
        made
    }

    /// The first sample after all contacts, in collision units.
    pub fn end(&self) -> f64 {
        if let Some(solved) = &self.history.pieces {
            return solved.summary.contact_time;
        }
        let last = self.indentation.iter().rposition(|u| u[0] > 0.0);
        (last.unwrap_or(0) + 1) as f64 * self.history.step
    }

    /// Force, rate and second rate at a time in collision units; zero outside the contacts.
    ///
    /// Inlined, so that whoever takes the force alone has it in half of the time.
    #[inline(always)]
    pub fn force(&self, time: f64) -> [f64; 3] {
        if let Some(solved) = &self.history.pieces {
            return solved.force(time);
        }
        match self.place(time) {
            Some((cell, x)) => pressed_by(self.indentation(cell, x)),
            None => [0.0; 3],
        }
    }

    /// The same at several times, fastest where they ascend.
    pub fn forces(&self, times: &[f64]) -> Vec<[f64; 3]> {
        match &self.history.pieces {
            Some(solved) => solved.forces(times),
            None => times.iter().map(|&time| self.force(time)).collect(),
        }
    }

    /// The state at a time in collision units, from the touch on.
    pub fn at(&self, time: f64) -> Instant {
        if let Some(solved) = &self.history.pieces {
            return solved.state(time);
        }
        let (d, h) = (&self.history.displacement, self.history.step);
        let v = self.velocity.get_or_init(|| self.history.velocities());
        let Some((cell, x)) = self.place(time) else {
            let last = d.len() - 1;
            return Instant {
                displacement: d[last] + v[last] * (time - last as f64 * h),
                velocity: v[last],
                ..Instant::default()
            };
        };
        let jet = self.indentation(cell, x);
        let displacement = hermite([d[cell], h * v[cell]], [d[cell + 1], h * v[cell + 1]], x);
        let slope = |i: usize| {
            let u = self.indentation[i][0].max(0.0);
            -INVERSE_MASS * h * u * u.sqrt()
        };
        Instant {
            force: pressed_by(jet)[0],
            displacement,
            velocity: hermite([v[cell], slope(cell)], [v[cell + 1], slope(cell + 1)], x),
            deflection: displacement - jet[0],
        }
    }

    /// The cell that holds a time, and the place in it; nothing after the last sample.
    fn place(&self, time: f64) -> Option<(usize, f64)> {
        let place = (time / self.history.step).max(0.0);
        let cell = place as usize;
        (cell + 1 < self.indentation.len()).then_some((cell, place - cell as f64))
    }

    /// The indentation, its slope and curvature in time: the polynomial that has all three of both ends.
    #[inline(always)]
    fn indentation(&self, cell: usize, x: f64) -> [f64; 3] {
        let [u, slope, bend] = quintic(self.indentation[cell], self.indentation[cell + 1], x);
        let per = 1.0 / self.history.step;
        [u, per * slope, per * per * bend]
    }

    /// Where the indentation changes its sign.
    fn crossings(&self) -> Vec<f64> {
        let mut found = vec![0.0];
        for (cell, pair) in self.indentation.windows(2).enumerate() {
            let [before, after] = [pair[0][0], pair[1][0]];
            if cell > 0 && (before > 0.0) != (after > 0.0) {
                let value = |x: f64| {
                    let [u, slope, _] = self.indentation(cell, x);
                    [u, slope * self.history.step]
                };
                found.push((cell as f64 + find_root(value, 0.0, 1.0)) * self.history.step);
            }
        }
        // the last sample is the end itself
        if found.len() % 2 == 1 {
            found.push(self.indentation.len().saturating_sub(1) as f64 * self.history.step);
        }
        found
    }
}

/// The force of an indentation u and its rates: p = u^(3/2).
#[inline(always)]
fn pressed_by([u, slope, bend]: [f64; 3]) -> [f64; 3] {
    if u <= 0.0 {
        return [0.0; 3];
    }
    let y = u.sqrt();
    let second_rate = 1.5 * (y * bend + 0.5 * slope * slope / y);
    [u * y, 1.5 * y * slope, second_rate]
}
