//! From files to a figure.

use crate::error::{Drawn, PlotError, kind_of, only};
use crate::impacts::{frames_of, of_impacts};
use crate::request::{Kind, Request};
use crate::sweep::of_sweep;
use crate::table::of_table;
use contact::Choice;
use figure::{Axis, ColourMap, Figure, Image, Layer, Scale};
use formats::stored::{FileKind, StoredImpact, file_kind};
use std::path::PathBuf;

/// Composes a figure of one or several files of one kind; and sentences for its user: what is not shown, and how to see it.
pub fn compose(paths: &[PathBuf], request: &Request) -> Drawn<Figure> {
    let file = common_kind(paths)?;
    // a kind of picture that a file of another kind does not give
    let unsuitable = |kind| {
        let kinds = Kind::ALL.iter().filter(|kind| kind.file() == file);
        let allowed = match &kinds.map(|kind| kind.name()).collect::<Vec<_>>()[..] {
            [] => "none".to_owned(),
            names => names.join(", "),
        };
        let path = paths[0].display();
        let sentence = format!("{path} is {file}, which has no picture {kind}; it has {allowed}");
        Err(PlotError::refused(Some(&paths[0]), sentence))
    };
    if let Some(kind) = request.kind.filter(|kind| kind.file() != file) {
        return unsuitable(kind);
    }
    let (mut figure, notes) = match file {
        FileKind::Impact => of_impacts(&open(paths)?, request)?,
        FileKind::Sweep => (of_sweep(only(paths, Kind::Sweep)?, request)?, Vec::new()),
        FileKind::Table => {
            let kind = kind_of(request, Kind::Errors)?;
            (of_table(only(paths, kind)?, request)?, Vec::new())
        }
        FileKind::SweepPart => return unsuitable(Kind::Sweep),
    };
    scale(&mut figure, request)?;
    Ok((figure, notes))
}

/// Shows what is asked for: limits, and sizes by their ratios; of colours where there are some, else of the y axis.
/// Limits that are not above zero make a scale linear that a kind of picture chooses to be logarithmic.
fn scale(figure: &mut Figure, request: &Request) -> Result<(), PlotError> {
    if let Some((low, high)) = request.limits {
        let refused = |why| {
            let [low, high] = [low, high].map(fault::number);
            let sentence = format!("the limits {low}:{high} are not those of a picture: {why}");
            Err(PlotError::refused(None, sentence))
        };
        if !(low < high && high.is_finite()) {
            return refused("the first has to be below the second");
        }
        if request.logarithmic && low <= 0.0 {
            return refused("sizes by their ratios are above zero");
        }
        let mut quantities = figure.panels.iter().map(|panel| &panel.y.quantity);
        let first = quantities.next();
        if quantities.any(|quantity| Some(quantity) != first) {
            return refused("it shows several quantities, choose one");
        }
    }
    let asked = |axis: &mut Axis| {
        if request.logarithmic {
            axis.scale = Scale::Logarithmic;
        }
        if request.limits.is_some_and(|(low, _)| low <= 0.0) {
            axis.scale = Scale::Linear;
        }
        axis.range = request.limits.or(axis.range);
    };
    for panel in &mut figure.panels {
        let mut has_colours = false;
        for layer in &mut panel.layers {
            if let Layer::Image(image) = layer {
                has_colours = true;
                if request.logarithmic {
                    show_sizes(image);
                }
                asked(&mut image.colours);
            }
        }
        if !has_colours {
            asked(&mut panel.y);
        }
    }
    Ok(())
}

/// Sizes in place of values with a sign, over four decades.
fn show_sizes(image: &mut Image) {
    if image.map == ColourMap::Diverging {
        image.colours.quantity = format!("size of the {}", image.colours.quantity);
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

/// Composes the frames of an animation of a section, one figure each; and sentences for its user.
pub fn animate(paths: &[PathBuf], request: &Request) -> Drawn<Vec<Figure>> {
    let file = common_kind(paths)?;
    let kind = request.kind.unwrap_or(Kind::Waves);
    if file != FileKind::Impact || kind != Kind::Waves {
        let path = &paths[0];
        let shown = (request.kind).map_or_else(String::new, |kind| format!(", shown as {kind}"));
        let sentence = format!(
            "an animation shows the waves in the section of an impact, and {} is {file}{shown}",
            path.display()
        );
        return Err(PlotError::refused(Some(path), sentence));
    }
    let (mut figures, notes) = frames_of(only(&open(paths)?, kind)?, request)?;
    for figure in &mut figures {
        scale(figure, request)?;
    }
    Ok((figures, notes))
}

fn open(paths: &[PathBuf]) -> Result<Vec<StoredImpact>, PlotError> {
    let open = |path: &PathBuf| StoredImpact::open(path).map_err(PlotError::from);
    paths.iter().map(open).collect()
}

/// What all files are.
fn common_kind(paths: &[PathBuf]) -> Result<FileKind, PlotError> {
    let first = file_kind(&paths[0])?;
    for path in &paths[1..] {
        let second = file_kind(path)?;
        if second != first {
            let sentence = format!(
                "{} is {first}, and {} is {second}: one picture shows files of one kind",
                paths[0].display(),
                path.display()
            );
            return Err(PlotError::refused(Some(path), sentence));
        }
    }
    Ok(first)
}
