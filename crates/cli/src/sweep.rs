//! `hertzlamb sweep`: many scenes.

use crate::failure::{Failure, print, say};
use crate::interrupt;
use crate::memory::MemoryLimit;
use crate::overwrite::Overwrite;
use crate::progress::Bar;
use clap::Args;
use formats::sweep::{
    Block, Done, JournalError, Spec, SweepError, is_computed, print_csv, run_sweep, stage_csv,
    stage_sweep,
};
use formats::{Existing, Output, QUANTITIES};
use output::{CSV, HDF5, Role, Staged, apart, behind, is_standard};
use serde::Serialize;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
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
    /// Also write the rows as text; - is standard output.
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
    #[command(flatten)]
    memory: MemoryLimit,
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
    /// Scenes in which a body yields, and in which one is expected to crack.
    yielding: usize,
    cracking: usize,
    wall_s: f64,
    computing_s: f64,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let start = Instant::now();
    let spec = Spec::from_file(&arguments.sweep).map_err(Failure::input)?;
    arguments
        .memory
        .check(spec.memory_bytes(), "the sweep", "ask for fewer rows")?;
    let outputs = Outputs::claim(arguments, &spec)?;
    let Some(done) = compute(arguments, &spec, &outputs)? else {
        return Err(Failure::work("the sweep was stopped"));
    };
    let computing_s = start.elapsed().as_secs_f64();
    outputs.write(&spec, &done.blocks)?;
    done.journal.remove();
    let failed: usize = done.blocks.iter().map(|b| b.failures.len()).sum();
    if let Some((row, reason)) = done.blocks.iter().find_map(|b| b.failures.first()) {
        say(format!(
            "warning: {failed} of {} scenes failed, the first in row {row} (rows count from 0): {reason}",
            spec.rows()
        ));
    }
    let report = Report {
        output: &arguments.output,
        csv: arguments.csv.as_deref(),
        shape: spec.axes.iter().map(|axis| axis.len).collect(),
        rows: spec.rows(),
        resumed: done.resumed,
        failed,
        yielding: beyond(&done.blocks, "yield_onset"),
        cracking: beyond(&done.blocks, "cone_crack_onset"),
        wall_s: start.elapsed().as_secs_f64(),
        computing_s,
    };
    if outputs.print {
        say(report.text(&spec));
        return print_rows(&spec, &done.blocks);
    }
    if arguments.json {
        print(serde_json::to_string(&report).map_err(Failure::work)?)
    } else {
        print(report.text(&spec))
    }
}

/// Scenes in which a ratio to what the bodies bear is above 1.
fn beyond(blocks: &[Block], name: &str) -> usize {
    let place = QUANTITIES.iter().position(|quantity| quantity.name == name);
    let rows = blocks.iter().flat_map(|block| &block.numbers);
    place.map_or(0, |k| rows.filter(|numbers| numbers[k] > 1.0).count())
}

/// Computes the rows; what is done is kept from moment to moment.
fn compute(arguments: &Arguments, spec: &Spec, outputs: &Outputs) -> Result<Option<Done>, Failure> {
    let kept = Arc::new(AtomicUsize::new(0));
    let (count, rows, place) = (Arc::clone(&kept), spec.rows(), outputs.part.clone());
    interrupt::say_then(move || {
        format!(
            "{} of {rows} scenes are kept in {}; the same command goes on with them",
            count.load(Ordering::Relaxed),
            place.display()
        )
    });
    let progress = Bar::new();
    progress.start("scenes", rows as u64);
    let existing = arguments.overwrite.existing();
    let done = run_sweep(spec, &outputs.part, existing, |rows| {
        kept.store(rows, Ordering::Relaxed);
        progress.set(rows as u64);
        true
    })
    .map_err(|error| match error {
        SweepError::Scene(scene) => Failure::input(scene.in_file(&arguments.sweep)),
        SweepError::Journal(JournalError::Output(output)) => output.into(),
        SweepError::Journal(other @ JournalError::Other { .. }) => Failure::input(format!(
            "{other}; give --force to drop it, or another output to keep it"
        )),
        SweepError::Journal(journal) => Failure::input(journal),
    })?;
    progress.finish();
    Ok(done)
}

/// Where a sweep goes, claimed before any work.
struct Outputs {
    results: Output,
    csv: Option<Output>,
    /// Whether the rows go to standard output.
    print: bool,
    /// Where finished blocks are kept until all are there: beside the results, under their name and `.part`.
    part: PathBuf,
}

impl Outputs {
    fn claim(arguments: &Arguments, spec: &Spec) -> Result<Self, Failure> {
        let print = arguments.csv.as_deref().is_some_and(is_standard);
        if print && arguments.json {
            return Err(Failure::input(
                "--csv - and --json both go to standard output: give the rows a file",
            ));
        }
        let csv = arguments.csv.as_deref().filter(|_| !print);
        HDF5.check(&arguments.output)?;
        let mut part = behind(&arguments.output)?.into_os_string();
        part.push(".part");
        let part = PathBuf::from(part);
        let mut outputs = vec![arguments.output.as_path(), &part];
        if let Some(csv) = csv {
            CSV.check(csv)?;
            outputs.push(csv);
        }
        let mut inputs = vec![Role::new("the sweep", &arguments.sweep)];
        inputs.extend(spec.inputs().iter().cloned());
        apart(&outputs, &inputs)?;
        let claim = |path: &Path| Output::claim(path, Existing::KeepUnlessSame);
        let (results, csv) = (claim(&arguments.output)?, csv.map(claim).transpose()?);
        // a run that was killed while it gave its outputs their names has left some of them
        let wanted = arguments.overwrite.existing();
        let finish = wanted == Existing::Keep && is_computed(spec, &part);
        let existing = if finish {
            Existing::KeepUnlessSame
        } else {
            wanted
        };
        Ok(Self {
            results: results.over(existing)?,
            csv: csv.map(|csv| csv.over(existing)).transpose()?,
            print,
            part,
        })
    }

    /// Writes all outputs, then gives them their names.
    fn write(&self, spec: &Spec, blocks: &[Block]) -> Result<(), Failure> {
        let results = stage_sweep(&self.results, spec, blocks)?;
        let csv = self.csv.as_ref();
        let csv = csv.map(|csv| stage_csv(csv, spec, blocks)).transpose()?;
        results.commit()?;
        csv.map_or(Ok(()), Staged::commit)?;
        Ok(())
    }
}

/// Writes the rows to standard output; a closed pipe ends the program quietly.
fn print_rows(spec: &Spec, blocks: &[Block]) -> Result<(), Failure> {
    let mut out = BufWriter::new(std::io::stdout().lock());
    match print_csv(&mut out, spec, blocks).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::unprintable(error))
        }
        Ok(()) | Err(_) => Ok(()),
    }
}

impl Report<'_> {
    fn text(&self, spec: &Spec) -> String {
        let axes: Vec<String> = spec
            .axes
            .iter()
            .map(|axis| format!("{} ({})", axis.name, axis.len))
            .collect();
        let beyond = match (self.yielding, self.cracking) {
            (0, 0) => String::new(),
            (yielding, cracking) => format!(
                "\nnot elastic    {yielding} yield (yield_onset above 1), {cracking} may crack (cone_crack_onset above 1)"
            ),
        };
        format!(
            "axes           {}\nscenes         {}, {} failed, {} resumed{beyond}\ntime           {:.2} s, {:.2} s of it computing\nwritten        {}",
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
