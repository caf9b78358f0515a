//! Maps of a section: frames, chosen so that waves are seen, and the largest value over time at every place.

use super::frames::{Section, colours, quantile_of_sizes};
use super::quantity::Quantity;
use crate::error::PlotError;
use crate::request::Request;
use crate::words::with_unit;
use figure::{ColourMap, ColourScale, Legend, Limits, Panel, Unit};
use formats::stored::StoredImpact;

/// Frames from which on a picture is a whole history.
const FEW: usize = 9;

/// Largest error of a velocity by differences that is shown, over its size.
const DOUBT: f64 = 0.1;

/// Frames of a section at the times that are asked for, or `count` until the longitudinal wave leaves it; and
/// what their user should know.
pub(crate) fn frames(
    impact: &StoredImpact,
    request: &Request,
    count: usize,
) -> Result<(Vec<Panel>, Vec<String>), PlotError> {
    let mut section = Section::of(impact)?;
    let mut notes = Vec::new();
    let chosen = instants(&section, &request.times_s, count, &mut notes);
    let mut quantity = section.quantity(request, "velocity_z")?;
    if quantity.is_rate() {
        let last = chosen.len().saturating_sub(4);
        let doubt = section.doubt(&quantity, &chosen[last..])?;
        if doubt > DOUBT && !request.quantities.is_empty() {
            let path = impact.path();
            let sentence = format!(
                "{} by differences between the frames of {} would be wrong by {} %: give [map] more frames, or show displacement_z",
                quantity.name,
                path.display(),
                (100.0 * doubt).round()
            );
            return Err(PlotError::refused(Some(path), sentence));
        }
        if doubt > DOUBT {
            notes.push("the frames are too far apart for velocities, the displacement is shown: give [map] more frames".to_owned());
            quantity = section.quantity(request, "displacement_z")?;
        }
    }
    let far = section.is_far();
    let mut images = Vec::new();
    for &frame in &chosen {
        images.push(section.values(&quantity, frame)?);
    }
    let colours = colours(&quantity, &images, &far);
    let panel = |(&frame, values): (&usize, Vec<f64>)| {
        let time_s = section.stored.time_s[frame];
        let mut panel = section
            .map(values, colours.clone())
            .title(&with_unit(time_s, "s"))
            .legend(Legend::Off);
        panel.layers.extend(section.fronts(time_s));
        panel
    };
    let panels = chosen.iter().zip(images).map(panel).collect();
    Ok((panels, notes))
}

/// Frames at given times, or evenly until the longitudinal wave leaves the section.
fn instants(
    section: &Section<'_>,
    times_s: &[f64],
    count: usize,
    notes: &mut Vec<String>,
) -> Vec<usize> {
    let known = &section.stored.time_s;
    let nearest = |time_s: f64| {
        let after = known.partition_point(|&t| t < time_s).min(known.len() - 1);
        let before = after.saturating_sub(1);
        let is_before = time_s - known[before] < known[after] - time_s;
        if is_before { before } else { after }
    };
    let wanted: Vec<f64> = if times_s.is_empty() {
        let end_s = shown_s(section, notes);
        let length_s = end_s - section.start_s;
        // a few frames begin where waves have parted, many where the force does
        let first = if count > FEW { 0.0 } else { 0.4 };
        let last = (count - 1).max(1) as f64;
        (0..count)
            .map(|i| first + (1.0 - first) * (i as f64 + f64::from(count == 1)) / last)
            .map(|share| section.start_s + share * length_s)
            .collect()
    } else {
        times_s.to_vec()
    };
    let mut found: Vec<usize> = wanted.into_iter().map(nearest).collect();
    found.dedup();
    found
}

/// Until when frames are shown: while the longitudinal wave is in the section; of a pulse longer than that, all.
fn shown_s(section: &Section<'_>, notes: &mut Vec<String>) -> f64 {
    let [r_m, z_m] = section.extent_m();
    let last_s = section.stored.time_s[section.stored.time_s.len() - 1];
    let crossing_s = r_m.min(z_m) / section.speeds.p;
    if section.pulse_s > crossing_s {
        let pulse_m = section.speeds.p * section.pulse_s;
        notes.push(format!(
            "no waves can be told apart: the pulse is {} long and the section {}; a [map] of {} would show them",
            with_unit(pulse_m, "m"),
            with_unit(r_m.min(z_m), "m"),
            with_unit(4.0 * pulse_m, "m")
        ));
        return (section.start_s + section.pulse_s).min(last_s);
    }
    (section.start_s + crossing_s).min(last_s)
}

/// The map of the largest sizes over time, in decades of colour.
pub(crate) fn peak(impact: &StoredImpact, request: &Request) -> Result<Panel, PlotError> {
    /// Lower end of the colours, over the upper one.
    const DECADES: f64 = 1e-4;
    let mut section = Section::of(impact)?;
    let quantity = section.quantity(request, "von_mises")?;
    let mut values: Vec<f64> = match section.stored.peak(&quantity.name) {
        Some(stored) => section.turned(&stored).into_iter().map(f64::abs).collect(),
        None => over_frames(&mut section, &quantity)?,
    };
    let positive = || values.iter().copied().filter(|v| *v > 0.0);
    let [low, high] = [0.05, 0.999].map(|share| quantile_of_sizes(positive(), share));
    // where no wave has come there is rounding, or nothing: the colour of the lower end
    let ends = [low.max(DECADES * high), high];
    for value in &mut values {
        *value = value.max(ends[0]);
    }
    let (words, unit) = (&quantity.words, Unit::Si(quantity.unit.clone()));
    let words = format!("{words}, largest over time");
    let colours = ColourScale::new(&words, unit, ColourMap::Sequential)
        .logarithmic()
        .limits(Limits::Between(ends[0], ends[1]));
    Ok(section.map(values, colours))
}

/// The largest sizes over the frames, for a file that has none over all samples.
fn over_frames(section: &mut Section<'_>, quantity: &Quantity) -> Result<Vec<f64>, PlotError> {
    /// Frames that are looked at, at most.
    const MOST_FRAMES: usize = 2000;
    let frames = section.stored.time_s.len();
    let mut peaks: Vec<f64> = Vec::new();
    for frame in (0..frames).step_by(frames.div_ceil(MOST_FRAMES)) {
        let values = section.values(quantity, frame)?;
        peaks.resize(values.len(), 0.0);
        for (peak, value) in peaks.iter_mut().zip(values) {
            *peak = peak.max(value.abs());
        }
    }
    Ok(peaks)
}
