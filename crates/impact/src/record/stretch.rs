//! The stretches of a record in which its force changes: only they require a fine step.
//!
//! Between two stretches the force is constant and the waves of the previous stretch have passed, so that the fields
//! are static and each stretch is computed independently.

use crate::record::ForceRecord;
use crate::sampled::projection::{Departure, largest};

/// A part of a record in which the force changes, with the constant force before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stretch {
    /// First and last time of change in s.
    pub(crate) span_s: [f64; 2],
    /// Force before it in N.
    pub(crate) base_n: f64,
}

/// Largest deviation of a constant force, relative to the tolerance.
const QUIET: f64 = 1e-3;

/// Steps within the time scale of the kernels for a force that jumps fully; fewer for a smaller jump.
///
/// `the_step_follows_the_steepest_part` fails without it.
const JUMP: f64 = 64.0;

impl ForceRecord {
    /// The stretches; those less than `quiet_s` apart are joined. None for a force that is zero everywhere.
    ///
    /// The force counts as constant while it stays within [`QUIET`] times `tolerance` of its largest value.
    pub(crate) fn stretches(&self, quiet_s: f64, tolerance: f64) -> Vec<Stretch> {
        let (time_s, force_n) = (self.time_s(), self.force_n());
        let quiet_n = QUIET * tolerance * self.largest_n();
        let mut found: Vec<Stretch> = Vec::new();
        let mut change = |from_s: f64, to_s: f64, base_n: f64| match found.last_mut() {
            Some(last) if from_s - last.span_s[1] < quiet_s => last.span_s[1] = to_s,
            Some(_) | None => found.push(Stretch {
                span_s: [from_s, to_s],
                base_n,
            }),
        };
        // the force is zero before the first sample and after the last
        let [first_s, last_s] = self.span_s();
        if force_n[0] != 0.0 {
            change(first_s, first_s, 0.0);
        }
        let mut rest_n = force_n[0];
        for (t, p) in time_s.windows(2).zip(&force_n[1..]) {
            if (p - rest_n).abs() > quiet_n {
                change(t[0], t[1], rest_n);
                rest_n = *p;
            }
        }
        let last_n = force_n[force_n.len() - 1];
        if last_n != 0.0 {
            change(last_s, last_s, last_n);
        }
        found
    }

    /// Largest difference between the force without its jumps and straight lines between its equidistant samples from
    /// `from_s` to `to_s`.
    ///
    /// Force and lines are linear between the rows and the samples, so that the difference is largest at a row.
    fn departure_at_rows(&self, from_s: f64, to_s: f64, step_s: f64) -> Departure {
        let time_s = self.time_s();
        let rows = time_s.partition_point(|&t| t < from_s)..time_s.partition_point(|&t| t <= to_s);
        let (mut cell, mut ends) = (f64::NAN, [0.0; 2]);
        let (mut here, mut found) = (0.0_f64, Departure::default());
        for row in rows {
            let place = (time_s[row] - from_s) / step_s;
            if place.floor() != cell {
                found.add(here);
                here = 0.0;
                cell = place.floor();
                ends = [cell, cell + 1.0].map(|i| self.continuous_n(from_s + i * step_s));
            }
            let joined = ends[0] + (place - cell) * (ends[1] - ends[0]);
            here = here.max((self.continuous_n(time_s[row]) - joined).abs());
        }
        found.add(here);
        found
    }

    /// The largest step in s, obtained by halving a start value, with an error below `tolerance` of the largest force.
    ///
    /// The error within one cell changes the fields by the ratio of the cell to `unit_s`, the time scale of the
    /// kernels. Jumps are exact on any step, but their waves are as short as the kernels, so they are resolved like the
    /// kernels of the largest force. At most about `most` samples are used.
    pub(crate) fn step_s(
        &self,
        stretches: &[Stretch],
        tolerance: f64,
        unit_s: f64,
        most: f64,
    ) -> f64 {
        let span = |stretch: &Stretch| stretch.span_s[1] - stretch.span_s[0];
        let spans = || stretches.iter().map(span).filter(|&s| s > 0.0);
        let (total_s, shortest_s) = (spans().sum::<f64>(), spans().fold(f64::INFINITY, f64::min));
        let (allowed_n, jump_n) = (tolerance * self.largest_n(), self.largest_jump_n());
        let mut step_s = shortest_s / 64.0;
        if jump_n > allowed_n {
            step_s = step_s.min(unit_s / JUMP * self.largest_n() / jump_n);
        }
        step_s = step_s.max(total_s / most);
        while step_s > total_s / most {
            let mut left = Departure::default();
            for stretch in stretches {
                let [from_s, to_s] = stretch.span_s;
                left.join(self.departure_at_rows(from_s, to_s, step_s));
            }
            if left.moves([1.0, step_s / unit_s]) <= allowed_n {
                break;
            }
            step_s *= 0.5;
        }
        step_s
    }

    /// Largest magnitude of the force in N.
    pub(crate) fn largest_n(&self) -> f64 {
        largest(self.force_n())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(time_s: &[f64], force_n: &[f64]) -> ForceRecord {
        ForceRecord::new(time_s.to_vec(), force_n.to_vec()).unwrap()
    }

    #[test]
    fn quiet_parts_separate_stretches() {
        let two = record(
            &[0.0, 1.0, 2.0, 50.0, 51.0, 60.0],
            &[0.0, 3.0, 1.0, 1.0, 0.0, 0.0],
        );
        let found = two.stretches(10.0, 1e-4);
        assert_eq!(found.len(), 2);
        assert_eq!(found[0].span_s, [0.0, 2.0]);
        assert_eq!((found[1].span_s, found[1].base_n), ([50.0, 51.0], 1.0));
        assert_eq!(two.stretches(49.0, 1e-4).len(), 1);
        assert!(
            record(&[0.0, 1.0], &[0.0, 0.0])
                .stretches(1.0, 1e-4)
                .is_empty()
        );
        // noise of an instrument after a pulse is quiet; a slow drift is not, however close its rows
        let rests = record(&[0.0, 1.0, 2.0, 50.0, 60.0], &[0.0, 3.0, 1e-9, 2e-9, -1e-9]);
        assert_eq!(rests.stretches(10.0, 1e-4)[0].span_s, [0.0, 2.0]);
        let rows: Vec<f64> = (0..4000).map(f64::from).collect();
        let drift = record(&rows, &rows).stretches(10.0, 1.0);
        assert!(drift[0].span_s[0] < 5.0 && drift[0].span_s[1] > 3995.0);
        // on at once and off at once
        let plateau = record(&[5.0, 100.0], &[2.0, 2.0]);
        let found = plateau.stretches(10.0, 1e-4);
        assert_eq!((found[0].span_s, found[1].span_s), ([5.0; 2], [100.0; 2]));
        assert_eq!((found[0].base_n, found[1].base_n), (0.0, 2.0));
    }

    #[test]
    fn the_step_follows_the_steepest_part() {
        // a triangle of 20 us in a record of 1 s
        let triangle = record(
            &[0.0, 0.5, 0.500_007, 0.500_02, 1.0],
            &[0.0, 0.0, 1.0, 0.0, 0.0],
        );
        let stretches = triangle.stretches(1e-3, 1e-4);
        let step_s = triangle.step_s(&stretches, 1e-3, 1e-12, 1e6);
        assert!(step_s < 1e-6 && step_s > 1e-9, "{step_s}");
        let [from_s, to_s] = stretches[0].span_s;
        let left = |step_s: f64| triangle.departure_at_rows(from_s, to_s, step_s);
        assert!(left(step_s).most_n <= 1e-3);
        // sampled at its corners it is exact
        assert!(left(1e-6).most_n < 1e-9);
        assert!(left(1.5e-5).most_n > 0.1);
        // kernels that change slowly do not see the corner
        assert!(triangle.step_s(&stretches, 1e-3, 1.0, 1e6) > step_s);
        // jumps are not resolved, their waves are
        let of = |first: f64| {
            let jumps = record(&[0.0, 1e-5, 2e-5], &[first, 1.0, 0.0]);
            let stretches = jumps.stretches(1e-3, 1e-4);
            jumps.step_s(&stretches, 1e-3, 1e-7, 1e6)
        };
        assert_eq!([of(0.0), of(1e-4)], [2e-5 / 64.0; 2]);
        assert!((of(0.5) / (2e-7 / 64.0) - 1.0).abs() < 1e-12, "{}", of(0.5));
    }
}
