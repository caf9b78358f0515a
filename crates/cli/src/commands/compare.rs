//! `hertzlamb compare`: how far histories differ from a reference.

use crate::arguments::Overwrite;
use crate::failure::{Failure, line, say, show};
use crate::report::short;
use clap::Args;
use figure::{Axis, Figure, Panel, Style, to_svg};
use formats::lamb::{Compared, compare_files};
use oracle::{Comparison, Limits};
use serde::Serialize;
use serde_json::{Value, json};
use std::fmt::{self, Display, Formatter};
use std::io::Write;
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  hertzlamb compare mine.csv exact.csv
  hertzlamb compare mine.csv exact.csv --map UZ1=near_uz_m --tolerance 0.02 -o compared.svg
  hertzlamb compare mine.csv exact.csv --time-tolerance 2e-6 --json";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Histories of another code: text with a header, a column of times and one for each history.
    theirs: PathBuf,
    /// Reference histories, such as those of `hertzlamb lamb`.
    ours: PathBuf,
    /// Largest relative error, the root mean square of the difference over that of the reference.
    #[arg(long, default_value_t = 0.05, value_parser = positive)]
    tolerance: f64,
    /// Largest shift in s. The error is then measured after the shift is removed. Default: shifts count as errors.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    time_tolerance: Option<f64>,
    /// Column of the other code and that of the reference with another name; may be repeated.
    #[arg(long, value_name = "THEIRS=OURS", value_parser = pair)]
    map: Vec<(String, String)>,
    /// Picture of both histories and their difference (SVG). Default: none.
    #[arg(short, long, value_name = "PICTURE.svg")]
    output: Option<PathBuf>,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overwrite: Overwrite,
}

fn positive(text: &str) -> Result<f64, String> {
    let number = text
        .parse()
        .ok()
        .filter(|x: &f64| *x > 0.0 && x.is_finite());
    number.ok_or_else(|| "it is outside (0, inf)".to_owned())
}

fn pair(text: &str) -> Result<(String, String), String> {
    let both = text
        .split_once('=')
        .map(|(a, b)| (a.trim().to_owned(), b.trim().to_owned()));
    both.ok_or_else(|| "THEIRS=OURS is required, such as UZ1=near_uz_m".to_owned())
}

struct Report {
    columns: Vec<Compared>,
    alone: Vec<String>,
}

impl Serialize for Report {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let row = |own: &Compared| {
            let found = &own.found;
            json!({
                "theirs": own.theirs, "ours": own.ours, "passed": found.passed, "error": found.error, "amplitude": found.amplitude,
                "shift_s": found.shift_s, "shifted_error": found.shifted_error, "spectral_error": found.spectral_error,
                "band_hz": found.band_hz, "span_s": [found.time_s.first(), found.time_s.last()], "samples": found.time_s.len(),
            })
        };
        let columns: Vec<Value> = self.columns.iter().map(row).collect();
        let passed = self.columns.iter().all(|own| own.found.passed);
        json!({ "passed": passed, "columns": columns, "ignored": self.alone }).serialize(serializer)
    }
}

impl Display for Report {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let width = self
            .columns
            .iter()
            .map(|own| own.theirs.chars().count())
            .fold(6, usize::max);
        write!(
            f,
            "{:width$}     error  amplitude      shift  without shift  spectrum",
            "column"
        )?;
        for own in &self.columns {
            let found = &own.found;
            let verdict = if found.passed {
                ""
            } else {
                "  above the tolerance"
            };
            let [error, shifted, spectral] =
                [found.error, found.shifted_error, found.spectral_error]
                    .map(|x| format!("{x:.2e}"));
            let shift = shift(found);
            let name = line(&own.theirs);
            write!(
                f,
                "\n{name:width$} {error:>9} {:10.4} {shift:>10} {shifted:>14} {spectral:>9}{verdict}",
                found.amplitude
            )?;
        }
        Ok(())
    }
}

/// The shift with its unit; one that rounding leaves is zero.
fn shift(found: &Comparison) -> String {
    /// Part of the time between two samples below which a shift is zero.
    const NONE: f64 = 1e-6;
    let [first, second] = [found.time_s[0], found.time_s[1]];
    if found.shift_s.abs() < NONE * (second - first) {
        return "0 s".to_owned();
    }
    short(found.shift_s, "s")
}

/// Both histories and the difference of each column.
fn picture(columns: &[Compared]) -> Figure {
    /// Columns that are drawn; more panels are too small to read.
    const MOST_PANELS: usize = 24;
    let mut figure = Figure::new("Compared histories");
    for own in columns.iter().take(MOST_PANELS) {
        let found = &own.found;
        let [theirs, ours] = &found.values;
        let curve = |value: &dyn Fn(usize) -> f64| {
            found
                .time_s
                .iter()
                .enumerate()
                .map(|(i, t)| (*t, value(i)))
                .collect::<Vec<_>>()
        };
        let panel = Panel::new(Axis::linear("time").si("s"), Axis::linear(&own.ours))
            .line("reference", Style::Plain, curve(&|i| ours[i]))
            .line("other", Style::Plain, curve(&|i| theirs[i]))
            .line("difference", Style::Plain, curve(&|i| theirs[i] - ours[i]));
        figure = figure.panel(panel);
    }
    figure
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let files = [&arguments.theirs, &arguments.ours];
    let inputs = files.map(|path| ("a file of histories", path.clone()));
    let claim = |path: &PathBuf| {
        output::Ending("a picture", &["svg"]).check(path)?;
        arguments.overwrite.claim(path, &inputs)
    };
    let output = arguments.output.as_ref().map(claim).transpose()?;
    let limits = Limits {
        tolerance: arguments.tolerance,
        time_tolerance_s: arguments.time_tolerance,
    };
    let (columns, alone) = compare_files(files.map(PathBuf::as_path), &arguments.map, limits)?;
    if !alone.is_empty() {
        say(format!(
            "note: without a column of the same name: {}",
            alone.join(", ")
        ));
    }
    if let Some(output) = output {
        let svg = to_svg(&picture(&columns)).map_err(Failure::work)?;
        output.write(|mut file| file.write_all(svg.as_bytes()))?;
    }
    let failed = columns.iter().filter(|own| !own.found.passed).count();
    let count = columns.len();
    show(arguments.json, &Report { columns, alone })?;
    if failed > 0 {
        return Err(Failure::work(format!(
            "{failed} of {count} columns are outside the tolerance"
        )));
    }
    Ok(())
}
