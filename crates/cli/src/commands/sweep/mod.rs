//! `hertzlamb sweep`: many scenes.

mod merge;
mod plan;
mod status;

use crate::arguments::{KernelOptions, MemoryLimit, Overwrite, check_rows, say_complete};
use crate::failure::{Failure, check_stdout, lines, say, show};
use crate::process;
use crate::progress::Bar;
use clap::{Args, Subcommand};
use fault::Fault as _;
use formats::parts::check_complete;
use formats::schema::sweep::COUNTED;
use formats::sweep::{
    Block, Blocks, Computed, Kept, Precision, Shard, Spec, SweepAxis, SweepError, fields_bytes,
    is_computed, print_csv, row_bytes, run_rows, stage_csv, stage_rows,
};
use formats::{Existing, Output, OutputError, QUANTITIES};
use output::{CSV, OutputFault, Staged, apart, behind, free_disk, is_standard};
use serde::Serialize;
use std::cell::RefCell;
use std::fmt::{self, Display, Formatter};
use std::io::{BufWriter, ErrorKind, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
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

To resume an interrupted sweep, run the same command again.
Recipes for Slurm, Snakemake and dask are in docs/cluster.md.";

#[derive(Debug, Args)]
#[command(
    after_help = EXAMPLES,
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    action: Option<SweepAction>,
    #[command(flatten)]
    run: RunArguments,
}

#[derive(Debug, Subcommand)]
pub(crate) enum SweepAction {
    /// Lists present, missing and unrelated parts in a folder.
    Status(status::Arguments),
    /// Joins the parts of a sweep; the result is byte for byte the file that one run would have written.
    Merge(merge::Arguments),
}

#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    /// Sweep file (TOML, see data-schema/sweep.md); - is standard input.
    #[arg(required = true)]
    sweep: Option<PathBuf>,
    /// Results file: Parquet if the name ends with .parquet, HDF5 otherwise (see data-schema/sweep.md).
    #[arg(short, long, value_name = "OUT", required_unless_present_any = ["plan", "csv"])]
    output: Option<PathBuf>,
    /// Also write the rows as text. With - for standard output, -o OUT is not required.
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    kernels: KernelOptions,
    /// Compute part I of N into the output, a part for `hertzlamb sweep merge`.
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Compute the rows A to B-1 into the output, a part for `hertzlamb sweep merge`.
    #[arg(long, value_name = "A:B", conflicts_with = "shard", value_parser = range)]
    rows: Option<Range<usize>>,
    /// Results to write, comma-separated, such as peak_force_n,restitution. Default: all. Model and failure are always
    /// written.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    columns: Option<Vec<String>>,
    /// Write results with 32 bits instead of 64, which rounds them by a relative 6e-8 at most.
    #[arg(long)]
    float32: bool,
    /// If the output exists: succeed at once if it is complete and of the same sweep, rows and version, fail with exit
    /// code 1 otherwise.
    #[arg(long, conflicts_with = "force", requires = "output")]
    skip_complete: bool,
    /// Exit with code 1 if any scene failed. Default: only if all scenes failed. The outputs are written in both cases.
    #[arg(long)]
    fail_if_failed: bool,
    /// Compute a few rows and print the time, memory and disk space that the sweep needs, in total and per shard; write
    /// nothing.
    #[arg(long, conflicts_with_all = ["output", "csv", "shard", "rows", "skip_complete", "force"])]
    plan: bool,
    /// Number of shards in the plan. Default: such that each takes five minutes.
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

/// Parses A:B.
fn range(text: &str) -> Result<Range<usize>, String> {
    let ends = text.split_once(':');
    let ends = ends.and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
    let (start, end) = ends.ok_or("use A:B with whole numbers, as in 0:32768")?;
    if start > end {
        return Err(format!("{start} is after {end}"));
    }
    Ok(start..end)
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let run = &arguments.run;
    match (&arguments.action, &run.sweep, &run.output) {
        (Some(SweepAction::Status(arguments)), _, _) => status::run(arguments),
        (Some(SweepAction::Merge(arguments)), _, _) => merge::run(arguments),
        (None, Some(sweep), _) if run.plan => plan::run(run, sweep, &spec(run, sweep)?),
        (None, Some(sweep), Some(output)) => compute(run, sweep, output),
        (None, Some(sweep), None) if run.csv.as_deref().is_some_and(is_standard) => {
            stream(run, sweep)
        }
        (None, _, _) => Err(Failure::input(
            "pass a sweep file and -o OUT; only --csv - works without OUT",
        )),
    }
}

/// The sweep with the selected rows, if it fits into memory.
fn selected(arguments: &RunArguments, sweep: &Path) -> Result<Spec, Failure> {
    let mut spec = spec(arguments, sweep)?;
    let (memory, needed) = (arguments.memory, spec.memory_bytes());
    memory.check(needed, "the sweep", "use fewer values")?;
    match (arguments.shard, &arguments.rows) {
        (Some(shard), _) => spec.select_shard(shard),
        (None, Some(rows)) => spec.select_rows(rows.clone())?,
        (None, None) => {}
    }
    let fields = fields_bytes(&spec).map_err(|error| error.in_file(sweep))?;
    let change = "use fewer probes, a larger step_s, a smaller duration_s or fewer threads";
    memory.check(needed + fields, "the sweep with its fields", change)?;
    Ok(spec)
}

/// Writes rows to standard output as they are computed and keeps none.
fn stream(arguments: &RunArguments, sweep: &Path) -> Result<(), Failure> {
    if arguments.json {
        return Err(Failure::input(STREAMED));
    }
    check_stdout()?;
    let spec = selected(arguments, sweep)?;
    let computed = Computed::new(&spec).map_err(|error| error.in_file(sweep))?;
    let progress = Bar::new();
    progress.total("scenes", spec.selected().len() as u64);
    let rows = Watched {
        computed,
        tally: RefCell::default(),
        progress,
    };
    print_rows(&spec, &rows)?;
    let tally = rows.tally.into_inner();
    tally.verdict(arguments, spec.selected().len())
}

const STREAMED: &str =
    "--csv - and --json both write to standard output: use --csv OUT.csv for the rows";

/// Rows that are counted while they are computed.
struct Watched<'a> {
    computed: Computed<'a>,
    tally: RefCell<Tally>,
    progress: Bar,
}

impl Blocks for Watched<'_> {
    fn each(
        &self,
        visit: &mut dyn FnMut(&Block) -> Result<(), OutputFault>,
    ) -> Result<(), OutputFault> {
        self.computed.each(&mut |block| {
            self.tally.borrow_mut().add(block);
            self.progress.advance(block.len() as u64);
            visit(block)
        })
    }
}

fn compute(arguments: &RunArguments, sweep: &Path, output: &Path) -> Result<(), Failure> {
    let start = Instant::now();
    let spec = selected(arguments, sweep)?;
    let Some(outputs) = Outputs::claim(arguments, sweep, output, &spec)? else {
        return say_complete(output, arguments.json);
    };
    let kept = rows(arguments.overwrite, &spec, &outputs).map_err(|error| match error {
        SweepError::Scene(scene) => scene.in_file(sweep).into(),
        other => failure(other),
    })?;
    let kept = kept.ok_or_else(|| Failure::work("the sweep was stopped"))?;
    let computing_s = start.elapsed().as_secs_f64();
    let tally = Tally::of(&kept).map_err(|fault| OutputError::writing(&outputs.part, fault))?;
    outputs.write(&spec, &kept)?;
    let took_s = [start.elapsed().as_secs_f64(), computing_s];
    let report = SweepReport::new(arguments, &spec, &outputs, &tally, took_s, kept.resumed);
    // if the rows or the report cannot be printed, the same command resumes from the kept rows
    if outputs.print {
        report.to_string().lines().for_each(say);
        print_rows(&spec, &kept)?;
    } else {
        show(arguments.json, &report)?;
    }
    kept.remove();
    tally.verdict(arguments, spec.selected().len())
}

/// Report of computed and written rows.
#[derive(Serialize)]
struct SweepReport {
    output: String,
    csv: Option<String>,
    shape: Vec<usize>,
    rows: usize,
    sweep_rows: usize,
    sweep_sha256: String,
    /// Rows that an earlier run had computed.
    resumed: usize,
    failed: usize,
    yielding: usize,
    cracking: usize,
    untrusted: usize,
    wall_s: f64,
    computing_s: f64,
    /// First row, if the rows are a part of the sweep.
    #[serde(skip_serializing_if = "Option::is_none")]
    first_row: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    shard: Option<String>,
    /// Rows whose fields were looked up, for a sweep with probes.
    #[serde(skip_serializing_if = "Option::is_none")]
    looked_up: Option<usize>,
    /// Name and length of each axis.
    #[serde(skip)]
    axes: Vec<String>,
}

impl SweepReport {
    fn new(
        arguments: &RunArguments,
        spec: &Spec,
        outputs: &Outputs,
        tally: &Tally,
        [wall_s, computing_s]: [f64; 2],
        resumed: usize,
    ) -> Self {
        let [yielding, cracking, untrusted] = tally.beyond;
        let axis = |axis: &SweepAxis| format!("{} ({})", axis.name, axis.len);
        let part = spec.selection.as_ref();
        Self {
            output: outputs.results.path.display().to_string(),
            csv: arguments
                .csv
                .as_ref()
                .map(|path| path.display().to_string()),
            shape: spec.shape(),
            rows: spec.selected().len(),
            sweep_rows: spec.rows(),
            sweep_sha256: spec.sha256.clone(),
            resumed,
            failed: tally.failed,
            yielding,
            cracking,
            untrusted,
            wall_s,
            computing_s,
            first_row: part.map(|part| part.rows.start),
            shard: part.and_then(|part| Some(part.shard?.to_string())),
            looked_up: spec.has_probes().then_some(tally.looked_up),
            axes: spec.axes.iter().map(axis).collect(),
        }
    }
}

impl Display for SweepReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let rows = self.rows;
        let mut text = vec![("axes", self.axes.join(" x "))];
        if let Some(start) = self.first_row {
            let of = self.shard.as_ref();
            let of = of.map_or_else(String::new, |shard| format!("shard {shard}: "));
            let (end, all) = (start + rows, self.sweep_rows);
            text.push(("part", format!("{of}rows {start}:{end} of {all}")));
        }
        let scenes = format!("{rows}, {} failed, {} resumed", self.failed, self.resumed);
        text.push(("scenes", scenes));
        if self.yielding + self.cracking > 0 {
            let beyond = format!(
                "{} yield (yield_onset above 1), {} may crack (cone_crack_onset above 1)",
                self.yielding, self.cracking
            );
            text.push(("not elastic", beyond));
        }
        if self.untrusted > 0 {
            let faster = format!(
                "{} are too fast for plasticity = \"jackson_green\" (velocity_over_trusted above 1): use \"thornton\" or \"recovery\" there",
                self.untrusted
            );
            text.push(("untrusted", faster));
        }
        if let Some(count) = self.looked_up {
            let fields = format!("{count} of {rows} scenes looked up, the others computed");
            text.push(("fields", fields));
        }
        let time = format!(
            "{:.2} s, {:.2} s of it computing",
            self.wall_s, self.computing_s
        );
        text.extend([("time", time), ("written", self.output.clone())]);
        f.write_str(&lines(text))
    }
}

/// The sweep with its kernels and the selected results.
fn spec(arguments: &RunArguments, sweep: &Path) -> Result<Spec, Failure> {
    let read = match is_standard(sweep) {
        true => Spec::from_standard_input(),
        false => Spec::from_file(sweep),
    };
    let spec = read.map_err(|error| {
        let is_scene = error.culprit().key.as_deref() == Some("scene");
        Failure::from(error).hint_if(is_scene, "; for one scene use `hertzlamb impact`")
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

/// Computes the rows and keeps finished blocks in the journal.
fn rows(overwrite: Overwrite, spec: &Spec, outputs: &Outputs) -> Result<Option<Kept>, SweepError> {
    static KEPT: AtomicUsize = AtomicUsize::new(0);
    let (rows, place) = (spec.selected().len(), outputs.part.clone());
    process::say_then(move || {
        let (kept, place) = (KEPT.load(Ordering::Relaxed), place.display());
        format!("{kept} of {rows} scenes are kept in {place}; run the same command again to resume")
    });
    let progress = Bar::new();
    progress.total("scenes", rows as u64);
    run_rows(spec, &outputs.part, overwrite.existing(), |rows| {
        KEPT.store(rows, Ordering::Relaxed);
        progress.set(rows as u64);
        true
    })
}

/// Failure to run or join a sweep, with a hint.
fn failure(error: SweepError) -> Failure {
    let other = matches!(error, SweepError::Output(OutputError::Begun(..)));
    let missing = matches!(error, SweepError::Missing(..));
    let drop = "; pass --force to drop it, or choose another output to keep it";
    Failure::from(error)
        .hint_if(other, drop)
        .hint_if(missing, "; `hertzlamb sweep status` lists them")
}

/// Outputs of a sweep, claimed before any work.
struct Outputs {
    results: Output,
    csv: Option<Output>,
    /// Whether the rows go to standard output.
    print: bool,
    /// Journal of finished blocks until all are computed: the name of the results with `.part` appended.
    part: PathBuf,
}

impl Outputs {
    /// Claims all outputs; returns none if they exist already and `--skip-complete` accepts them.
    fn claim(
        arguments: &RunArguments,
        sweep: &Path,
        output: &Path,
        spec: &Spec,
    ) -> Result<Option<Self>, Failure> {
        let print = arguments.csv.as_deref().is_some_and(is_standard);
        if print && arguments.json {
            return Err(Failure::input(STREAMED));
        }
        if print {
            check_stdout()?;
        }
        let csv = arguments.csv.as_deref().filter(|_| !print);
        check_rows(output)?;
        let mut part = behind(output)?.into_os_string();
        part.push(".part");
        let part = PathBuf::from(part);
        csv.map_or(Ok(()), |csv| CSV.check(csv))?;
        let outputs: Vec<&Path> = [output, &part].into_iter().chain(csv).collect();
        let mut inputs = Vec::new();
        if !is_standard(sweep) {
            inputs.push(("the sweep", sweep.to_owned()));
        }
        inputs.extend_from_slice(&spec.inputs);
        inputs.extend(arguments.kernels.input());
        apart(&outputs, &inputs)?;
        let claim = |path: &Path| Output::claim(path, Existing::KeepUnlessSame);
        let (results, csv) = (claim(output)?, csv.map(claim).transpose()?);
        // a run that was killed while it renamed its outputs has left some of them
        let wanted = arguments.overwrite.existing();
        let finish = wanted == Existing::Keep && is_computed(spec, &part);
        if arguments.skip_complete && !finish && results.real.exists() {
            check_complete(output, spec).map_err(Failure::work)?;
            return match csv.filter(|csv| !csv.real.exists()) {
                None if !print => Ok(None),
                None => Err(Failure::work(
                    "--csv - cannot print rows that --skip-complete does not compute: leave one of them out",
                )),
                Some(csv) => Err(Failure::work(format!(
                    "{} is complete, but {} does not exist; pass --force to compute both",
                    output.display(),
                    csv.path.display()
                ))),
            };
        }
        let existing = if finish {
            Existing::KeepUnlessSame
        } else {
            check_disk(spec, &part)?;
            wanted
        };
        Ok(Some(Self {
            results: results.over(existing)?,
            csv: csv.map(|csv| csv.over(existing)).transpose()?,
            print,
            part,
        }))
    }

    /// Writes all outputs, then renames them to their final names.
    fn write(&self, spec: &Spec, blocks: &impl Blocks) -> Result<(), Failure> {
        let results = stage_rows(&self.results, spec, blocks)?;
        let csv = self.csv.as_ref();
        let csv = csv.map(|csv| stage_csv(csv, spec, blocks)).transpose()?;
        results.commit()?;
        Ok(csv.map_or(Ok(()), Staged::commit)?)
    }
}

/// Rejects rows that exceed the free disk space, counted for the file and, while it is written, the journal.
fn check_disk(spec: &Spec, part: &Path) -> Result<(), Failure> {
    let (rows, (bytes, kept)) = (spec.selected().len(), row_bytes(spec));
    let there = std::fs::metadata(part).map_or(0.0, |journal| journal.len() as f64);
    let needed = rows as f64 * (bytes + kept) as f64 - there;
    match free_disk(part) {
        Some(free) if needed > free => Err(Failure::until_later(format!(
            "no space left: {rows} rows need about {:.3} GB of disk while they are written, more than the {:.3} GB free in the folder of {}: compute fewer rows, or write shards to another disk",
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
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::unprintable(error)),
        Ok(()) | Err(_) => Ok(()),
    }
}

/// Counts over all rows.
#[derive(Debug, Default)]
struct Tally {
    failed: usize,
    first: Option<(usize, String)>,
    /// Scenes with one of [`COUNTED`] above 1: those that yield, that may crack, and that are too fast for their
    /// plasticity law.
    beyond: [usize; 3],
    /// Rows whose fields were looked up.
    looked_up: usize,
}

impl Tally {
    fn of(rows: &impl Blocks) -> Result<Self, OutputFault> {
        let mut tally = Self::default();
        rows.each(&mut |block| {
            tally.add(block);
            Ok(())
        })?;
        Ok(tally)
    }

    fn add(&mut self, block: &Block) {
        self.failed += block.failures.len();
        let first = || block.failures.first().cloned();
        self.first = self.first.take().or_else(first);
        self.looked_up += block.looked_up();
        for (count, name) in self.beyond.iter_mut().zip(COUNTED) {
            let place = QUANTITIES.iter().position(|quantity| quantity.name == name);
            *count += place.map_or(0, |k| block.rows().filter(|row| row[k] > 1.0).count());
        }
    }

    /// Warns about failed scenes; returns an error if all failed, or if one failed and `--fail-if-failed` is set.
    fn verdict(&self, arguments: &RunArguments, rows: usize) -> Result<(), Failure> {
        let Some((row, reason)) = &self.first else {
            return Ok(());
        };
        let failed = match self.failed {
            all if all == rows => format!("all {rows} scenes failed"),
            some => format!("{some} of {rows} scenes failed"),
        };
        let told = format!("{failed}, the first in row {row} (rows count from 0): {reason}");
        if self.failed == rows || arguments.fail_if_failed {
            return Err(Failure::work(told));
        }
        say(format!("warning: {told}"));
        Ok(())
    }
}
