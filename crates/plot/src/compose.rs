//! From files to a figure.

use crate::error::{PlotError, only};
use crate::impacts::{frames_of, of_impacts};
use crate::request::{Drawn, Kind, Request};
use crate::sweep::of_sweep;
use crate::table::of_table;
use figure::Figure;
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
    match file {
        FileKind::Impact => of_impacts(&open(paths)?, request),
        FileKind::Sweep => of_sweep(&StoredSweep::open(only(paths, Kind::Sweep)?)?, request),
        FileKind::Table => of_table(only(paths, Kind::Errors)?, request),
        FileKind::SweepPart => Err(PlotError::unsuitable(&paths[0], file, Kind::Sweep)),
        FileKind::Chart => Err(PlotError::unsuitable(&paths[0], file, Kind::Impact)),
    }
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
    frames_of(only(&open(paths)?, kind)?, request)
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
