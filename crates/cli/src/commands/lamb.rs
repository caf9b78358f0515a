//! `hertzlamb lamb`: exact histories of Lamb's problem.

use crate::arguments::Overwrite;
use crate::failure::{Failure, say, show};
use clap::Args;
use formats::lamb::{LambCase, LambHistory, read_lamb, stage_lamb};
use output::HISTORIES;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  hertzlamb lamb scenes/lamb-point.toml -o point.csv
  hertzlamb lamb scenes/lamb-disc.toml -o disc.h5 --json";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Case file (TOML): a half-space, a force on its surface, receivers.
    case: PathBuf,
    /// File to write the histories to: text (.csv) or HDF5 (.h5).
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overwrite: Overwrite,
}

#[derive(Serialize)]
struct Report {
    output: String,
    times: usize,
    histories: Vec<Row>,
}

#[derive(Serialize)]
struct Row {
    receiver: String,
    name: &'static str,
    unit: &'static str,
    peak: f64,
    error: f64,
}

impl Report {
    fn of(output: String, case: &LambCase, found: &[LambHistory]) -> Self {
        let row = |own: &LambHistory| Row {
            receiver: case.receivers[own.receiver].name.clone(),
            name: own.name,
            unit: own.unit,
            peak: own.peak(),
            error: own.error,
        };
        Self {
            output,
            times: case.times_s.len(),
            histories: found.iter().map(row).collect(),
        }
    }
}

impl Display for Report {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:20} {:>5} {:>12} {:>9}",
            "receiver", "", "peak", "error"
        )?;
        for row in &self.histories {
            writeln!(
                f,
                "{:20} {:>5} {:12.4e} {:9.1e} {}",
                row.receiver, row.name, row.peak, row.error, row.unit
            )?;
        }
        write!(
            f,
            "{} times written to {}",
            self.times,
            crate::failure::line(&self.output)
        )
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let path = &arguments.output;
    HISTORIES.check(path)?;
    let case = read_lamb(&arguments.case)?;
    let output = arguments.overwrite.claim(path, &case.inputs)?;
    if let Some(warning) = case.warning() {
        say(format!("warning: {warning}"));
    }
    let found = case.run()?;
    stage_lamb(&output, path, &case, &found)?.commit()?;
    show(
        arguments.json,
        &Report::of(path.display().to_string(), &case, &found),
    )
}
