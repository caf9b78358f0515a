//! Many inputs of one target.

use crate::mutate::Mutator;
use crate::seeds::Seeds;
use crate::target::{Target, Verdict};
use output::processor_s;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// How many inputs went which way.
#[derive(Debug, Clone, Default)]
pub struct Report {
    /// Inputs tried.
    pub tried: usize,
    /// Inputs that were read.
    pub read: usize,
    /// The longest that one took in s: of the clock or, where it has less, of the processor.
    pub slowest_s: f64,
    /// Inputs on which the program panicked or took more than [`MOST_S`], with what was seen.
    pub faults: Vec<(Vec<u8>, String)>,
}

/// Longer than this is a fault.
pub const MOST_S: f64 = 10.0;

/// Gives a target `count` inputs that follow from a seed.
#[must_use]
pub fn campaign(target: Target, seeds: &Seeds, count: usize, seed: u64) -> Report {
    let mut mutator = Mutator::new(seed);
    let mut report = Report::default();
    let good = seeds.of(target);
    for _ in 0..count {
        let start = &good[mutator.below(good.len())];
        let input = match std::str::from_utf8(start) {
            Ok(text) if target.is_text() => mutator.text(text),
            Ok(_) | Err(_) => mutator.bytes(start, 512),
        };
        let began = (Instant::now(), processor_s());
        let verdict = catch_unwind(AssertUnwindSafe(|| target.judge(&input, seeds.folder())));
        let used_s = processor_s().zip(began.1).map(|(now, then)| now - then);
        let clock_s = began.0.elapsed().as_secs_f64();
        // on a machine with no processor to spare the clock goes on without the program
        let took_s = clock_s.min(used_s.unwrap_or(f64::INFINITY));
        report.tried += 1;
        report.slowest_s = report.slowest_s.max(took_s);
        match verdict {
            Err(payload) => report.faults.push((input, words(&*payload))),
            Ok(_) if took_s > MOST_S => {
                report.faults.push((input, format!("took {took_s:.1} s")));
            }
            Ok(verdict) => report.read += usize::from(verdict == Verdict::Read),
        }
    }
    report
}

fn words(payload: &(dyn std::any::Any + Send)) -> String {
    let text = payload
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned());
    text.or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "panic".to_owned())
}
