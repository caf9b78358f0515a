//! From files to a figure.

use crate::error::{PlotError, only};
use crate::impacts::{frames_of, of_impacts};
use crate::request::{Drawn, Kind, Request};
use crate::sweep::of_sweep;
use crate::table::of_table;
use figure::{ColourMap, Figure, Layer, Scale};
use formats::stored::{FileKind, StoredImpact, StoredSweep, file_kind};
use std::path::PathBuf;

/// Composes a figure of one or several files of one kind.
pub fn compose(paths: &[PathBuf], request: &Request) -> Result<Drawn, PlotError> {
    let file = common_kind(paths)?;
    if let Some(kind) = request.kind
        && kind.file() != file
    {
        return Err(PlotError::unsuitable(&paths[0], file, kind));
    }
    let mut drawn = match file {
        FileKind::Impact => of_impacts(&open(paths)?, request)?,
        FileKind::Sweep => of_sweep(&StoredSweep::open(only(paths, Kind::Sweep)?)?, request)?,
        FileKind::Table => of_table(only(paths, Kind::Errors)?, request)?,
        FileKind::SweepPart => {
            return Err(PlotError::unsuitable(&paths[0], file, Kind::Sweep));
        }
        FileKind::Chart => return Err(PlotError::unsuitable(&paths[0], file, Kind::Impact)),
    };
    scale(&mut drawn.figure, request)?;
    Ok(drawn)
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
        let mut names = figure
            .panels
            .windows(2)
            .map(|pair| pair[0].y.quantity == pair[1].y.quantity);
        if !names.all(|same| same) {
            return refused("it shows several quantities, choose one");
        }
    }
    let is_linear = request.limits.is_some_and(|(low, _)| low <= 0.0);
    for panel in &mut figure.panels {
        let mut has_colours = false;
        for layer in &mut panel.layers {
            let Layer::Image(image) = layer else {
                continue;
            };
            has_colours = true;
            if request.logarithmic {
                if image.map == ColourMap::Diverging {
                    image.colours.quantity = format!("size of the {}", image.colours.quantity);
                    image
                        .values
                        .iter_mut()
                        .for_each(|value| *value = value.abs());
                }
                if image.colours.scale == Scale::Linear {
                    let largest = image.values.iter().copied().fold(0.0, f64::max);
                    image.colours.range = Some((1e-4 * largest, largest));
                }
                image.map = ColourMap::Sequential;
                image.colours.scale = Scale::Logarithmic;
            }
            if is_linear {
                image.colours.scale = Scale::Linear;
            }
            image.colours.range = request.limits.or(image.colours.range);
        }
        if !has_colours {
            if request.logarithmic {
                panel.y.scale = Scale::Logarithmic;
            }
            if is_linear {
                panel.y.scale = Scale::Linear;
            }
            panel.y.range = request.limits.or(panel.y.range);
        }
    }
    Ok(())
}

/// Composes the frames of an animation of a section, one figure each.
pub fn animate(
    paths: &[PathBuf],
    request: &Request,
) -> Result<(Vec<Figure>, Vec<String>), PlotError> {
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
    let mut common: Option<(&PathBuf, FileKind)> = None;
    for path in paths {
        let second = file_kind(path)?;
        let (first_path, first) = *common.get_or_insert((path, second));
        if second != first {
            let sentence = format!(
                "{} is {first}, and {} is {second}: one picture shows files of one kind",
                first_path.display(),
                path.display()
            );
            return Err(PlotError::refused(Some(path), sentence));
        }
    }
    Ok(common.map_or(FileKind::Impact, |(_, kind)| kind))
}
