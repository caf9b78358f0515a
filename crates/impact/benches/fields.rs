//! The direct sum against the transform: `cargo bench --package hertzlamb-impact --bench fields`.

#![allow(missing_docs, reason = "criterion's macros make undocumented items")]
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use impact::convolve::{Method, bench_convolution};
use std::hint::black_box;

fn sums(c: &mut Criterion) {
    let mut group = c.benchmark_group("six fields at one point");
    for samples in [64_usize, 128, 256, 512, 1024, 4096] {
        let force: Vec<f64> = (0..samples)
            .map(|i| (6.0 * i as f64 / samples as f64).sin().max(0.0))
            .collect();
        for method in [Method::Direct, Method::Transform, Method::Chosen] {
            let run = bench_convolution(&force, method);
            group.bench_function(BenchmarkId::new(format!("{method:?}"), samples), |b| {
                b.iter(|| black_box(run()));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, sums);
criterion_main!(benches);
