//! A measured or prescribed force history: linear between its samples.
//!
//! `jump` has its jumps, `blow` the beginning and end of its main pulse, `condition` its treatments, and
//! `stretch` the parts in which it changes.

pub(crate) mod blow;
pub(crate) mod condition;
pub(crate) mod jump;
pub(crate) mod stretch;

use crate::record::jump::{Jump, MOST_JUMPS, follows, jumps, rounded_up};
use crate::sampled::projection::Node;
use halfspace::gauss;
use std::path::PathBuf;
use thiserror::Error;

/// Conversion of an instrument's file to a record, if it is not one already.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Reading {
    /// Columns of time and force, by name or by number from 1.
    pub columns: Option<[String; 2]>,
    /// Their units.
    pub units: Option<[String; 2]>,
    /// Time in s of the file that becomes zero; earlier samples are cut off.
    pub start_s: Option<f64>,
    /// Last time in s of the file that is used.
    pub end_s: Option<f64>,
    /// Time in s of the file at which the main pulse begins.
    pub onset_s: Option<f64>,
    /// -1 if the file counts compression as negative.
    pub sign: Option<f64>,
    /// Times in s and forces in N in the scene itself, instead of a file.
    pub samples: Option<[Vec<f64>; 2]>,
    /// Volts per newton of the sensor whose signal is in the file.
    pub sensitivity_v_per_n: Option<f64>,
}

/// Samples of a force, connected by lines; zero before the first and from the last on.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceRecord {
    time_s: Vec<f64>,
    force_n: Vec<f64>,
    jumps: Vec<Jump>,
    /// Onset of the main pulse, if known.
    onset_s: Option<f64>,
    /// File that it was read from, if any.
    pub file: Option<PathBuf>,
    /// Settings of the reading.
    pub reading: Box<Reading>,
    /// Treatment; none if there was none.
    pub treated: Option<Treated>,
}

/// Treatment of a record and its effects.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Treated {
    /// Length in s of the first part whose mean was subtracted from the whole record.
    pub baseline_s: Option<f64>,
    /// That mean in N.
    pub baseline_n: f64,
    /// Cutoff in Hz of the low pass.
    pub low_pass_hz: Option<f64>,
    /// Root mean square over time in N of the part removed by the low pass.
    pub removed_rms_n: f64,
    /// Impulse in N s that the low pass moved to times before zero, where it is lost.
    pub before_zero_n_s: f64,
}

/// Samples that are not a force history; they are counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum RecordError {
    /// Times and forces differ in number, or there are fewer than two.
    #[error("there are {times} times and {forces} forces; both need the same number, at least 2")]
    Count {
        /// Number of times.
        times: usize,
        /// Number of forces.
        forces: usize,
    },
    /// A number that is not finite.
    #[error("sample {sample} is not finite")]
    NotFinite {
        /// The sample.
        sample: usize,
    },
    /// A time before the origin.
    #[error("the first time is {time_s} s, outside [0, inf)")]
    Negative {
        /// The first time in s.
        time_s: f64,
    },
    /// A time that does not follow the previous ones.
    #[error("time {time_s} s of sample {sample} does not follow {before_s} s: {ASCENDING}")]
    NotAscending {
        /// The sample.
        sample: usize,
        /// Its time in s.
        time_s: f64,
        /// The time before in s.
        before_s: f64,
    },
    /// All samples have the same time.
    #[error("all samples have the time {time_s} s: a force needs a duration")]
    AtOnce {
        /// The time in s.
        time_s: f64,
    },
    /// Too many jumps.
    #[error(
        "the force jumps at {jumps} times, at most {MOST_JUMPS} are allowed: two rows share each of these times, perhaps because of rounding"
    )]
    Jumps {
        /// Number of jumps.
        jumps: usize,
    },
}

/// Rule for the times of a record, for messages.
pub const ASCENDING: &str =
    "times must ascend, and at most two rows may share a time, at a jump of the force";

/// Largest slope of sin^4(pi t/T) times T: 3 sqrt(3) pi/4.
const STEEPNESS: f64 = 4.081;

/// Longest record in s without a warning: impacts last microseconds to milliseconds.
const LONG_S: f64 = 1.0;
/// Fraction of the largest force at which a record may begin or end.
const NOT_AT_REST: f64 = 0.05;

impl ForceRecord {
    /// A record of times in s, ascending from 0 or later, and forces in N; compression is positive.
    ///
    /// Two rows with the same time are a jump. A first or last force that is not zero is a jump from or to zero.
    ///
    /// ```
    /// let triangle = impact::ForceRecord::new(vec![0.0, 1e-5, 2e-5], vec![0.0, 100.0, 0.0])?;
    /// assert_eq!(triangle.at(5e-6), 50.0);
    /// assert_eq!(triangle.impulse_n_s(), 1e-3);
    ///
    /// let at_once = impact::ForceRecord::new(vec![0.0, 1e-5, 1e-5], vec![40.0, 40.0, 0.0])?;
    /// assert_eq!((at_once.jumps().len(), at_once.at(1e-5)), (2, 0.0));
    /// # Ok::<(), impact::RecordError>(())
    /// ```
    ///
    /// # Errors
    /// [`RecordError`] with the first sample at fault.
    pub fn new(time_s: Vec<f64>, force_n: Vec<f64>) -> Result<Self, RecordError> {
        if time_s.len() != force_n.len() || time_s.len() < 2 {
            return Err(RecordError::Count {
                times: time_s.len(),
                forces: force_n.len(),
            });
        }
        let finite = |i: usize| time_s[i].is_finite() && force_n[i].is_finite();
        if let Some(sample) = (0..time_s.len()).find(|&i| !finite(i)) {
            return Err(RecordError::NotFinite { sample });
        }
        if time_s[0] < 0.0 {
            return Err(RecordError::Negative { time_s: time_s[0] });
        }
        if let Some(i) = (1..time_s.len()).find(|&i| !follows(&time_s[..i], time_s[i])) {
            return Err(RecordError::NotAscending {
                sample: i,
                time_s: time_s[i],
                before_s: time_s[i - 1],
            });
        }
        if time_s[0] == time_s[time_s.len() - 1] {
            return Err(RecordError::AtOnce { time_s: time_s[0] });
        }
        let found = Self::of_rows(time_s, force_n);
        let jumps = found.jumps.len();
        if jumps > MOST_JUMPS {
            return Err(RecordError::Jumps { jumps });
        }
        Ok(found)
    }

    /// Of rows that are checked.
    fn of_rows(time_s: Vec<f64>, force_n: Vec<f64>) -> Self {
        Self {
            jumps: jumps(&time_s, &force_n),
            time_s,
            force_n,
            onset_s: None,
            file: None,
            reading: Box::default(),
            treated: None,
        }
    }

    /// Times of the samples in s.
    pub fn time_s(&self) -> &[f64] {
        &self.time_s
    }

    /// Forces of the samples in N.
    pub fn force_n(&self) -> &[f64] {
        &self.force_n
    }

    /// The force at a time: linear between samples, zero outside, the later value at a jump.
    pub fn at(&self, time_s: f64) -> f64 {
        let until_s = rounded_up(time_s);
        let after = self.time_s.partition_point(|&t| t <= until_s);
        if after == 0 || after == self.time_s.len() {
            return 0.0;
        }
        let (t0, t1) = (self.time_s[after - 1], self.time_s[after]);
        let fraction = (time_s - t0) / (t1 - t0);
        self.force_n[after - 1] + fraction * (self.force_n[after] - self.force_n[after - 1])
    }

    /// Nodes for the continuous force in the cell of `step_s` from `from_s`, two between neighbouring samples, so that
    /// quadratures are exact.
    pub(crate) fn nodes(&self, from_s: f64, step_s: f64, nodes: &mut Vec<Node>) {
        let to_s = from_s + step_s;
        let begin = self.time_s.partition_point(|&t| t <= from_s);
        let end = self.time_s.partition_point(|&t| t < to_s);
        let corners = self.time_s[begin..end].iter();
        let corners = corners.map(|&t| (t - from_s) / step_s - 0.5);
        let mut before = -0.5;
        for corner in corners.chain([0.5]) {
            if corner > before {
                for (x, weight) in gauss::rule(2).on(before, corner) {
                    nodes.push(Node {
                        x,
                        weight,
                        force: self.continuous_n(from_s + (x + 0.5) * step_s),
                    });
                }
            }
            before = corner;
        }
    }

    /// Times of the first and the last sample in s.
    pub fn span_s(&self) -> [f64; 2] {
        [self.time_s[0], self.time_s[self.time_s.len() - 1]]
    }

    /// Time in s and force in N of the largest sample; zeros if none is positive.
    pub(crate) fn peak(&self) -> (f64, f64) {
        let rows = self.time_s.iter().zip(&self.force_n);
        rows.fold((0.0, 0.0), |peak, (&t, &p)| match p > peak.1 {
            true => (t, p),
            false => peak,
        })
    }

    /// int P dt in N s.
    pub fn impulse_n_s(&self) -> f64 {
        let pairs = self.time_s.windows(2).zip(self.force_n.windows(2));
        pairs.fold(0.0, |sum, (t, p)| sum + 0.5 * (t[1] - t[0]) * (p[0] + p[1]))
    }

    /// Length in s of a pulse sin^4(pi t/T) of the same largest force and the same largest slope between jumps, at most the
    /// time from the first to the last sample.
    pub(crate) fn pulse_s(&self) -> f64 {
        let pairs = self.time_s.windows(2).zip(self.force_n.windows(2));
        let lines = pairs.filter(|(t, _)| t[0] < t[1]);
        let steepest = lines.fold(0.0_f64, |most, (t, p)| {
            most.max((p[1] - p[0]).abs() / (t[1] - t[0]))
        });
        let [from_s, to_s] = self.span_s();
        // without a slope no number, or infinite: then the minimum is the record's length
        (STEEPNESS * self.largest_n() / steepest).min(to_s - from_s)
    }

    /// Hints at wrong units or a wrong cut: sentences for the user with their numbers.
    pub(crate) fn doubts(&self) -> Vec<String> {
        let mut found = Vec::new();
        let [start_s, end_s] = self.span_s();
        let length_s = end_s - start_s;
        if length_s > LONG_S {
            found.push(format!(
                "the record lasts {} s: an impact lasts microseconds to milliseconds; are its times in s?",
                fault::rounded(length_s)
            ));
        }
        let largest_n = self.largest_n();
        let [first_n, last_n] = [self.force_n.first(), self.force_n.last()];
        let ends = [
            ("begins", "from", "before", start_s, first_n),
            ("ends", "to", "after", end_s, last_n),
        ];
        for (verb, way, side, at_s, force_n) in ends {
            if let Some(force_n) = force_n.filter(|p| p.abs() > NOT_AT_REST * largest_n) {
                found.push(format!(
                    "the record {verb} at {} N, {:.0} % of its largest force: the force jumps {way} zero at {} s, and the fields include that jump; add the part {side} it if it is missing, or subtract a baseline",
                    fault::rounded(*force_n),
                    100.0 * force_n.abs() / largest_n,
                    fault::rounded(at_s)
                ));
            }
        }
        found.extend(self.quiet_part());
        let [most_n, least_n] =
            [f64::max, f64::min].map(|of| self.force_n.iter().copied().fold(0.0, of));
        if -least_n > most_n {
            found.push(format!(
                "the largest force is tensile: {} N, and {} N in compression; set force.sign = -1 if the record counts compression as negative",
                fault::rounded(least_n),
                fault::rounded(most_n)
            ));
        } else if least_n < 0.0 {
            found.push("the force record is tensile (negative) in places".to_owned());
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_told_with_their_numbers() {
        let of = |unit_s: f64, first_n: f64| {
            let time_s = vec![0.0, 10.0 * unit_s, 20.0 * unit_s];
            let record = ForceRecord::new(time_s, vec![first_n, 1000.0, 0.0]);
            record.unwrap_or_else(|error| panic!("{error}")).doubts()
        };
        assert!(of(1e-6, 0.0).is_empty());
        assert!(of(1e-6, 40.0).is_empty());
        let seconds = of(1.0, 0.0);
        assert!(
            seconds.len() == 1 && seconds[0].contains("lasts 20 s"),
            "{seconds:?}"
        );
        let cut = of(1e-6, 500.0);
        assert!(
            cut.len() == 1 && cut[0].contains("begins at 500 N, 50 %"),
            "{cut:?}"
        );
    }
}
