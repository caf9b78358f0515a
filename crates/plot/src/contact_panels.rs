//! The contact over time: force, displacements, velocity.

use crate::error::PlotError;
use crate::history::curve;
use crate::span::{end_s, onset_s};
use contact::WaveSpeeds;
use contact::{Model, Settings};
use figure::{Axis, Legend, Panel, Style};
use formats::stored::StoredImpact;
use impact::{FieldsError, Impact, StrikerSeries};

/// Height of a panel in pixels.
const HEIGHT: f64 = 210.0;

/// Panels of the contacts, one curve an impact; a single one has Hertz's force beside its own.
pub(crate) fn contact_panels(
    impacts: &[StoredImpact],
    labels: &[String],
) -> Result<Vec<Panel>, PlotError> {
    let ends = impacts
        .iter()
        .map(|i| end_s(&i.series.time_s, &i.series.force_n));
    let end_s = 1.1 * ends.fold(0.0, f64::max);
    let panel = |quantity: &str, unit: &str| {
        let time = Axis::linear("time").si("s").range(0.0, end_s);
        let legend = if impacts.len() == 1 {
            Legend::Auto
        } else {
            Legend::Off
        };
        Panel::new(time, Axis::linear(quantity).si(unit))
            .height(HEIGHT)
            .legend(legend)
    };
    // several impacts have the same colours in all panels
    let mut force = panel("force", "N").legend(Legend::Auto);
    let mut displacement = panel("displacement", "m");
    let mut velocity = panel("velocity of the striker", "m/s");
    let mut deflection = panel("deflection of the half-space", "m");
    let mut has_striker = false;
    for (impact, label) in impacts.iter().zip(labels) {
        let series = &impact.series;
        let line = |samples: &[f64]| curve(&series.time_s, samples, end_s);
        let is_single = impacts.len() == 1;
        let named = |single: &'static str| if is_single { single } else { label.as_str() };
        force = force.line(named("contact force"), Style::Plain, line(&series.force_n));
        if is_single {
            if let Some(hertz) = hertz(impact, end_s)? {
                force = force.line("Hertz, without waves", Style::Plain, hertz);
            }
            if let Some(echo_s) = echo_s(impact)? {
                force = force.mark(echo_s, "first echo");
            }
        }
        if let Some(StrikerSeries {
            displacement_m,
            velocity_m_s,
        }) = &series.striker
        {
            has_striker = true;
            displacement = displacement.line(named("striker"), Style::Plain, line(displacement_m));
            velocity = velocity.line(named(""), Style::Plain, line(velocity_m_s));
        }
        if is_single {
            let name = deflection_name(impact);
            displacement = displacement.line(name, Style::Plain, line(&series.deflection_m));
        } else {
            deflection = deflection.line(label, Style::Plain, line(&series.deflection_m));
        }
    }
    let mut panels = vec![force];
    if impacts.len() == 1 {
        panels.push(displacement);
    } else {
        if has_striker {
            displacement.y.quantity = "displacement of the striker".to_owned();
            panels.push(displacement);
        }
        panels.push(deflection);
    }
    if has_striker {
        panels.push(velocity);
    }
    Ok(panels)
}

/// What the deflection of a file is: Hertz's law may hold the static part of it.
fn deflection_name(impact: &StoredImpact) -> &'static str {
    match (impact.model.as_str(), impact.static_share.as_str()) {
        ("prescribed", _) => "disc",
        ("hertz" | "radiation" | "growing", _) | (_, "dynamic") => "half-space, dynamic part",
        _ => "half-space",
    }
}

/// Hertz's force for the same bodies: no waves and no disc. None where the file is it, or has no striker.
fn hertz(impact: &StoredImpact, end_s: f64) -> Result<Option<Vec<(f64, f64)>>, PlotError> {
    let Some(strike) = &impact.scene.strike else {
        return Ok(None);
    };
    if impact.model == "hertz" {
        return Ok(None);
    }
    let target = impact.scene.target.clone();
    let mut alone = Impact::new(target, strike.striker.clone(), strike.velocity_m_s);
    alone.settings = Settings {
        model: Model::Hertz,
        ..Settings::default()
    };
    let Ok(run) = alone.solve() else {
        return Ok(None);
    };
    const POINTS: u32 = 400;
    let time = |i: u32| end_s * f64::from(i) / f64::from(POINTS);
    let points = (0..=POINTS).map(|i| (time(i), run.excitation().force_n(time(i))));
    Ok(Some(points.collect()))
}

/// When the first echo from the faces of the block reaches the contact, where they are known.
fn echo_s(impact: &StoredImpact) -> Result<Option<f64>, PlotError> {
    let target = &impact.scene.target;
    let speeds = WaveSpeeds::of(target).map_err(FieldsError::from)?;
    let start_s = onset_s(&impact.series.time_s, &impact.series.force_n);
    let echo_s = speeds.first_echo_s(target, [0.0; 2], 0.0);
    Ok(echo_s.map(|t| start_s + t))
}
