//! `hertzlamb export`: the contact of a scene as inputs of particle codes, and its rebound over velocities.

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

Run them with `lmp -in in.drop` and `yade -n -x drop.py`: both print restitution, peak force and contact time.";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// What is written.
    format: Format,
    /// Scene file (TOML, see data-schema/scene.md); - is standard input.
    scene: PathBuf,
    /// The file to write.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The target is no block but a ball of this diameter in m, free to move.
    #[arg(long, value_name = "METRES", allow_negative_numbers = true)]
    target_diameter: Option<f64>,
    /// Velocities of a table in m/s, evenly in their logarithm; a hundredth of the scene's up to it otherwise.
    #[arg(long, value_name = "FROM,TO", value_delimiter = ',', num_args = 1)]
    velocities: Option<Vec<f64>>,
    /// Rows of a table.
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
    /// An input of LAMMPS.
    Lammps,
    /// A script for YADE.
    Yade,
    /// Restitution, loss, contact time and peak force against velocity, as CSV.
    Table,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Arguments { format, output, .. } = arguments;
    let (velocities, rows) = (arguments.velocities.as_deref(), arguments.rows);
    if *format == Format::Table {
        CSV.check(output)?;
    } else if velocities.is_some() || rows.is_some() {
        return Err(Failure::input(
            "--velocities and --rows are those of a table: leave them out",
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

/// The file that was written, and what it holds.
#[derive(Serialize)]
struct Exported {
    output: String,
    /// Of a file with a force law.
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

/// Notes and warnings as comments, which all three formats have in the same way.
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
