//! `hertzlamb plot`: pictures of what was computed.

use crate::failure::{Failure, print, say};
use crate::overwrite::Overwrite;
use clap::Args;
use clap::builder::PossibleValuesParser;
use contact::Choice;
use figure::{Figure, RenderError, to_pdf, to_png, to_svg};
use output::{Output, Role, apart};
use plot::{Kind, PlotError, Request, compose};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  hertzlamb plot drop.h5 -o drop.svg
  hertzlamb plot slow.h5 fast.h5 -o both.pdf
  hertzlamb plot drop.h5 --kind probes --quantity stress_zz -o stress.png";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Files of impacts or sweeps, or a kernel table; several impacts are drawn over each other.
    #[arg(required = true, value_name = "FILE.h5")]
    files: Vec<PathBuf>,
    /// The picture; its ending, .svg, .png or .pdf, says what it becomes.
    #[arg(short, long, value_name = "PICTURE")]
    output: PathBuf,
    /// What is shown; without it what suits the file.
    #[arg(long, value_name = "KIND", value_parser = kinds())]
    kind: Option<String>,
    /// Quantities by their names in the file, divided by commas.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    quantity: Vec<String>,
    /// Title; without it one that says what strikes.
    #[arg(long)]
    title: Option<String>,
    /// Width in pixels of 1/96 inch; 321 is a column of a journal.
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u16).range(160..=8000))]
    width: Option<u16>,
    /// Pixels of a PNG for each of its own.
    #[arg(long, value_name = "FACTOR", default_value_t = 2, value_parser = clap::value_parser!(u8).range(1..=4))]
    scale: u8,
    #[command(flatten)]
    overwrite: Overwrite,
}

fn kinds() -> PossibleValuesParser {
    let value = |kind: &Kind| clap::builder::PossibleValue::new(kind.name()).help(kind.meaning());
    PossibleValuesParser::new(Kind::ALL.iter().map(value))
}

/// What the picture becomes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Svg,
    Png,
    Pdf,
}

impl Format {
    fn of(path: &Path) -> Result<Self, Failure> {
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("svg") => Ok(Self::Svg),
            Some("png") => Ok(Self::Png),
            Some("pdf") => Ok(Self::Pdf),
            Some(_) | None => Err(Failure::input(format!(
                "{} ends neither in .svg nor in .png nor in .pdf",
                path.display()
            ))),
        }
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let format = Format::of(&arguments.output)?;
    let drawn_from = |path: &PathBuf| Role::new("a file", path);
    let inputs: Vec<Role> = arguments.files.iter().map(drawn_from).collect();
    apart(&[&arguments.output], &inputs)?;
    let output = Output::claim(&arguments.output, arguments.overwrite.existing())?;
    let request = Request {
        kind: arguments.kind.as_deref().and_then(Kind::named),
        quantities: arguments.quantity.clone(),
        title: arguments.title.clone(),
    };
    let mut drawn = compose(&arguments.files, &request)?;
    if let Some(width) = arguments.width {
        drawn.figure = sized(drawn.figure, f64::from(width));
    }
    let bytes = rendered(&drawn.figure, format, arguments.scale).map_err(Failure::work)?;
    output.write(|part| std::fs::write(part, &bytes))?;
    for note in &drawn.notes {
        say(format!("note: {note}"));
    }
    print(arguments.output.display())
}

/// Of another width, with text that suits it.
fn sized(figure: Figure, width: f64) -> Figure {
    let text = (figure.text * (width / figure.width).sqrt()).clamp(8.0, 16.0);
    figure.width(width).text(text)
}

fn rendered(figure: &Figure, format: Format, scale: u8) -> Result<Vec<u8>, RenderError> {
    match format {
        Format::Svg => to_svg(figure).map(String::into_bytes),
        Format::Png => to_png(figure, f32::from(scale)),
        Format::Pdf => to_pdf(figure),
    }
}

impl From<PlotError> for Failure {
    fn from(error: PlotError) -> Self {
        Self::input(error)
    }
}
