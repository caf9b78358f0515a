//! The direct sum against the transform: `cargo bench --package hertzlamb-impact --bench fields`.

#![allow(missing_docs, reason = "criterion's macros make undocumented items")]
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use impact::convolve::{Convolver, Method};
use std::hint::black_box;

fn sums(c: &mut Criterion) {
    let mut group = c.benchmark_group("six fields at one point");
    for samples in [64_usize, 128, 256, 512, 1024, 4096] {
        let force: Vec<f64> = (0..samples)
            .map(|i| (6.0 * i as f64 / samples as f64).sin().max(0.0))
            .collect();
        let cells: Vec<[f64; 6]> = (0..samples)
            .map(|j| std::array::from_fn(|f| 1.0 / (1.0 + (j * (f + 1)) as f64)))
            .collect();
        for method in [Method::Direct, Method::Transform] {
            let convolver = Convolver::by(&force, method);
            group.bench_function(BenchmarkId::new(format!("{method:?}"), samples), |b| {
                b.iter(|| black_box(convolver.fields(&[1.0; 6], black_box(&cells))));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, sums);
criterion_main!(benches);
