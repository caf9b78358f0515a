//! `hertzlamb sweep status`: what a folder of parts has and lacks.

use super::failure;
use crate::arguments::Kernels;
use crate::failure::{Failure, lines, print, show};
use clap::Args;
use formats::parts::Parts;
use formats::stored::Part;
use formats::sweep::{Shard, Spec, Unfinished};
use serde_json::{Value, json};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
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
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let of_file = |path: &PathBuf| arguments.kernels.with_fields(Spec::from_file(path)?);
    let spec = arguments.sweep.as_ref().map(of_file).transpose()?;
    let parts = Parts::in_folder(&arguments.folder, spec.as_ref()).map_err(failure)?;
    let shards = arguments.shards.map(|count| count as usize);
    let shards = shards.or(parts.shards());
    let missing_shards = shards.map(|count| parts.missing_shards(count));
    if arguments.missing {
        let unknown =
            "the parts do not say into how many shards the sweep is divided: give --shards N";
        let missing = missing_shards.ok_or_else(|| Failure::input(unknown))?;
        return print(ranges(&missing));
    }
    let gaps = parts.missing();
    let rows = parts.sweep_rows - gaps.iter().map(ExactSizeIterator::len).sum::<usize>();
    let failed: usize = parts.parts.iter().map(|part| part.failed).sum();
    let overlap = parts.overlap().map(|error| error.to_string());
    let complete = gaps.is_empty() && overlap.is_none();
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
        "foreign": parts.foreign.iter().map(foreign).collect::<Value>(),
        "unfinished": parts.unfinished.iter().map(at_work).collect::<Value>(),
    });
    let (count, all) = (parts.parts.len(), parts.sweep_rows);
    let of_rows = format!("{count} with {rows} of {all} rows, {failed} failed");
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
    for (_, reason) in &parts.foreign {
        text.push(("foreign", reason.clone()));
    }
    for run in &parts.unfinished {
        let (file, rows) = (run.path.display(), run.rows.len());
        let keeps = format!("{file} keeps {} of {rows} rows", run.kept);
        text.push(("unfinished", keeps));
    }
    let unsealed = parts.parts.iter().filter(|part| !part.sealed).count();
    if unsealed > 0 {
        let of_older = format!("{unsealed} parts of an older version: damage to them is not seen");
        text.push(("unsealed", of_older));
    }
    if complete {
        text.push(("complete", "yes".to_owned()));
    }
    show(arguments.json, &value, lines(text))
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

/// A file that is none of the parts.
fn foreign((path, reason): &(PathBuf, String)) -> Value {
    json!({ "file": path.display().to_string(), "reason": reason })
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
    let runs = numbers.chunk_by(|before, next| before + 1 == *next);
    let told: Vec<String> = runs
        .map(|run| match run {
            [first, .., last] => format!("{first}-{last}"),
            one => format!("{}", one[0]),
        })
        .collect();
    told.join(",")
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
