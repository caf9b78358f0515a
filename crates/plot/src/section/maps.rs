//! Maps of a section: frames, chosen so that waves are seen, and the largest value over time at every place.

use super::frames::{Quantity, Section, quantile_of_sizes};
use crate::error::{Drawn, PlotError};
use crate::request::Request;
use crate::words::{axis, of_quantity, with_unit};
use figure::{ColourMap, Legend, Panel, Scale};
use formats::stored::StoredImpact;

/// Frames from which on a picture is a whole history.
const FEW: usize = 9;

/// Frames of a section at the times that are asked for, or `count` until the longitudinal wave leaves it; and
/// what their user should know.
pub(crate) fn frames(impact: &StoredImpact, request: &Request, count: usize) -> Drawn<Vec<Panel>> {
    let section = Section::of(impact)?;
    let mut notes = Vec::new();
    let mut chosen = match request.times_s.as_slice() {
        [] => instants(&section, count),
        given => section.asked(given)?,
    };
    chosen.dedup();
    let quantity = section.quantity(request, section.usual())?;
    if section.is_near() {
        let pulse_m = section.speeds.p * section.pulse_s;
        notes.push(format!(
            "no waves can be told apart: the pulse is {} long and the section {}; a [map] of {} would show them",
            with_unit(pulse_m, "m"),
            with_unit(section.side_m(), "m"),
            with_unit(4.0 * pulse_m, "m")
        ));
    } else if request.quantities.is_empty() && quantity.name == "displacement_z" {
        notes.push("waves are seen better as velocities: give the scene [output] quantities = [\"velocity_z\"]".to_owned());
    }
    let images = chosen.iter().map(|&frame| section.values(&quantity, frame));
    let images = images.collect::<Result<Vec<_>, _>>()?;
    let (colours, map) = section.colours(&quantity, &images, &section.is_far());
    let panel = |(&frame, values): (&usize, Vec<f64>)| {
        let time_s = section.stored.time_s[frame];
        let mut panel = section
            .map(values, colours.clone(), map)
            .title(&with_unit(time_s, "s"))
            .legend(Legend::Off);
        panel.layers.extend(section.fronts(time_s));
        panel
    };
    Ok((chosen.iter().zip(images).map(panel).collect(), notes))
}

/// Frames evenly: until the longitudinal wave leaves the section, or within a pulse that is longer.
fn instants(section: &Section<'_>, count: usize) -> Vec<usize> {
    let half = 0.5 / count as f64;
    let (length_s, first, last) = match section.is_near() {
        true => (section.pulse_s, half, 1.0 - half),
        // a few frames begin where waves have parted, many where the force does
        false if count > FEW => (section.crossing_s(), 0.0, 1.0),
        false => (section.crossing_s(), 0.4, 1.0),
    };
    let steps = (count - 1).max(1) as f64;
    let share = |i: usize| first + (last - first) * (i as f64 + f64::from(count == 1)) / steps;
    (0..count)
        .map(|i| section.nearest(section.start_s + share(i) * length_s))
        .collect()
}

/// The map of the largest sizes over time, in decades of colour.
pub(crate) fn peak(impact: &StoredImpact, request: &Request) -> Result<Panel, PlotError> {
    /// Lower end of the colours, over the upper one.
    const DECADES: f64 = 1e-4;
    let section = Section::of(impact)?;
    let quantity = section.quantity(request, "von_mises")?;
    let mut values: Vec<f64> = match section.stored.peak(&quantity.name) {
        Some(stored) => section.turned(&stored).into_iter().map(f64::abs).collect(),
        None => over_frames(&section, &quantity)?,
    };
    let positive = || values.iter().copied().filter(|v| *v > 0.0);
    let [low, high] = [0.05, 0.999].map(|share| quantile_of_sizes(positive(), share));
    // where no wave has come there is rounding, or nothing: the colour of the lower end
    let low = low.max(DECADES * high);
    for value in &mut values {
        *value = value.max(low);
    }
    let words = format!("{}, largest over time", of_quantity(&quantity.name));
    let colours = axis(&words, &quantity.unit, Scale::Logarithmic).range(low, high);
    Ok(section.map(values, colours, ColourMap::Sequential))
}

/// The largest sizes over the frames, for a file that has none over all samples.
fn over_frames(section: &Section<'_>, quantity: &Quantity) -> Result<Vec<f64>, PlotError> {
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
