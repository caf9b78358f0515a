//! `hertzlamb chart`: speed against accuracy, and where methods fail.

use crate::arguments::Overwrite;
use crate::failure::{Failure, print, say};
use crate::progress::Bar;
use clap::Args;
use output::Folder;
use std::path::PathBuf;
use study::{Chart, Effort};

const EXAMPLES: &str = "Examples:
  hertzlamb chart --quick -o chart-quick
  hertzlamb chart -o chart-full --force
  hertzlamb chart --quick --check -o chart-check

The folder gets chart.csv, pictures.csv, report.md and the pictures as SVG and PNG.
Times are those of this machine; run it on an idle one.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Few settings and coarse maps: under a minute instead of many.
    #[arg(long)]
    quick: bool,
    /// Folder for the chart.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Fail unless the default path is on the Pareto front by time, or the report says why not.
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    overwrite: Overwrite,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let effort = if arguments.quick {
        Effort::Quick
    } else {
        Effort::Full
    };
    let folder = Folder::claim(&arguments.output, arguments.overwrite.existing())?;
    let old = arguments.output.join("chart.h5");
    if old.exists() {
        let old = old.display();
        say(format!(
            "note: {old} is of an earlier version and stays; this one writes CSV files"
        ));
    }
    let chart = Chart::run(effort, &Bar::new()).map_err(Failure::in_part)?;
    chart.write(&folder).map_err(Failure::in_part)?;
    print(format!(
        "{}: {} rows, {} pictures, {:.0} s\n{}",
        arguments.output.join("report.md").display(),
        chart.records.len(),
        chart.diagrams.len() + chart.maps.len(),
        chart.wall_s,
        chart.machine
    ))?;
    match chart.unexplained() {
        ahead if arguments.check && !ahead.is_empty() => Err(Failure::work(format!(
            "the default path is not on the Pareto front at {}",
            ahead.join("; ")
        ))),
        _ => Ok(()),
    }
}
