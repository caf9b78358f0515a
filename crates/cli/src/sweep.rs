//! `hertzlamb sweep`: many scenes.

use crate::failure::{Failure, print};
use crate::overwrite::Overwrite;
use crate::progress::Bar;
use clap::Args;
use formats::check;
use formats::sweep::{Spec, SweepError, run_sweep, write_csv, write_sweep};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Instant;

#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  hertzlamb sweep scenes/sweep.toml -o sweep.h5 --csv sweep.csv\n\nAn interrupted sweep goes on where it stopped when the same command is given again."
)]
pub(crate) struct Arguments {
    /// Sweep file (TOML, see data-schema/sweep.md).
    sweep: PathBuf,
    /// Results file (HDF5, see data-schema/sweep.md).
    #[arg(short, long, value_name = "OUT.h5")]
    output: PathBuf,
    /// Also write the rows as text.
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

/// The JSON object of `sweep --json`.
#[derive(Debug, Serialize)]
struct Report<'a> {
    output: &'a Path,
    csv: Option<&'a Path>,
    shape: Vec<usize>,
    rows: usize,
    resumed: usize,
    failed: usize,
    wall_s: f64,
    computing_s: f64,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let start = Instant::now();
    let existing = arguments.overwrite.existing();
    let spec = Spec::from_file(&arguments.sweep).map_err(Failure::input)?;
    check(&arguments.output, existing)?;
    if let Some(csv) = &arguments.csv {
        check(csv, existing)?;
    }
    let progress = Bar::new();
    progress.start("scenes", spec.rows() as u64);
    let part = part(&arguments.output);
    let done = run_sweep(&spec, &part, |rows| {
        progress.set(rows as u64);
        true
    })
    .map_err(|error| match error {
        SweepError::Scene(scene) => Failure::input(scene.in_file(&arguments.sweep)),
        journal @ SweepError::Journal(_) => Failure::input(journal),
    })?;
    progress.finish();
    let Some(done) = done else {
        return Err(Failure::work("the sweep was stopped"));
    };
    let computing_s = start.elapsed().as_secs_f64();
    write_sweep(&arguments.output, &spec, &done.blocks, existing)?;
    if let Some(csv) = &arguments.csv {
        write_csv(csv, &spec, &done.blocks, existing)?;
    }
    done.journal.remove();
    let failed: usize = done.blocks.iter().map(|b| b.failures.len()).sum();
    if let Some((row, reason)) = done.blocks.iter().find_map(|b| b.failures.first()) {
        eprintln!(
            "warning: {failed} of {} scenes failed, the first in row {row}: {reason}",
            spec.rows()
        );
    }
    let report = Report {
        output: &arguments.output,
        csv: arguments.csv.as_deref(),
        shape: spec.axes.iter().map(|axis| axis.len).collect(),
        rows: spec.rows(),
        resumed: done.resumed,
        failed,
        wall_s: start.elapsed().as_secs_f64(),
        computing_s,
    };
    if arguments.json {
        print(serde_json::to_string(&report).map_err(Failure::work)?)
    } else {
        print(report.text(&spec))
    }
}

impl Report<'_> {
    fn text(&self, spec: &Spec) -> String {
        let axes: Vec<String> = spec
            .axes
            .iter()
            .map(|axis| format!("{} ({})", axis.name, axis.len))
            .collect();
        format!(
            "axes           {}\nscenes         {}, {} failed, {} resumed\ntime           {:.2} s, {:.2} s of it computing\nwritten        {}",
            axes.join(" x "),
            self.rows,
            self.failed,
            self.resumed,
            self.wall_s,
            self.computing_s,
            self.output.display()
        )
    }
}

/// Where finished blocks are kept until all are there: beside the results, under their name and `.part`.
fn part(output: &Path) -> PathBuf {
    let mut name = output.as_os_str().to_owned();
    name.push(".part");
    PathBuf::from(name)
}
