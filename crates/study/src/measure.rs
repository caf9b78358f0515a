//! Measurement of a method: its error relative to a reference, and the median time of repeated runs.

use crate::method::ComparedMethod;
use crate::record::{Question, Record, sizes};
use fault::AnyError;
use std::hint::black_box;
use std::time::Instant;

/// Extent of the measurements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effort {
    /// Few settings, few times, coarse maps.
    Quick,
    /// All settings.
    Full,
}

impl Effort {
    /// The value for this extent.
    pub(crate) fn pick<T>(self, quick: T, full: T) -> T {
        match self {
            Self::Quick => quick,
            Self::Full => full,
        }
    }
}

/// The first result of `run`, and the time in ns for one of the `values` of a run: median and half the interquartile
/// range.
///
/// The times are those of at least three samples. Each sample repeats the run for a minimum time, and no sample begins
/// after a maximum total time.
fn time<T>(effort: Effort, values: f64, run: impl Fn() -> T) -> (T, [f64; 2]) {
    let (runs, shortest_s, longest_s) = effort.pick((5, 5e-4, 0.06), (11, 5e-3, 1.5));
    let begun = Instant::now();
    let first = black_box(run());
    let once_s = begun.elapsed().as_secs_f64().max(20e-9);
    let repeats = (shortest_s / once_s).ceil().max(1.0);
    let mut samples = Vec::with_capacity(runs);
    if repeats <= 1.0 {
        // long enough that a run fits and caches do not matter
        samples.push(once_s * 1e9 / values);
    }
    while samples.len() < runs {
        if samples.len() >= 3 && begun.elapsed().as_secs_f64() > longest_s {
            break;
        }
        let start = Instant::now();
        for _ in 0..repeats as usize {
            black_box(run());
        }
        samples.push(start.elapsed().as_secs_f64() * 1e9 / repeats / values);
    }
    samples.sort_by(f64::total_cmp);
    let at = |share: f64| lookup::quantile(&samples, share);
    (first, [at(0.5), 0.5 * (at(0.75) - at(0.25))])
}

/// Result of a run, and its work if it is counted.
pub(crate) type Found<T> = Result<(T, Option<u64>), AnyError>;

/// Rows of a question.
pub(crate) type Rows = Result<Vec<Record>, AnyError>;

/// Text of a tolerance as a setting.
pub(crate) fn at(tolerance: f64) -> String {
    format!("tolerance {tolerance:.0e}")
}

/// A scene of a question, with the measurement of methods in it.
pub(crate) struct MeasuredScene<'a, T> {
    pub(crate) effort: Effort,
    pub(crate) question: Question,
    pub(crate) name: &'static str,
    /// Number of values that a run computes.
    pub(crate) values: f64,
    /// Relative errors of the result of a run.
    pub(crate) errors: &'a dyn Fn(&T) -> Result<Vec<f64>, AnyError>,
    /// Rows measured so far.
    pub(crate) records: &'a mut Vec<Record>,
}

impl<T> MeasuredScene<'_, T> {
    /// Adds the row of a method at a setting, at first not marked as part of the default path. For a method that fails
    /// the row contains the reason.
    pub(crate) fn add(
        &mut self,
        method: ComparedMethod,
        setting: impl Into<String>,
        run: impl Fn() -> Found<T>,
    ) -> Result<&mut Record, AnyError> {
        let (found, timed) = if cfg!(test) {
            (run(), None)
        } else {
            let (found, timed) = time(self.effort, self.values, run);
            (found, Some(timed))
        };
        let (errors, work, refusal) = match found {
            Ok((found, work)) => ((self.errors)(&found)?, work, None),
            Err(error) => (vec![f64::NAN], None, Some(error.to_string())),
        };
        let work = work.map(|work| work as f64 / self.values);
        // tests use errors and work, which are the same on every machine
        let [cost_ns, cost_spread_ns] = timed.unwrap_or([work.unwrap_or(f64::INFINITY), 0.0]);
        let [error_max, error_rms] = sizes(&errors);
        let place = self.records.len();
        self.records.push(Record {
            question: self.question,
            scene: self.name,
            method,
            setting: setting.into(),
            default_path: false,
            cost_ns,
            cost_spread_ns,
            error_max,
            error_rms,
            work,
            refusal,
        });
        Ok(&mut self.records[place])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn a_run_does_as_much_work_as_it_says() {
        let count = Cell::new(0_u64);
        let (first, [median_ns, spread_ns]) =
            time(Effort::Quick, 10.0, || count.replace(count.get() + 1));
        assert_eq!(first, 0);
        assert!(count.get() >= 6, "{}", count.get());
        assert!(median_ns > 0.0 && spread_ns >= 0.0);
    }
}
