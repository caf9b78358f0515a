//! Composes figures from files.

use crate::error::{Drawn, PlotError};
use crate::impacts::{frames_of, of_impacts};
use crate::request::{PictureKind, Request, only};
use crate::sweep::of_sweep;
use crate::table::of_table;
use contact::Choice;
use figure::{Axis, ColourMap, Figure, Image, Layer, Line, Panel, Scale};
use formats::stored::{FileKind, StoredImpact, file_kind};
use std::path::PathBuf;

/// Composes a figure of one or several files of the same kind. Also returns notes for the user, such as what is not
/// shown and how to see it.
pub fn compose(paths: &[PathBuf], request: &Request) -> Drawn<Figure> {
    let file = common_kind(paths)?;
    // a kind of picture that requires another kind of file
    let unsuitable = |kind| {
        let kinds = PictureKind::ALL.iter().filter(|kind| kind.file() == file);
        let allowed = match &kinds.map(|kind| kind.name()).collect::<Vec<_>>()[..] {
            [] => "none".to_owned(),
            names => names.join(", "),
        };
        let path = paths[0].display();
        let sentence = format!(
            "{path} is {file}, for which the picture {kind} does not exist; choose one of {allowed}"
        );
        Err(PlotError::refused(Some(&paths[0]), sentence))
    };
    if let Some(kind) = request.kind.filter(|kind| kind.file() != file) {
        return unsuitable(kind);
    }
    let (mut figure, notes) = match file {
        FileKind::Impact => of_impacts(&open(paths)?, request)?,
        FileKind::Sweep => of_sweep(only(paths, PictureKind::Sweep)?, request)?,
        FileKind::Table => {
            let kind = request.kind_or(PictureKind::Errors)?;
            (of_table(only(paths, kind)?, request)?, Vec::new())
        }
        FileKind::SweepPart => return unsuitable(PictureKind::Sweep),
    };
    scale(&mut figure, request, file)?;
    Ok((figure, notes))
}

/// Applies the requested limits and scale to the colours, or else to the y axis. Limits that are not above zero make a
/// scale linear that would be logarithmic by default. The axes of a sweep have their scale already.
fn scale(figure: &mut Figure, request: &Request, file: FileKind) -> Result<(), PlotError> {
    let scale = request.scale.filter(|_| file != FileKind::Sweep);
    if let Some((low, high)) = request.limits {
        let refused = |why| {
            let [low, high] = [low, high].map(fault::number);
            let sentence = format!("the limits {low}:{high} cannot be used: {why}");
            Err(PlotError::refused(None, sentence))
        };
        if !(low < high && high.is_finite()) {
            return refused("the first must be below the second");
        }
        if request.scale == Some(Scale::Logarithmic) && low <= 0.0 {
            return refused("a logarithmic scale needs values above zero");
        }
        let mut quantities = figure.panels.iter().map(|panel| &panel.y.quantity);
        let first = quantities.next();
        if quantities.any(|quantity| Some(quantity) != first) {
            return refused("the picture shows several quantities, choose one");
        }
    }
    let asked = |axis: &mut Axis| {
        let from_zero = request.limits.is_some_and(|(low, _)| low <= 0.0);
        let scale = from_zero.then_some(Scale::Linear).or(scale);
        if let (Some(Scale::Linear), Scale::Logarithmic, Some((_, high))) =
            (scale, axis.scale, axis.range)
        {
            axis.range = Some((0.0, high));
        }
        axis.scale = scale.unwrap_or(axis.scale);
        axis.range = request.limits.or(axis.range);
    };
    for panel in &mut figure.panels {
        let mut has_colours = false;
        for layer in &mut panel.layers {
            if let Layer::Image(image) = layer {
                has_colours = true;
                if scale == Some(Scale::Logarithmic) {
                    show_sizes(image);
                }
                asked(&mut image.colours);
            }
        }
        if !has_colours {
            if scale == Some(Scale::Logarithmic) {
                show_sizes_of_curves(panel);
            }
            asked(&mut panel.y);
        }
    }
    figure.panels.iter().try_for_each(shows_something)
}

/// Name of an axis that shows magnitudes.
fn size_of(quantity: &str) -> String {
    format!("magnitude of the {quantity}")
}

/// Replaces signed values by their magnitude, over four decades.
fn show_sizes(image: &mut Image) {
    if image.map == ColourMap::Diverging {
        image.colours.quantity = size_of(&image.colours.quantity);
        for value in &mut image.values {
            *value = value.abs();
        }
    }
    if image.colours.scale == Scale::Linear {
        let largest = image.values.iter().copied().fold(0.0, f64::max);
        image.colours.range = Some((1e-4 * largest, largest));
    }
    image.map = ColourMap::Sequential;
}

/// Smallest relative magnitude in curves of signed values: smaller values are rounding errors near a zero. A test of
/// signed histories fails without it.
const SIGNED_DECADES: f64 = 1e-6;

/// Replaces the values of curves with negative values by their magnitude, and likewise their bands.
fn show_sizes_of_curves(panel: &mut Panel) {
    let mut lines: Vec<&mut Line> = Vec::new();
    for layer in &mut panel.layers {
        if let Layer::Line(line) = layer {
            lines.push(line);
        }
    }
    let values = || {
        lines
            .iter()
            .flat_map(|line| line.points.iter().map(|p| p.1))
    };
    if values().all(|value| value >= 0.0) {
        return;
    }
    let largest = values().map(f64::abs).fold(0.0, f64::max);
    let low = SIGNED_DECADES * largest;
    for line in lines {
        line.points.iter_mut().for_each(|p| p.1 = p.1.abs());
        let [lower, upper] = &mut line.band;
        for (a, b) in lower.iter_mut().zip(upper) {
            let crosses = a.1 < 0.0 && b.1 > 0.0;
            let [one, other] = [a.1.abs(), b.1.abs()];
            // a band that contains zero extends to the end of the axis
            a.1 = if crosses {
                low
            } else {
                one.min(other).max(low)
            };
            b.1 = one.max(other).max(low);
        }
    }
    panel.y.quantity = size_of(&panel.y.quantity);
    panel.y.range = (largest > 0.0).then_some((low, 2.0 * largest));
}

/// Checks that a logarithmic axis has a positive value to show.
fn shows_something(panel: &Panel) -> Result<(), PlotError> {
    let lines = || panel.layers.iter().filter_map(Layer::as_line);
    let shown = |line: &Line| line.points.iter().any(|p| panel.y.scale.shows(p.1));
    if panel.y.scale == Scale::Linear || lines().next().is_none() || lines().any(shown) {
        return Ok(());
    }
    let quantity = &panel.y.quantity;
    let sentence =
        format!("{quantity}: no value is above zero, so a logarithmic axis has nothing to show");
    Err(PlotError::refused(None, sentence))
}

/// Composes the frames of an animation of a section, one figure each. Also returns notes for the user.
pub fn animate(paths: &[PathBuf], request: &Request) -> Drawn<Vec<Figure>> {
    let file = common_kind(paths)?;
    let kind = request.kind_or(PictureKind::Waves)?;
    if file != FileKind::Impact || kind != PictureKind::Waves {
        let path = &paths[0];
        let shown = (request.kind).map_or_else(String::new, |kind| format!(", shown as {kind}"));
        let sentence = format!(
            "an animation shows the waves in the section of an impact, but {} is {file}{shown}",
            path.display()
        );
        return Err(PlotError::refused(Some(path), sentence));
    }
    let (mut figures, notes) = frames_of(only(&open(paths)?, kind)?, request)?;
    for figure in &mut figures {
        scale(figure, request, file)?;
    }
    Ok((figures, notes))
}

fn open(paths: &[PathBuf]) -> Result<Vec<StoredImpact>, PlotError> {
    let open = |path: &PathBuf| StoredImpact::open(path).map_err(PlotError::from);
    paths.iter().map(open).collect()
}

/// The common kind of all files.
fn common_kind(paths: &[PathBuf]) -> Result<FileKind, PlotError> {
    let first = file_kind(&paths[0])?;
    for path in &paths[1..] {
        let second = file_kind(path)?;
        if second != first {
            let sentence = format!(
                "{} is {first}, but {} is {second}: all files of a picture must be of the same kind",
                paths[0].display(),
                path.display()
            );
            return Err(PlotError::refused(Some(path), sentence));
        }
    }
    Ok(first)
}
