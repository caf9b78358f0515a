//! The largest value over time at every place of a section.

use crate::error::PlotError;
use crate::quantity::Quantity;
use crate::request::Request;
use crate::section::{Section, quantile_of_sizes};
use figure::{Axis, ColourMap, ColourScale, Image, Layer, Limits, Mirror, Panel, Shading, Unit};
use formats::stored::StoredImpact;

/// Frames that are looked at, at most.
const MOST_FRAMES: usize = 2000;

/// Lower end of the colours, over the upper one.
const DECADES: f64 = 1e-4;

/// The map of the largest sizes over time, in decades of colour.
pub(crate) fn peak(impact: &StoredImpact, request: &Request) -> Result<Panel, PlotError> {
    let mut section = Section::of(impact)?;
    let quantity = section.quantity(impact, &request.quantities, "von_mises")?;
    let peaks = match section.stored.peak(&quantity.name) {
        Some(stored) => stored.into_iter().map(f64::abs).collect(),
        None => over_frames(&mut section, &quantity)?,
    };
    let mut values = section.image(&peaks);
    let positive = || values.iter().copied().filter(|v| *v > 0.0);
    let [low, high] = [0.05, 0.999].map(|share| quantile_of_sizes(positive(), share));
    // where no wave has come there is rounding, or nothing: the colour of the lower end
    let ends = [low.max(DECADES * high), high];
    for value in &mut values {
        *value = value.max(ends[0]);
    }
    let colours = ColourScale::new(
        &format!("{}, largest over time", quantity.words),
        Unit::Si(quantity.unit.clone()),
        ColourMap::Sequential,
    )
    .logarithmic()
    .limits(Limits::Between(ends[0], ends[1]));
    let [r_max_m, z_max_m] = section.extent_m();
    let image = Image {
        x: section.stored.r_m.clone(),
        y: section.depths_m(),
        values,
        shading: Shading::Smooth,
        colours,
    };
    Ok(Panel::new(
        Axis::linear("distance from the axis")
            .si("m")
            .range(0.0, r_max_m),
        Axis::linear("depth").si("m").range(0.0, z_max_m).reversed(),
    )
    .equal_lengths()
    .mirrored(Mirror::Even)
    .layer(Layer::Image(image)))
}

/// The largest sizes over the frames, for a file that has none over all samples.
fn over_frames(section: &mut Section, quantity: &Quantity) -> Result<Vec<f64>, PlotError> {
    let frames = section.stored.time_s.len();
    let mut peaks: Vec<f64> = Vec::new();
    for frame in (0..frames).step_by(frames.div_ceil(MOST_FRAMES)) {
        let values = quantity.at(section, frame)?;
        peaks.resize(values.len(), 0.0);
        for (peak, value) in peaks.iter_mut().zip(values) {
            *peak = peak.max(value.abs());
        }
    }
    Ok(peaks)
}
