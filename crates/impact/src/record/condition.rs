//! Treatments of a record before it loads the half-space: subtraction of a baseline, low pass.

use crate::record::jump::jumps;
use crate::record::{ForceRecord, Treated};
use crate::sampled::low_pass::{Rows, allowed_hz, low_pass};
use thiserror::Error;

/// A treatment that is impossible for the record.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{key} = {value} is outside {range}, {reason}")]
pub struct TreatmentError {
    /// Name of its scene key.
    pub key: &'static str,
    /// Its value.
    pub value: f64,
    /// Its limits.
    pub limits: [f64; 2],
    /// The same in interval notation.
    pub range: String,
    /// Origin of the limits.
    pub reason: &'static str,
}

impl TreatmentError {
    /// The error of a value outside two limits, with the brackets of their interval.
    pub fn new(
        key: &'static str,
        value: f64,
        limits: [f64; 2],
        [open, shut]: [char; 2],
        reason: &'static str,
    ) -> Self {
        let [least, most] = limits.map(fault::number);
        Self {
            key,
            value,
            limits,
            range: format!("{open}{least}, {most}{shut}"),
            reason,
        }
    }
}

impl ForceRecord {
    /// The record after a treatment; [`ForceRecord::treated`] describes its effect.
    ///
    /// The low pass is exact for a piecewise linear force with any spacing of rows. A force that is smooth on the
    /// period of the cutoff keeps its shape, and every force its impulse. Rows are added if there are fewer than 64 per
    /// period of the cutoff, and beyond both ends, where the filtered force decays.
    ///
    /// # Errors
    /// [`TreatmentError`] with the range that this record allows.
    pub fn treat(
        self,
        baseline_s: Option<f64>,
        low_pass_hz: Option<f64>,
    ) -> Result<Self, TreatmentError> {
        let mut done = Treated {
            baseline_s,
            low_pass_hz,
            ..Treated::default()
        };
        let mut record = self;
        if let Some(baseline_s) = baseline_s {
            done.baseline_n = record.mean_n(baseline_s)?;
            for force_n in &mut record.force_n {
                *force_n -= done.baseline_n;
            }
        }
        if let Some(cutoff_hz) = low_pass_hz {
            let limits = allowed_hz(record.time_s());
            if !(cutoff_hz > limits[0] && cutoff_hz <= limits[1]) {
                let reason =
                    "from one period per record to the number of rows that fits into memory";
                return Err(TreatmentError::new(
                    "low_pass_hz",
                    cutoff_hz,
                    limits,
                    ['(', ']'],
                    reason,
                ));
            }
            let filtered = low_pass(record.time_s(), record.force_n(), cutoff_hz);
            done.before_zero_n_s = filtered.before_zero_n_s;
            done.removed_rms_n = record.difference_rms_n(&filtered);
            (record.time_s, record.force_n) = (filtered.time_s, filtered.force_n);
        }
        record.jumps = jumps(&record.time_s, &record.force_n);
        if done.baseline_s.is_some() || done.low_pass_hz.is_some() {
            record.treated = Some(done);
        }
        Ok(record)
    }

    /// A warning if the low pass moves a thousandth of the impulse or of the force to times before zero.
    pub(crate) fn lost_before_zero(&self) -> Option<String> {
        const SEEN: f64 = 1e-3;
        let done = self.treated?;
        done.low_pass_hz?;
        let (lost_n_s, begins_n) = (done.before_zero_n_s, self.force_n()[0]);
        let seen = lost_n_s.abs() > SEEN * self.impulse_n_s().abs()
            || begins_n.abs() > SEEN * self.largest_n();
        seen.then(|| {
            format!(
                "the low pass spreads the force to times before zero, which loses {lost_n_s:.3e} N s, and the force begins with {} N: use a record that begins before the pulse",
                fault::rounded(begins_n)
            )
        })
    }

    /// Mean force in N over the first `length_s`.
    fn mean_n(&self, length_s: f64) -> Result<f64, TreatmentError> {
        let [start_s, end_s] = self.span_s();
        let (most, reason) = match self.onset_s.filter(|onset_s| *onset_s > start_s) {
            Some(onset_s) => (onset_s - start_s, "the part of the record before onset_s"),
            None => (end_s - start_s, "the length of the record"),
        };
        if !(length_s > 0.0 && length_s <= most) {
            return Err(TreatmentError::new(
                "baseline_s",
                length_s,
                [0.0, most],
                ['(', ']'],
                reason,
            ));
        }
        let until_s = start_s + length_s;
        let mut sum = 0.0;
        for (t, p) in self.time_s.windows(2).zip(self.force_n.windows(2)) {
            if t[0] >= until_s {
                break;
            }
            // a jump has no width
            let width_s = t[1].min(until_s) - t[0];
            let slope = if t[0] < t[1] {
                (p[1] - p[0]) / (t[1] - t[0])
            } else {
                0.0
            };
            sum += width_s * (p[0] + 0.5 * slope * width_s);
        }
        Ok(sum / length_s)
    }

    /// Root mean square over the time of this record of its difference from a record with the same rows.
    fn difference_rms_n(&self, other: &Rows) -> f64 {
        let mut sum = 0.0;
        let mut place = 0;
        let mut gap = |time_s: f64, force_n: f64| {
            while other.time_s[place] < time_s {
                place += 1;
            }
            force_n - other.force_n[place]
        };
        for (t, p) in self.time_s.windows(2).zip(self.force_n.windows(2)) {
            let (before, after) = (gap(t[0], p[0]), gap(t[1], p[1]));
            // the square of a line, integrated
            let part = before * before + before * after + after * after;
            sum += (t[1] - t[0]) * part / 3.0;
        }
        let [start_s, end_s] = self.span_s();
        (sum / (end_s - start_s)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(time_s: &[f64], force_n: &[f64]) -> ForceRecord {
        ForceRecord::new(time_s.to_vec(), force_n.to_vec()).unwrap()
    }

    #[test]
    fn the_baseline_is_the_mean_over_time_of_the_first_part() {
        let uneven = record(&[1.0, 1.1, 3.0, 4.0], &[2.0, 2.0, 4.0, 0.0]);
        let treated = |baseline_s| uneven.clone().treat(Some(baseline_s), None);
        let found = treated(2.0).unwrap();
        // 0.1 of 2, 1.9 of 3
        let mean = (0.2 + 1.9 * 3.0) / 2.0;
        let done = found.treated.unwrap();
        assert!((done.baseline_n - mean).abs() < 1e-15);
        assert!((found.at(3.5) - (2.0 - mean)).abs() < 1e-15);
        let half = treated(0.05).unwrap();
        assert!((half.treated.unwrap().baseline_n - 2.0).abs() < 1e-14);
        for bad in [0.0, 3.001, f64::NAN, -1.0] {
            let message = treated(bad).unwrap_err().to_string();
            assert!(message.contains("baseline_s"), "{message}");
        }
    }

    #[test]
    fn nothing_asked_is_nothing_done() {
        let given = record(&[0.0, 1.0], &[1.0, 2.0]);
        let found = given.clone().treat(None, None).unwrap();
        assert_eq!(found, given);
        assert_eq!(found.treated, None);
    }

    #[test]
    fn cutoffs_beyond_the_record_are_refused_with_their_range() {
        let given = record(&[0.0, 1.0, 2.0], &[0.0, 2.0, 0.0]);
        for bad in [0.5, f64::NAN, f64::INFINITY, -1.0, 1e300] {
            let message = given
                .clone()
                .treat(None, Some(bad))
                .unwrap_err()
                .to_string();
            assert!(
                message.starts_with("low_pass_hz = ") && message.contains("(0.5, "),
                "{message}"
            );
        }
    }
}
