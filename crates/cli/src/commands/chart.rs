//! `hertzlamb chart`: speed against accuracy, and where methods fail.

use crate::failure::{Failure, print};
use crate::overwrite::Overwrite;
use crate::progress::Bar;
use clap::Args;
use output::Folder;
use std::path::PathBuf;
use study::{Chart, Effort, StudyError};

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
    let progress = Bar::new();
    let chart = Chart::run(effort, &progress).map_err(failure)?;
    progress.finish();
    chart.write(&folder).map_err(failure)?;
    print(format!(
        "{}: {} rows, {} pictures, {:.0} s",
        arguments.output.join("report.md").display(),
        chart.records.len(),
        chart.diagrams.len() + chart.maps.len(),
        chart.wall_s
    ))?;
    match chart.unexplained() {
        ahead if arguments.check && !ahead.is_empty() => Err(Failure::Work(format!(
            "the default path is not on the Pareto front at {}",
            ahead.join("; ")
        ))),
        _ => Ok(()),
    }
}

/// Files that cannot be written are told as everywhere, the rest is work that failed.
fn failure(error: StudyError) -> Failure {
    match error {
        StudyError::Output(error) => error.into(),
        StudyError::Domain(_)
        | StudyError::March(_)
        | StudyError::Body(_)
        | StudyError::Material(_)
        | StudyError::Growing(_)
        | StudyError::Contact(_)
        | StudyError::Field(_)
        | StudyError::Fields(_)
        | StudyError::Build(_)
        | StudyError::Table(_)
        | StudyError::Lookup(_)
        | StudyError::Picture { .. }
        | StudyError::Temporary(_) => Failure::work(error),
    }
}
