//! `hertzlamb sweep --plan`: what a sweep takes, measured on a few of its rows.

use super::RunArguments;
use crate::failure::{Failure, lines, show};
use formats::sweep::{Spec, column_names, compute_rows, grain, row_bytes};
use output::processor_s;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};
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

pub(crate) fn run(arguments: &RunArguments, sweep: &Path, spec: &Spec) -> Result<(), Failure> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let (measured_rows, rows_per_second) =
        measure(spec, threads).map_err(|error| error.in_file(sweep))?;
    let rows = spec.rows();
    let seconds = rows as f64 / rows_per_second;
    let grain = grain(&spec.fields);
    let grains = rows.div_ceil(grain);
    let wished = (seconds / SHARD_S).ceil() as usize;
    let own = wished.clamp(1, MOST_SHARDS).min(grains);
    let count = arguments.shards.map_or(own, |count| count as usize);
    let rows_per_shard = (grains.div_ceil(count) * grain).min(rows);
    let (bytes, kept) = row_bytes(spec);
    // 32 bytes of its seal for each 8192
    let sealed = |bytes: usize| bytes + bytes / 256;
    let bytes_per_shard = sealed(rows_per_shard * bytes);
    let report = SweepPlan {
        rows,
        shards: count,
        rows_per_shard,
        bytes_per_shard,
        disk_bytes_per_shard: bytes_per_shard + rows_per_shard * kept,
        seconds_per_shard: rows_per_shard as f64 / rows_per_second,
        seconds,
        bytes: sealed(rows * bytes),
        rows_per_second,
        threads,
        measured_rows,
        sweep_sha256: spec.sha256.clone(),
        columns: column_names(spec),
    };
    show(arguments.json, &report)
}

/// Time, memory and disk that a sweep takes, as a whole and by shards.
#[derive(Serialize)]
struct SweepPlan {
    rows: usize,
    shards: usize,
    rows_per_shard: usize,
    bytes_per_shard: usize,
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

impl Display for SweepPlan {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [each, all, disk] = [self.bytes_per_shard, self.bytes, self.disk_bytes_per_shard]
            .map(|bytes| format!("{:.3} GB", 1e-9 * bytes as f64));
        let shards = format!(
            "{} of up to {} rows, {each} and {:.3} s each",
            self.shards, self.rows_per_shard, self.seconds_per_shard
        );
        let rate = format!(
            "{:.0} rows a second on {} threads, from {} rows",
            self.rows_per_second, self.threads, self.measured_rows
        );
        let all = format!("{all}, {:.3} s on this machine", self.seconds);
        f.write_str(&lines([
            ("sweep", self.sweep_sha256.clone()),
            ("rows", self.rows.to_string()),
            ("shards", shards),
            ("in all", all),
            ("rate", rate),
            ("disk", format!("{disk} a shard while it is written")),
        ]))
    }
}

/// Rows spread over the sweep, and how many of them a second takes; time is that of the processor, which other work on
/// the machine changes little.
fn measure(spec: &Spec, threads: usize) -> Result<(usize, f64), formats::SceneError> {
    let mut count = FIRST_ROWS.min(spec.rows());
    loop {
        let step = (spec.rows() / count).max(1);
        let (began, spent_s) = (Instant::now(), processor_s());
        compute_rows(spec, 0, step, count, |_, _| true)?;
        let both = processor_s().zip(spent_s);
        let spent_s = both.map(|(after, before)| (after - before) / threads as f64);
        let took_s = spent_s.unwrap_or(began.elapsed().as_secs_f64()).max(1e-6);
        let more = (count as f64 * (MEASURED_S / took_s).min(16.0)) as usize;
        if took_s > MEASURED_S / 2.0 || count >= spec.rows().min(1 << 20) {
            return Ok((count, count as f64 / took_s));
        }
        count = more.clamp(count + 1, spec.rows().min(1 << 20));
    }
}
