//! `hertzlamb sweep --plan`: what a sweep takes, measured on a few of its rows.

use super::Run;
use crate::failure::{Failure, lines, show};
use formats::sweep::{Spec, column_names, compute_rows, grain, row_bytes};
use output::processor_s;
use serde_json::json;
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

pub(crate) fn run(arguments: &Run, sweep: &Path, spec: &Spec) -> Result<(), Failure> {
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
    let all_bytes = sealed(rows * bytes);
    let bytes_per_shard = sealed(rows_per_shard * bytes);
    let disk_bytes_per_shard = bytes_per_shard + rows_per_shard * kept;
    let seconds_per_shard = rows_per_shard as f64 / rows_per_second;
    let value = json!({
        "rows": rows,
        "shards": count,
        "rows_per_shard": rows_per_shard,
        "bytes_per_shard": bytes_per_shard,
        "disk_bytes_per_shard": disk_bytes_per_shard,
        "seconds_per_shard": seconds_per_shard,
        "seconds": seconds,
        "bytes": all_bytes,
        "rows_per_second": rows_per_second,
        "threads": threads,
        "measured_rows": measured_rows,
        "sweep_sha256": spec.sha256,
        "columns": column_names(spec),
    });
    let [each, all, disk] = [bytes_per_shard, all_bytes, disk_bytes_per_shard]
        .map(|bytes| format!("{:.3} GB", 1e-9 * bytes as f64));
    let shards =
        format!("{count} of up to {rows_per_shard} rows, {each} and {seconds_per_shard:.3} s each");
    let rate = format!(
        "{rows_per_second:.0} rows a second on {threads} threads, from {measured_rows} rows"
    );
    let text = lines([
        ("sweep", spec.sha256.clone()),
        ("rows", rows.to_string()),
        ("shards", shards),
        ("in all", format!("{all}, {seconds:.3} s on this machine")),
        ("rate", rate),
        ("disk", format!("{disk} a shard while it is written")),
    ]);
    show(arguments.json, &value, text)
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
