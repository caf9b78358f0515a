//! `hertzlamb table`: looks at finished tables and joins shards.

use crate::commands::tabulate;
use crate::failure::{Failure, print};
use crate::overwrite::Overwrite;
use crate::progress::Bar;
use clap::{Args, Subcommand};
use lookup::{Content, DamagedPatch, TableError};
use output::TABLE;
use serde::Serialize;
use std::path::{Path, PathBuf};
use tabulator::{BadNode, Difference, check_table, differences, merge};

const EXAMPLES: &str = "Examples:
  hertzlamb table info kernels.h5
  hertzlamb table verify kernels.h5 --sample 200
  hertzlamb table diff old.h5 new.h5
  hertzlamb table merge 1.shard 2.shard -o kernels.h5";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    action: Action,
    /// Print one JSON object instead of text.
    #[arg(long, global = true)]
    json: bool,
}

#[derive(Debug, Subcommand)]
enum Action {
    /// Says what a table covers, how it was made and how exact it is.
    Info {
        /// Kernel table.
        table: PathBuf,
    },
    /// Checks checksums, completeness and finiteness, and computes a sample of nodes again.
    Verify {
        /// Kernel table.
        table: PathBuf,
        /// Nodes to compute again.
        #[arg(long, default_value_t = 50)]
        sample: usize,
        /// Picks the nodes; another one at each call unless given, and said.
        #[arg(long)]
        seed: Option<u64>,
    },
    /// Compares two tables, apart from their creation time; exit code 1 if they differ.
    Diff {
        /// Kernel table.
        first: PathBuf,
        /// Kernel table.
        second: PathBuf,
    },
    /// Joins the shards of one table.
    Merge {
        /// Files made with `hertzlamb tabulate --shard`.
        #[arg(required = true)]
        shards: Vec<PathBuf>,
        /// The table to write.
        #[arg(short, long, value_name = "OUT.h5")]
        output: PathBuf,
        #[command(flatten)]
        overwrite: Overwrite,
    },
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.action {
        Action::Info { table } => info(table, arguments.json),
        Action::Verify {
            table,
            sample,
            seed,
        } => verify(
            table,
            *sample,
            seed.unwrap_or_else(any_seed),
            arguments.json,
        ),
        Action::Diff { first, second } => diff(first, second, arguments.json),
        Action::Merge {
            shards,
            output,
            overwrite,
        } => join(shards, output, *overwrite, arguments.json),
    }
}

#[derive(Debug, Serialize)]
struct Info<'a> {
    file: String,
    bytes: u64,
    id: String,
    format_version: &'a str,
    software_version: &'a str,
    git_revision: &'a str,
    created_unix_s: u64,
    content_sha256: String,
    poisson_ratios: Vec<f64>,
    r_nodes: usize,
    z_nodes: usize,
    r_max: f64,
    z_max: f64,
    cell_width: f64,
    cells: Vec<usize>,
    stencil_points: usize,
    accuracy_asked: f64,
    pulse_lengths: &'a [f64],
    p99_relative_error: &'a [f64],
    relative_errors: Vec<tabulate::Errors>,
    grid: &'a str,
}

fn info(path: &Path, json: bool) -> Result<(), Failure> {
    let table = lookup::Table::open(path).map_err(Failure::input)?;
    let content = table.content();
    let origin = &content.origin;
    let accuracy = content.accuracy();
    let info = Info {
        file: path.display().to_string(),
        bytes: std::fs::metadata(path).map_or(0, |data| data.len()),
        id: table.id().to_owned(),
        format_version: table.format_version(),
        software_version: &origin.software_version,
        git_revision: &origin.git_revision,
        created_unix_s: origin.created_unix_s,
        content_sha256: lookup::content_hash(content),
        poisson_ratios: table.poisson_ratios().to_vec(),
        r_nodes: content.r.len(),
        z_nodes: content.z.len(),
        r_max: table.r_max(),
        z_max: table.z_max(),
        cell_width: content.cell_width,
        cells: content.slices.iter().map(|slice| slice.cells).collect(),
        stencil_points: content.stencil_points,
        accuracy_asked: origin.accuracy_asked,
        pulse_lengths: &content.pulse_lengths,
        p99_relative_error: &origin.accuracy_reached,
        relative_errors: tabulate::Errors::of(&accuracy),
        grid: &origin.grid,
    };
    if json {
        return print(serde_json::to_string(&info).map_err(Failure::work)?);
    }
    print(format!(
        "file            {} ({:.1} MB)",
        info.file,
        info.bytes as f64 / 1e6
    ))?;
    print(format!(
        "id              {}, format {}, written by {}",
        info.id, info.format_version, info.software_version
    ))?;
    print(format!("content         sha256 {}", info.content_sha256))?;
    print(format!("Poisson ratios  {:?}", info.poisson_ratios))?;
    print(format!(
        "r               0 .. {} r0, {} nodes",
        info.r_max, info.r_nodes
    ))?;
    print(format!(
        "z               0 .. {} r0, {} nodes",
        info.z_max, info.z_nodes
    ))?;
    print(format!(
        "time            cells of {} r0/c1, {:?} of them, then a tail",
        info.cell_width, info.cells
    ))?;
    print(format!("interpolation   {} points", info.stencil_points))?;
    tabulate::print_errors(&accuracy)
}

#[derive(Debug, Serialize)]
struct Verified {
    file: String,
    nodes_checked: usize,
    seed: u64,
    largest_relative_difference: f64,
    hash_right: bool,
    bad_nodes: Vec<String>,
    damaged_patches: Vec<String>,
}

/// Another seed at each call: the time in seconds.
fn any_seed() -> u64 {
    let since = std::time::UNIX_EPOCH.elapsed();
    since.map_or(1, |time| time.as_secs())
}

fn verify(path: &Path, sample: usize, seed: u64, json: bool) -> Result<(), Failure> {
    let report = check_table(path, sample, seed).map_err(|error| match error {
        tabulator::BuildError::Table(
            error @ (TableError::Unreadable { .. }
            | TableError::NotHdf5 { .. }
            | TableError::Foreign { .. }
            | TableError::Version { .. }),
        ) => Failure::input(error),
        tabulator::BuildError::Table(error) => Failure::work(error),
        other => tabulate::failure(other),
    })?;
    let verified = Verified {
        file: path.display().to_string(),
        nodes_checked: report.nodes_checked,
        seed,
        largest_relative_difference: report.largest_difference,
        hash_right: report.hash_right,
        bad_nodes: report.bad.iter().map(bad_node).collect(),
        damaged_patches: report.damaged.iter().map(damaged_patch).collect(),
    };
    if json {
        print(serde_json::to_string(&verified).map_err(Failure::work)?)?;
    }
    if report.is_good() {
        return if json {
            Ok(())
        } else {
            print(format!(
                "{}: complete, checksum right, {} nodes of seed {seed} computed again, largest difference {:.1e}",
                verified.file, verified.nodes_checked, verified.largest_relative_difference
            ))
        };
    }
    Err(Failure::work(wrong(&verified, sample)))
}

/// What is wrong with a table, in one line.
fn wrong(verified: &Verified, sample: usize) -> String {
    let first = |list: &[String]| {
        let more = match list.len() {
            0..=5 => String::new(),
            count => format!("; and {} more", count - 5),
        };
        list[..list.len().min(5)].join("; ") + &more
    };
    let mut parts = Vec::new();
    if !verified.damaged_patches.is_empty() {
        let patches = first(&verified.damaged_patches);
        parts.push(format!("damaged, nodes that cannot be read: {patches}"));
    } else if !verified.hash_right {
        parts.push("the content is not that of content_sha256, it was changed".to_owned());
    }
    if !verified.bad_nodes.is_empty() {
        let count = verified.bad_nodes.len();
        parts.push(format!("{count} wrong: {}", first(&verified.bad_nodes)));
    } else if verified.damaged_patches.is_empty() {
        parts.push(format!(
            "no wrong node among {sample}, try a larger --sample"
        ));
    }
    format!("{}: {}", verified.file, parts.join("; "))
}

fn bad_node(bad: &BadNode) -> String {
    let what = if bad.relative_difference.is_finite() {
        format!("differs by {:.1e}", bad.relative_difference)
    } else {
        "is not finite".to_owned()
    };
    format!(
        "nu = {}, r/r0 = {}, z/r0 = {}: {} ({}) {what}",
        bad.poisson_ratio, bad.r, bad.z, bad.field, bad.dataset
    )
}

fn damaged_patch(patch: &DamagedPatch) -> String {
    format!(
        "nu = {}, r/r0 = {} .. {}, z/r0 = {} .. {}: {}",
        patch.poisson_ratio, patch.r[0], patch.r[1], patch.z[0], patch.z[1], patch.dataset
    )
}

fn diff(first: &Path, second: &Path, json: bool) -> Result<(), Failure> {
    let found: Vec<String> = differences(&read(first)?, &read(second)?)
        .iter()
        .map(describe)
        .collect();
    if json {
        let object = serde_json::json!({ "same": found.is_empty(), "differences": found });
        print(object)?;
    } else if found.is_empty() {
        print("the tables hold the same")?;
    } else {
        found.iter().try_for_each(print)?;
    }
    if found.is_empty() {
        Ok(())
    } else {
        Err(Failure::work(format!(
            "{} and {} differ",
            first.display(),
            second.display()
        )))
    }
}

fn join(
    shards: &[PathBuf],
    output: &Path,
    overwrite: Overwrite,
    json: bool,
) -> Result<(), Failure> {
    TABLE.check(output)?;
    let progress = Bar::new();
    let summary =
        merge(shards, output, overwrite.existing(), &progress).map_err(tabulate::failure)?;
    progress.finish();
    let file = output.display().to_string();
    if json {
        return print(serde_json::json!({
            "file": file,
            "id": summary.id,
            "content_sha256": summary.content_sha256,
            "points": summary.points,
            "bytes": summary.bytes,
        }));
    }
    print(format!(
        "{file}: {} points, {:.1} MB, id {}",
        summary.points,
        summary.bytes as f64 / 1e6,
        summary.id
    ))
}

fn describe(difference: &Difference) -> String {
    match difference {
        Difference::Setting { name } => format!("{name} differs"),
        Difference::Slice {
            poisson_ratio,
            in_first: true,
        } => {
            format!("nu = {poisson_ratio} is in the first table only")
        }
        Difference::Slice {
            poisson_ratio,
            in_first: false,
        } => {
            format!("nu = {poisson_ratio} is in the second table only")
        }
        Difference::Values {
            poisson_ratio,
            dataset,
            count,
            largest,
        } => {
            format!(
                "nu = {poisson_ratio}: {count} values of {dataset} differ, by up to {largest:.1e}"
            )
        }
    }
}

fn read(path: &Path) -> Result<Content, Failure> {
    lookup::read(path).map_err(Failure::input)
}
