//! Figures of impacts: one kind of picture after the other.

use crate::axis_profile::axis_profile;
use crate::contact_panels::contact_panels;
use crate::error::PlotError;
use crate::kind::Kind;
use crate::labels::labels;
use crate::number::{digits, with_unit};
use crate::peak::peak;
use crate::probe_panels::{FEW, probe_panels};
use crate::request::{Drawn, Request};
use crate::space_time::{Path, space_time};
use crate::spectrum::spectrum;
use crate::waves::frames;
use contact::Shape;
use figure::{Figure, Panel, Sharing};
use formats::stored::{FileKind, StoredImpact};

/// Frames of a picture.
const FRAMES: usize = 4;

/// Frames of an animation, at most.
const MOST_FRAMES: usize = 120;

/// The figure of some impacts.
pub(crate) fn of_impacts(impacts: &[StoredImpact], request: &Request) -> Result<Drawn, PlotError> {
    let suits = match impacts {
        [only] if only.section()?.is_some() => Kind::Waves,
        _ => Kind::Impact,
    };
    let kind = request.kind.unwrap_or(suits);
    let one = || match impacts {
        [only] => Ok(only),
        several => Err(PlotError::OneFile {
            kind,
            given: several.len(),
        }),
    };
    let figure = headed(impacts, request);
    let single = |panel: Panel| Drawn {
        figure: figure.clone().width(760.0).panel(panel),
        notes: Vec::new(),
    };
    match kind {
        Kind::Impact | Kind::Probes => histories(impacts, kind, request),
        Kind::Spectrum => Ok(single(spectrum(impacts, &labels(impacts))?)),
        Kind::Peak => Ok(single(peak(one()?, request)?)),
        Kind::Axis => Ok(single(axis_profile(one()?, request)?)),
        Kind::Surface => Ok(single(space_time(one()?, request, Path::Surface)?)),
        Kind::Depth => Ok(single(space_time(one()?, request, Path::Axis)?)),
        Kind::Sweep | Kind::Loss | Kind::Histogram | Kind::Errors => Err(PlotError::Unsuitable {
            path: impacts[0].path().to_owned(),
            found: FileKind::Impact,
            kind,
            allowed: Kind::of(FileKind::Impact).join(", "),
        }),
        Kind::Waves => {
            let found = frames(one()?, request, request.frames.unwrap_or(FRAMES))?;
            let columns = if found.panels.len() > 4 { 3 } else { 2 };
            let mut figure = figure
                .width(960.0)
                .columns(columns.min(found.panels.len()))
                .sharing(Sharing::Both)
                .common_colour_bar();
            figure.panels = found.panels;
            Ok(Drawn {
                figure,
                notes: found.notes,
            })
        }
    }
}

/// The frames of an animation, a figure each, and what its user should know.
pub(crate) fn frames_of(
    impact: &StoredImpact,
    request: &Request,
) -> Result<(Vec<Figure>, Vec<String>), PlotError> {
    let count = request.frames.unwrap_or(MOST_FRAMES);
    let found = frames(impact, request, count)?;
    let base = headed(std::slice::from_ref(impact), request).width(720.0);
    let figures = found
        .panels
        .into_iter()
        .map(|panel| base.clone().panel(panel));
    Ok((figures.collect(), found.notes))
}

/// A figure without panels, with title and subtitle.
fn headed(impacts: &[StoredImpact], request: &Request) -> Figure {
    let title = request.title.clone().unwrap_or_else(|| title(impacts));
    Figure::new(&title).subtitle(&subtitle(impacts))
}

/// Contacts and probes over time.
fn histories(impacts: &[StoredImpact], kind: Kind, request: &Request) -> Result<Drawn, PlotError> {
    let labels = labels(impacts);
    let mut notes = Vec::new();
    let is_all = kind == Kind::Probes;
    let most = if is_all { usize::MAX } else { FEW };
    let probes = probe_panels(impacts, &labels, &request.quantities, most)?;
    if is_all && probes.panels.is_empty() {
        return Err(PlotError::Absent {
            path: impacts[0].path().to_owned(),
            what: "probes",
            hint: "give the scene a [[probe]] with r_m and z_m",
        });
    }
    if probes.left_out > 0 {
        notes.push(format!(
            "{} probes are not shown: --kind probes shows all",
            probes.left_out
        ));
    }
    let contact = if is_all {
        Vec::new()
    } else {
        contact_panels(impacts, &labels)?
    };
    let alone = probes.panels.is_empty();
    let figure = headed(impacts, request);
    let mut figure = if alone || contact.len() + probes.panels.len() < 3 {
        figure.width(760.0)
    } else {
        figure.columns(2).width(1040.0)
    };
    if alone {
        figure = figure.sharing(Sharing::X);
    }
    figure.panels = contact.into_iter().chain(probes.panels).collect();
    Ok(Drawn { figure, notes })
}

/// What strikes: `A ball of 3 mm strikes at 1.98 m/s`, or its mass and tip.
fn title(impacts: &[StoredImpact]) -> String {
    if impacts.len() > 1 {
        return format!("{} impacts", impacts.len());
    }
    match &impacts[0].scene.strike {
        Some(strike) => {
            let speed = with_unit(strike.velocity_m_s, "m/s");
            match strike.striker.shape {
                Some(Shape::Ball { diameter_m }) => {
                    let size = with_unit(diameter_m, "m");
                    format!("A ball of {size} strikes at {speed}")
                }
                Some(Shape::Rod {
                    length_m,
                    diameter_m,
                    ..
                }) => {
                    let (length, width) = (with_unit(length_m, "m"), with_unit(diameter_m, "m"));
                    format!("A rod of {length}, {width} thick, strikes at {speed}")
                }
                None => format!(
                    "Impact of {} at {speed}, tip radius {}",
                    with_unit(strike.striker.mass_kg, "kg"),
                    with_unit(strike.striker.tip_radius_m, "m")
                ),
            }
        }
        None => "A given force on the half-space".to_owned(),
    }
}

/// The most important numbers of a single impact.
fn subtitle(impacts: &[StoredImpact]) -> String {
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
    let parts: Vec<String> = parts.collect();
    format!(
        "{} (model {})",
        parts.join(", "),
        impact.model.replace('_', " ")
    )
}
