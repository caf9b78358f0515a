//! `hertzlamb sweep --plan`: what a sweep takes, measured on a few of its rows.

use crate::failure::{Failure, print};
use formats::sweep::{Rows, Spec, column_names, compute_rows, grain, row_bytes};
use serde::Serialize;
use std::path::Path;
use std::time::Instant;

/// Time in s that a shard is to take.
const SHARD_S: f64 = 300.0;
/// Shards at most: what Slurm takes as one array unless told otherwise.
const MOST_SHARDS: usize = 1000;
/// Time in s of the measurement, about.
const MEASURED_S: f64 = 1.0;
/// Rows of the first measurement.
const FIRST_ROWS: usize = 64;

/// The JSON object of `sweep --plan --json`.
#[derive(Debug, Serialize)]
struct Plan {
    rows: usize,
    shards: usize,
    /// Of the largest shard.
    rows_per_shard: usize,
    bytes_per_shard: usize,
    /// While it is computed and written.
    disk_bytes_per_shard: usize,
    seconds_per_shard: f64,
    seconds: f64,
    bytes: usize,
    rows_per_second: f64,
    threads: usize,
    measured_rows: usize,
    sweep_sha256: String,
    columns: Vec<String>,
}

pub(crate) fn run(
    sweep: &Path,
    spec: &Spec,
    shards: Option<u32>,
    json: bool,
) -> Result<(), Failure> {
    let (measured_rows, rows_per_second) =
        measure(spec).map_err(|error| Failure::input(error.in_file(sweep)))?;
    let rows = spec.rows();
    let seconds = rows as f64 / rows_per_second;
    let grain = grain(&spec.fields);
    let grains = rows.div_ceil(grain);
    let wished = (seconds / SHARD_S).ceil() as usize;
    let own = wished.clamp(1, MOST_SHARDS).min(grains);
    let count = shards.map_or(own, |count| count as usize);
    let rows_per_shard = (grains.div_ceil(count) * grain).min(rows);
    let (bytes, kept) = row_bytes(spec);
    // 32 bytes of its seal for each 8192
    let sealed = |bytes: usize| bytes + bytes / 256;
    let plan = Plan {
        rows,
        shards: count,
        rows_per_shard,
        bytes_per_shard: sealed(rows_per_shard * bytes),
        disk_bytes_per_shard: sealed(rows_per_shard * bytes) + rows_per_shard * kept,
        seconds_per_shard: rows_per_shard as f64 / rows_per_second,
        seconds,
        bytes: sealed(rows * bytes),
        rows_per_second,
        threads: std::thread::available_parallelism().map_or(1, usize::from),
        measured_rows,
        sweep_sha256: spec.sha256(),
        columns: column_names(spec),
    };
    if json {
        return print(serde_json::to_string(&plan).map_err(Failure::work)?);
    }
    print(plan.text())
}

/// Rows spread over the sweep, and how many of them a second takes.
fn measure(spec: &Spec) -> Result<(usize, f64), formats::SceneError> {
    let mut count = FIRST_ROWS.min(spec.rows());
    loop {
        let step = (spec.rows() / count).max(1);
        let began = Instant::now();
        let rows = Rows {
            start: 0,
            step,
            count,
        };
        compute_rows(spec, rows, |_| true)?;
        let took_s = began.elapsed().as_secs_f64().max(1e-6);
        let more = (count as f64 * (MEASURED_S / took_s).min(16.0)) as usize;
        if took_s > MEASURED_S / 2.0 || count >= spec.rows().min(1 << 20) {
            return Ok((count, count as f64 / took_s));
        }
        count = more.clamp(count + 1, spec.rows().min(1 << 20));
    }
}

impl Plan {
    fn text(&self) -> String {
        format!(
            "sweep          {}\nrows           {}\nshards         {} of up to {} rows, {:.3} GB and {:.3} s each\n\
             in all         {:.3} GB, {:.3} s on this machine\nrate           {:.0} rows a second on {} threads, from {} rows\n\
             disk           {:.3} GB a shard while it is written",
            self.sweep_sha256,
            self.rows,
            self.shards,
            self.rows_per_shard,
            1e-9 * self.bytes_per_shard as f64,
            self.seconds_per_shard,
            1e-9 * self.bytes as f64,
            self.seconds,
            self.rows_per_second,
            self.threads,
            self.measured_rows,
            1e-9 * self.disk_bytes_per_shard as f64,
        )
    }
}
