//! `hertzlamb impact`: one scene.

use crate::failure::{Failure, print};
use crate::report::Report;
use clap::{Args, ValueEnum};
use impact::output::{Existing, check, write};
use impact::{ImpactError, KernelChoice, Outcome, Scene, simulate};
use lookup::TableFile;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Where the kernels of the fields come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Kernel {
    /// Computed for each probe, no table.
    Direct,
    /// Looked up in the table given with --table.
    Table,
    /// The table or computed, by the estimated cost and error of both.
    Auto,
}

#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  hertzlamb impact scenes/copper-on-steel.toml --table kernels.h5 -o impact.h5 --json"
)]
pub(crate) struct Arguments {
    /// Scene file (TOML, see data-schema/scene.md).
    scene: PathBuf,
    /// Kernel table for the fields at probes.
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    /// Where the kernels of the fields come from.
    #[arg(long, value_enum, default_value_t = Kernel::Auto)]
    kernel: Kernel,
    /// Results file (HDF5, see data-schema/results.md).
    #[arg(short, long, value_name = "OUT.h5")]
    output: Option<PathBuf>,
    /// Replace an existing results file.
    #[arg(long)]
    force: bool,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let start = Instant::now();
    let existing = if arguments.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    let scene = read_scene(&arguments.scene)?;
    let table = match &arguments.table {
        Some(path) => Some(open_table(path)?),
        None => None,
    };
    if let Some(path) = &arguments.output {
        check(path, existing)?;
    }
    let outcome = compute(&scene, arguments.kernel, table)?;
    if let Some(path) = &arguments.output {
        write(path, &outcome, existing)?;
    }
    for warning in &outcome.warnings {
        eprintln!("warning: {warning}");
    }
    let report = Report::new(&outcome, start.elapsed().as_secs_f64());
    if arguments.json {
        print(serde_json::to_string(&report).map_err(Failure::work)?)
    } else {
        print(report.text())
    }
}

pub(crate) fn read_scene(path: &Path) -> Result<Scene, Failure> {
    Scene::from_file(path).map_err(|error| match error {
        named @ (impact::SceneError::Unreadable { .. } | impact::SceneError::ForceFile { .. }) => {
            Failure::input(named)
        }
        other => Failure::input(format!("{}: {other}", path.display())),
    })
}

/// The table at `path`.
pub(crate) fn open_table(path: &Path) -> Result<TableFile, Failure> {
    TableFile::open(path).map_err(|source| {
        Failure::from(ImpactError::Table {
            path: path.to_owned(),
            source,
        })
    })
}

pub(crate) fn compute(
    scene: &Scene,
    kernel: Kernel,
    table: Option<TableFile>,
) -> Result<Outcome, Failure> {
    match (kernel, table) {
        (Kernel::Table, None) => Err(Failure::input(
            "--kernel table needs a table: give --table FILE, made with hertzlamb tabulate",
        )),
        (Kernel::Direct, _) | (Kernel::Auto, None) => Ok(simulate(scene, &KernelChoice::Direct)?),
        (Kernel::Table, Some(table)) => Ok(simulate(scene, &KernelChoice::Table(table))?),
        (Kernel::Auto, Some(table)) => Ok(simulate(scene, &KernelChoice::Auto(table))?),
    }
}
