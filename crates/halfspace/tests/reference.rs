//! Every row of `tests/reference/step_response.csv`, values of the Hertz step response at 30 digits and more.
//!
//! `cargo test -p hertzlamb-halfspace --test reference -- --nocapture` prints the tables of errors.
//! With `REFERENCE_ROWS=file` in the environment it is the rows of that file, as `tests/reference/attack.py` writes them.
//!
//! An error is relative to the peak over time of the same field's step response at the same point.
//! The promise is 1e-10 of that peak, at arrivals too; a field that is zero at all times may be
//! 1e-15. At a depth z below the surface outside the disc the peaks of sigma_zz and sigma_rz are of order sqrt(z).

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod support;

use halfspace::{Kernel, Medium, Profile, Six};
use std::collections::BTreeMap;
use std::sync::LazyLock;
use support::{NAMES, heading, line, peaks, read_csv, read_csv_at};

struct Sample {
    kind: String,
    label: String,
    field: usize,
    /// Absolute error, the kernel's own estimate of it, and the peak of the field.
    error: f64,
    estimate: f64,
    peak: f64,
}

/// Rounding error of terms of order one that cancel, in P/(mu r0) and P/r0^2.
const ROUNDING: f64 = 1e-15;

impl Sample {
    /// Error over peak; where a field vanishes at all times rounding counts as none.
    fn relative(&self) -> f64 {
        if self.peak == 0.0 && self.error < ROUNDING {
            0.0
        } else {
            self.error / self.peak
        }
    }

    fn within(&self, bound: f64) -> bool {
        self.relative() <= bound
    }
}

/// The rows as text, each with the peaks of its fields.
static ROWS: LazyLock<Vec<(Vec<String>, Six)>> = LazyLock::new(|| {
    let (header, rows) = match std::env::var("REFERENCE_ROWS") {
        Ok(path) => read_csv_at(&path),
        Err(_) => read_csv("step_response.csv"),
    };
    assert_eq!(header[4..10], NAMES);
    let with_peaks = rows.into_iter().map(|row| {
        let v: Vec<f64> = row[..4].iter().map(|x| x.parse().unwrap()).collect();
        let rough = Kernel::new(&Medium::new(v[0]).unwrap(), Profile::Hertz, 1e-6).unwrap();
        let peak = peaks(&rough, v[1], v[2], &[v[3]]);
        (row, peak)
    });
    with_peaks.collect()
});

fn samples(tolerance: f64) -> Vec<Sample> {
    let mut kernels: BTreeMap<&String, Kernel> = BTreeMap::new();
    let mut samples = vec![];
    for (row, peak) in ROWS.iter() {
        let kernel = kernels.entry(&row[0]).or_insert_with(|| {
            let medium = Medium::new(row[0].parse().unwrap()).unwrap();
            Kernel::new(&medium, Profile::Hertz, tolerance).unwrap()
        });
        let v: Vec<f64> = row[1..10].iter().map(|x| x.parse().unwrap()).collect();
        let (r, z, t) = (v[0], v[1], v[2]);
        let rest = kernel.static_field(r, z).unwrap();
        let found = kernel.remainder(r, z, t).unwrap();
        for f in 0..6 {
            samples.push(Sample {
                kind: row[10].clone(),
                label: format!(
                    "nu {} r {r} z {z} t {t} {}: {:e} for {:e}",
                    row[0],
                    NAMES[f],
                    rest[f] + found.value[f],
                    v[3 + f]
                ),
                field: f,
                error: (rest[f] + found.value[f] - v[3 + f]).abs(),
                estimate: found.error[f],
                peak: peak[f],
            });
        }
    }
    samples
}

/// The promise.
fn bound(kind: &str) -> f64 {
    match kind {
        "random" | "axis" | "far" | "surface" | "nu_special" | "shallow" | "edge" | "meets"
        | "arrival" => 1e-10,
        kind => panic!("no bound for rows of kind {kind}"),
    }
}

#[test]
fn every_row_is_within_the_promised_accuracy() {
    let samples = samples(1e-10);
    assert!(
        std::env::var("REFERENCE_ROWS").is_ok() || samples.len() >= 6 * 300,
        "{} values",
        samples.len()
    );
    let mut by_kind: BTreeMap<&str, Vec<&Sample>> = BTreeMap::new();
    for sample in &samples {
        by_kind.entry(&sample.kind).or_default().push(sample);
    }
    let mut failures = vec![];
    heading("error relative to the peak, by kind");
    for (kind, all) in &by_kind {
        line(kind, &all.iter().map(|s| s.relative()).collect::<Vec<_>>());
        let missing = all.iter().filter(|s| !s.within(bound(kind)));
        failures.extend(missing.map(|s| format!("{kind} {:e}: {}", s.relative(), s.label)));
    }
    heading("error relative to the peak, by field");
    for (f, name) in NAMES.iter().enumerate() {
        let of = |s: &&Sample| s.field == f;
        line(
            name,
            &samples
                .iter()
                .filter(of)
                .map(Sample::relative)
                .collect::<Vec<_>>(),
        );
    }
    println!("\nlargest:");
    let mut worst: Vec<&Sample> = samples.iter().collect();
    worst.sort_by(|a, b| b.relative().total_cmp(&a.relative()));
    for s in worst.iter().take(12) {
        println!(
            "{:10} {:.1e} (absolute {:.1e}, estimate {:.1e}, peak {:.1e}) {}",
            s.kind,
            s.relative(),
            s.error,
            s.estimate,
            s.peak,
            s.label
        );
    }
    assert!(failures.is_empty(), "{failures:?}");
}

#[test]
fn the_reported_error_bounds_the_observed_error() {
    for tolerance in [1e-11, 1e-10, 1e-8, 1e-6, 1e-4] {
        let samples = samples(tolerance);
        // the estimate is that of the remainder; the static part adds its own rounding
        let covered = |s: &&Sample| s.error <= s.estimate + ROUNDING;
        let fraction = samples.iter().filter(covered).count() as f64 / samples.len() as f64;
        let caution: Vec<f64> = samples
            .iter()
            .filter(|s| s.error > 0.0)
            .map(|s| s.estimate / s.error)
            .collect();
        heading(&format!(
            "tolerance {tolerance:e}: {:.2} % of the errors within the estimate",
            100.0 * fraction
        ));
        let caution = line("estimate / error", &caution);
        let relative: Vec<f64> = samples.iter().map(Sample::relative).collect();
        line("error / peak", &relative);
        if tolerance == 1e-11 {
            // one digit more than the promise, and it holds for every row, those at arrivals too
            assert!(samples.iter().all(|s| s.within(1e-10)));
        }
        for s in samples.iter().filter(|s| !covered(s)).take(12) {
            println!(
                "  not bounded: {:.1e} > {:.1e} {} {}",
                s.error, s.estimate, s.kind, s.label
            );
        }
        assert!(fraction >= 0.999, "tolerance {tolerance:e}: {fraction}");
        assert!(
            caution.p50 < 200.0,
            "tolerance {tolerance:e}: {}",
            caution.p50
        );
    }
}
