//! `hertzlamb export`: inputs of particle codes for the contact of a scene, and a table of its rebound over velocity.

mod case;
mod codes;
mod law;
mod motion;
mod table;

use crate::arguments::Overwrite;
use crate::failure::{Failure, lines, say, show};
use case::{Case, named};
use clap::{Args, ValueEnum};
use formats::read_with_inputs;
use impact::Run;
use law::{Code, LawReport, Laws};
use output::CSV;
use serde::Serialize;
use serde_json::{Map, Value};
use std::fmt::{self, Display, Formatter};
use std::io::Write;
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  hertzlamb export lammps scenes/first-impact.toml -o in.drop
  hertzlamb export yade scenes/first-impact.toml -o drop.py
  hertzlamb export table scenes/plastic-drop.toml --velocities 0.01,10 -o drop.csv
  hertzlamb export lammps scenes/plastic-drop.toml --target-diameter 0.005 -o in.pair

Run the files with `lmp -in in.drop` and `yade -n -x drop.py`: both print restitution, peak force and contact time.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Format of the file.
    format: Format,
    /// Scene file (TOML, see data-schema/scene.md); - is standard input.
    scene: PathBuf,
    /// File to write.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Replace the block by a free ball of this diameter in m.
    #[arg(long, value_name = "METRES", allow_negative_numbers = true)]
    target_diameter: Option<f64>,
    /// Velocities of a table in m/s, with logarithmic spacing. Default: from 1/100 of the scene's velocity up to that
    /// velocity.
    #[arg(long, value_name = "FROM,TO", value_delimiter = ',', num_args = 1)]
    velocities: Option<Vec<f64>>,
    /// Number of rows of a table. Default: 41.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=10_000))]
    rows: Option<u32>,
    #[command(flatten)]
    overwrite: Overwrite,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Input file for LAMMPS.
    Lammps,
    /// Script for YADE.
    Yade,
    /// CSV table of restitution, loss, contact time and peak force over velocity.
    Table,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Arguments { format, output, .. } = arguments;
    let (velocities, rows) = (arguments.velocities.as_deref(), arguments.rows);
    if *format == Format::Table {
        CSV.check(output)?;
    } else if velocities.is_some() || rows.is_some() {
        return Err(Failure::input(
            "--velocities and --rows apply only to the format table: leave them out",
        ));
    }
    let (scene, inputs) = read_with_inputs(&arguments.scene)?;
    let claimed = arguments.overwrite.claim(output, &inputs)?;
    let case = Case::new(&scene, arguments.target_diameter)?;
    let mut notes = case.notes.clone();
    let mut law = None;
    let mut laws = |code| {
        let laws = Laws::new(&case, code)?;
        notes.extend(laws.notes.iter().cloned());
        law = Some(laws.report());
        Ok::<_, Failure>((head(&case.run, &notes), laws))
    };
    let text = match format {
        Format::Lammps => {
            let (head, laws) = laws(Code::Lammps)?;
            head + &codes::lammps(&case, &laws)
        }
        Format::Yade => {
            let (head, laws) = laws(Code::Yade)?;
            head + &codes::yade(&case, &laws)
        }
        Format::Table => table::table(&case, velocities, rows.unwrap_or(41))?,
    };
    claimed.write(|mut file| file.write_all(text.as_bytes()))?;
    for warning in &case.run.warnings {
        say(format!("warning: {warning}"));
    }
    let results = named(&case.run).into_iter();
    let report = Exported {
        output: output.display().to_string(),
        law,
        results: results
            .map(|(name, value)| (name.to_owned(), value.into()))
            .collect(),
        notes,
    };
    show(arguments.json, &report)
}

/// Report of the written file.
#[derive(Serialize)]
struct Exported {
    output: String,
    /// Absent from a table.
    #[serde(skip_serializing_if = "Option::is_none")]
    law: Option<LawReport>,
    #[serde(flatten)]
    results: Map<String, Value>,
    notes: Vec<String>,
}

impl Display for Exported {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let written = lines([("written", &self.output)]);
        write!(f, "{}\n{written}", self.notes.join("\n"))
    }
}

/// Notes and warnings as comments, the same in all three formats.
fn head(run: &Run, notes: &[String]) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let mut text = format!("# hertzlamb {version}: SI units\n");
    let warnings = run.warnings.iter();
    let warnings = warnings.map(|warning| format!("warning: {warning}"));
    for note in notes.iter().cloned().chain(warnings) {
        text += &format!("# {note}\n");
    }
    text
}
