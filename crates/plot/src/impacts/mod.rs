//! Figures of impacts, one kind of picture after the other.
//!
//! `histories` draws the contact and the probes over time, `spectrum` the spectra of the force and at the probes; `labels` names several
//! impacts.

mod histories;
mod labels;
mod spectrum;

use crate::error::{Drawn, PlotError};
use crate::request::{PictureKind, Request, only};
use crate::section::{axis_profile, frames, peak, space_time};
use crate::words::{digits, with_unit};
use contact::Shape;
use figure::{Figure, Sharing};
use formats::stored::{StoredImpact, Value};
use histories::{
    FEW_PROBES, contact_names, contact_panels, loop_panel, probe_panels, sensor_panels,
};
use labels::labels;
use spectrum::spectra;
use std::collections::BTreeMap;
use std::{mem, slice};

/// Largest number of frames of an animation.
const MOST_ANIMATED_FRAMES: usize = 120;

/// The figure of some impacts, with notes for the user.
pub(crate) fn of_impacts(impacts: &[StoredImpact], request: &Request) -> Drawn<Figure> {
    let suits = match impacts {
        [only] if only.section()?.is_some() => PictureKind::Waves,
        _ => PictureKind::Impact,
    };
    let kind = request.kind_or(suits)?;
    let one = || only(impacts, kind);
    let panel = match kind {
        PictureKind::Loop => loop_panel(impacts, &labels(impacts))?,
        PictureKind::Spectrum => {
            let panels = spectra(impacts, &labels(impacts), request)?;
            let columns = panels.len().min(2);
            return Ok((headed(impacts, request, columns).panels(panels), Vec::new()));
        }
        PictureKind::Sensors => {
            let panels = sensor_panels(one()?, request)?;
            let columns = if panels.len() > 2 { 2 } else { 1 };
            return Ok((headed(impacts, request, columns).panels(panels), Vec::new()));
        }
        PictureKind::Peak => {
            let (mut panel, notes) = peak(one()?, request)?;
            // in the subtitle: a star at the surface would cover the title of the panel
            let mut figure = headed(impacts, request, 1);
            figure.subtitle = format!("{}; {}", figure.subtitle, mem::take(&mut panel.title));
            return Ok((figure.panel(panel), notes));
        }
        PictureKind::Axis => axis_profile(one()?, request)?,
        PictureKind::Surface | PictureKind::Depth => {
            let (panel, notes) = space_time(one()?, request, kind)?;
            return Ok((headed(impacts, request, 1).panel(panel), notes));
        }
        PictureKind::Waves => {
            let (panels, notes) = frames(one()?, request, request.frames.unwrap_or(4))?;
            let columns = if panels.len() > 4 { 3 } else { 2 };
            let mut figure = headed(impacts, request, columns.min(panels.len())).width(960.0);
            figure.has_common_bar = true;
            return Ok((figure.sharing(Sharing::Both).panels(panels), notes));
        }
        PictureKind::Impact | PictureKind::Probes => return histories(impacts, kind, request),
        // pictures of other files do not reach this function
        PictureKind::Sweep
        | PictureKind::Loss
        | PictureKind::Restitution
        | PictureKind::Histogram
        | PictureKind::Errors => {
            return histories(impacts, kind, request);
        }
    };
    Ok((headed(impacts, request, 1).panel(panel), Vec::new()))
}

/// The frames of an animation, one figure each, with notes for the user.
pub(crate) fn frames_of(impact: &StoredImpact, request: &Request) -> Drawn<Vec<Figure>> {
    let (panels, notes) = frames(
        impact,
        request,
        request.frames.unwrap_or(MOST_ANIMATED_FRAMES),
    )?;
    let base = headed(slice::from_ref(impact), request, 1).width(720.0);
    let figures = panels.into_iter().map(|panel| base.clone().panel(panel));
    Ok((figures.collect(), notes))
}

/// A figure without panels, with title and subtitle.
fn headed(impacts: &[StoredImpact], request: &Request, columns: usize) -> Figure {
    request.figure(&title(impacts), &subtitle(impacts), columns)
}

/// Contacts and probes over time.
fn histories(impacts: &[StoredImpact], kind: PictureKind, request: &Request) -> Drawn<Figure> {
    let labels = labels(impacts);
    let is_all = kind == PictureKind::Probes;
    let most = if is_all { usize::MAX } else { FEW_PROBES };
    let is_of_contact = |name: &String| contact_names().contains(&name.as_str());
    let (of_contact, at_probes): (Vec<String>, Vec<String>) =
        request.quantities.iter().cloned().partition(is_of_contact);
    if let (true, [name, ..]) = (is_all, of_contact.as_slice()) {
        let sentence =
            format!("{name} is a quantity of the contact, not of a probe: use the picture impact");
        return Err(PlotError::refused(None, sentence));
    }
    let (mut probes, left_out) = match of_contact.is_empty() || !at_probes.is_empty() {
        true => probe_panels(impacts, &labels, (request, &at_probes), most)?,
        false => (Vec::new(), 0),
    };
    if (is_all || !at_probes.is_empty()) && probes.is_empty() {
        let hint = "add a [[probe]] with r_m and z_m to the scene";
        return Err(PlotError::absent(impacts[0].path(), "probes", hint));
    }
    if let ([impact], true, true) = (impacts, probes.is_empty(), request.quantities.is_empty())
        && !impact.sensors()?.is_empty()
    {
        probes = sensor_panels(impact, request)?;
        probes.truncate(FEW_PROBES);
    }
    let note = || format!("{left_out} probes are not shown: use the picture probes to see all");
    let notes = (left_out > 0).then(note).into_iter().collect();
    let mut panels = match is_all {
        true => Vec::new(),
        false => {
            let asked: Vec<&str> = of_contact.iter().map(String::as_str).collect();
            contact_panels(impacts, &labels, request, &asked)?
        }
    };
    let (columns, sharing) = match probes.len() {
        0 => (1, Sharing::X),
        count if panels.len() + count < 3 => (1, Sharing::Separate),
        _ => (2, Sharing::Separate),
    };
    panels.extend(probes);
    let figure = headed(impacts, request, columns).sharing(sharing);
    Ok((figure.panels(panels), notes))
}

/// Title of the impact: `bearing-steel ball of 3 mm strikes granite at 1.98 m/s`, or with mass and tip.
fn title(impacts: &[StoredImpact]) -> String {
    if impacts.len() > 1 {
        return format!("{} impacts", impacts.len());
    }
    let keys: BTreeMap<String, Value> = impacts[0].keys().into_iter().collect();
    let material = |key: &str| keys.get(key).and_then(Value::as_str);
    let target = material("target.material").map_or_else(
        || {
            let modulus_pa = impacts[0].target.material().youngs_modulus_pa;
            format!("a block of E = {}", with_unit(modulus_pa, "Pa"))
        },
        str::to_owned,
    );
    let Some(strike) = &impacts[0].strike else {
        let file = material("force.file").unwrap_or("a record");
        return format!("force of {file} on {target}");
    };
    let of = material("striker.material").map_or_else(String::new, |name| format!("{name} "));
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
    format!("{body} strikes {target} at {speed}")
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
    let onset = impact.number("yield_onset").filter(|onset| *onset > 1.0);
    let yields = onset.map(|onset| format!("pressure {} times the onset of yield", digits(onset)));
    let parts = parts.chain(yields).collect::<Vec<_>>().join(", ");
    format!("{parts} (model {})", impact.model.replace('_', " "))
}
