//! Jumps of a record: instants at which its force changes at once.
//!
//! A record is zero before its first row and from its last row on, and two rows may have one time. Its force is the sum of
//! a continuous one, made of lines, and of a step for each jump. The waves of a step are the step response of the
//! half-space, so that a jump is exact on any step of the output.
//!
//! Theory: `docs/theory.md` (T24).

use crate::record::ForceRecord;

/// A jump of a force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// Its instant in s.
    pub time_s: f64,
    /// Force after it less the force before it, in N.
    pub rise_n: f64,
}

impl Jump {
    /// Whether it has happened at a time, or happens then.
    pub(crate) fn is_past(&self, time_s: f64) -> bool {
        self.time_s <= rounded_up(time_s)
    }
}

/// Largest number of jumps of a record: each is read at every sample of the output. More are a column of rounded times.
///
/// `a_column_of_rounded_times_is_refused` fails without it.
pub(crate) const MOST_JUMPS: usize = 1000;

/// Relative difference up to which two times are equal: times of samples are sums of products with a few roundings.
///
/// `samples_at_a_jump_and_at_its_fronts_are_those_after` fails without it.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A time, increased by its possible rounding error.
pub(crate) fn rounded_up(time_s: f64) -> f64 {
    time_s + ROUNDING * time_s.abs()
}

/// Whether a time may follow those of other rows: it is later than the last, or equals only the last, which is a jump.
pub fn follows(before_s: &[f64], time_s: f64) -> bool {
    match before_s {
        [] => true,
        [.., second, last] if time_s == *last => second != last,
        [.., last] => time_s >= *last,
    }
}

/// The jumps of rows that are zero outside, ascending.
pub(super) fn jumps(time_s: &[f64], force_n: &[f64]) -> Vec<Jump> {
    let mut found: Vec<Jump> = Vec::new();
    let mut jump = |time_s: f64, rise_n: f64| match found.last_mut() {
        Some(last) if last.time_s == time_s => last.rise_n += rise_n,
        Some(_) | None => found.push(Jump { time_s, rise_n }),
    };
    let rows = || time_s.iter().copied().zip(force_n.iter().copied());
    if let Some((first_s, first_n)) = rows().next() {
        jump(first_s, first_n);
    }
    for ((before_s, before_n), (after_s, after_n)) in rows().zip(rows().skip(1)) {
        if before_s == after_s {
            jump(after_s, after_n - before_n);
        }
    }
    if let Some((last_s, last_n)) = rows().next_back() {
        jump(last_s, -last_n);
    }
    found.retain(|jump| jump.rise_n != 0.0);
    found
}

impl ForceRecord {
    /// Its jumps, ascending: at the first row that is not zero, at two rows of one time, at a last row that is not zero.
    pub fn jumps(&self) -> &[Jump] {
        &self.jumps
    }

    /// Sum of the jumps in N until a time, including a jump at that time.
    pub(crate) fn jumped_n(&self, time_s: f64) -> f64 {
        let until = self.jumps.partition_point(|jump| jump.is_past(time_s));
        self.jumps[..until].iter().map(|jump| jump.rise_n).sum()
    }

    /// The force in N at a time without its jumps: continuous.
    pub(crate) fn continuous_n(&self, time_s: f64) -> f64 {
        self.at(time_s) - self.jumped_n(time_s)
    }

    /// The largest jump in N.
    pub(crate) fn largest_jump_n(&self) -> f64 {
        let sizes = self.jumps.iter().map(|jump| jump.rise_n.abs());
        sizes.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::RecordError;

    fn record(rows: &[(f64, f64)]) -> ForceRecord {
        let (time_s, force_n) = rows.iter().copied().unzip();
        ForceRecord::new(time_s, force_n).unwrap()
    }

    #[test]
    fn a_record_is_its_steps_and_a_continuous_force() {
        let rows = [(1.0, 4.0), (2.0, 6.0), (2.0, 1.0), (3.0, 2.0)];
        let given = record(&rows);
        let jumps: Vec<_> = (given.jumps().iter())
            .map(|jump| (jump.time_s, jump.rise_n))
            .collect();
        assert_eq!(jumps, [(1.0, 4.0), (2.0, -5.0), (3.0, -2.0)]);
        // the force is that of the later side
        let forces = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0].map(|t| given.at(t));
        assert_eq!(forces, [0.0, 4.0, 5.0, 1.0, 1.5, 0.0, 0.0]);
        let beside = |t: f64| {
            let [a, b] = [t - 1e-12, t + 1e-12].map(|t| given.continuous_n(t));
            (a - b).abs()
        };
        assert!([1.0, 2.0, 3.0].into_iter().all(|t| beside(t) < 1e-10));
        // a zero row before a jump at the same time says no more than none
        assert_eq!(
            record(&[(1.0, 0.0), (1.0, 4.0), (2.0, 0.0)]).jumps().len(),
            1
        );
        assert!(
            record(&[(0.0, 0.0), (1.0, 4.0), (2.0, 0.0)])
                .jumps()
                .is_empty()
        );
        assert_eq!(given.impulse_n_s(), 5.0 + 1.5);
    }

    #[test]
    fn a_column_of_rounded_times_is_refused() {
        let of = |count: usize, of_each: usize| {
            let time_s: Vec<f64> = (0..count).map(|i| (i / of_each) as f64).collect();
            let force_n = (0..count).map(|i| (i + 1) as f64).collect();
            ForceRecord::new(time_s, force_n)
        };
        assert!(of(1500, 2).is_ok());
        let many = RecordError::Jumps { jumps: 1500 };
        assert_eq!(of(3000, 2), Err(many));
        assert!(matches!(
            of(30, 3),
            Err(RecordError::NotAscending { sample: 2, .. })
        ));
        assert!(matches!(of(2, 2), Err(RecordError::AtOnce { .. })));
    }
}
