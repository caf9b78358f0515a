//! Figures of impacts: one kind of picture after the other.
//!
//! `histories` has the contact and the probes over time, `spectrum` that of the force, `labels` what several impacts
//! are called.

mod histories;
mod labels;
mod spectrum;

use crate::error::{PlotError, only};
use crate::request::{Drawn, Kind, Request};
use crate::section::{axis_profile, frames, peak, space_time};
use crate::words::with_unit;
use contact::Shape;
use figure::{Figure, Panel, Sharing};
use formats::stored::{StoredImpact, Value};
use histories::{FEW, contact_panels, loop_panel, probe_panels};
use labels::labels;
use spectrum::spectrum;

/// Frames of an animation, at most.
const MOST_FRAMES: usize = 120;

/// The figure of some impacts.
pub(crate) fn of_impacts(impacts: &[StoredImpact], request: &Request) -> Result<Drawn, PlotError> {
    let suits = match impacts {
        [only] if only.section()?.is_some() => Kind::Waves,
        _ => Kind::Impact,
    };
    let kind = request.kind.unwrap_or(suits);
    if !request.times_s.is_empty() && !matches!(kind, Kind::Waves | Kind::Axis) {
        return Err(PlotError::all_times(kind));
    }
    let one = || only(impacts, kind);
    let figure = headed(impacts, request);
    let single = |panel: Panel| Drawn {
        figure: figure.clone().width(760.0).panel(panel),
        notes: Vec::new(),
    };
    match kind {
        Kind::Loop => Ok(single(loop_panel(impacts, &labels(impacts))?)),
        Kind::Spectrum => Ok(single(spectrum(impacts, &labels(impacts))?)),
        Kind::Peak => Ok(single(peak(one()?, request)?)),
        Kind::Axis => Ok(single(axis_profile(one()?, request)?)),
        Kind::Surface => Ok(single(space_time(one()?, request, true)?)),
        Kind::Depth => Ok(single(space_time(one()?, request, false)?)),
        Kind::Waves => {
            let (panels, notes) = frames(one()?, request, request.frames.unwrap_or(4))?;
            let columns = if panels.len() > 4 { 3 } else { 2 };
            let mut figure = figure
                .width(960.0)
                .columns(columns.min(panels.len()))
                .sharing(Sharing::Both)
                .common_colour_bar();
            figure.panels = panels;
            Ok(Drawn { figure, notes })
        }
        // kinds of other files do not come here
        _ => histories(impacts, kind, request),
    }
}

/// The frames of an animation, a figure each, and what its user should know.
pub(crate) fn frames_of(
    impact: &StoredImpact,
    request: &Request,
) -> Result<(Vec<Figure>, Vec<String>), PlotError> {
    let (panels, notes) = frames(impact, request, request.frames.unwrap_or(MOST_FRAMES))?;
    let base = headed(std::slice::from_ref(impact), request).width(720.0);
    let figures = panels.into_iter().map(|panel| base.clone().panel(panel));
    Ok((figures.collect(), notes))
}

/// A figure without panels, with title and subtitle.
fn headed(impacts: &[StoredImpact], request: &Request) -> Figure {
    let title = request.title.clone().unwrap_or_else(|| title(impacts));
    Figure::new(&title).subtitle(&subtitle(impacts))
}

/// Contacts and probes over time.
fn histories(impacts: &[StoredImpact], kind: Kind, request: &Request) -> Result<Drawn, PlotError> {
    let labels = labels(impacts);
    let is_all = kind == Kind::Probes;
    let most = if is_all { usize::MAX } else { FEW };
    let (probes, left_out) = probe_panels(impacts, &labels, &request.quantities, most)?;
    if is_all && probes.is_empty() {
        let hint = "give the scene a [[probe]] with r_m and z_m";
        return Err(PlotError::absent(impacts[0].path(), "probes", hint));
    }
    let notes = match left_out {
        0 => Vec::new(),
        count => vec![format!(
            "{count} probes are not shown: --kind probes shows all"
        )],
    };
    let mut panels = match is_all {
        true => Vec::new(),
        false => contact_panels(impacts, &labels)?,
    };
    let mut figure = headed(impacts, request);
    if probes.is_empty() {
        figure = figure.sharing(Sharing::X);
    }
    let is_narrow = probes.is_empty() || panels.len() + probes.len() < 3;
    panels.extend(probes);
    figure = match is_narrow {
        true => figure.width(760.0),
        false => figure.columns(2).width(1040.0),
    };
    figure.panels = panels;
    Ok(Drawn { figure, notes })
}

/// What strikes what: `bearing-steel ball of 3 mm strikes granite at 1.98 m/s`, or its mass and tip.
fn title(impacts: &[StoredImpact]) -> String {
    if impacts.len() > 1 {
        return format!("{} impacts", impacts.len());
    }
    let Some(strike) = &impacts[0].strike else {
        return "A given force on the half-space".to_owned();
    };
    let keys = impacts[0].keys();
    let material = |section: &str| {
        let key = format!("{section}.material");
        keys.iter().find_map(|(name, value)| match value {
            Value::String(text) if *name == key => Some(text.as_str()),
            _ => None,
        })
    };
    let target = material("target").map_or_else(String::new, |name| format!(" {name}"));
    let of = material("striker").map_or_else(String::new, |name| format!("{name} "));
    let speed = with_unit(strike.velocity_m_s, "m/s");
    let length = |metres| with_unit(metres, "m");
    let body = match strike.striker.shape {
        Some(Shape::Ball { diameter_m }) => format!("{of}ball of {}", length(diameter_m)),
        Some(Shape::Rod {
            length_m,
            diameter_m,
            ..
        }) => {
            let (long, thick) = (length(length_m), length(diameter_m));
            format!("{of}rod of {long}, {thick} thick,")
        }
        None => {
            let mass = with_unit(strike.striker.mass_kg, "kg");
            let tip = length(strike.striker.tip_radius_m);
            format!("{of}mass of {mass}, tip radius {tip},")
        }
    };
    format!("{body} strikes{target} at {speed}")
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
        Some(format!("{name} {}", with_unit(value, unit)))
    });
    let parts = parts.collect::<Vec<_>>().join(", ");
    format!("{parts} (model {})", impact.model.replace('_', " "))
}
