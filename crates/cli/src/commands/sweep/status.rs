//! `hertzlamb sweep status`: present, missing and unrelated parts in a folder.

use super::failure;
use crate::arguments::KernelOptions;
use crate::failure::{Failure, lines, print, show};
use clap::Args;
use formats::parts::Parts;
use formats::sweep::{Shard, Spec};
use serde::Serialize;
use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Folder with the parts.
    folder: PathBuf,
    /// Sweep file. Default: the sweep of most parts.
    #[arg(long, value_name = "SWEEP.toml")]
    sweep: Option<PathBuf>,
    #[command(flatten)]
    kernels: KernelOptions,
    /// Number of shards of the sweep. Default: the number stored in the parts.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=Shard::MOST as i64))]
    shards: Option<u32>,
    /// Print only the missing shards, in the format of a Slurm array: 3,17,40-42; an empty line if none is missing.
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
        let unknown = "the parts do not store the number of shards of the sweep: pass --shards N";
        let missing = missing_shards.ok_or_else(|| Failure::input(unknown))?;
        return print(ranges(&missing));
    }
    show(arguments.json, &Status::of(&parts, shards, missing_shards))
}

/// Present and missing parts of a sweep in a folder.
#[derive(Serialize)]
struct Status {
    sweep_sha256: String,
    sweep_rows: usize,
    rows: usize,
    failed: usize,
    complete: bool,
    shards: Option<usize>,
    parts: Vec<PartReport>,
    missing_rows: Vec<[usize; 2]>,
    missing_shards: Option<Vec<usize>>,
    overlap: Option<String>,
    foreign: Vec<ForeignFile>,
    unfinished: Vec<UnfinishedRun>,
}

#[derive(Serialize)]
struct PartReport {
    file: String,
    shard: Option<String>,
    first_row: usize,
    rows: usize,
    failed: usize,
    sealed: bool,
}

/// A file in the folder that is not a part of the sweep.
#[derive(Serialize)]
struct ForeignFile {
    file: String,
    reason: String,
}

/// A run that is in progress or was interrupted.
#[derive(Serialize)]
struct UnfinishedRun {
    file: String,
    first_row: usize,
    rows: usize,
    kept: usize,
}

impl Status {
    fn of(parts: &Parts, shards: Option<usize>, missing_shards: Option<Vec<usize>>) -> Self {
        let gaps = parts.missing();
        let overlap = parts.overlap().map(|error| error.to_string());
        let stored = parts.parts.iter().map(|part| PartReport {
            file: part.path.display().to_string(),
            shard: part.selection.shard.map(|shard| shard.to_string()),
            first_row: part.selection.rows.start,
            rows: part.selection.rows.len(),
            failed: part.failed,
            sealed: part.sealed,
        });
        let foreign = parts.foreign.iter().map(|(path, reason)| ForeignFile {
            file: path.display().to_string(),
            reason: reason.clone(),
        });
        let unfinished = parts.unfinished.iter().map(|run| UnfinishedRun {
            file: run.path.display().to_string(),
            first_row: run.rows.start,
            rows: run.rows.len(),
            kept: run.kept,
        });
        Self {
            sweep_sha256: parts.sha256.clone(),
            sweep_rows: parts.sweep_rows,
            rows: parts.sweep_rows - gaps.iter().map(ExactSizeIterator::len).sum::<usize>(),
            failed: parts.parts.iter().map(|part| part.failed).sum(),
            complete: gaps.is_empty() && overlap.is_none(),
            shards,
            parts: stored.collect(),
            missing_rows: gaps.iter().map(|gap| [gap.start, gap.end]).collect(),
            missing_shards,
            overlap,
            foreign: foreign.collect(),
            unfinished: unfinished.collect(),
        }
    }

    /// Missing shards and ranges of rows, one line each.
    fn missing(&self) -> Vec<String> {
        let mut text = Vec::new();
        if let (Some(missing), Some(count)) = (&self.missing_shards, self.shards)
            && !missing.is_empty()
        {
            text.push(format!("shards {} of {count}", ranges(missing)));
        }
        let shown = self.missing_rows.iter().take(MOST_LINES);
        text.extend(shown.map(|[start, end]| format!("rows {start}:{end}")));
        if self.missing_rows.len() > MOST_LINES {
            let more = self.missing_rows.len() - MOST_LINES;
            text.push(format!("{more} more ranges of rows"));
        }
        text
    }
}

impl Display for Status {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (count, rows, all) = (self.parts.len(), self.rows, self.sweep_rows);
        let of_rows = format!("{count} with {rows} of {all} rows, {} failed", self.failed);
        let mut text = vec![("sweep", self.sweep_sha256.clone()), ("parts", of_rows)];
        text.extend(
            self.missing()
                .into_iter()
                .map(|missing| ("missing", missing)),
        );
        text.extend(self.overlap.clone().map(|overlap| ("twice", overlap)));
        let foreign = self.foreign.iter();
        text.extend(foreign.map(|file| ("foreign", file.reason.clone())));
        for UnfinishedRun {
            file, rows, kept, ..
        } in &self.unfinished
        {
            text.push(("unfinished", format!("{file} keeps {kept} of {rows} rows")));
        }
        let unsealed = self.parts.iter().filter(|part| !part.sealed).count();
        if unsealed > 0 {
            let of_older =
                format!("{unsealed} parts of an older version, in which damage is not detected");
            text.push(("unsealed", of_older));
        }
        if self.complete {
            text.push(("complete", "yes".to_owned()));
        }
        f.write_str(&lines(text))
    }
}

/// Number of missing ranges that are listed individually.
const MOST_LINES: usize = 5;

/// Ascending numbers in the format of a Slurm array.
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
