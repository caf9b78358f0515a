//! Frames of a section, chosen so that waves are seen.

use crate::error::PlotError;
use crate::number::with_unit;
use crate::quantity::Quantity;
use crate::request::Request;
use crate::section::{Section, quantile_of_sizes};
use figure::{Axis, ColourScale, Image, Layer, Legend, Limits, Mirror, Panel, Shading, Unit};
use formats::stored::StoredImpact;

/// Share of the values outside the near field that the colours hold.
pub(crate) const SHARE: f64 = 0.985;

/// Frames from which on a picture is a whole history.
const FEW: usize = 9;

/// Largest error of a velocity by differences that is shown, over its size.
const DOUBT: f64 = 0.1;

/// Panels of frames, and what their user should know.
pub(crate) struct Frames {
    pub(crate) panels: Vec<Panel>,
    pub(crate) notes: Vec<String>,
}

/// Frames of a section at the times that are asked for, or `count` until the longitudinal wave leaves it.
pub(crate) fn frames(
    impact: &StoredImpact,
    request: &Request,
    count: usize,
) -> Result<Frames, PlotError> {
    let mut section = Section::of(impact)?;
    let mut notes = Vec::new();
    let chosen = instants(&section, &request.times_s, count, &mut notes);
    let mut quantity = section.quantity(impact, &request.quantities, "velocity_z")?;
    if quantity.is_rate() {
        let doubt = section.doubt(&quantity, few(&chosen))?;
        if doubt > DOUBT && !request.quantities.is_empty() {
            return Err(PlotError::Coarse {
                path: impact.path().to_owned(),
                quantity: quantity.name,
                percent: (100.0 * doubt).round(),
            });
        }
        if doubt > DOUBT {
            notes.push("the frames are too far apart for velocities, the displacement is shown: give [map] more frames".to_owned());
            quantity = Quantity::named(
                "displacement_z",
                &section.stored.quantities(),
                impact.path(),
            )?;
        }
    }
    let far = section.is_far();
    let mut images = Vec::new();
    for &frame in &chosen {
        let values = quantity.at(&mut section, frame)?;
        images.push(section.image(&values));
    }
    let outside = images.iter().flat_map(|image| {
        let pairs = image.iter().zip(&far).filter(|(_, far)| **far);
        pairs.map(|(value, _)| *value)
    });
    let largest = quantile_of_sizes(outside, SHARE);
    let limits = if quantity.has_sign() {
        Limits::Between(-largest, largest)
    } else {
        Limits::Between(0.0, largest)
    };
    let colours = ColourScale::new(
        &quantity.words,
        Unit::Si(quantity.unit.clone()),
        quantity.colours(),
    )
    .limits(limits);
    let panels = chosen
        .iter()
        .zip(images)
        .map(|(&frame, values)| panel(&section, frame, values, &colours))
        .collect();
    Ok(Frames { panels, notes })
}

/// A frame, mirrored at the axis, with its fronts.
fn panel(section: &Section, frame: usize, values: Vec<f64>, colours: &ColourScale) -> Panel {
    let [r_max_m, z_max_m] = section.extent_m();
    let time_s = section.stored.time_s[frame];
    let image = Image {
        x: section.stored.r_m.clone(),
        y: section.depths_m(),
        values,
        shading: Shading::Smooth,
        colours: colours.clone(),
    };
    let mut panel = Panel::new(
        Axis::linear("distance from the axis")
            .si("m")
            .range(0.0, r_max_m),
        Axis::linear("depth").si("m").range(0.0, z_max_m).reversed(),
    )
    .title(&with_unit(time_s, "s"))
    .equal_lengths()
    .mirrored(Mirror::Even)
    .legend(Legend::Off)
    .layer(Layer::Image(image));
    panel.layers.extend(section.fronts(time_s));
    panel
}

/// Frames at given times, or evenly until the longitudinal wave leaves the section.
fn instants(
    section: &Section,
    times_s: &[f64],
    count: usize,
    notes: &mut Vec<String>,
) -> Vec<usize> {
    let known = &section.stored.time_s;
    let nearest = |time_s: f64| {
        let after = known.partition_point(|&t| t < time_s).min(known.len() - 1);
        let before = after.saturating_sub(1);
        if time_s - known[before] < known[after] - time_s {
            before
        } else {
            after
        }
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
fn shown_s(section: &Section, notes: &mut Vec<String>) -> f64 {
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

/// A few of many frames.
fn few(frames: &[usize]) -> &[usize] {
    let from = frames.len().saturating_sub(4);
    &frames[from..]
}
