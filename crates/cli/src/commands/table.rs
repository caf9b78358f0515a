//! `hertzlamb table`: looks at finished tables and joins shards.

use crate::arguments::Overwrite;
use crate::commands::tabulate;
use crate::failure::{Failure, print, show};
use crate::progress::Bar;
use clap::{Args, Subcommand};
use formats::table_report;
use lookup::Content;
use output::TABLE;
use serde_json::json;
use std::path::{Path, PathBuf};
use tabulator::{CheckReport, check_table, differences, merge};

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
        } => verify(table, *sample, *seed, arguments.json),
        Action::Diff { first, second } => diff(first, second, arguments.json),
        Action::Merge {
            shards,
            output,
            overwrite,
        } => join(shards, output, *overwrite, arguments.json),
    }
}

fn info(path: &Path, json: bool) -> Result<(), Failure> {
    let table = lookup::Table::open(path).map_err(Failure::input)?;
    let content = table.content();
    let origin = &content.origin;
    let value = table_report(path, &table);
    let cells: Vec<usize> = content.slices.iter().map(|slice| slice.cells).collect();
    let text = format!(
        "file            {} ({:.1} MB)\n\
         id              {}, format {}, written by {}\n\
         content         sha256 {}\n\
         Poisson ratios  {:?}\n\
         r               0 .. {} r0, {} nodes\n\
         z               0 .. {} r0, {} nodes\n\
         time            cells of {} r0/c1, {cells:?} of them, then a tail\n\
         interpolation   {} points\n{}",
        path.display(),
        value["bytes"].as_f64().unwrap_or(0.0) / 1e6,
        table.id(),
        origin.format_version,
        origin.software_version,
        value["content_sha256"].as_str().unwrap_or(""),
        table.poisson_ratios(),
        content.r_max,
        content.r.len(),
        content.z_max,
        content.z.len(),
        content.cell_width,
        content.stencil_points,
        tabulate::errors_in_words(&content.accuracy())
    );
    show(json, &value, text)
}

fn verify(path: &Path, sample: usize, seed: Option<u64>, json: bool) -> Result<(), Failure> {
    // another one at each call: the time in seconds
    let time = || std::time::UNIX_EPOCH.elapsed();
    let seed = seed.unwrap_or_else(|| time().map_or(1, |time| time.as_secs()));
    let report = check_table(path, sample, seed).map_err(tabulate::failure)?;
    let file = path.display().to_string();
    let is_good = report.is_good();
    let CheckReport {
        nodes_checked: nodes,
        largest_difference: largest,
        hash_right,
        bad,
        damaged,
    } = report;
    let value = json!({
        "file": file,
        "nodes_checked": nodes,
        "seed": seed,
        "largest_relative_difference": largest,
        "hash_right": hash_right,
        "bad_nodes": bad,
        "damaged_patches": damaged,
    });
    if is_good {
        let text = format!(
            "{file}: complete, checksum right, {nodes} nodes of seed {seed} computed again, largest difference {largest:.1e}"
        );
        return show(json, &value, text);
    }
    if json {
        print(value)?;
    }
    // what is wrong, in one line
    let first = |list: &[String]| {
        let more = match list.len() {
            0..=5 => String::new(),
            count => format!("; and {} more", count - 5),
        };
        list[..list.len().min(5)].join("; ") + &more
    };
    let mut parts = Vec::new();
    if !damaged.is_empty() {
        let patches = first(&damaged);
        parts.push(format!("damaged, nodes that cannot be read: {patches}"));
    } else if !hash_right {
        parts.push("the content is not that of content_sha256, it was changed".to_owned());
    }
    if !bad.is_empty() {
        parts.push(format!("{} wrong: {}", bad.len(), first(&bad)));
    } else if damaged.is_empty() {
        parts.push(format!(
            "no wrong node among {sample}, try a larger --sample"
        ));
    }
    Err(Failure::work(format!("{file}: {}", parts.join("; "))))
}

fn diff(first: &Path, second: &Path, json: bool) -> Result<(), Failure> {
    let found = differences(&read(first)?, &read(second)?);
    let same = if found.is_empty() {
        "the tables hold the same".to_owned()
    } else {
        found.join("\n")
    };
    let value = json!({ "same": found.is_empty(), "differences": found });
    show(json, &value, same)?;
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
    let summary = merge(shards, output, overwrite.existing(), &Bar::new());
    let summary = summary.map_err(tabulate::failure)?;
    let file = output.display().to_string();
    let value = json!({
        "file": file,
        "id": summary.id,
        "content_sha256": summary.content_sha256,
        "points": summary.points,
        "bytes": summary.bytes,
    });
    let text = format!(
        "{file}: {} points, {:.1} MB, id {}",
        summary.points,
        summary.bytes as f64 / 1e6,
        summary.id
    );
    show(json, &value, text)
}

fn read(path: &Path) -> Result<Content, Failure> {
    lookup::read(path).map_err(Failure::input)
}
