//! `hertzlamb tabulate`: builds a kernel table.

use crate::failure::{Failure, print, say};
use crate::memory::MemoryLimit;
use crate::overwrite::{Overwrite, say_complete};
use crate::progress::Bar;
use clap::Args;
use lookup::{Accuracy, Origin, Quantiles, TableError, schema};
use output::{Existing, Output, Role, SHARD, TABLE, apart};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tabulator::{BuildError, Extension, Grid, JournalError, NUMBERS_REVISION, Shard, Summary};
use tabulator::{build_over, build_shard, extend, refine};

const EXAMPLES: &str = "Examples:
  hertzlamb tabulate --grid demo -o kernels.h5
  hertzlamb tabulate --grid demo --nu 0.25,0.3 -o two.h5
  hertzlamb tabulate --tol 1e-5 --pulse 10 -o fine.h5
  hertzlamb tabulate --nu 0.2917 --r-max 8 -o kernels.h5      (adds to that table)
  hertzlamb tabulate --grid my-grid.toml -o mine.h5 --json
  hertzlamb tabulate --grid standard --shard 2/4 -o 2.shard

An interrupted build goes on where it stopped when the same command is given again.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// A preset (demo, standard, wide) or a grid file (TOML, see data-schema/kernel-table.md); demo if the output is new.
    #[arg(long, value_name = "PRESET|FILE.toml")]
    grid: Option<String>,
    /// Poisson ratios, comma-separated: instead of those of the grid, or, without --grid, slices to add to the output if it exists.
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    nu: Option<Vec<f64>>,
    /// Serve radii up to this, in r0; extends the output if it exists.
    #[arg(long, value_name = "R0")]
    r_max: Option<f64>,
    /// Serve depths up to this, in r0; extends the output if it exists.
    #[arg(long, value_name = "R0")]
    z_max: Option<f64>,
    /// End the time cells at this multiple of the last arrival; extends the output if it exists.
    #[arg(long, value_name = "FACTOR")]
    time_factor: Option<f64>,
    /// Choose the spacing so that off-grid errors over the peak in time stay below this.
    #[arg(long, value_name = "ERROR", requires = "pulse")]
    tol: Option<f64>,
    /// Length of the pulses that --tol is meant for, in r0/c1.
    #[arg(long, value_name = "LENGTH", requires = "tol")]
    pulse: Option<f64>,
    /// The table to write.
    #[arg(short, long, value_name = "OUT.h5")]
    output: PathBuf,
    /// Succeed at once where the output is a whole table of this grid and version; fail with 1 where it is not.
    #[arg(long, conflicts_with = "force")]
    skip_complete: bool,
    #[command(flatten)]
    overwrite: Overwrite,
    #[command(flatten)]
    memory: MemoryLimit,
    /// Compute part I of N into the output, which is then a shard for `hertzlamb table merge`.
    #[arg(long, value_name = "I/N", conflicts_with = "force")]
    shard: Option<Shard>,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Serialize)]
struct Report<'a> {
    file: String,
    id: &'a str,
    content_sha256: &'a str,
    format_version: &'a str,
    poisson_ratios: Vec<f64>,
    points: usize,
    bytes: u64,
    wall_s: f64,
    resumed_blocks: usize,
    pulse_lengths: &'a [f64],
    p99_relative_error: &'a [f64],
    relative_errors: Vec<Errors>,
}

/// Relative errors measured off the grid with pulses of one length, by region and field.
#[derive(Debug, Serialize)]
pub(crate) struct Errors {
    pulse_length: f64,
    on_slices: BTreeMap<&'static str, OfField>,
    #[serde(skip_serializing_if = "Option::is_none")]
    between_slices: Option<BTreeMap<&'static str, OfField>>,
}

#[derive(Debug, Serialize)]
struct OfField {
    p50: f64,
    p99: f64,
    max: f64,
}

impl Errors {
    /// All that were measured.
    pub(crate) fn of(accuracy: &[Accuracy]) -> Vec<Self> {
        let fields = |errors: &[Quantiles; 6]| {
            let named = schema::FIELD_NAMES.into_iter().zip(errors);
            named
                .map(|(name, &Quantiles { p50, p99, max })| (name, OfField { p50, p99, max }))
                .collect()
        };
        accuracy
            .iter()
            .map(|measured| Self {
                pulse_length: measured.pulse_length,
                on_slices: fields(&measured.on_slices),
                between_slices: measured.between_slices.as_ref().map(fields),
            })
            .collect()
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let ending = if arguments.shard.is_some() {
        SHARD
    } else {
        TABLE
    };
    ending.check(&arguments.output)?;
    if let Some(grid) = arguments.grid.as_deref().filter(|name| is_file(name)) {
        let grid = Role::new("the grid", Path::new(grid));
        apart(&[&arguments.output], &[grid])?;
    }
    if let Some(extension) = extension(arguments) {
        let progress = Bar::new();
        let summary = extend(&arguments.output, &extension, &progress).map_err(failure)?;
        progress.finish();
        let content = lookup::read(&arguments.output).map_err(Failure::work)?;
        return tell(&Grid::of(&content).map_err(failure)?, arguments, &summary);
    }
    let grid = grid(arguments)?;
    // a shard ends at once where it has all its blocks
    let is_shard = arguments.shard.is_some();
    if arguments.skip_complete && !is_shard && arguments.output.exists() {
        // also removes what a killed run has left beside it
        Output::claim(&arguments.output, Existing::Replace)?;
        check_complete(&arguments.output, &grid)?;
        return say_complete(&arguments.output, arguments.json);
    }
    let existing = arguments.overwrite.existing();
    let progress = Bar::new();
    if let Some(shard) = arguments.shard {
        let blocks = build_shard(&grid, shard, &arguments.output, &progress).map_err(failure)?;
        progress.finish();
        return shard_report(arguments, blocks);
    }
    let needed = grid.memory_bytes().map_err(failure)?;
    let change = "ask for fewer nodes, fewer slices or wider cells";
    arguments.memory.check(needed, "the table", change)?;
    let summary = build_over(&grid, &arguments.output, existing, &progress).map_err(failure)?;
    progress.finish();
    tell(&grid, arguments, &summary)
}

/// Fails where a file is not the whole table of a grid, made by this version.
fn check_complete(path: &Path, grid: &Grid) -> Result<(), Failure> {
    let Origin {
        grid: settings,
        software_version: version,
        numbers_revision: revision,
        ..
    } = &lookup::check_whole(path).map_err(Failure::work)?;
    let other = if Grid::parse(settings).map_err(Failure::work)? != *grid {
        "has another grid".to_owned()
    } else if version != env!("CARGO_PKG_VERSION") {
        format!("was made by version {version}")
    } else if *revision != NUMBERS_REVISION {
        format!(
            "has numbers of revision {revision}, where this version computes revision {NUMBERS_REVISION}"
        )
    } else {
        return Ok(());
    };
    Err(Failure::Work(format!(
        "{} is a table that {other}",
        path.display()
    )))
}

/// What to add to the output, if it exists and no new table was asked for.
fn extension(arguments: &Arguments) -> Option<Extension> {
    let more = arguments.nu.is_some()
        || arguments.r_max.is_some()
        || arguments.z_max.is_some()
        || arguments.time_factor.is_some();
    let new = arguments.grid.is_some()
        || arguments.overwrite.force
        || arguments.skip_complete
        || arguments.shard.is_some()
        || arguments.tol.is_some();
    (more && !new && arguments.output.exists()).then(|| Extension {
        exact_ratios: arguments.nu.clone().unwrap_or_default(),
        r_max: arguments.r_max,
        z_max: arguments.z_max,
        time_factor: arguments.time_factor,
    })
}

/// The settings of a new table.
fn grid(arguments: &Arguments) -> Result<Grid, Failure> {
    let mut grid = resolve(arguments.grid.as_deref().unwrap_or("demo"))?;
    if let Some(ratios) = &arguments.nu {
        grid.poisson_ratios.clone_from(ratios);
        grid.poisson_ratios.sort_by(f64::total_cmp);
        grid.poisson_ratios.dedup();
        grid.exact_ratios.clear();
    }
    for (axis, max) in [
        (&mut grid.r, arguments.r_max),
        (&mut grid.z, arguments.z_max),
    ] {
        axis.max = max.unwrap_or(axis.max);
    }
    grid.time_factor = arguments.time_factor.unwrap_or(grid.time_factor);
    let (Some(tolerance), Some(pulse)) = (arguments.tol, arguments.pulse) else {
        return Ok(grid);
    };
    let progress = Bar::new();
    let (grid, trials) = refine(&grid, tolerance, pulse, &progress).map_err(failure)?;
    progress.finish();
    for trial in trials {
        say(format!(
            "spacing {:.4} r0: {} nodes a slice, error {:.1e} for pulses of {pulse} r0/c1",
            trial.spacing, trial.nodes, trial.error
        ));
    }
    Ok(grid)
}

fn tell(grid: &Grid, arguments: &Arguments, summary: &Summary) -> Result<(), Failure> {
    let report = report(grid, arguments, summary);
    if arguments.json {
        return print(serde_json::to_string(&report).map_err(Failure::work)?);
    }
    print(format!(
        "{}: {} points, {:.1} MB, {:.1} s, id {}",
        report.file,
        report.points,
        report.bytes as f64 / 1e6,
        report.wall_s,
        report.id
    ))?;
    print_errors(&summary.accuracy)
}

/// The errors of the worst field in each region, for each length of the pulse.
pub(crate) fn print_errors(accuracy: &[Accuracy]) -> Result<(), Failure> {
    print(
        "measured off the grid, error over the peak in time, of the worst field: 50 %, 99 %, most",
    )?;
    for measured in accuracy {
        let length = measured.pulse_length;
        let regions = [
            ("on slices", Some(measured.worst_on_slices())),
            ("between slices", measured.worst_between_slices()),
        ];
        for (region, worst) in regions {
            if let Some((field, Quantiles { p50, p99, max })) = worst {
                let field = schema::FIELD_NAMES[field as usize];
                print(format!(
                    "  pulses of {length:>5} r0/c1, {region:14}  {p50:.1e}  {p99:.1e}  {max:.1e}  {field}"
                ))?;
            }
        }
    }
    Ok(())
}

fn shard_report(arguments: &Arguments, blocks: usize) -> Result<(), Failure> {
    let file = arguments.output.display().to_string();
    if arguments.json {
        return print(serde_json::json!({ "file": file, "blocks": blocks }));
    }
    print(format!(
        "{file}: {blocks} blocks; join all shards with hertzlamb table merge"
    ))
}

fn report<'a>(grid: &'a Grid, arguments: &Arguments, summary: &'a Summary) -> Report<'a> {
    Report {
        file: arguments.output.display().to_string(),
        id: &summary.id,
        content_sha256: &summary.content_sha256,
        format_version: schema::FORMAT_VERSION_VALUE,
        poisson_ratios: grid.slices().iter().map(|slice| slice.0).collect(),
        points: summary.points,
        bytes: summary.bytes,
        wall_s: summary.wall_s,
        resumed_blocks: summary.resumed_blocks,
        pulse_lengths: &summary.pulse_lengths,
        p99_relative_error: &summary.p99_error,
        relative_errors: Errors::of(&summary.accuracy),
    }
}

/// The grid of a preset or a file.
fn resolve(name: &str) -> Result<Grid, Failure> {
    if let Some(grid) = Grid::preset(name).map_err(failure)? {
        return Ok(grid);
    }
    if !is_file(name) {
        return Err(Failure::input(format!(
            "--grid {name}: neither a preset ({}) nor a .toml file",
            tabulator::PRESETS.join(", ")
        )));
    }
    Grid::from_file(name.as_ref()).map_err(failure)
}

/// Whether the name of a grid is that of a file.
fn is_file(name: &str) -> bool {
    name.ends_with(".toml")
}

/// Bad settings and files in the way are the user's, the rest is work that failed.
pub(crate) fn failure(error: BuildError) -> Failure {
    match error {
        BuildError::Output(error) => error.into(),
        BuildError::Journal(JournalError::Other { .. }) => {
            Failure::input(format!("{error}; a new table with --force replaces it"))
        }
        BuildError::Journal(_)
        | BuildError::Setting { .. }
        | BuildError::InFile { .. }
        | BuildError::Shrinks { .. }
        | BuildError::TooFine { .. }
        | BuildError::Settings { .. }
        | BuildError::File { .. }
        | BuildError::NotBlocks { .. }
        | BuildError::Mixed { .. }
        | BuildError::NoShards
        | BuildError::Incomplete { .. }
        | BuildError::Table(
            TableError::Unreadable { .. }
            | TableError::NotHdf5 { .. }
            | TableError::Foreign { .. }
            | TableError::Version { .. },
        ) => Failure::input(error),
        BuildError::Unwritable(_)
        | BuildError::NotFinite { .. }
        | BuildError::Domain(_)
        | BuildError::Table(_)
        | BuildError::Content(_)
        | BuildError::Lookup(_) => Failure::work(error),
    }
}
