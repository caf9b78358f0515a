//! Traces of 300 cells by pattern of access, median and 99 % quantile; and 10,000 probes on one and two threads.
//!
//! `cargo bench -p hertzlamb-lookup --bench patterns`

#![allow(missing_docs, unreachable_pub, reason = "a program")]
#![allow(clippy::unwrap_used, reason = "a panic is how a measurement fails")]

mod common;

use common::{BYTES, CELLS, NODES, POINTS, STORED, uniform};
use lookup::{Smoothness, Table, TraceInfo};
use std::hint::black_box;
use std::time::Instant;

const COUNT: usize = 4000;

/// Median and 99 % quantile in microseconds.
fn quantiles(mut times: Vec<f64>) -> (f64, f64) {
    times.sort_by(f64::total_cmp);
    (times[times.len() / 2], times[times.len() * 99 / 100])
}

fn timed(mut work: impl FnMut(usize)) -> (f64, f64) {
    quantiles(
        (0..COUNT)
            .map(|i| {
                let start = Instant::now();
                work(i);
                start.elapsed().as_secs_f64() * 1e6
            })
            .collect(),
    )
}

fn random(table: &Table, i: usize) -> [f64; 2] {
    let i = 2 * i as u64;
    [
        uniform(i) * table.content().r_max,
        uniform(i + 1) * table.content().z_max,
    ]
}

fn clustered(table: &Table, i: usize) -> [f64; 2] {
    let [r, z] = random(table, i);
    [2.0 + 0.1 * r, 1.5 + 0.1 * z]
}

fn main() {
    let table = common::table();
    let mut cells = vec![[0.0; 6]; CELLS];
    let mut plain = f64::NAN;
    println!("microseconds a trace of {CELLS} cells, 6 fields, {POINTS} points: median, 99 %");
    for (smoothness, name) in [
        (Smoothness::Linear, "averages"),
        (Smoothness::Smooth, "averages and moments"),
    ] {
        for (place, pattern) in [
            (random as fn(&Table, usize) -> [f64; 2], "random"),
            (clustered, "clustered"),
        ] {
            let (median, most) = timed(|i| {
                let [r, z] = place(&table, i);
                table.trace(smoothness, 0.3, r, z, 0, &mut cells).unwrap();
            });
            println!("  {pattern:16} {name:22} {median:7.1} {most:7.1}");
            if pattern == "random" && smoothness == Smoothness::Linear {
                plain = median;
            }
        }
    }
    for (place, pattern) in [
        (random as fn(&Table, usize) -> [f64; 2], "random, cold"),
        (clustered, "clustered, cold"),
    ] {
        let (median, most) = cold(&table, place, &mut cells);
        println!("  {pattern:16} {:22} {median:7.1} {most:7.1}", "averages");
    }
    let copy = copies(&table);
    println!(
        "a random trace of averages takes {:.1} times as long as the copy of the bytes that it reads",
        plain / copy
    );
    scaling(&table);
}

/// A first call each time: 64 MB of other memory went through the caches before it.
fn cold(table: &Table, place: fn(&Table, usize) -> [f64; 2], cells: &mut [[f64; 6]]) -> (f64, f64) {
    let mut other = vec![0_u64; 8 << 20];
    let times = (0..400)
        .map(|i| {
            other.iter_mut().for_each(|x| *x = x.wrapping_add(1));
            black_box(&other);
            let [r, z] = place(table, i);
            let start = Instant::now();
            table
                .trace(Smoothness::Linear, 0.3, r, z, 0, cells)
                .unwrap();
            start.elapsed().as_secs_f64() * 1e6
        })
        .collect();
    quantiles(times)
}

/// The bytes of a trace, copied from random patches.
fn copies(table: &Table) -> f64 {
    let stored = &table.content().slices[0].remainder;
    let row = POINTS * 6 * STORED;
    let mut copy = vec![0.0_f32; POINTS * row];
    let (median, most) = timed(|i| {
        let place = |k: usize| (uniform((2 * i + k) as u64) * (NODES - POINTS) as f64) as usize;
        for (j, part) in copy.chunks_exact_mut(row).enumerate() {
            let start = ((place(0) + j) * NODES + place(1)) * 6 * STORED;
            part.copy_from_slice(&stored[start..start + row]);
        }
        black_box(&copy);
    });
    println!(
        "  {:16} {:22} {median:7.1} {most:7.1}",
        "random",
        format!("copy of {} kB", BYTES / 1000)
    );
    median
}

/// 10,000 probes in batches of 100, each thread with memory of its own.
fn scaling(table: &Table) {
    let points: Vec<[f64; 2]> = (0..10_000).map(|i| random(table, i)).collect();
    let run = |threads: usize| {
        let start = Instant::now();
        std::thread::scope(|scope| {
            for part in points.chunks(points.len().div_ceil(threads)) {
                scope.spawn(move || {
                    let mut cells = vec![[0.0; 6]; 100 * CELLS];
                    let blank = TraceInfo {
                        static_part: [0.0; 6],
                        cell_width: 0.0,
                        error: [0.0; 6],
                    };
                    let mut infos = [blank; 100];
                    for batch in part.chunks(100) {
                        table
                            .traces(Smoothness::Linear, 0.3, batch, 0, &mut cells, &mut infos)
                            .unwrap();
                    }
                });
            }
        });
        start.elapsed().as_secs_f64()
    };
    let best = |threads| (0..7).map(|_| run(threads)).fold(f64::INFINITY, f64::min);
    let (one, two) = (best(1), best(2));
    println!(
        "10,000 probes: {:.0} a second on one thread, {:.0} on two, {:.2} times as many",
        1e4 / one,
        1e4 / two,
        one / two
    );
}
