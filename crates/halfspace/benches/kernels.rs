//! Speed of the kernels and the accuracy that goes with it, on one core.
//!
//! `cargo bench -p hertzlamb-halfspace` prints, for tolerances of 1e-4 to 1e-10,
//!
//! - errors relative to the peak over time of each field, against tolerance 1e-13: median, 99th percentile, largest;
//! - the time of one sample and samples per second, six fields each, over (r, z) uniform in [0, 6]^2 and t in [0, 20];
//! - the time of a trace of 300 cell averages of width 0.1, at places of the same square, and cells per second;
//! - the time of 300 instants of the echoes of a plate;
//! - the time of one deflection of the surface centre.

#![allow(
    clippy::unwrap_used,
    reason = "a benchmark has nobody to report errors to"
)]

#[path = "../tests/support/mod.rs"]
mod support;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use halfspace::random::Stream;
use halfspace::{Deflection, Kernel, Medium, Plate, Profile, Six, SurfaceResponse, kausel};
use std::hint::black_box;
use std::time::{Duration, Instant};
use support::{heading, line, peaks};

const POISSON_RATIO: f64 = 0.3;
const TOLERANCES: [f64; 4] = [1e-4, 1e-6, 1e-8, 1e-10];

/// Takes the place of the exact value.
const REFERENCE: f64 = 1e-13;

/// (r, z) uniform in the square of this side, t up to the end.
const SIDE: f64 = 6.0;
const END: f64 = 20.0;

const CELLS: usize = 300;
const WIDTH: f64 = 0.1;

fn kernel(tolerance: f64) -> Kernel {
    Kernel::new(
        &Medium::new(POISSON_RATIO).unwrap(),
        Profile::Hertz,
        tolerance,
    )
    .unwrap()
}

fn places(count: usize) -> Vec<(f64, f64)> {
    let mut random = Stream::new(2024);
    (0..count)
        .map(|_| (random.within(0.0, SIDE), random.within(0.0, SIDE)))
        .collect()
}

/// Whether timings are wanted: `cargo test` runs every benchmark once, without the option.
fn is_bench() -> bool {
    std::env::args().any(|argument| argument == "--bench")
}

fn trace(kernel: &Kernel, r: f64, z: f64) -> Vec<Six> {
    let mut cells = vec![Six::default(); CELLS];
    let trace = kernel.trace(r, z, CELLS as f64 * WIDTH).unwrap();
    trace
        .for_each_cell(WIDTH, CELLS, |j, [average, ..]| cells[j] = average)
        .unwrap();
    cells
}

/// Prints the errors of samples and cells at each tolerance, relative to the peaks at their places.
fn accuracy() {
    let (at, times) = if is_bench() { (400, 25) } else { (4, 2) };
    let (exact, rough) = (kernel(REFERENCE), kernel(1e-5));
    let kernels = TOLERANCES.map(kernel);
    let (mut samples, mut cells) = (TOLERANCES.map(|_| vec![]), TOLERANCES.map(|_| vec![]));
    let mut random = Stream::new(7);
    for (i, (r, z)) in places(at).into_iter().enumerate() {
        let peak = peaks(&rough, r, z, &[]);
        let errors = |a: Six, b: Six| (0..6).map(move |f| (a[f] - b[f]).abs() / peak[f]);
        for _ in 0..times {
            let t = random.within(0.0, END);
            let best = exact.remainder(r, z, t).unwrap().value;
            for (kernel, samples) in kernels.iter().zip(&mut samples) {
                samples.extend(errors(kernel.remainder(r, z, t).unwrap().value, best));
            }
        }
        if i % 10 == 0 {
            let best = trace(&exact, r, z);
            for (kernel, cells) in kernels.iter().zip(&mut cells) {
                for (a, b) in trace(kernel, r, z).into_iter().zip(&best) {
                    cells.extend(errors(a, *b));
                }
            }
        }
    }
    for (what, found) in [("sample", samples), ("cell average", cells)] {
        heading(&format!(
            "error of a {what} against tolerance 1e-13, relative to the peak over time"
        ));
        for (tolerance, errors) in TOLERANCES.iter().zip(&found) {
            line(&format!("tolerance {tolerance:e}"), errors);
        }
    }
    let medium = Medium::new(POISSON_RATIO).unwrap();
    let centre = SurfaceResponse::new(&medium, Deflection::Centre);
    let errors: Vec<f64> = (1..=2000)
        .map(|i| 1.1 * centre.disc.memory * f64::from(i) / 2000.0)
        .map(|t| (centre.step(t) - kausel::centre_step(&medium, medium.kappa() * t)).abs())
        .collect();
    heading("error of W of the surface centre against Kausel's closed form");
    line("surface centre", &errors);
    println!();
}

/// Time of one of a batch, repeated as often as asked.
fn each<T>(repetitions: u64, batch: &[T], mut f: impl FnMut(&T)) -> Duration {
    let clock = Instant::now();
    for _ in 0..repetitions {
        batch.iter().for_each(&mut f);
    }
    clock.elapsed() / batch.len() as u32
}

fn samples(criterion: &mut Criterion) {
    accuracy();
    let mut random = Stream::new(11);
    let points: Vec<_> = places(1000)
        .into_iter()
        .map(|(r, z)| (r, z, random.within(0.0, END)))
        .collect();
    let mut group = criterion.benchmark_group("six fields at one point");
    group.throughput(Throughput::Elements(1));
    for tolerance in TOLERANCES {
        let kernel = kernel(tolerance);
        let sample = |&(r, z, t): &(f64, f64, f64)| {
            black_box(kernel.remainder(r, z, t).unwrap());
        };
        group.bench_function(format!("{tolerance:e}"), |b| {
            b.iter_custom(|repetitions| each(repetitions, &points, sample));
        });
    }
}

fn traces(criterion: &mut Criterion) {
    let places = places(32);
    let mut group = criterion.benchmark_group("300 cells of six fields");
    group.throughput(Throughput::Elements(CELLS as u64));
    for tolerance in TOLERANCES {
        let kernel = kernel(tolerance);
        let sample = |&(r, z): &(f64, f64)| {
            black_box(trace(&kernel, r, z));
        };
        group.bench_function(format!("{tolerance:e}"), |b| {
            b.iter_custom(|repetitions| each(repetitions, &places, sample));
        });
    }
}

/// A trace of 300 times of the echoes of a plate of four radii, at two radii from the axis.
fn echoes(criterion: &mut Criterion) {
    const THICKNESS: f64 = 4.0;
    let plate = Plate::new(&kernel(1e-6), THICKNESS).unwrap();
    let mut group = criterion.benchmark_group("300 times of the echoes of a plate");
    for (face, z) in [("upper face", 0.0), ("lower face", 4.0), ("inside", 1.5)] {
        for transits in [3.0, 6.0, 12.0] {
            let times = (1..=300).map(|i| transits * THICKNESS * f64::from(i) / 300.0);
            let times: Vec<f64> = times.collect();
            group.bench_function(format!("{face}, {transits} transits"), |b| {
                b.iter(|| {
                    for &t in &times {
                        black_box(plate.echoes(2.0, z, t).unwrap());
                    }
                });
            });
        }
    }
}

fn surface(criterion: &mut Criterion) {
    let medium = Medium::new(POISSON_RATIO).unwrap();
    let mut group = criterion.benchmark_group("deflection of the surface");
    group.throughput(Throughput::Elements(1));
    for deflection in [Deflection::Centre, Deflection::Mean] {
        let response = SurfaceResponse::new(&medium, deflection);
        let mut random = Stream::new(13);
        let times: Vec<f64> = (0..1000)
            .map(|_| random.within(0.0, response.disc.memory))
            .collect();
        let sample = |&t: &f64| {
            black_box(response.step(t));
        };
        group.bench_function(format!("{deflection:?}"), |b| {
            b.iter_custom(|repetitions| each(repetitions, &times, sample));
        });
    }
}

criterion_group! {
    name = kernels;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(4));
    targets = samples, traces, echoes, surface
}
criterion_main!(kernels);
