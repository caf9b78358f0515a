//! `hertzlamb sweep --plan`: cost of a sweep, measured on a few of its rows.

use super::RunArguments;
use crate::failure::{Failure, lines, show};
use formats::sweep::{Spec, column_names, compute_rows, grain, row_bytes};
use output::processor_s;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};
use std::path::Path;
use std::time::Instant;

/// Target time of a shard in s.
const SHARD_S: f64 = 300.0;
/// Largest number of shards: the default limit of Slurm for the size of an array.
const MOST_SHARDS: usize = 1000;
/// Approximate time of the measurement in s.
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
    // the checksum trailer has 32 bytes for each 8192
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

/// Time and disk space that a sweep needs, in total and per shard.
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
            "{:.0} rows per second on {} threads, measured on {} rows",
            self.rows_per_second, self.threads, self.measured_rows
        );
        let all = format!("{all}, {:.3} s on this machine", self.seconds);
        f.write_str(&lines([
            ("sweep", self.sweep_sha256.clone()),
            ("rows", self.rows.to_string()),
            ("shards", shards),
            ("in all", all),
            ("rate", rate),
            ("disk", format!("{disk} per shard while it is written")),
        ]))
    }
}

/// Number of measured rows, spread over the sweep, and rows per second. The time is processor time, which depends little
/// on other work on the machine.
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
