//! `hertzlamb chart`: speed and accuracy of all methods, and maps of their failures.

use crate::arguments::Overwrite;
use crate::failure::{Failure, line, print};
use crate::progress::Bar;
use clap::Args;
use output::Folder;
use std::path::PathBuf;
use study::{Chart, Effort};

const EXAMPLES: &str = "Examples:
  hertzlamb chart --quick -o chart-quick
  hertzlamb chart -o chart-full --force
  hertzlamb chart --quick --check -o chart-check

Writes chart.csv, pictures.csv, report.md and the pictures as SVG and PNG.
Times are measured on this machine, which should be idle.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Use few settings and coarse maps: under a minute instead of many.
    #[arg(long)]
    quick: bool,
    /// Folder for the chart.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Fail if the default method is not on the Pareto front of time and the report has no reason for that.
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
    let chart = Chart::run(effort, &Bar::new()).map_err(Failure::in_part)?;
    chart.write(&folder).map_err(Failure::in_part)?;
    let report = arguments.output.join("report.md");
    let (rows, pictures) = (chart.records.len(), chart.diagrams.len() + chart.maps.len());
    let (report, wall_s, machine) = (line(report.display()), chart.wall_s, &chart.machine);
    print(format!(
        "{report}: {rows} rows, {pictures} pictures, {wall_s:.0} s\n{machine}"
    ))?;
    let ahead = chart.unexplained().join("; ");
    if arguments.check && !ahead.is_empty() {
        let told = format!("the default method is not on the Pareto front at {ahead}");
        return Err(Failure::work(told));
    }
    Ok(())
}
