//! From files to a figure.

use crate::contact_panels::contact_panels;
use crate::error::PlotError;
use crate::kind::Kind;
use crate::labels::labels;
use crate::number::{digits, with_unit};
use crate::probe_panels::{FEW, probe_panels};
use crate::request::Request;
use figure::{Figure, Sharing};
use formats::stored::{FileKind, StoredImpact, file_kind};
use std::path::PathBuf;

/// A figure, and what its user should know.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// The figure.
    pub figure: Figure,
    /// Sentences: what is not shown, and how to see it.
    pub notes: Vec<String>,
}

/// Composes a figure of one or several files of one kind.
///
/// # Errors
/// [`PlotError`].
pub fn compose(paths: &[PathBuf], request: &Request) -> Result<Drawn, PlotError> {
    let file = common_kind(paths)?;
    let kind = match request.kind {
        None => match file {
            FileKind::Impact | FileKind::Sweep | FileKind::Table | FileKind::Chart => Kind::Impact,
        },
        Some(kind) => kind,
    };
    if kind.file() != file {
        return Err(PlotError::Unsuitable {
            path: paths[0].clone(),
            found: file,
            kind,
            allowed: Kind::of(file).join(", "),
        });
    }
    match kind {
        Kind::Impact | Kind::Probes => {
            let open = |path: &PathBuf| StoredImpact::open(path).map_err(PlotError::from);
            let impacts: Vec<StoredImpact> = paths.iter().map(open).collect::<Result<_, _>>()?;
            of_impacts(&impacts, kind, request)
        }
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

fn of_impacts(impacts: &[StoredImpact], kind: Kind, request: &Request) -> Result<Drawn, PlotError> {
    let labels = labels(impacts);
    let mut notes = Vec::new();
    let probes = match kind {
        Kind::Impact => probe_panels(impacts, &labels, &request.quantities, FEW)?,
        Kind::Probes => {
            let found = probe_panels(impacts, &labels, &request.quantities, usize::MAX)?;
            if found.panels.is_empty() {
                return Err(PlotError::Absent {
                    path: impacts[0].path().to_owned(),
                    what: "probes",
                    hint: "give the scene a [[probe]] with r_m and z_m",
                });
            }
            found
        }
    };
    if probes.left_out > 0 {
        notes.push(format!(
            "{} of {} probes are not shown: --kind probes shows all",
            probes.left_out,
            probes.left_out + probes.panels.len()
        ));
    }
    let contact = match kind {
        Kind::Impact => contact_panels(impacts, &labels)?,
        Kind::Probes => Vec::new(),
    };
    let columns = if probes.panels.is_empty() || contact.len() + probes.panels.len() < 3 {
        1
    } else {
        2
    };
    let mut figure = Figure::new(request.title.as_deref().unwrap_or(&title(impacts)))
        .subtitle(&subtitle(impacts))
        .columns(columns)
        .width(if columns == 1 { 760.0 } else { 1040.0 })
        .sharing(
            if columns == 1 && kind == Kind::Impact && probes.panels.is_empty() {
                Sharing::X
            } else {
                Sharing::Separate
            },
        );
    figure.panels = contact.into_iter().chain(probes.panels).collect();
    Ok(Drawn { figure, notes })
}

/// What strikes: `Impact of 110.5 mg at 1.98 m/s, tip radius 1.5 mm`.
pub(crate) fn title(impacts: &[StoredImpact]) -> String {
    if impacts.len() > 1 {
        return format!("{} impacts", impacts.len());
    }
    match &impacts[0].scene.strike {
        Some(strike) => format!(
            "Impact of {} at {}, tip radius {}",
            with_unit(strike.striker.mass_kg, "kg"),
            with_unit(strike.velocity_m_s, "m/s"),
            with_unit(strike.striker.tip_radius_m, "m")
        ),
        None => "A given force on the half-space".to_owned(),
    }
}

/// The most important numbers of a single impact.
pub(crate) fn subtitle(impacts: &[StoredImpact]) -> String {
    let [impact] = impacts else {
        return String::new();
    };
    let known = [
        ("peak force", "peak_force_n", "N"),
        ("contact", "contact_time_s", "s"),
        ("restitution", "restitution", "1"),
    ];
    let parts = known.iter().filter_map(|(name, key, unit)| {
        let value = impact.number(key)?;
        Some(match *unit {
            "1" => format!("{name} {}", digits(value)),
            unit => format!("{name} {}", with_unit(value, unit)),
        })
    });
    let mut text = parts.collect::<Vec<_>>().join(", ");
    text.push_str(&format!(" (model {})", impact.model.replace('_', " ")));
    text
}
