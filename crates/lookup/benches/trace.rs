//! One trace of six fields and 300 cells between the nodes, compared with a plain copy of the bytes that it reads.
//!
//! `cargo bench -p hertzlamb-lookup --bench trace`

#![allow(missing_docs, unreachable_pub, reason = "a program")]

mod common;

use common::{BYTES, CELLS, NODES, POINTS, STORED};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lookup::Smoothness;
use std::hint::black_box;

fn traces(criterion: &mut Criterion) {
    let table = common::table();
    let mut cells = vec![[0.0; 6]; CELLS];
    let mut group = criterion.benchmark_group("300 cells, 6 fields, off the grid");
    group.throughput(Throughput::Bytes(BYTES as u64));
    for (name, smoothness) in [
        ("averages", Smoothness::Linear),
        ("averages and moments", Smoothness::Smooth),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                let place = (black_box(2.03), black_box(1.71));
                table.trace(smoothness, 0.3, place.0, place.1, 0, &mut cells)
            });
        });
    }
    // The same patch of nodes, each read once and written once.
    let stored = &table.content().slices[0].remainder;
    let row = POINTS * 6 * STORED;
    let mut copy = vec![0.0_f32; POINTS * row];
    group.bench_function("copy of the same bytes", |bencher| {
        bencher.iter(|| {
            for (i, part) in copy.chunks_exact_mut(row).enumerate() {
                let start = ((20 + i) * NODES + 16) * 6 * STORED;
                part.copy_from_slice(black_box(&stored[start..start + row]));
            }
            black_box(&copy);
        });
    });
    group.finish();
}

criterion_group!(benches, traces);
criterion_main!(benches);
