//! When the blow of a record begins and ends: a record may have a part before it, and one after it, in which only an
//! instrument's noise is seen.

use crate::record::ForceRecord;
use crate::record::condition::TreatmentError;
use crate::sampled::projection::largest;

/// Part of the largest force that a blow surely exceeds.
const SEEN: f64 = 0.05;

/// Times the largest force of a quiet part that the noise elsewhere may have: ever more samples have ever larger extremes,
/// 3.3 deviations of 1,000 and 4.9 of 1,000,000.
///
/// `the_blow_is_told_from_the_noise_around_it` fails without it.
const NOISE: f64 = 2.0;

/// Part of the time that the blow lasts from which on a quiet part before it is mentioned: smooth pulses have slow feet,
/// sin^4 up to 0.13.
const OBVIOUS: f64 = 0.25;

impl ForceRecord {
    /// The same record with a main pulse that begins at a time in s; the part before it is quiet.
    ///
    /// Arrivals, the first echo and the duration count from it. The fields are those of the whole record.
    ///
    /// # Errors
    /// [`TreatmentError`] for an onset that is not within the record.
    pub fn with_onset(mut self, onset_s: f64) -> Result<Self, TreatmentError> {
        let [start_s, end_s] = self.span_s();
        if !(start_s..end_s).contains(&onset_s) {
            // in times of the file
            let zero_s = self.reading.start_s.unwrap_or(0.0);
            let limits = [start_s, end_s].map(|t| zero_s + t);
            let reason = "the times of the record";
            return Err(TreatmentError::new(
                "onset_s",
                zero_s + onset_s,
                limits,
                ['[', ')'],
                reason,
            ));
        }
        self.onset_s = Some(onset_s);
        Ok(self)
    }

    /// When the blow begins, in s: the onset where it is given, otherwise the last time before the force leaves zero.
    pub fn start_s(&self) -> f64 {
        self.onset_s.unwrap_or_else(|| self.leaves_zero_s())
    }

    /// The last time in s before the force leaves zero.
    pub(crate) fn leaves_zero_s(&self) -> f64 {
        let first = self.force_n.iter().position(|&force| force != 0.0);
        first.map_or(self.time_s[0], |i| self.time_s[i.saturating_sub(1)])
    }

    /// How long the blow lasts, in s: from its beginning to the first row after which the force does not exceed the noise
    /// before the onset, or zero where no onset is given.
    pub(crate) fn blow_s(&self) -> f64 {
        let start_s = self.start_s();
        let before = self.time_s.partition_point(|&t| t < start_s);
        let level_n = match self.onset_s {
            Some(_) => NOISE * largest(&self.force_n[..before]),
            None => 0.0,
        };
        let last = self.force_n.iter().rposition(|force| force.abs() > level_n);
        let end = last.map_or(0, |last| (last + 1).min(self.time_s.len() - 1));
        (self.time_s[end] - start_s).max(0.0)
    }

    /// A sentence where a quiet part before the blow is counted as a part of it.
    pub(crate) fn quiet_part(&self) -> Option<String> {
        if self.onset_s.is_some() {
            return None;
        }
        let (time_s, force_n) = (&self.time_s, &self.force_n);
        let seen_n = SEEN * self.largest_n();
        let first = force_n.iter().position(|force| force.abs() > seen_n)?;
        let last = force_n.iter().rposition(|force| force.abs() > seen_n)?;
        let start_s = self.leaves_zero_s();
        let half_s = 0.5 * (start_s + time_s[first]);
        let quiet = &force_n[..time_s.partition_point(|&t| t <= half_s).min(first)];
        let level_n = NOISE * largest(quiet);
        let foot = force_n[..first]
            .iter()
            .rposition(|force| force.abs() <= level_n)?;
        let (quiet_s, blow_s) = (time_s[foot] - start_s, time_s[last] - time_s[foot]);
        let zero_s = self.reading.start_s.unwrap_or(0.0);
        (quiet_s > OBVIOUS * blow_s).then(|| {
            format!(
                "the force stays below {} N until {:.4e} s, but arrivals, echoes and the duration are counted from {start_s:.4e} s, where it leaves zero: set force.onset_s = {:.4e} to count from the main pulse",
                fault::rounded(level_n),
                time_s[foot],
                zero_s + time_s[foot]
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Half a sine of 1.2 ms and 1,000 N after a quiet part, in rows of 5 us with noise, to 6 ms.
    fn noisy(quiet_s: f64, noise_n: f64) -> ForceRecord {
        let time_s: Vec<f64> = (0..1200).map(|i| 5e-6 * f64::from(i)).collect();
        let of = |(i, &t): (usize, &f64)| {
            let x = (t - quiet_s) / 1.2e-3;
            let pulse = if (0.0..1.0).contains(&x) {
                1000.0 * (PI * x).sin()
            } else {
                0.0
            };
            // without a pattern
            let noise = ((i * i) as f64 * 0.7311).sin();
            pulse + noise_n * noise
        };
        let force_n = time_s.iter().enumerate().map(of).collect();
        ForceRecord::new(time_s, force_n).unwrap()
    }

    #[test]
    fn the_blow_is_told_from_the_noise_around_it() {
        let found = noisy(1e-3, 3.0);
        let sentence = found.quiet_part().unwrap();
        assert!(sentence.contains("force.onset_s = "), "{sentence}");
        assert!(
            found.blow_s() > 5.9e-3,
            "all of the record without an onset"
        );
        let told: f64 = sentence
            .split("onset_s = ")
            .nth(1)
            .unwrap()
            .split(' ')
            .next()
            .unwrap()
            .parse()
            .unwrap();
        assert!((told - 1e-3).abs() < 2e-5, "{sentence}");
        let blow = found.with_onset(1e-3).unwrap();
        assert!(
            (blow.blow_s() / 1.2e-3 - 1.0).abs() < 0.02,
            "{}",
            blow.blow_s()
        );
        assert_eq!((blow.start_s(), blow.quiet_part()), (1e-3, None));
    }

    #[test]
    fn clean_pulses_have_nothing_to_be_told() {
        assert_eq!(noisy(0.0, 0.0).quiet_part(), None);
        // zeros before a blow are left out already
        let still = noisy(2e-3, 0.0);
        assert_eq!(still.quiet_part(), None);
        assert!((still.start_s() - 2e-3).abs() < 1e-5 && (still.blow_s() - 1.2e-3).abs() < 1e-5);
        let slow = (0..=100)
            .map(|i| (PI * f64::from(i) / 100.0).sin().powi(4))
            .collect();
        let slow = ForceRecord::new((0..=100).map(f64::from).collect(), slow).unwrap();
        assert_eq!(slow.quiet_part(), None);
    }

    #[test]
    fn an_onset_outside_is_refused_with_the_times_of_the_file() {
        for bad in [-1e-9, 6e-3, f64::NAN] {
            let message = noisy(1e-3, 0.0).with_onset(bad).unwrap_err().to_string();
            assert!(
                message.starts_with("onset_s = ") && message.contains("[0, 0.005995)"),
                "{message}"
            );
        }
    }
}
