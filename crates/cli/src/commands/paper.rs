//! `hertzlamb paper`: comparison of the source paper's numbers and figures with those of this program.

use crate::arguments::Overwrite;
use crate::failure::{Failure, line, print};
use clap::Args;
use output::Folder;
use paper::Redone;
use std::path::PathBuf;

const EXAMPLES: &str = "Example:
  hertzlamb paper -o paper

Writes report.md, numbers.csv and claims.csv.
Also writes an SVG, a PNG and a CSV for each of Figures 4 to 11 and for a figure of the time step.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Folder for the report.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    #[command(flatten)]
    overwrite: Overwrite,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let folder = Folder::claim(&arguments.output, arguments.overwrite.existing())?;
    let redone = Redone::compute().map_err(Failure::in_part)?;
    redone.write(&folder).map_err(Failure::in_part)?;
    let sections = redone.numbers.sections.iter();
    let rows = sections.map(|section| section.rows.len());
    print(format!(
        "{}: {} numbers, {} figures",
        line(arguments.output.join("report.md").display()),
        rows.sum::<usize>(),
        redone.figures.len()
    ))
}
