//! Diagrams of distance against time: along the surface and down the axis, with fronts as straight lines.

use crate::error::PlotError;
use crate::quantity::Instants;
use crate::request::Request;
use crate::section::{Section, quantile_of_sizes};
use crate::waves::SHARE;
use figure::{
    Axis, ColourScale, Image, LabelledPoint, Layer, Legend, Limits, Line, Panel, Shading, Style,
    Unit,
};
use formats::stored::StoredImpact;

/// Along what.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Path {
    /// The surface: distances from the axis.
    Surface,
    /// The axis: depths.
    Axis,
}

/// Instants that are drawn, at most.
const MOST_INSTANTS: usize = 600;

/// A diagram along a path.
pub(crate) fn space_time(
    impact: &StoredImpact,
    request: &Request,
    path: Path,
) -> Result<Panel, PlotError> {
    let mut section = Section::of(impact)?;
    let usual = match path {
        Path::Surface => "velocity_z",
        Path::Axis => "stress_zz",
    };
    let quantity = section.quantity(impact, &request.quantities, usual)?;
    let frames = section.time_s().len();
    let chosen: Vec<usize> = (0..frames)
        .step_by(frames.div_ceil(MOST_INSTANTS))
        .collect();
    let distances = match path {
        Path::Surface => section.stored.r_m.clone(),
        Path::Axis => section.depths_m(),
    };
    let mut rows = Vec::new();
    for &frame in &chosen {
        let values = quantity.at(&mut section, frame)?;
        let image = section.image(&values);
        let width = section.stored.r_m.len();
        rows.push(match path {
            Path::Surface => image[..width].to_vec(),
            Path::Axis => image.iter().step_by(width).copied().collect(),
        });
    }
    let times: Vec<f64> = chosen
        .iter()
        .map(|&frame| section.time_s()[frame])
        .collect();
    let most = distances[distances.len() - 1];
    let near = (0.125 * most)
        .max(3.0 * section.disc_radius_m)
        .min(0.5 * most);
    let far = rows.iter().flat_map(|row: &Vec<f64>| {
        let pairs = row.iter().zip(&distances).filter(|(_, d)| **d > near);
        pairs.map(|(value, _)| *value)
    });
    let largest = quantile_of_sizes(far, SHARE);
    let low = if quantity.has_sign() { -largest } else { 0.0 };
    let colours = ColourScale::new(
        &quantity.words,
        Unit::Si(quantity.unit.clone()),
        quantity.colours(),
    )
    .limits(Limits::Between(low, largest));
    let along = distances.len();
    let image = Image {
        values: (0..along)
            .flat_map(|i| rows.iter().map(move |row| row[i]))
            .collect(),
        x: times,
        y: distances,
        shading: Shading::Smooth,
        colours,
    };
    Ok(panel(&section, image, path))
}

fn panel(section: &Section, image: Image, path: Path) -> Panel {
    let (first_s, last_s) = (image.x[0], image.x[image.x.len() - 1]);
    let most = image.y[image.y.len() - 1];
    let time = Axis::linear("time").si("s").range(first_s, last_s);
    let distance = match path {
        Path::Surface => Axis::linear("distance from the axis").si("m"),
        Path::Axis => Axis::linear("depth").si("m").reversed(),
    };
    let mut panel = Panel::new(time, distance.range(0.0, most))
        .height(380.0)
        .legend(Legend::Off)
        .layer(Layer::Image(image));
    let speeds = section.speeds;
    let fronts = match path {
        Path::Surface => vec![("P", speeds.p), ("S", speeds.s), ("R", speeds.rayleigh)],
        Path::Axis => vec![("P", speeds.p), ("S", speeds.s)],
    };
    for (i, (name, speed)) in fronts.into_iter().enumerate() {
        let start = match path {
            Path::Surface => section.disc_radius_m,
            Path::Axis => 0.0,
        };
        let at = |time_s: f64| (time_s, start + speed * (time_s - section.start_s));
        let end_s = last_s.min(section.start_s + (most - start) / speed);
        let points = vec![at(section.start_s), at(end_s)];
        panel = panel.layer(Layer::Line(Line::new("", Style::RimmedDashed, points)));
        // S and R are close together: their names are not
        let share = [0.8, 0.9, 0.68][i];
        let (x, y) = at(section.start_s + share * (end_s - section.start_s));
        panel = panel.layer(Layer::Point(LabelledPoint::text(x, y, name)));
    }
    panel
}
