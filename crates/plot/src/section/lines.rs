//! What is seen along the surface and down the axis of a section: distance against time, and the axis beside the static
//! field.

use super::frames::{Quantity, Section};
use crate::error::PlotError;
use crate::request::Request;
use crate::series::curve;
use crate::words::{axis, with_unit};
use contact::KernelUnits;
use figure::{Axis, Image, LabelledPoint, Layer, Legend, Panel, Scale, Style};
use formats::results::schema::FIELDS;
use formats::stored::StoredImpact;
use halfspace::{Kernel, Medium, Profile};

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
    let section = Section::of(impact)?;
    let frames = section.stored.time_s.len();
    let chosen: Vec<usize> = (0..frames)
        .step_by(frames.div_ceil(MOST_INSTANTS))
        .collect();
    let (usual, distances) = match path {
        Path::Surface => (section.usual(), section.stored.r_m.clone()),
        Path::Axis => ("stress_zz", section.depths_m()),
    };
    let quantity = section.quantity(request, usual)?;
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for &frame in &chosen {
        let image = section.values(&quantity, frame)?;
        let width = section.stored.r_m.len();
        rows.push(match path {
            Path::Surface => image[..width].to_vec(),
            Path::Axis => image.iter().step_by(width).copied().collect(),
        });
    }
    let near_m = section.near_m(distances[distances.len() - 1]);
    let is_far: Vec<bool> = distances.iter().map(|d| *d > near_m).collect();
    let (colours, map) = section.colours(&quantity, &rows, &is_far);
    let times = chosen.iter().map(|&frame| section.stored.time_s[frame]);
    let along = distances.len();
    let values = (0..along).flat_map(|i| rows.iter().map(move |row| row[i]));
    let image = Image::new(times.collect(), distances, values.collect(), colours, map);
    Ok(panel(&section, image, path))
}

fn panel(section: &Section<'_>, image: Image, path: Path) -> Panel {
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
    let (start_m, fronts) = match path {
        Path::Surface => (section.disc_radius_m, 3),
        Path::Axis => (0.0, 2),
    };
    // S and R are close together: their names are not
    let named = [
        ("P", speeds.p, 0.8),
        ("S", speeds.s, 0.9),
        ("R", speeds.rayleigh, 0.68),
    ];
    for (name, speed, share) in named.into_iter().take(fronts) {
        let at = |time_s: f64| (time_s, start_m + speed * (time_s - section.start_s));
        let end_s = last_s.min(section.start_s + (most - start_m) / speed);
        let points = vec![at(section.start_s), at(end_s)];
        let (x, y) = at(section.start_s + share * (end_s - section.start_s));
        panel = panel
            .line("", Style::Rimmed, points)
            .layer(Layer::Point(LabelledPoint::text(x, y, name)));
    }
    panel
}

/// Instants without times that are asked for: these shares of the pulse.
const SHARES: [f64; 4] = [0.2, 0.4, 0.6, 0.8];

/// Smallest size that is shown over the largest, at most.
const DECADES: f64 = 1e-6;

/// The field on the axis at some instants, and what would be there if the largest force lay on the disc for ever.
///
/// Sizes on logarithmic axes: the static field falls with the square of the depth, and waves run ahead of it.
pub(crate) fn axis_profile(impact: &StoredImpact, request: &Request) -> Result<Panel, PlotError> {
    let section = Section::of(impact)?;
    let quantity = section.quantity(request, "stress_zz")?;
    let times_s = match request.times_s.as_slice() {
        [] => SHARES
            .map(|share| section.start_s + share * section.pulse_s)
            .to_vec(),
        given => given.to_vec(),
    };
    let depths = section.depths_m();
    let depths_mm: Vec<f64> = depths.iter().map(|z| 1e3 * z).collect();
    let [first_m, last_m] = [depths[1], depths[depths.len() - 1]];
    let depth = Axis::logarithmic("depth")
        .unit("mm")
        .range(1e3 * first_m, 1e3 * last_m);
    let words = format!("size of the {}", quantity.words);
    let size = axis(&words, &quantity.unit, Scale::Logarithmic);
    let mut panel = Panel::new(depth, size).height(380.0);
    let (mut smallest, mut largest) = (f64::INFINITY, 0.0_f64);
    let mut drawn = Vec::new();
    for time_s in times_s {
        let frame = section.nearest(time_s);
        if drawn.contains(&frame) {
            continue;
        }
        drawn.push(frame);
        let name = with_unit(section.stored.time_s[frame], "s");
        let values = section.values(&quantity, frame)?;
        let column = values.iter().step_by(section.stored.r_m.len());
        let sizes: Vec<f64> = column.map(|value| value.abs()).collect();
        largest = sizes[1..].iter().copied().fold(largest, f64::max);
        let positive = sizes[1..].iter().copied().filter(|size| *size > 0.0);
        smallest = positive.fold(smallest, f64::min);
        let points = curve(&depths_mm, &sizes, f64::INFINITY);
        panel = panel.line(&name, Style::Plain, points);
    }
    if let Some(points) = static_points(&section, &quantity)? {
        let shown = points.iter().filter(|(z_mm, _)| *z_mm >= 1e3 * first_m);
        largest = shown.map(|(_, size)| *size).fold(largest, f64::max);
        panel = panel.line("static, largest force", Style::HeavyDashed, points);
    }
    if largest > 0.0 {
        // before any wave there is nothing to see of the instants
        let low = (0.5 * smallest.min(largest)).max(DECADES * largest);
        panel.y = panel.y.range(low, 2.0 * largest);
    }
    Ok(panel)
}

/// Sizes of the static field on the axis under the largest force, over depths in mm; none for rates.
fn static_points(
    section: &Section<'_>,
    quantity: &Quantity,
) -> Result<Option<Vec<(f64, f64)>>, PlotError> {
    let Some(force_n) = section.impact.number("peak_force_n") else {
        return Ok(None);
    };
    if section.disc_radius_m <= 0.0 {
        return Ok(None);
    }
    let field = FIELDS.iter().position(|field| field.0 == quantity.name);
    let stress = quantity.stress();
    let target = &section.impact.target;
    let medium = Medium::new(target.material().poisson_ratio)?;
    let kernel = Kernel::new(&medium, Profile::Hertz, 1e-10)?;
    let units = KernelUnits {
        shear_modulus_pa: target.material().shear_modulus_pa(),
        longitudinal_speed_m_s: target.longitudinal_speed_m_s(),
        disc_radius_m: section.disc_radius_m,
    };
    let unit = if quantity.unit == "m" {
        units.displacement_m_per_n()
    } else {
        units.stress_pa_per_n()
    };
    const POINTS: u32 = 400;
    let most = section.extent_m()[1];
    let mut points = Vec::new();
    for i in 0..=POINTS {
        let z_m = most * 1e-4_f64.powf(1.0 - f64::from(i) / f64::from(POINTS));
        let six = kernel.static_field(0.0, z_m / section.disc_radius_m)?;
        let size = match (field, stress) {
            (Some(field), _) => six[field],
            (None, Some(of)) => of.of([six[2], six[3], six[4], six[5]], [1.0, 0.0]),
            (None, None) => return Ok(None),
        };
        points.push((1e3 * z_m, (force_n * unit * size).abs()));
    }
    Ok(Some(points))
}
