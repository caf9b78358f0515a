//! `hertzlamb sweep status` and `merge`: what a folder of parts has and lacks, and all of it in one file.

use crate::failure::{Failure, print, say};
use crate::kernels::Kernels;
use crate::overwrite::Overwrite;
use clap::Subcommand;
use formats::parts::{Parts, PartsError};
use formats::stored::Part;
use formats::sweep::{Shard, Spec, Unfinished, check_rows};
use output::ROWS;
use serde::Serialize;
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
                let spec = Spec::from_file(path).map_err(Failure::input)?;
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

/// The JSON object of `sweep status --json`.
#[derive(Debug, Serialize)]
struct Status<'a> {
    sweep_sha256: &'a str,
    sweep_rows: usize,
    rows: usize,
    failed: usize,
    /// Whether every row is there, once.
    complete: bool,
    shards: Option<usize>,
    parts: Vec<Stored<'a>>,
    /// First row and the one behind the last of each gap.
    missing_rows: Vec<(usize, usize)>,
    missing_shards: Option<Vec<usize>>,
    overlap: Option<String>,
    foreign: Vec<Stranger<'a>>,
    unfinished: Vec<AtWork<'a>>,
}

#[derive(Debug, Serialize)]
struct Stored<'a> {
    file: &'a Path,
    shard: Option<String>,
    first_row: usize,
    rows: usize,
    failed: usize,
    /// Whether damage to it is seen.
    sealed: bool,
}

/// A run that is at work or was interrupted.
#[derive(Debug, Serialize)]
struct AtWork<'a> {
    file: &'a Path,
    first_row: usize,
    rows: usize,
    kept: usize,
}

#[derive(Debug, Serialize)]
struct Stranger<'a> {
    file: &'a Path,
    reason: &'a str,
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
    let gap_rows: usize = gaps.iter().map(ExactSizeIterator::len).sum();
    let overlap = parts.overlap().map(|error| error.to_string());
    let status = Status {
        sweep_sha256: &parts.sha256,
        sweep_rows: parts.sweep_rows,
        rows: parts.sweep_rows - gap_rows,
        failed: parts.parts.iter().map(|part| part.failed).sum(),
        complete: gaps.is_empty() && overlap.is_none(),
        shards,
        parts: parts.parts.iter().map(stored).collect(),
        missing_rows: gaps.iter().map(|gap| (gap.start, gap.end)).collect(),
        missing_shards,
        overlap,
        foreign: (parts.foreign.iter())
            .map(|foreign| Stranger {
                file: &foreign.path,
                reason: &foreign.reason,
            })
            .collect(),
        unfinished: parts.unfinished.iter().map(at_work).collect(),
    };
    if json {
        return print(serde_json::to_string(&status).map_err(Failure::work)?);
    }
    print(status.text())
}

fn stored(part: &Part) -> Stored<'_> {
    Stored {
        file: &part.path,
        shard: part.selection.shard.map(|shard| shard.to_string()),
        first_row: part.selection.rows.start,
        rows: part.selection.rows.len(),
        failed: part.failed,
        sealed: part.sealed,
    }
}

fn at_work(run: &Unfinished) -> AtWork<'_> {
    AtWork {
        file: &run.path,
        first_row: run.rows.start,
        rows: run.rows.len(),
        kept: run.kept,
    }
}

impl Status<'_> {
    fn text(&self) -> String {
        let mut text = format!(
            "sweep          {}\nparts          {} with {} of {} rows, {} failed",
            self.sweep_sha256,
            self.parts.len(),
            self.rows,
            self.sweep_rows,
            self.failed
        );
        let mut line = |name: &str, value: &str| text.push_str(&format!("\n{name:15}{value}"));
        match (&self.missing_shards, self.shards) {
            (Some(missing), Some(count)) if !missing.is_empty() => {
                line("missing", &format!("shards {} of {count}", ranges(missing)));
            }
            _ => {}
        }
        for (start, end) in self.missing_rows.iter().take(MOST_LINES) {
            line("missing", &format!("rows {start}:{end}"));
        }
        if self.missing_rows.len() > MOST_LINES {
            let more = self.missing_rows.len() - MOST_LINES;
            line("missing", &format!("{more} more ranges of rows"));
        }
        if let Some(overlap) = &self.overlap {
            line("twice", overlap);
        }
        for foreign in &self.foreign {
            line("foreign", foreign.reason);
        }
        for run in &self.unfinished {
            let file = run.file.display();
            line(
                "unfinished",
                &format!("{file} keeps {} of {} rows", run.kept, run.rows),
            );
        }
        let unsealed = self.parts.iter().filter(|part| !part.sealed).count();
        if unsealed > 0 {
            line(
                "unsealed",
                &format!("{unsealed} parts of an older version: damage to them is not seen"),
            );
        }
        if self.complete {
            line("complete", "yes");
        }
        text
    }
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
    let own = |path: &Path| path.canonicalize().ok() == claimed.real().canonicalize().ok();
    if let Some(part) = parts
        .parts
        .iter()
        .find(|part| claimed.real().exists() && own(&part.path))
    {
        return Err(Failure::input(format!(
            "{} is a part that this command reads: give the output another name",
            part.path.display()
        )));
    }
    parts
        .foreign
        .retain(|foreign| !own(&foreign.path) || !claimed.real().exists());
    let staged = if refer {
        parts.merge_virtual(&claimed)
    } else {
        parts.merge(&claimed)
    };
    staged.map_err(failure)?.commit()?;
    let empty = parts
        .parts
        .iter()
        .filter(|part| part.selection.rows.is_empty());
    let empty = empty.count();
    if empty > 0 {
        say(format!("note: {empty} parts have no rows"));
    }
    if json {
        return print(serde_json::json!({
            "output": output,
            "rows": parts.sweep_rows,
            "parts": parts.parts.len(),
            "sweep_sha256": parts.sha256,
        }));
    }
    print(format!(
        "written        {}, {} rows of {} parts",
        output.display(),
        parts.sweep_rows,
        parts.parts.len()
    ))
}

fn failure(error: PartsError) -> Failure {
    match error {
        PartsError::Output(output) => output.into(),
        missing @ PartsError::Missing { .. } => {
            Failure::input(format!("{missing}; hertzlamb sweep status lists them"))
        }
        other => Failure::input(other),
    }
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
