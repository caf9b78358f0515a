//! Time of a method: median of repeated runs, with spread.

use std::time::{Duration, Instant};

/// Nanoseconds per value on one core.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// Median over the runs.
    pub median_ns: f64,
    /// Half the distance between the quartiles of the runs.
    pub spread_ns: f64,
}

/// How long a method is measured.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Clock {
    runs: usize,
    shortest: Duration,
    longest: Duration,
}

impl Clock {
    /// At least three of `runs` runs of at least `shortest` each, none begun after `longest` in all.
    pub(crate) fn new(runs: usize, shortest: Duration, longest: Duration) -> Self {
        Self {
            runs,
            shortest,
            longest,
        }
    }

    /// Times `work`, which is worth `values` values.
    pub(crate) fn time(&self, values: f64, mut work: impl FnMut()) -> Timing {
        let begun = Instant::now();
        work();
        let once = begun.elapsed().max(Duration::from_nanos(20));
        let repeats = (self.shortest.as_secs_f64() / once.as_secs_f64())
            .ceil()
            .max(1.0);
        let mut samples = Vec::with_capacity(self.runs);
        if repeats <= 1.0 {
            // long enough for a run, and for the caches not to matter
            samples.push(once.as_secs_f64() * 1e9 / values);
        }
        while samples.len() < self.runs {
            if samples.len() >= 3 && begun.elapsed() > self.longest {
                break;
            }
            let start = Instant::now();
            for _ in 0..repeats as usize {
                work();
            }
            samples.push(start.elapsed().as_secs_f64() * 1e9 / repeats / values);
        }
        samples.sort_by(f64::total_cmp);
        let at = |share: f64| samples[((samples.len() - 1) as f64 * share).round() as usize];
        Timing {
            median_ns: at(0.5),
            spread_ns: 0.5 * (at(0.75) - at(0.25)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_does_as_much_work_as_it_says() {
        let clock = Clock::new(5, Duration::from_micros(200), Duration::from_millis(50));
        let mut count = 0_u64;
        let timing = clock.time(10.0, || count += 1);
        assert!(count >= 6, "{count}");
        assert!(timing.median_ns > 0.0 && timing.spread_ns >= 0.0);
    }
}
