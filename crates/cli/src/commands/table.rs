//! `hertzlamb table`: inspects finished tables and joins shards.

use crate::arguments::Overwrite;
use crate::commands::tabulate;
use crate::failure::{Failure, line, show};
use crate::progress::Bar;
use clap::{Args, Subcommand};
use formats::table_report;
use lookup::Table;
use output::{Existing, TABLE};
use serde::{Serialize, Serializer};
use serde_json::Value;
use std::fmt::{self, Display, Formatter};
use std::path::{Path, PathBuf};
use tabulator::{check_table, differences, merge};

const EXAMPLES: &str = "Examples:
  hertzlamb table info kernels.h5
  hertzlamb table verify kernels.h5 --sample 200
  hertzlamb table diff old.h5 new.h5
  hertzlamb table merge 1.shard 2.shard -o kernels.h5";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    action: TableAction,
    /// Print one JSON object instead of text.
    #[arg(long, global = true)]
    json: bool,
}

#[derive(Debug, Subcommand)]
enum TableAction {
    /// Prints the range, origin and accuracy of a table.
    Info {
        /// Kernel table.
        table: PathBuf,
    },
    /// Checks checksums, completeness and finite values, and recomputes a sample of nodes.
    Verify {
        /// Kernel table.
        table: PathBuf,
        /// Number of nodes to recompute.
        #[arg(long, default_value_t = 50)]
        sample: usize,
        /// Seed of the sample. Default: a different one at each call, which the report prints.
        #[arg(long)]
        seed: Option<u64>,
    },
    /// Compares two tables except for their creation times; exit code 1 if they differ.
    Diff {
        /// First kernel table.
        first: PathBuf,
        /// Second kernel table.
        second: PathBuf,
    },
    /// Joins the shards of one table.
    Merge {
        /// Files made with `hertzlamb tabulate --shard`.
        #[arg(required = true)]
        shards: Vec<PathBuf>,
        /// Table to write.
        #[arg(short, long, value_name = "OUT.h5")]
        output: PathBuf,
        #[command(flatten)]
        overwrite: Overwrite,
    },
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.action {
        TableAction::Info { table } => info(table, arguments.json),
        TableAction::Verify {
            table,
            sample,
            seed,
        } => verify(table, *sample, *seed, arguments.json),
        TableAction::Diff { first, second } => diff(first, second, arguments.json),
        TableAction::Merge {
            shards,
            output,
            overwrite,
        } => join(shards, output, overwrite.existing(), arguments.json),
    }
}

fn info(path: &Path, json: bool) -> Result<(), Failure> {
    let table = Table::open(path).map_err(Failure::input)?;
    let value = table_report(path, &table);
    show(json, &TableInfo { path, table, value })
}

/// Range, origin and accuracy of a table.
struct TableInfo<'a> {
    path: &'a Path,
    table: Table,
    value: Value,
}

impl Serialize for TableInfo<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.value.serialize(serializer)
    }
}

impl Display for TableInfo<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (table, value) = (&self.table, &self.value);
        let content = table.content();
        let cells = content.slices.iter().map(|slice| slice.cells);
        let cells = match (cells.clone().min(), cells.max()) {
            (Some(fewest), Some(most)) if fewest < most => format!("{fewest} to {most}"),
            (_, most) => most.unwrap_or(0).to_string(),
        };
        write!(
            f,
            "file            {} ({:.1} MB)\n\
             id              {}, format {}, written by {}\n\
             content         sha256 {}\n\
             Poisson ratios  {:?}\n\
             r               0 .. {} r0, {} nodes\n\
             z               0 .. {} r0, {} nodes\n\
             time            {cells} cells of {} r0/c1 per slice, then a tail\n\
             interpolation   {} points\n{}",
            line(self.path.display()),
            value["bytes"].as_f64().unwrap_or(0.0) / 1e6,
            table.id(),
            content.origin.format_version,
            content.origin.software_version,
            value["content_sha256"].as_str().unwrap_or(""),
            table.poisson_ratios(),
            content.r_max,
            content.r.len(),
            content.z_max,
            content.z.len(),
            content.cell_width,
            content.stencil_points,
            tabulate::errors_in_words(&content.accuracy())
        )
    }
}

fn verify(path: &Path, sample: usize, seed: Option<u64>, json: bool) -> Result<(), Failure> {
    // the time in seconds differs at each call
    let time = || std::time::UNIX_EPOCH.elapsed();
    let seed = seed.unwrap_or_else(|| time().map_or(1, |time| time.as_secs()));
    let found = check_table(path, sample, seed).map_err(tabulate::failure)?;
    let is_good = found.is_good();
    let report = Verified {
        file: path.display().to_string(),
        nodes_checked: found.nodes_checked,
        seed,
        largest_relative_difference: found.largest_difference,
        hash_right: found.hash_right,
        bad_nodes: found.bad,
        damaged_patches: found.damaged,
    };
    if is_good {
        return show(json, &report);
    }
    if json {
        show(json, &report)?;
    }
    Err(Failure::work(report.wrong(sample)))
}

/// Report of a verified table.
#[derive(Serialize)]
struct Verified {
    file: String,
    nodes_checked: usize,
    seed: u64,
    largest_relative_difference: f64,
    hash_right: bool,
    bad_nodes: Vec<String>,
    damaged_patches: Vec<String>,
}

impl Display for Verified {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let text = format!(
            "{}: complete, checksum right, {} nodes (seed {}) recomputed, largest relative difference {:.1e}",
            self.file, self.nodes_checked, self.seed, self.largest_relative_difference
        );
        f.write_str(&line(text))
    }
}

impl Verified {
    /// All defects, in one line.
    fn wrong(&self, sample: usize) -> String {
        let first = |list: &[String]| match list.split_at_checked(5) {
            Some((first, more @ [_, ..])) => {
                format!("{}; and {} more", first.join("; "), more.len())
            }
            _ => list.join("; "),
        };
        let (bad, damaged) = (&self.bad_nodes, &self.damaged_patches);
        let mut parts = Vec::new();
        if !damaged.is_empty() {
            let patches = first(damaged);
            parts.push(format!("damaged, unreadable nodes: {patches}"));
        } else if !self.hash_right {
            parts.push("the content was changed, it does not match content_sha256".to_owned());
        }
        if !bad.is_empty() {
            parts.push(format!("{} wrong: {}", bad.len(), first(bad)));
        } else if damaged.is_empty() {
            let advice = format!("no wrong node in a sample of {sample}, try a larger --sample");
            parts.push(advice);
        }
        format!("{}: {}", self.file, parts.join("; "))
    }
}

fn diff(first: &Path, second: &Path, json: bool) -> Result<(), Failure> {
    let read = |path: &Path| lookup::read(path).map_err(Failure::input);
    let found = differences(&read(first)?, &read(second)?);
    let report = Compared {
        same: found.is_empty(),
        differences: found,
    };
    show(json, &report)?;
    if report.same {
        return Ok(());
    }
    let (first, second) = (first.display(), second.display());
    Err(Failure::work(format!("{first} and {second} differ")))
}

/// Differences of two tables.
#[derive(Serialize)]
struct Compared {
    same: bool,
    differences: Vec<String>,
}

impl Display for Compared {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.same {
            return f.write_str("the tables are identical");
        }
        let found: Vec<String> = self.differences.iter().map(line).collect();
        f.write_str(&found.join("\n"))
    }
}

fn join(shards: &[PathBuf], output: &Path, existing: Existing, json: bool) -> Result<(), Failure> {
    TABLE.check(output)?;
    let summary = merge(shards, output, existing, &Bar::new());
    let summary = summary.map_err(tabulate::failure)?;
    let report = Joined {
        file: output.display().to_string(),
        id: summary.id,
        content_sha256: summary.content_sha256,
        points: summary.points,
        bytes: summary.bytes,
    };
    show(json, &report)
}

/// Report of a table joined from shards.
#[derive(Serialize)]
struct Joined {
    file: String,
    id: String,
    content_sha256: String,
    points: usize,
    bytes: u64,
}

impl Display for Joined {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let megabytes = self.bytes as f64 / 1e6;
        let text = format!(
            "{}: {} points, {megabytes:.1} MB, id {}",
            self.file, self.points, self.id
        );
        f.write_str(&line(text))
    }
}
