//! Motion of a ball under a force law of a particle code, from the first to the last contact.
//!
//! In collision units: v' = -(5/4) p, and Hertz's law is p = d^1.5.

use std::f64::consts::PI;

/// Depth at which a contact begins and ends, and the largest step relative to the depth.
const TOUCH: f64 = 1e-10;
const LARGEST_RELATIVE_STEP: f64 = 0.05;

/// Largest time step, and the step that locates the end of a contact without tensile force.
const LARGEST_STEP: f64 = 2e-3;
const SMALLEST_STEP: f64 = 1e-9;

/// Largest damping ratio; its restitution is below 1e-3.
const MOST_DAMPING: f64 = 50.0;

/// Results of a contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rebound {
    pub(super) restitution: f64,
    pub(super) contact_time: f64,
    pub(super) peak_force: f64,
    /// Largest indentation.
    pub(super) depth: f64,
}

/// Damping of a force law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Damping {
    None,
    /// (9/4) c d v with the lag c: the area dashpot.
    Area(f64),
    /// 2 beta sqrt(m k) v with the stiffness k = dp/dd: the same restitution at all velocities.
    Ratio(f64),
}

impl Damping {
    /// The ratio for a restitution e in (0, 1] in a code with tensile damping: `sqrt(5/6) |ln e|/sqrt(pi^2 + ln^2 e)`.
    ///
    /// If the force is cut at zero, the ratio is solved for such that the ball leaves with e.
    pub(super) fn of_restitution(restitution: f64, pulls: bool) -> Self {
        let decay = -restitution.ln();
        if pulls || decay <= 0.0 {
            return Self::Ratio((5.0_f64 / 6.0).sqrt() * decay / decay.hypot(PI));
        }
        let (mut low, mut high) = (0.0, MOST_DAMPING);
        // bisects to 1e-13 of the largest ratio
        for _ in 0..43 {
            let middle = 0.5 * (low + high);
            let slow = Self::Ratio(middle).rebound(false).restitution < restitution;
            *if slow { &mut high } else { &mut low } = middle;
        }
        Self::Ratio(0.5 * (low + high))
    }

    fn force(self, d: f64, v: f64) -> f64 {
        let root = d.sqrt();
        let damping = match self {
            Self::None => 0.0,
            Self::Area(lag) => 2.25 * lag * d,
            // m = 4/5
            Self::Ratio(beta) => 2.0 * beta * (1.2 * root).sqrt(),
        };
        d * root + damping * v
    }

    /// The contact with this damping and Hertz's spring, to 1e-6; `pulls` if the force is not cut at zero.
    pub(super) fn rebound(self, pulls: bool) -> Rebound {
        let slope = |[d, v]: [f64; 2]| [v, -1.25 * self.force(d.max(0.0), v)];
        let moved =
            |[d, v]: [f64; 2], [by, speed]: [f64; 2], step: f64| [d + step * by, v + step * speed];
        let (mut state, mut time, mut largest) = ([TOUCH, 1.0], TOUCH, LARGEST_STEP);
        let (mut peak_force, mut depth) = (0.0_f64, 0.0_f64);
        while state[0] >= TOUCH && largest > SMALLEST_STEP {
            let step = (LARGEST_RELATIVE_STEP * state[0] / state[1].abs()).min(largest);
            let first = slope(state);
            let second = slope(moved(state, first, 0.5 * step));
            let third = slope(moved(state, second, 0.5 * step));
            let fourth = slope(moved(state, third, step));
            let mean = |i: usize| (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]) / 6.0;
            let next = moved(state, [mean(0), mean(1)], step);
            let force = self.force(next[0].max(0.0), next[1]);
            if !pulls && force <= 0.0 {
                largest = 0.5 * step;
                continue;
            }
            (state, time) = (next, time + step);
            peak_force = peak_force.max(force);
            depth = depth.max(state[0]);
        }
        Rebound {
            restitution: -state[1],
            contact_time: time,
            peak_force,
            depth,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hertz_contact_and_restitutions_are_met() {
        let hertz = Damping::None.rebound(true);
        assert!((hertz.restitution - 1.0).abs() < 1e-7, "{hertz:?}");
        assert!((hertz.contact_time / 2.943_275_184_324_705 - 1.0).abs() < 1e-6);
        assert!((hertz.peak_force - 1.0).abs() < 1e-6);
        assert!((hertz.depth - 1.0).abs() < 1e-6);
        for restitution in [0.999, 0.9, 0.5, 0.2, 0.03] {
            for pulls in [true, false] {
                let found = Damping::of_restitution(restitution, pulls).rebound(pulls);
                let error = (found.restitution / restitution - 1.0).abs();
                assert!(error < 1e-5, "{restitution} {pulls}: {found:?}");
            }
        }
        assert!(Damping::Ratio(MOST_DAMPING).rebound(false).restitution < 1e-3);
    }

    #[test]
    fn the_first_order_of_the_area_dashpot_is_that_of_the_radiation_law() {
        let found = Damping::Area(1e-4).rebound(false);
        let loss = 1.0 - found.restitution.powi(2);
        assert!(
            (loss / (contact::law::radiation::LOSS * 1e-4) - 1.0).abs() < 1e-3,
            "{loss}"
        );
    }
}
