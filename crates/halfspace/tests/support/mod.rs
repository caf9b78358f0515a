//! Helpers of all tests of this crate: quantiles, peaks over time, reference files.

#![allow(dead_code, reason = "every test crate uses some of these helpers")]

use halfspace::{Arrivals, FIELDS, Kernel, Six};

/// Names of the fields in the order of [`FIELDS`], as in the headers of the reference files.
pub(crate) const NAMES: [&str; 6] = ["u", "w", "srr", "stt", "szz", "srz"];

/// Header and rows of a reference file.
pub(crate) fn read_csv(name: &str) -> (Vec<String>, Vec<Vec<String>>) {
    read_csv_at(&format!(
        "{}/../../tests/reference/{name}",
        env!("CARGO_MANIFEST_DIR")
    ))
}

/// The same of a file anywhere.
pub(crate) fn read_csv_at(path: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let split = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let header = split(lines.next().unwrap());
    (header, lines.map(split).collect())
}

/// Step response: static part plus remainder.
pub(crate) fn step(kernel: &Kernel, r: f64, z: f64, t: f64) -> Six {
    let rest = kernel.static_field(r, z).unwrap();
    let value = kernel.remainder(r, z, t).unwrap().value;
    std::array::from_fn(|f| rest[f] + value[f])
}

/// Largest magnitude over time of each field's step response at a point, the static limit included.
///
/// Sampled evenly until after the last arrival and on both sides of every arrival, at the given times too.
pub(crate) fn peaks(kernel: &Kernel, r: f64, z: f64, also: &[f64]) -> Six {
    const SAMPLES: usize = 160;
    const NEAR: [f64; 10] = [
        -1e-3, -1e-4, -1e-5, -1e-6, -1e-9, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3,
    ];
    let arrivals = Arrivals::new(kernel.medium(), kernel.profile(), r, z).unwrap();
    let end = 1.1 * arrivals.last();
    let even = (1..=SAMPLES).map(|i| end * i as f64 / SAMPLES as f64);
    let fronts = arrivals
        .sorted()
        .into_iter()
        .flat_map(|a| NEAR.map(|gap| a + gap * (1.0 + a)));
    let mut peak = kernel.static_field(r, z).unwrap().map(f64::abs);
    let times = even.chain(fronts).chain(also.iter().copied());
    for t in times.filter(|&t| t >= 0.0) {
        for (p, v) in peak.iter_mut().zip(step(kernel, r, z, t)) {
            *p = p.max(v.abs());
        }
    }
    peak
}

/// Quantiles of a set of errors.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Quantiles {
    pub(crate) count: usize,
    pub(crate) p50: f64,
    pub(crate) p90: f64,
    pub(crate) p99: f64,
    pub(crate) max: f64,
}

impl Quantiles {
    /// Of at least one error.
    pub(crate) fn of(errors: &[f64]) -> Self {
        let mut sorted = errors.to_vec();
        sorted.sort_by(f64::total_cmp);
        let last = sorted.len() - 1;
        let at = |q: f64| sorted[(q * last as f64).round() as usize];
        Self {
            count: sorted.len(),
            p50: at(0.5),
            p90: at(0.9),
            p99: at(0.99),
            max: sorted[last],
        }
    }
}

impl std::fmt::Display for Quantiles {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{:6}   {:8.1e} {:8.1e} {:8.1e} {:8.1e}",
            self.count, self.p50, self.p90, self.p99, self.max
        )
    }
}

/// Heading of a table of [`Quantiles`].
pub(crate) fn heading(title: &str) {
    println!("\n{title}");
    println!(
        "{:24} {:>6}   {:>8} {:>8} {:>8} {:>8}",
        "", "count", "p50", "p90", "p99", "max"
    );
}

/// One line of a table.
pub(crate) fn line(label: &str, errors: &[f64]) -> Quantiles {
    let quantiles = Quantiles::of(errors);
    println!("{label:24} {quantiles}");
    quantiles
}

/// The number of fields, to tie [`NAMES`] to [`FIELDS`].
pub(crate) const COUNT: usize = FIELDS.len();
