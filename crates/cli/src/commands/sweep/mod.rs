//! `hertzlamb sweep`: many scenes.

mod parts;
mod plan;

use crate::arguments::{Kernels, MemoryLimit, Overwrite, check_rows, say_complete};
use crate::failure::{Failure, check_stdout, lines, say, show};
use crate::process;
use crate::progress::Bar;
use clap::Args;
use fault::Fault as _;
use formats::parts::check_complete;
use formats::sweep::schema::COUNTED;
use formats::sweep::{
    Blocks, JournalError, Kept, Precision, Selection, Shard, Spec, SweepError, is_computed,
    print_csv, row_bytes, run_rows, stage_csv, stage_rows,
};
use formats::{Existing, Output, OutputError, QUANTITIES};
use output::{CSV, Fault, Staged, apart, behind, free_disk, is_standard};
use parts::Action;
use serde_json::{Value, json};
use std::io::{BufWriter, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use tabulator::Progress;

const EXAMPLES: &str = "Examples:
  hertzlamb sweep scenes/sweep.toml -o sweep.h5 --csv sweep.csv
  hertzlamb sweep scenes/sweep.toml --plan --json
  hertzlamb sweep scenes/sweep.toml --shard 2/4 --skip-complete -o out/2.h5
  hertzlamb sweep scenes/sweep-probes.toml --table kernels.h5 -o probed.h5
  hertzlamb sweep status out --missing
  hertzlamb sweep merge out -o sweep.h5
  hertzlamb sweep scenes/sweep.toml -o sweep.parquet

An interrupted sweep goes on where it stopped when the same command is given again.
Recipes for Slurm, Snakemake and dask are in docs/cluster.md.";

#[derive(Debug, Args)]
#[command(
    after_help = EXAMPLES,
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    action: Option<Action>,
    #[command(flatten)]
    run: Run,
}

#[derive(Debug, Args)]
pub(crate) struct Run {
    /// Sweep file (TOML, see data-schema/sweep.md).
    #[arg(required = true)]
    sweep: Option<PathBuf>,
    /// Results file: HDF5, or Parquet where the name ends with .parquet (see data-schema/sweep.md).
    #[arg(short, long, value_name = "OUT", required_unless_present = "plan")]
    output: Option<PathBuf>,
    /// Also write the rows as text; - is standard output.
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    kernels: Kernels,
    /// Compute part I of N into the output, which is then a part for `hertzlamb sweep merge`.
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Compute the rows from A up to B, which is not among them, into the output, which is then a part.
    #[arg(long, value_name = "A:B", conflicts_with = "shard", value_parser = range)]
    rows: Option<Range<usize>>,
    /// Results to write, comma-separated, such as peak_force_n,restitution; all otherwise. Model and failure always are.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    columns: Option<Vec<String>>,
    /// Write results with 32 bits instead of 64, rounded by up to 6e-8 of themselves.
    #[arg(long)]
    float32: bool,
    /// Succeed at once where the output is whole and of the same sweep, rows and version; fail with 1 where it is not.
    #[arg(long, conflicts_with = "force")]
    skip_complete: bool,
    /// Compute a few rows and say what the sweep takes, in shards; nothing is written.
    #[arg(long, conflicts_with_all = ["output", "csv", "shard", "rows", "skip_complete", "force"])]
    plan: bool,
    /// Shards of the plan; as many as take five minutes each otherwise.
    #[arg(long, value_name = "N", requires = "plan", value_parser = clap::value_parser!(u32).range(1..))]
    shards: Option<u32>,
    #[command(flatten)]
    overwrite: Overwrite,
    #[command(flatten)]
    memory: MemoryLimit,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

/// A:B.
fn range(text: &str) -> Result<Range<usize>, String> {
    let ends = text.split_once(':');
    let ends = ends.and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
    let (start, end) = ends.ok_or("give A:B with whole numbers, as in 0:32768")?;
    if start > end {
        return Err(format!("{start} is after {end}"));
    }
    Ok(start..end)
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let run = &arguments.run;
    match (&arguments.action, &run.sweep, &run.output) {
        (Some(action), _, _) => parts::run(action),
        (None, Some(sweep), _) if run.plan => {
            plan::run(sweep, &spec(run, sweep)?, run.shards, run.json)
        }
        (None, Some(sweep), Some(output)) => compute(run, sweep, output),
        (None, _, _) => Err(Failure::input("give a sweep file and -o OUT")),
    }
}

fn compute(arguments: &Run, sweep: &Path, output: &Path) -> Result<(), Failure> {
    let start = Instant::now();
    let spec = spec(arguments, sweep)?;
    let change = "ask for fewer values";
    arguments
        .memory
        .check(spec.memory_bytes(), "the sweep", change)?;
    let selection = selection(arguments, &spec)?;
    let Some(outputs) = Outputs::claim(arguments, sweep, output, &spec, selection)? else {
        return say_complete(output, arguments.json);
    };
    let kept = rows(arguments.overwrite, &spec, &outputs).map_err(|error| match error {
        SweepError::Scene(scene) => scene.in_file(sweep).into(),
        other => failure(other),
    })?;
    let Some(kept) = kept else {
        return Err(Failure::work("the sweep was stopped"));
    };
    let computing_s = start.elapsed().as_secs_f64();
    let tally =
        Tally::of(&spec, &kept).map_err(|fault| OutputError::writing(&outputs.part, fault))?;
    if let Some((row, reason)) = &tally.first {
        say(format!(
            "warning: {} of {} scenes failed, the first in row {row} (rows count from 0): {reason}",
            tally.failed, tally.rows
        ));
    }
    outputs.write(&spec, &kept)?;
    let wall_s = start.elapsed().as_secs_f64();
    let (value, text) = report(
        arguments,
        &spec,
        &outputs,
        &tally,
        [wall_s, computing_s],
        kept.resumed,
    );
    let done = if outputs.print {
        say(text);
        print_rows(&spec, &kept)
    } else {
        show(arguments.json, &value, text)
    };
    kept.remove();
    done
}

/// What was done, in how many s and s of computing, with how many rows of an earlier run.
fn report(
    arguments: &Run,
    spec: &Spec,
    outputs: &Outputs,
    tally: &Tally,
    [wall_s, computing_s]: [f64; 2],
    resumed: usize,
) -> (Value, String) {
    let [yielding, cracking] = tally.beyond;
    let (rows, failed) = (tally.rows, tally.failed);
    let output = outputs.results.path.display().to_string();
    let part = outputs.selection.as_ref();
    let shard = part.and_then(|part| Some(part.shard?.to_string()));
    let lengths = spec.axes.iter().map(|axis| axis.len).collect();
    let mut value = json!({
        "output": output,
        "csv": arguments.csv.as_ref().map(|path| path.display().to_string()),
        "shape": part.map_or(lengths, |part| vec![part.rows.len()]),
        "rows": rows,
        "sweep_rows": spec.rows(),
        "sweep_sha256": spec.sha256,
        "resumed": resumed,
        "failed": failed,
        "yielding": yielding,
        "cracking": cracking,
        "wall_s": wall_s,
        "computing_s": computing_s,
    });
    let axes = spec.axes.iter();
    let axes: Vec<String> = axes
        .map(|axis| format!("{} ({})", axis.name, axis.len))
        .collect();
    let mut text = vec![("axes", axes.join(" x "))];
    if let Some(part) = part {
        let first = part.rows.start;
        value["first_row"] = first.into();
        let mut of = String::new();
        if let Some(shard) = shard {
            of = format!("shard {shard}: ");
            value["shard"] = shard.into();
        }
        let rows = format!("{of}rows {first}:{} of {}", first + rows, spec.rows());
        text.push(("part", rows));
    }
    text.push((
        "scenes",
        format!("{rows}, {failed} failed, {resumed} resumed"),
    ));
    if yielding + cracking > 0 {
        text.push(("not elastic", format!(
            "{yielding} yield (yield_onset above 1), {cracking} may crack (cone_crack_onset above 1)"
        )));
    }
    if let Some(count) = tally.looked_up {
        value["looked_up"] = count.into();
        let fields = format!("{count} of {rows} scenes looked up, the others computed");
        text.push(("fields", fields));
    }
    text.push((
        "time",
        format!("{wall_s:.2} s, {computing_s:.2} s of it computing"),
    ));
    text.push(("written", output));
    (value, lines(text))
}

/// The sweep, and what of its results is written.
fn spec(arguments: &Run, sweep: &Path) -> Result<Spec, Failure> {
    let spec = Spec::from_file(sweep).map_err(|error| {
        let hint = match error.culprit().key.as_deref() {
            Some("scene") => "; one scene is computed by `hertzlamb impact`",
            _ => "",
        };
        Failure::from(error).hint(hint)
    })?;
    let mut spec = arguments.kernels.with_fields(spec)?;
    if let Some(names) = &arguments.columns {
        spec.fields = spec.fields.only(names)?;
    }
    if arguments.float32 {
        spec.fields.precision = Precision::Single;
    }
    Ok(spec)
}

/// The rows that are asked for; nothing where they are the whole sweep in its own shape.
fn selection(arguments: &Run, spec: &Spec) -> Result<Option<Selection>, Failure> {
    if let Some(shard) = arguments.shard {
        return Ok(Some(Selection::of_shard(shard, spec.rows(), &spec.fields)));
    }
    let rows = arguments.rows.clone();
    let rows = rows.map(|rows| Selection::of_rows(rows, spec.rows()));
    Ok(rows.transpose()?)
}

/// Computes the rows; what is done is kept from moment to moment.
fn rows(overwrite: Overwrite, spec: &Spec, outputs: &Outputs) -> Result<Option<Kept>, SweepError> {
    let kept = Arc::new(AtomicUsize::new(0));
    let range = outputs.rows.clone();
    let (count, rows, place) = (Arc::clone(&kept), range.len(), outputs.part.clone());
    process::say_then(move || {
        format!(
            "{} of {rows} scenes are kept in {}; the same command goes on with them",
            count.load(Ordering::Relaxed),
            place.display()
        )
    });
    let progress = Bar::new();
    progress.total("scenes", rows as u64);
    let existing = overwrite.existing();
    run_rows(spec, range, &outputs.part, existing, |rows| {
        kept.store(rows, Ordering::Relaxed);
        progress.set(rows as u64);
        true
    })
}

/// A sweep that could not be run or joined, with what to do.
fn failure(error: SweepError) -> Failure {
    let hint = match error {
        SweepError::Journal(JournalError::Other(..)) => {
            "; give --force to drop it, or another output to keep it"
        }
        SweepError::Missing { .. } => "; hertzlamb sweep status lists them",
        _ => "",
    };
    Failure::from(error).hint(hint)
}

/// Where a sweep goes, claimed before any work.
struct Outputs {
    results: Output,
    csv: Option<Output>,
    /// The rows, where they are not the whole sweep in its own shape.
    selection: Option<Selection>,
    rows: Range<usize>,
    /// Whether the rows go to standard output.
    print: bool,
    /// Where finished blocks are kept until all are there: beside the results, under their name and `.part`.
    part: PathBuf,
}

impl Outputs {
    /// Claims all outputs; nothing where they are there already and that is enough.
    fn claim(
        arguments: &Run,
        sweep: &Path,
        output: &Path,
        spec: &Spec,
        selection: Option<Selection>,
    ) -> Result<Option<Self>, Failure> {
        let print = arguments.csv.as_deref().is_some_and(is_standard);
        if print && arguments.json {
            return Err(Failure::input(
                "--csv - and --json both go to standard output: give the rows a file",
            ));
        }
        if print {
            check_stdout()?;
        }
        let csv = arguments.csv.as_deref().filter(|_| !print);
        check_rows(output)?;
        let mut part = behind(output)?.into_os_string();
        part.push(".part");
        let part = PathBuf::from(part);
        let mut outputs = vec![output, &part];
        if let Some(csv) = csv {
            CSV.check(csv)?;
            outputs.push(csv);
        }
        let mut inputs = vec![("the sweep", sweep.to_owned())];
        inputs.extend(spec.inputs().iter().cloned());
        inputs.extend(arguments.kernels.inputs());
        apart(&outputs, &inputs)?;
        let claim = |path: &Path| Output::claim(path, Existing::KeepUnlessSame);
        let (results, csv) = (claim(output)?, csv.map(claim).transpose()?);
        // a run that was killed while it gave its outputs their names has left some of them
        let wanted = arguments.overwrite.existing();
        let some = selection.as_ref().map(|some| some.rows.clone());
        let rows = some.unwrap_or(0..spec.rows());
        let finish = wanted == Existing::Keep && is_computed(spec, rows.clone(), &part);
        if arguments.skip_complete && !finish && results.real.exists() {
            check_complete(output, spec, selection.as_ref()).map_err(Failure::work)?;
            return match csv.filter(|csv| !csv.real.exists()) {
                None if !print => Ok(None),
                None => Err(Failure::work("--skip-complete has no rows for --csv -")),
                Some(csv) => Err(Failure::work(format!(
                    "{} is complete, but {} is not there; give --force to compute both",
                    output.display(),
                    csv.path.display()
                ))),
            };
        }
        let existing = if finish {
            Existing::KeepUnlessSame
        } else {
            check_disk(spec, rows.len(), &part)?;
            wanted
        };
        Ok(Some(Self {
            results: results.over(existing)?,
            csv: csv.map(|csv| csv.over(existing)).transpose()?,
            selection,
            rows,
            print,
            part,
        }))
    }

    /// Writes all outputs, then gives them their names.
    fn write(&self, spec: &Spec, blocks: &impl Blocks) -> Result<(), Failure> {
        let results = stage_rows(&self.results, spec, self.selection.as_ref(), blocks)?;
        let csv = self.csv.as_ref();
        let csv = csv.map(|csv| stage_csv(csv, spec, blocks)).transpose()?;
        results.commit()?;
        csv.map_or(Ok(()), Staged::commit)?;
        Ok(())
    }
}

/// Refuses rows that the disk does not hold, in the file and, while it is written, in the journal.
fn check_disk(spec: &Spec, rows: usize, part: &Path) -> Result<(), Failure> {
    let (bytes, kept) = row_bytes(spec);
    let there = std::fs::metadata(part).map_or(0.0, |journal| journal.len() as f64);
    let needed = rows as f64 * (bytes + kept) as f64 - there;
    match free_disk(part) {
        Some(free) if needed > free => Err(Failure::until_later(format!(
            "no space left: {rows} rows need about {:.3} GB of disk while they are written, more than the {:.3} GB free beside {}: ask for fewer, or for a shard of them elsewhere",
            1e-9 * needed,
            1e-9 * free,
            part.display()
        ))),
        Some(_) | None => Ok(()),
    }
}

/// Writes the rows to standard output; a closed pipe ends the program quietly.
fn print_rows(spec: &Spec, blocks: &impl Blocks) -> Result<(), Failure> {
    let mut out = BufWriter::new(std::io::stdout().lock());
    match print_csv(&mut out, spec, blocks).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::unprintable(error))
        }
        Ok(()) | Err(_) => Ok(()),
    }
}

/// What is counted over all rows.
#[derive(Debug, Default)]
struct Tally {
    rows: usize,
    failed: usize,
    first: Option<(usize, String)>,
    /// Scenes in which a ratio to what the bodies bear is above 1: those that yield, and those that may crack.
    beyond: [usize; 2],
    /// Rows whose fields were looked up, of a sweep with probes.
    looked_up: Option<usize>,
}

impl Tally {
    fn of(spec: &Spec, rows: &impl Blocks) -> Result<Self, Fault> {
        let mut tally = Self {
            looked_up: spec.has_probes().then_some(0),
            ..Self::default()
        };
        rows.each(&mut |block| {
            tally.rows += block.len();
            tally.failed += block.failures.len();
            let first = || block.failures.first().cloned();
            tally.first = tally.first.take().or_else(first);
            for (count, name) in tally.beyond.iter_mut().zip(COUNTED) {
                let place = QUANTITIES.iter().position(|quantity| quantity.name == name);
                *count += place.map_or(0, |k| block.rows().filter(|row| row[k] > 1.0).count());
            }
            if let Some(count) = &mut tally.looked_up {
                *count += block.looked_up();
            }
            Ok(())
        })?;
        Ok(tally)
    }
}
