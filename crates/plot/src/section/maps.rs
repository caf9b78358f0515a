//! Maps of a section: frames at times that show the waves, and the largest value over time at every point.

use super::contour::contour;
use super::frames::{SectionGrid, SectionQuantity, SectionView, quantile_of_sizes};
use crate::error::{Drawn, PlotError};
use crate::request::Request;
use crate::words::{axis, of_quantity, with_unit};
use figure::{ColourMap, Layer, Legend, Panel, Scale, Style};
use formats::stored::StoredImpact;

/// Number of frames from which a picture is a complete history.
const FEW_FRAMES: usize = 9;

/// Frames of a section at the requested times, or `count` frames until the longitudinal wave leaves it, with notes for
/// the user.
pub(crate) fn frames(impact: &StoredImpact, request: &Request, count: usize) -> Drawn<Vec<Panel>> {
    let section = SectionView::of(impact)?;
    let mut notes = Vec::new();
    let mut chosen = match (request.times_s.as_slice(), request.span_s) {
        ([], None) => instants(&section, count),
        ([], Some(_)) => within(&section, request, count)?,
        (given, None) => section.asked(given)?,
        (_, Some(_)) => {
            let sentence = "times and a span both select frames: use only one of them";
            return Err(PlotError::refused(None, sentence.to_owned()));
        }
    };
    chosen.dedup();
    let quantity = section.quantity(request, section.usual())?;
    if section.is_near() && section.impact.target.echoing().is_none() {
        let pulse_m = section.speeds.p * section.pulse_s;
        notes.push(format!(
            "the waves overlap: the pulse is {} long and the section {}; use a [map] of {} to separate them",
            with_unit(pulse_m, "m"),
            with_unit(section.side_m(), "m"),
            with_unit(4.0 * pulse_m, "m")
        ));
    } else if request.quantities.is_empty() && quantity.name == "displacement_z" {
        notes.push(
            "velocities show waves better: add [output] quantities = [\"velocity_z\"] to the scene"
                .to_owned(),
        );
    }
    let images = chosen.iter().map(|&frame| section.values(&quantity, frame));
    let images = images.collect::<Result<Vec<_>, _>>()?;
    let (colours, map) = section.colours(&quantity, &images, &section.is_far());
    let panel = |(&frame, values): (&usize, Vec<f64>)| {
        let time_s = section.stored.time_s[frame];
        let mut panel = section
            .map(section.finer(&quantity, &values), colours.clone(), map)
            .title(&with_unit(time_s, "s"))
            .legend(Legend::Off);
        panel.layers.extend(section.fronts(time_s));
        panel
    };
    Ok((chosen.iter().zip(images).map(panel).collect(), notes))
}

/// Uniformly spaced frames: until the longitudinal wave leaves the section, or within a longer pulse; in a plate all of the output.
fn instants(section: &SectionView<'_>, count: usize) -> Vec<usize> {
    let half = 0.5 / count as f64;
    let (length_s, first, last) = match section.is_near() {
        _ if section.impact.target.echoing().is_some() => {
            let last_s = section.stored.time_s.last().copied().unwrap_or(0.0);
            (last_s - section.start_s, half, 1.0)
        }
        true => (section.pulse_s, half, 1.0 - half),
        // few frames begin after the waves have separated, many at the onset of the force
        false if count > FEW_FRAMES => (section.crossing_s(), 0.0, 1.0),
        false => (section.crossing_s(), 0.4, 1.0),
    };
    let steps = (count - 1).max(1) as f64;
    let share = |i: usize| first + (last - first) * (i as f64 + f64::from(count == 1)) / steps;
    (0..count)
        .map(|i| section.nearest(section.start_s + share(i) * length_s))
        .collect()
}

/// Uniformly spaced frames within the requested span.
fn within(
    section: &SectionView<'_>,
    request: &Request,
    count: usize,
) -> Result<Vec<usize>, PlotError> {
    let known = &section.stored.time_s;
    let [from_s, to_s] = request.span_within([known[0], known[known.len() - 1]])?;
    let steps = (count - 1).max(1) as f64;
    let time_s = |i: usize| from_s + (to_s - from_s) * i as f64 / steps;
    Ok((0..count).map(|i| section.nearest(time_s(i))).collect())
}

/// The map of the largest magnitudes over time with a logarithmic colour scale and the place of the largest. If the
/// target has a yield strength, a line marks where von Mises' stress reaches it.
pub(crate) fn peak(impact: &StoredImpact, request: &Request) -> Drawn<Panel> {
    /// Lower end of the colours, relative to the upper one.
    const DECADES: f64 = 1e-4;
    let section = SectionView::of(impact)?;
    let quantity = section.quantity(request, "von_mises")?;
    let (values, over, notes) = match section.stored.peak(&quantity.name) {
        Some(stored) => (section.turned(&stored), "time".to_owned(), Vec::new()),
        None => over_frames(&section, &quantity)?,
    };
    let sizes: Vec<f64> = values.into_iter().map(f64::abs).collect();
    let mut grid = section.finer(&quantity, &sizes);
    let of_yield = contour_of_yield(&section, &quantity, &grid);
    let positive = || grid.values.iter().copied().filter(|v| *v > 0.0);
    let [low, high] = [0.05, 0.999].map(|share| quantile_of_sizes(positive(), share));
    // before the first wave there is only rounding, which gets the colour of the lower end
    let low = low.max(DECADES * high);
    for value in &mut grid.values {
        *value = value.max(low);
    }
    let words = format!("{}, largest over {over}", of_quantity(&quantity.name));
    let colours = axis(&words, &quantity.unit, Scale::Logarithmic).range(low, high);
    let panel = section.map(grid, colours, ColourMap::Sequential);
    let largest = largest_of(&section, &sizes);
    let panel = with_landmarks(&section, panel, largest, of_yield, &quantity.unit);
    Ok((panel, notes))
}

/// The contour of von Mises' stress at the yield strength of the target; none for other quantities, or without a
/// strength.
fn contour_of_yield(
    section: &SectionView<'_>,
    quantity: &SectionQuantity,
    grid: &SectionGrid,
) -> Option<(f64, Vec<(f64, f64)>)> {
    let strength_pa = section.impact.target.material().yield_strength_pa?;
    let is_shown = quantity.name == "von_mises";
    is_shown.then(|| (strength_pa, contour(grid, strength_pa)))
}

/// Adds the largest value at its place, the size of the contact, and the contour of yield to a panel.
fn with_landmarks(
    section: &SectionView<'_>,
    mut panel: Panel,
    (largest, at): (f64, (f64, f64)),
    of_yield: Option<(f64, Vec<(f64, f64)>)>,
    unit: &str,
) -> Panel {
    let mut words = format!("contact radius {}", with_unit(section.disc_radius_m, "m"));
    if let Some((strength_pa, points)) = of_yield {
        let strength = with_unit(strength_pa, "Pa");
        let reached = match (points.is_empty(), largest < strength_pa) {
            (true, true) => "not reached",
            (true, false) => "reached everywhere",
            (false, _) => "reached inside the line",
        };
        words += &format!(", yield strength {strength} {reached}");
        panel = panel.line("", Style::Rimmed, points);
    }
    let label = format!("largest {}", with_unit(largest, unit));
    panel.title(&words).layer(Layer::star(at, &label))
}

/// The largest magnitude over the section with its place.
fn largest_of(section: &SectionView<'_>, sizes: &[f64]) -> (f64, (f64, f64)) {
    let width = section.stored.r_m.len();
    let by_size = |a: &usize, b: &usize| sizes[*a].total_cmp(&sizes[*b]);
    let largest = (0..sizes.len()).max_by(by_size).unwrap_or(0);
    let (r_m, z_m) = (&section.stored.r_m, section.depths_m());
    (sizes[largest], (r_m[largest % width], z_m[largest / width]))
}

/// The largest magnitudes over the frames, for a file without those over all samples, with words for the title and a
/// note.
fn over_frames(
    section: &SectionView<'_>,
    quantity: &SectionQuantity,
) -> Result<(Vec<f64>, String, Vec<String>), PlotError> {
    /// Largest number of frames that are searched.
    const MOST_SEARCHED_FRAMES: usize = 2000;
    let frames = section.stored.time_s.len();
    let looked_at = (0..frames).step_by(frames.div_ceil(MOST_SEARCHED_FRAMES));
    let count = looked_at.len();
    let mut peaks: Vec<f64> = Vec::new();
    for frame in looked_at {
        let values = section.values(quantity, frame)?;
        peaks.resize(values.len(), 0.0);
        for (peak, value) in peaks.iter_mut().zip(values) {
            *peak = peak.max(value.abs());
        }
    }
    let name = &quantity.name;
    let quantities = match section
        .stored
        .quantities()
        .iter()
        .any(|stored| stored.name == *name)
    {
        true => String::new(),
        false => format!(" and quantities = [\"{name}\"]"),
    };
    let note = format!(
        "the largest values are taken over {count} frames and may be too low: set [output] peaks = true{quantities} to store those over all samples"
    );
    Ok((peaks, format!("{count} frames"), vec![note]))
}
