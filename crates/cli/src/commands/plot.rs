//! `hertzlamb plot`: pictures of results.

use crate::arguments::Overwrite;
use crate::failure::{Failure, line, print, say};
use clap::Args;
use clap::builder::PossibleValuesParser;
use contact::Choice;
use figure::{Figure, Scale, to_gif, to_pdf, to_png, to_svg};
use output::Role;
use plot::{PictureKind, PlotError, Request, animate, compose};
use std::io::Write;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  hertzlamb plot drop.h5 -o drop.svg
  hertzlamb plot slow.h5 fast.h5 -o both.pdf
  hertzlamb plot drop.h5 --kind probes --quantity stress_zz -o stress.png
  hertzlamb plot waves.vtkhdf -o waves.gif
  hertzlamb plot sweep.h5 --kind loss --at target.material=steel -o loss.svg
  hertzlamb plot kernels.h5 -o errors.svg";

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Results of impacts or of a sweep, or a kernel table; several impacts share one picture.
    #[arg(required = true, value_name = "FILE.h5")]
    files: Vec<PathBuf>,
    /// Picture to write. The file extension sets the format: .svg, .png, .pdf or .gif (an animation).
    #[arg(short, long, value_name = "PICTURE")]
    output: PathBuf,
    /// Kind of picture. Default: the one that suits the file.
    #[arg(long, value_name = "KIND", value_parser = kinds())]
    kind: Option<String>,
    /// Quantities by their names in the file, comma-separated.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    quantity: Vec<String>,
    /// Times in s at which fields are shown, comma-separated.
    #[arg(long, value_name = "SECONDS", value_delimiter = ',', value_parser = number)]
    times: Vec<f64>,
    /// Number of frames of a section. Default: 4 in a picture, up to 120 in an animation.
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=2000))]
    frames: Option<u16>,
    /// Limits in s of the time axis, or of the frames of a section.
    #[arg(long, value_name = "FROM:TO", value_parser = interval, allow_hyphen_values = true)]
    span: Option<(f64, f64)>,
    /// Key of a sweep on the x axis. Default: the key with the most numbers.
    #[arg(long, value_name = "KEY")]
    along: Option<String>,
    /// Fixed value of a key of a sweep; may be repeated for other keys.
    #[arg(long, value_name = "KEY=VALUE", value_parser = held)]
    at: Vec<(String, String)>,
    /// Limits of the colour scale, or of the y axis if there are no colours, in SI units.
    #[arg(long, value_name = "LOW:HIGH", value_parser = interval, allow_hyphen_values = true)]
    limits: Option<(f64, f64)>,
    /// Use a logarithmic scale for colours, the y axis or the values of a histogram. Signed values are shown by their magnitude.
    #[arg(long)]
    log: bool,
    /// Use a linear scale for colours, the y axis, the values of a histogram and the keys of a sweep.
    #[arg(long, conflicts_with = "log")]
    linear: bool,
    /// Title of the picture. Default: a description of the impact.
    #[arg(long)]
    title: Option<String>,
    /// Width in pixels of 1/96 inch; 321 fits a journal column.
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u16).range(160..=8000))]
    width: Option<u16>,
    /// Resolution of a PNG as a multiple of 96 pixels per inch. Default: 2.
    #[arg(long, value_name = "FACTOR", value_parser = clap::value_parser!(u8).range(1..=4))]
    scale: Option<u8>,
    #[command(flatten)]
    overwrite: Overwrite,
}

/// Parses KEY=VALUE.
fn held(text: &str) -> Result<(String, String), String> {
    let both = text.split_once('=');
    let both = both.map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned()));
    both.ok_or_else(|| format!("{text} is not KEY=VALUE, such as target.material=steel"))
}

/// Parses LOW:HIGH.
fn interval(text: &str) -> Result<(f64, f64), String> {
    let ends = text.split_once(':');
    let ends = ends.and_then(|(low, high)| Some((number(low).ok()?, number(high).ok()?)));
    ends.ok_or_else(|| format!("{text} is not LOW:HIGH, such as -2e6:2e6"))
}

/// Parses a finite number.
fn number(text: &str) -> Result<f64, String> {
    let found = text.trim().parse().ok().filter(|x: &f64| x.is_finite());
    found.ok_or_else(|| format!("{text} is not a finite number"))
}

fn kinds() -> PossibleValuesParser {
    let value =
        |kind: &PictureKind| clap::builder::PossibleValue::new(kind.name()).help(kind.meaning());
    PossibleValuesParser::new(PictureKind::ALL.iter().map(value))
}

/// The file extension of a picture, which sets its format.
fn ending(path: &Path) -> Result<String, Failure> {
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    let known = ending.filter(|end| ["svg", "png", "pdf", "gif"].contains(&end.as_str()));
    let path = path.display();
    let otherwise = || {
        Failure::input(format!(
            "{path} does not have the extension .svg, .png, .pdf or .gif"
        ))
    };
    known.ok_or_else(otherwise)
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let ending = ending(&arguments.output)?;
    if ending != "png" && arguments.scale.is_some() {
        let output = arguments.output.display();
        let sentence = format!("--scale does not apply to {output}: only a .png has a resolution");
        return Err(Failure::input(sentence));
    }
    let files = arguments.files.iter().cloned();
    let inputs: Vec<Role> = files.map(|path| ("a file", path)).collect();
    let output = arguments.overwrite.claim(&arguments.output, &inputs)?;
    let request = Request {
        kind: arguments.kind.as_deref().and_then(PictureKind::named),
        quantities: arguments.quantity.clone(),
        times_s: arguments.times.clone(),
        frames: arguments.frames.map(usize::from),
        along: arguments.along.clone(),
        at: arguments.at.clone(),
        limits: arguments.limits,
        span_s: arguments.span,
        scale: match (arguments.log, arguments.linear) {
            (true, _) => Some(Scale::Logarithmic),
            (_, true) => Some(Scale::Linear),
            (false, false) => None,
        },
        title: arguments.title.clone(),
    };
    let size = |figure| match arguments.width {
        Some(width) => sized(figure, f64::from(width)),
        None => figure,
    };
    let (bytes, notes) = if ending == "gif" {
        let (figures, notes) = animate(&arguments.files, &request).map_err(failure)?;
        let figures: Vec<Figure> = figures.into_iter().map(size).collect();
        (to_gif(&figures, 1.0, FRAME_S), notes)
    } else {
        let (figure, notes) = compose(&arguments.files, &request).map_err(failure)?;
        let figure = size(figure);
        let bytes = match ending.as_str() {
            "png" => to_png(&figure, f32::from(arguments.scale.unwrap_or(PNG_SCALE))),
            "pdf" => to_pdf(&figure),
            _ => to_svg(&figure).map(String::into_bytes),
        };
        (bytes, notes)
    };
    let bytes = bytes.map_err(Failure::work)?;
    output.write(|mut file| file.write_all(&bytes))?;
    for note in notes {
        say(format!("note: {note}"));
    }
    print(line(arguments.output.display()))
}

/// Failure to draw a picture, with a hint.
fn failure(error: PlotError) -> Failure {
    let hint = match &error {
        PlotError::NoAxis(_) => "; sweep --csv writes its rows".to_owned(),
        PlotError::TooManyCurves {
            example: Some(example),
            ..
        } => format!(", such as by --at {example}"),
        PlotError::NoSlice(_) => ": `hertzlamb table verify` lists the defects".to_owned(),
        _ => String::new(),
    };
    Failure::from(error).hint_if(true, &hint)
}

/// Default of `--scale`.
const PNG_SCALE: u8 = 2;

/// Time in s for which a frame of an animation is shown.
const FRAME_S: f64 = 0.06;

/// In pictures narrower than this, panels are stacked in one column.
const COLUMN: f64 = 480.0;

/// The figure with another width and a text size that suits it.
fn sized(mut figure: Figure, width: f64) -> Figure {
    if width < COLUMN {
        figure.columns = 1;
    }
    figure.text = (figure.text * (width / figure.width).sqrt()).clamp(8.0, 16.0);
    figure.width(width)
}
