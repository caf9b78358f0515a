//! `hertzlamb sweep status` and `merge`: what a folder of parts has and lacks, and all of it in one file.

use super::failure;
use crate::arguments::{Kernels, Overwrite, check_rows};
use crate::failure::{Failure, lines, print, say, show};
use clap::Subcommand;
use formats::parts::Parts;
use formats::stored::Part;
use formats::sweep::{Shard, Spec, Unfinished};
use output::ROWS;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

#[derive(Debug, Subcommand)]
pub(crate) enum Action {
    /// Says which parts of a sweep a folder has, which are missing and what else lies there.
    Status {
        /// The folder of the parts.
        folder: PathBuf,
        /// The sweep file; that of most parts otherwise.
        #[arg(long, value_name = "SWEEP.toml")]
        sweep: Option<PathBuf>,
        #[command(flatten)]
        kernels: Kernels,
        /// Into how many shards it is divided; as the parts say otherwise.
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=Shard::MOST as i64))]
        shards: Option<u32>,
        /// Print the missing shards alone, as a Slurm array takes them: 3,17,40-42; an empty line for none.
        #[arg(long, conflicts_with = "json")]
        missing: bool,
        /// Print one JSON object instead of text.
        #[arg(long)]
        json: bool,
    },
    /// Joins the parts of a sweep: byte by byte the file that one run would have written.
    Merge {
        /// The folder of the parts.
        folder: PathBuf,
        /// Results file: HDF5, or Parquet where the name ends with .parquet, whatever the parts are.
        #[arg(short, long, value_name = "OUT")]
        output: PathBuf,
        /// Copy no results: the output (HDF5) refers to the parts (HDF5), which have to stay where they are, seen from it.
        #[arg(long = "virtual")]
        refer: bool,
        #[command(flatten)]
        overwrite: Overwrite,
        /// Print one JSON object instead of text.
        #[arg(long)]
        json: bool,
    },
}

pub(crate) fn run(action: &Action) -> Result<(), Failure> {
    match action {
        Action::Status {
            folder,
            sweep,
            kernels,
            shards,
            missing,
            json,
        } => {
            let spec = sweep.as_deref().map(|path| {
                let spec = Spec::from_file(path)?;
                kernels.with_fields(spec)
            });
            let spec = spec.transpose()?;
            let parts = Parts::in_folder(folder, spec.as_ref()).map_err(failure)?;
            let shards = shards
                .map(|count| count as usize)
                .or_else(|| parts.shards());
            status(&parts, shards, *missing, *json)
        }
        Action::Merge {
            folder,
            output,
            refer,
            overwrite,
            json,
        } => merge(folder, output, *refer, *overwrite, *json),
    }
}

fn status(parts: &Parts, shards: Option<usize>, list: bool, json: bool) -> Result<(), Failure> {
    let missing_shards = shards.map(|count| parts.missing_shards(count));
    if list {
        let Some(missing) = &missing_shards else {
            return Err(Failure::input(
                "the parts do not say into how many shards the sweep is divided: give --shards N",
            ));
        };
        return print(ranges(missing));
    }
    let gaps = parts.missing();
    let rows = parts.sweep_rows - gaps.iter().map(ExactSizeIterator::len).sum::<usize>();
    let failed: usize = parts.parts.iter().map(|part| part.failed).sum();
    let overlap = parts.overlap().map(|error| error.to_string());
    let complete = gaps.is_empty() && overlap.is_none();
    let foreign = parts.foreign.iter();
    let value = json!({
        "sweep_sha256": parts.sha256,
        "sweep_rows": parts.sweep_rows,
        "rows": rows,
        "failed": failed,
        "complete": complete,
        "shards": shards,
        "parts": parts.parts.iter().map(stored).collect::<Value>(),
        "missing_rows": gaps.iter().map(|gap| json!([gap.start, gap.end])).collect::<Value>(),
        "missing_shards": missing_shards,
        "overlap": overlap,
        "foreign": foreign
            .map(|(path, reason)| json!({ "file": path.display().to_string(), "reason": reason }))
            .collect::<Value>(),
        "unfinished": parts.unfinished.iter().map(at_work).collect::<Value>(),
    });
    let count = parts.parts.len();
    let of_rows = format!(
        "{count} with {rows} of {} rows, {failed} failed",
        parts.sweep_rows
    );
    let mut text = vec![("sweep", parts.sha256.clone()), ("parts", of_rows)];
    if let (Some(missing), Some(count)) = (missing_shards, shards)
        && !missing.is_empty()
    {
        text.push(("missing", format!("shards {} of {count}", ranges(&missing))));
    }
    for gap in gaps.iter().take(MOST_LINES) {
        text.push(("missing", format!("rows {}:{}", gap.start, gap.end)));
    }
    if gaps.len() > MOST_LINES {
        let more = gaps.len() - MOST_LINES;
        text.push(("missing", format!("{more} more ranges of rows")));
    }
    text.extend(overlap.map(|overlap| ("twice", overlap)));
    let foreign = parts.foreign.iter();
    text.extend(foreign.map(|(_, reason)| ("foreign", reason.clone())));
    let unfinished = parts.unfinished.iter();
    text.extend(unfinished.map(|run| {
        let (file, rows) = (run.path.display(), run.rows.len());
        let keeps = format!("{file} keeps {} of {rows} rows", run.kept);
        ("unfinished", keeps)
    }));
    let unsealed = parts.parts.iter().filter(|part| !part.sealed).count();
    if unsealed > 0 {
        let of_older = format!("{unsealed} parts of an older version: damage to them is not seen");
        text.push(("unsealed", of_older));
    }
    if complete {
        text.push(("complete", "yes".to_owned()));
    }
    show(json, &value, lines(text))
}

fn stored(part: &Part) -> Value {
    json!({
        "file": part.path.display().to_string(),
        "shard": part.selection.shard.map(|shard| shard.to_string()),
        "first_row": part.selection.rows.start,
        "rows": part.selection.rows.len(),
        "failed": part.failed,
        "sealed": part.sealed,
    })
}

/// A run that is at work or was interrupted.
fn at_work(run: &Unfinished) -> Value {
    json!({
        "file": run.path.display().to_string(),
        "first_row": run.rows.start,
        "rows": run.rows.len(),
        "kept": run.kept,
    })
}

/// Ranges that are told one by one.
const MOST_LINES: usize = 5;

/// Ascending numbers as a Slurm array takes them.
fn ranges(numbers: &[usize]) -> String {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for &number in numbers {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => runs.push((number, number)),
        }
    }
    let told = runs.iter().map(|&(first, last)| {
        if first == last {
            first.to_string()
        } else {
            format!("{first}-{last}")
        }
    });
    told.collect::<Vec<_>>().join(",")
}

fn merge(
    folder: &Path,
    output: &Path,
    refer: bool,
    overwrite: Overwrite,
    json: bool,
) -> Result<(), Failure> {
    check_rows(output)?;
    let claimed = overwrite.claim(output, ROWS, &[])?;
    let mut parts = Parts::in_folder(folder, None).map_err(failure)?;
    // with --force the output itself may be a merged sweep of before
    let own = |path: &Path| path.canonicalize().ok() == claimed.real.canonicalize().ok();
    if let Some(part) = parts
        .parts
        .iter()
        .find(|part| claimed.real.exists() && own(&part.path))
    {
        return Err(Failure::input(format!(
            "{} is a part that this command reads: give the output another name",
            part.path.display()
        )));
    }
    parts
        .foreign
        .retain(|(path, _)| !own(path) || !claimed.real.exists());
    let staged = parts.merge(&claimed, refer);
    staged.map_err(failure)?.commit()?;
    let empty = parts
        .parts
        .iter()
        .filter(|part| part.selection.rows.is_empty());
    let empty = empty.count();
    if empty > 0 {
        say(format!("note: {empty} parts have no rows"));
    }
    let output = output.display().to_string();
    let (rows, count) = (parts.sweep_rows, parts.parts.len());
    let value = json!({
        "output": output,
        "rows": rows,
        "parts": count,
        "sweep_sha256": parts.sha256,
    });
    let text = lines([("written", format!("{output}, {rows} rows of {count} parts"))]);
    show(json, &value, text)
}

#[cfg(test)]
mod tests {
    use super::ranges;

    #[test]
    fn missing_shards_are_a_slurm_list() {
        assert_eq!(ranges(&[3, 17, 40, 41, 42]), "3,17,40-42");
        assert_eq!(ranges(&[1, 2]), "1-2");
        assert_eq!(ranges(&[]), "");
    }
}
