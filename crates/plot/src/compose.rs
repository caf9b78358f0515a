//! From files to a figure.

use crate::error::PlotError;
use crate::kind::Kind;
use crate::of_impacts::{frames_of, of_impacts};
use crate::of_sweep::of_sweep;
use crate::of_table::of_table;
use crate::request::{Drawn, Request};
use figure::Figure;
use formats::stored::{FileKind, StoredImpact, StoredSweep, file_kind};
use std::path::{Path, PathBuf};

/// Composes a figure of one or several files of one kind.
///
/// # Errors
/// [`PlotError`].
pub fn compose(paths: &[PathBuf], request: &Request) -> Result<Drawn, PlotError> {
    let file = common_kind(paths)?;
    if let Some(kind) = request.kind
        && kind.file() != file
    {
        return Err(unsuitable(&paths[0], file, kind));
    }
    match file {
        FileKind::Impact => of_impacts(&open(paths)?, request),
        FileKind::Sweep => of_sweep(&StoredSweep::open(only(paths, Kind::Sweep)?)?, request),
        FileKind::Table => of_table(only(paths, Kind::Errors)?, request),
        FileKind::SweepPart => Err(unsuitable(&paths[0], file, Kind::Sweep)),
        FileKind::Chart => Err(unsuitable(&paths[0], file, Kind::Impact)),
    }
}

/// Composes the frames of an animation of a section, one figure each.
///
/// # Errors
/// [`PlotError`].
pub fn animate(
    paths: &[PathBuf],
    request: &Request,
) -> Result<(Vec<Figure>, Vec<String>), PlotError> {
    let file = common_kind(paths)?;
    let kind = request.kind.unwrap_or(Kind::Waves);
    if file != FileKind::Impact || kind != Kind::Waves {
        return Err(PlotError::NotMoving {
            path: paths[0].clone(),
            found: file,
            kind: request.kind,
        });
    }
    let impacts = open(paths)?;
    let [impact] = impacts.as_slice() else {
        return Err(PlotError::OneFile {
            kind,
            given: impacts.len(),
        });
    };
    frames_of(impact, request)
}

/// The only path.
fn only(paths: &[PathBuf], kind: Kind) -> Result<&Path, PlotError> {
    match paths {
        [only] => Ok(only),
        several => Err(PlotError::OneFile {
            kind,
            given: several.len(),
        }),
    }
}

fn open(paths: &[PathBuf]) -> Result<Vec<StoredImpact>, PlotError> {
    let open = |path: &PathBuf| StoredImpact::open(path).map_err(PlotError::from);
    paths.iter().map(open).collect()
}

fn unsuitable(path: &Path, found: FileKind, kind: Kind) -> PlotError {
    PlotError::Unsuitable {
        path: path.to_owned(),
        found,
        kind,
        allowed: match Kind::of(found).as_slice() {
            [] => "none".to_owned(),
            names => names.join(", "),
        },
    }
}

/// What all files are.
fn common_kind(paths: &[PathBuf]) -> Result<FileKind, PlotError> {
    let mut kinds = paths
        .iter()
        .map(|path| file_kind(path).map(|kind| (path, kind)));
    let Some(first) = kinds.next() else {
        return Ok(FileKind::Impact);
    };
    let (first_path, first) = first?;
    for found in kinds {
        let (path, second) = found?;
        if second != first {
            return Err(PlotError::Mixed {
                paths: [first_path.clone(), path.clone()],
                first,
                second,
            });
        }
    }
    Ok(first)
}
