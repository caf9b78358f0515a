//! `hertzlamb sweep`: many scenes.

use crate::failure::{Failure, print};
use clap::Args;
use impact::output::{Existing, check};
use impact::sweep::{Spec, SweepError, run as run_sweep, write, write_csv};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;
use std::io::IsTerminal;
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
    /// Replace existing files.
    #[arg(long)]
    force: bool,
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
    let existing = if arguments.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    let named = |error: &dyn std::fmt::Display| {
        Failure::input(format!("{}: {error}", arguments.sweep.display()))
    };
    let spec = Spec::from_file(&arguments.sweep).map_err(|error| match error {
        unreadable @ impact::SceneError::Unreadable { .. } => Failure::input(unreadable),
        other => named(&other),
    })?;
    check(&arguments.output, existing)?;
    if let Some(csv) = &arguments.csv {
        check(csv, existing)?;
    }
    let mut progress = Progress::new(spec.rows());
    let part = part(&arguments.output);
    let done = run_sweep(&spec, &part, |rows| {
        progress.show(rows);
        true
    })
    .map_err(|error| match error {
        SweepError::Scene(scene) => named(&scene),
        journal @ SweepError::Journal(_) => Failure::input(journal),
    })?;
    progress.finish();
    let Some(done) = done else {
        return Err(Failure::work("the sweep was stopped"));
    };
    let computing_s = start.elapsed().as_secs_f64();
    write(&arguments.output, &spec, &done.blocks, existing)?;
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

/// A bar on a terminal, else a line for each tenth.
struct Progress {
    bar: Option<ProgressBar>,
    rows: usize,
    tenths: usize,
}

impl Progress {
    fn new(rows: usize) -> Self {
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar =
                ProgressBar::with_draw_target(Some(rows as u64), ProgressDrawTarget::stderr());
            if let Ok(style) = ProgressStyle::with_template(
                "{bar:40} {human_pos}/{human_len} scenes, {per_sec}, {eta} left",
            ) {
                bar.set_style(style);
            }
            bar
        });
        Self {
            bar,
            rows,
            tenths: 0,
        }
    }

    fn show(&mut self, done: usize) {
        match &self.bar {
            Some(bar) => bar.set_position(done as u64),
            None => {
                let tenths = 10 * done / self.rows.max(1);
                if tenths > self.tenths && tenths < 10 {
                    eprintln!("{done} of {} scenes", self.rows);
                }
                self.tenths = tenths;
            }
        }
    }

    fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
