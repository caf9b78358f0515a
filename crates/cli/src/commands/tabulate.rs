//! `hertzlamb tabulate`: builds a kernel table.

use crate::arguments::{MemoryLimit, Overwrite, say_complete};
use crate::failure::{Failure, line, lines, say, show};
use crate::process;
use crate::progress::Bar;
use clap::Args;
use formats::accuracy_report;
use lookup::{Accuracy, Quantiles, schema, worst};
use output::{Existing, Output, OutputError, SHARD, TABLE, apart, processor_s};
use serde::Serialize;
use serde_json::Value;
use std::fmt::{self, Display, Formatter};
use std::path::{Path, PathBuf};
use tabulator::{BuildError, BuildSummary, Extension, Grid, NUMBERS_REVISION, Shard};
use tabulator::{build_over, build_shard, extend, refine};

const EXAMPLES: &str = "Examples:
  hertzlamb tabulate --grid demo -o kernels.h5
  hertzlamb tabulate --grid demo --nu 0.25,0.3 -o two.h5
  hertzlamb tabulate --tol 1e-5 --pulse 10 -o fine.h5
  hertzlamb tabulate --nu 0.2917 --r-max 8 -o kernels.h5      (adds to that table)
  hertzlamb tabulate --grid my-grid.toml -o mine.h5 --json
  hertzlamb tabulate --grid standard --shard 2/4 -o 2.shard
  hertzlamb tabulate --grid wide --plan

To resume an interrupted build, run the same command again.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Grid of a new table: a preset (demo, standard, wide) or a grid file (TOML, see data-schema/kernel-table.md).
    /// Default: demo.
    #[arg(long, value_name = "PRESET|FILE.toml")]
    grid: Option<String>,
    /// Poisson ratios, comma-separated. They replace those of the grid; without --grid they are added to an existing output.
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = ratio)]
    nu: Option<Vec<f64>>,
    /// Largest radius in units of r0; extends an existing output.
    #[arg(long, value_name = "R0")]
    r_max: Option<f64>,
    /// Largest depth in units of r0; extends an existing output.
    #[arg(long, value_name = "R0")]
    z_max: Option<f64>,
    /// End of the time cells as a multiple of the last arrival; extends an existing output.
    #[arg(long, value_name = "FACTOR")]
    time_factor: Option<f64>,
    /// Choose the spacing such that errors between grid points, relative to the peak in time, stay below ERROR.
    #[arg(long, value_name = "ERROR", requires = "pulse")]
    tol: Option<f64>,
    /// Pulse length for --tol, in units of r0/c1.
    #[arg(long, value_name = "LENGTH", requires = "tol")]
    pulse: Option<f64>,
    /// Table to write.
    #[arg(short, long, value_name = "OUT.h5", required_unless_present = "plan")]
    output: Option<PathBuf>,
    /// Compute a few points and print the time, memory and size that the table needs; write nothing.
    #[arg(long, conflicts_with_all = ["output", "shard", "skip_complete", "force"])]
    plan: bool,
    /// If the output exists: succeed at once if it is a complete table of this grid and version, fail with exit code 1
    /// otherwise.
    #[arg(long, conflicts_with = "force")]
    skip_complete: bool,
    #[command(flatten)]
    overwrite: Overwrite,
    #[command(flatten)]
    memory: MemoryLimit,
    /// Compute part I of N into the output, a shard for `hertzlamb table merge`.
    #[arg(long, value_name = "I/N", conflicts_with = "force")]
    shard: Option<Shard>,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

/// A Poisson's ratio.
fn ratio(text: &str) -> Result<f64, &'static str> {
    let number = text.parse().ok();
    let number = number.filter(|nu| (-0.95..=0.495).contains(nu));
    number.ok_or("it is outside [-0.95, 0.495]")
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.output {
        None => plan(arguments),
        Some(output) => tabulate(arguments, output),
    }
}

/// Prints the cost of a table.
fn plan(arguments: &Arguments) -> Result<(), Failure> {
    /// Approximate time of the measurement in s.
    const MEASURED_S: f64 = 2.0;
    let found = grid(arguments)?
        .cost(MEASURED_S, processor_s)
        .map_err(failure)?;
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let report = TablePlan {
        points: found.points,
        blocks: found.blocks,
        seconds: found.seconds / threads as f64,
        threads,
        measured_points: found.measured_points,
        memory_bytes: found.memory_bytes,
        most_bytes: found.most_bytes,
    };
    show(arguments.json, &report)
}

/// Time, memory and disk space that a table needs.
#[derive(Serialize)]
struct TablePlan {
    points: usize,
    blocks: usize,
    seconds: f64,
    threads: usize,
    measured_points: usize,
    memory_bytes: f64,
    most_bytes: f64,
}

impl Display for TablePlan {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [memory, size] = [self.memory_bytes, self.most_bytes].map(|bytes| 1e-9 * bytes);
        let points = format!("{} in {} blocks", self.points, self.blocks);
        let time = format!(
            "{:.0} s on {} threads, from {} points",
            self.seconds, self.threads, self.measured_points
        );
        let memory = format!("{memory:.2} GB; a shard needs its fraction of it");
        let size = format!("at most {size:.2} GB, usually a third of that: the file is compressed");
        f.write_str(&lines([
            ("points", points),
            ("time", time),
            ("memory", memory),
            ("size", size),
        ]))
    }
}

/// A shard that was written.
#[derive(Serialize)]
struct ShardReport {
    file: String,
    blocks: usize,
}

impl Display for ShardReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { file, blocks } = self;
        let text = format!("{file}: {blocks} blocks; join all shards with hertzlamb table merge");
        f.write_str(&line(text))
    }
}

fn tabulate(arguments: &Arguments, output: &Path) -> Result<(), Failure> {
    let ending = arguments.shard.map_or(TABLE, |_| SHARD);
    ending.check(output)?;
    if let Some(grid) = arguments.grid.as_deref().filter(|name| is_file(name)) {
        apart(&[output], &[("the grid", grid.into())])?;
    }
    let beside = arguments.shard.map_or(".journal", |_| "");
    let place = format!("{}{beside}", output.display());
    process::say_then(move || {
        format!("finished blocks are kept in {place}; run the same command again to resume")
    });
    if let Some(extension) = extension(arguments, output) {
        let summary = extend(output, &extension, &Bar::new()).map_err(failure)?;
        let content = lookup::read(output).map_err(Failure::work)?;
        let grid = Grid::parse(&content.origin.grid).map_err(failure)?;
        let report = TableReport::new(&grid, output, summary);
        return show(arguments.json, &report);
    }
    let grid = grid(arguments)?;
    // ends at once if the shard has all its blocks
    if let Some(shard) = arguments.shard {
        let blocks = build_shard(&grid, shard, output, &Bar::new()).map_err(failure)?;
        let file = output.display().to_string();
        return show(arguments.json, &ShardReport { file, blocks });
    }
    if arguments.skip_complete && output.exists() {
        // also removes temporary files that a killed run has left next to the output
        Output::claim(output, Existing::Replace)?;
        check_complete(output, &grid)?;
        return say_complete(output, arguments.json);
    }
    let existing = arguments.overwrite.existing();
    let needed = grid.memory_bytes().map_err(failure)?;
    let change = "ask for fewer nodes, fewer slices or wider cells";
    arguments.memory.check(needed, "the table", change)?;
    let summary = build_over(&grid, output, existing, &Bar::new()).map_err(failure)?;
    show(arguments.json, &TableReport::new(&grid, output, summary))
}

/// Fails if a file is not the complete table of a grid, made by this version.
fn check_complete(path: &Path, grid: &Grid) -> Result<(), Failure> {
    let origin = lookup::check_whole(path).map_err(Failure::work)?;
    let (version, revision) = (&origin.software_version, origin.numbers_revision);
    let other = if Grid::parse(&origin.grid).map_err(Failure::work)? != *grid {
        "has another grid".to_owned()
    } else if version != env!("CARGO_PKG_VERSION") {
        format!("was made by version {version}")
    } else if revision != NUMBERS_REVISION {
        format!(
            "has numbers of revision {revision}, but this version computes revision {NUMBERS_REVISION}"
        )
    } else {
        return Ok(());
    };
    let path = path.display();
    Err(Failure::work(format!("{path} is a table that {other}")))
}

/// The extension of an existing output, if no new table is requested.
fn extension(arguments: &Arguments, output: &Path) -> Option<Extension> {
    let extension = Extension {
        exact_ratios: arguments.nu.clone().unwrap_or_default(),
        r_max: arguments.r_max,
        z_max: arguments.z_max,
        time_factor: arguments.time_factor,
    };
    let more = extension != Extension::default();
    let new = arguments.grid.is_some()
        || arguments.overwrite.force
        || arguments.skip_complete
        || arguments.shard.is_some()
        || arguments.tol.is_some();
    (more && !new && output.exists()).then_some(extension)
}

/// The grid of a new table.
fn grid(arguments: &Arguments) -> Result<Grid, Failure> {
    let most = [arguments.r_max, arguments.z_max, arguments.time_factor];
    let name = arguments.grid.as_deref().unwrap_or("demo");
    let grid = match Grid::preset(name) {
        Some(grid) => grid,
        None if is_file(name) => Grid::from_file(name.as_ref()).map_err(failure)?,
        None => {
            let presets = tabulator::PRESETS.join(", ");
            return Err(Failure::input(format!(
                "--grid {name}: neither a preset ({presets}) nor a .toml file"
            )));
        }
    };
    let grid = grid.with(arguments.nu.clone(), most);
    let (Some(tolerance), Some(pulse)) = (arguments.tol, arguments.pulse) else {
        return Ok(grid);
    };
    let (grid, trials) = refine(&grid, tolerance, pulse, &Bar::new()).map_err(failure)?;
    trials.into_iter().for_each(say);
    Ok(grid)
}

/// Report of a written table.
#[derive(Serialize)]
struct TableReport {
    file: String,
    id: String,
    content_sha256: String,
    format_version: &'static str,
    poisson_ratios: Vec<f64>,
    points: usize,
    bytes: u64,
    wall_s: f64,
    resumed_blocks: usize,
    pulse_lengths: Vec<f64>,
    p99_relative_error: Vec<f64>,
    relative_errors: Value,
    #[serde(skip)]
    accuracy: Vec<Accuracy>,
}

impl TableReport {
    fn new(grid: &Grid, output: &Path, summary: BuildSummary) -> Self {
        let accuracy = summary.accuracy;
        let p99 = accuracy.iter().map(|errors| worst(&errors.on_slices).1.p99);
        Self {
            file: output.display().to_string(),
            id: summary.id,
            content_sha256: summary.content_sha256,
            format_version: schema::FORMAT_VERSION_VALUE,
            poisson_ratios: grid.slices().iter().map(|slice| slice.0).collect(),
            points: summary.points,
            bytes: summary.bytes,
            wall_s: summary.wall_s,
            resumed_blocks: summary.resumed_blocks,
            pulse_lengths: accuracy.iter().map(|errors| errors.pulse_length).collect(),
            p99_relative_error: p99.collect(),
            relative_errors: accuracy_report(&accuracy),
            accuracy,
        }
    }
}

impl Display for TableReport {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let megabytes = self.bytes as f64 / 1e6;
        write!(
            f,
            "{}: {} points, {megabytes:.1} MB, {:.1} s, id {}\n{}",
            line(&self.file),
            self.points,
            self.wall_s,
            self.id,
            errors_in_words(&self.accuracy)
        )
    }
}

/// The errors of the worst field in each region, for each pulse length.
pub(crate) fn errors_in_words(accuracy: &[Accuracy]) -> String {
    let mut text =
        "errors measured between grid points, relative to the peak in time, of the worst field: median, 99 %, maximum"
            .to_owned();
    for measured in accuracy {
        let length = measured.pulse_length;
        let on = Some(("on slices", &measured.on_slices));
        let between = measured.between_slices.as_ref();
        let between = between.map(|errors| ("between slices", errors));
        for (region, errors) in on.into_iter().chain(between) {
            let (field, Quantiles { p50, p99, max }) = worst(errors);
            let field = schema::FIELD_NAMES[field as usize];
            text += &format!(
                "\n  pulses of {length:>5} r0/c1, {region:14}  {p50:.1e}  {p99:.1e}  {max:.1e}  {field}"
            );
        }
    }
    text
}

/// Whether a grid is named by a file.
fn is_file(name: &str) -> bool {
    name.ends_with(".toml")
}

/// Failure to build a table.
pub(crate) fn failure(error: BuildError) -> Failure {
    let other = matches!(error, BuildError::Output(OutputError::Begun(..)));
    Failure::from(error).hint_if(other, "; a new table with --force replaces it")
}
