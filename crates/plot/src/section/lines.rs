//! What is seen along the surface and down the axis of a section: distance against time, and the axis beside the static
//! field.

use super::frames::{Quantity, Section};
use crate::error::PlotError;
use crate::request::{Kind, Request};
use crate::series::curve;
use crate::words::{axis, of_quantity, with_unit};
use contact::KernelUnits;
use figure::{Axis, Image, Layer, Legend, Panel, Scale, Style};
use formats::results::schema::FIELDS;
use formats::stored::StoredImpact;
use halfspace::{Kernel, Medium, Profile};

/// Instants that are drawn, at most.
const MOST_INSTANTS: usize = 600;

/// Distances along the surface against time, or depths on the axis, with the fronts that pass there.
pub(crate) fn space_time(impact: &StoredImpact, request: &Request) -> Result<Panel, PlotError> {
    let is_surface = request.kind == Some(Kind::Surface);
    let section = Section::of(impact)?;
    let (frames, width) = (section.stored.time_s.len(), section.stored.r_m.len());
    let chosen = (0..frames).step_by(frames.div_ceil(MOST_INSTANTS));
    let distance = Axis::linear("distance from the axis").si("m");
    let (usual, distances, distance, start_m, fronts) = match is_surface {
        true => {
            let (r_m, start_m) = (section.stored.r_m.clone(), section.disc_radius_m);
            (section.usual(), r_m, distance, start_m, 3)
        }
        false => {
            let depth = Axis::linear("depth").si("m").reversed();
            ("stress_zz", section.depths_m(), depth, 0.0, 2)
        }
    };
    let quantity = section.quantity(request, usual)?;
    let (mut rows, mut times): (Vec<Vec<f64>>, Vec<f64>) = (Vec::new(), Vec::new());
    for frame in chosen {
        let image = section.values(&quantity, frame)?;
        times.push(section.stored.time_s[frame]);
        rows.push(match is_surface {
            true => image[..width].to_vec(),
            false => image.iter().step_by(width).copied().collect(),
        });
    }
    let (along, most) = (distances.len(), distances[distances.len() - 1]);
    let near_m = section.near_m(most);
    let is_far: Vec<bool> = distances.iter().map(|d| *d > near_m).collect();
    let (colours, map) = section.colours(&quantity, &rows, &is_far);
    let values = (0..along).flat_map(|i| rows.iter().map(move |row| row[i]));
    let last_s = times[times.len() - 1];
    let time = Axis::linear("time").si("s").range(times[0], last_s);
    let image = Image::new(times, distances, values.collect(), colours, map);
    let mut panel = Panel::new(time, distance.range(0.0, most))
        .height(380.0)
        .legend(Legend::Off)
        .layer(Layer::Image(image));
    // S and R are close together: their names are not
    let named = [
        ("P", section.speeds.p, 0.8),
        ("S", section.speeds.s, 0.9),
        ("R", section.speeds.rayleigh, 0.68),
    ];
    for (name, speed, share) in named.into_iter().take(fronts) {
        let at = |time_s: f64| (time_s, start_m + speed * (time_s - section.start_s));
        let end_s = last_s.min(section.start_s + (most - start_m) / speed);
        let points = vec![at(section.start_s), at(end_s)];
        let place = at(section.start_s + share * (end_s - section.start_s));
        panel = panel
            .line("", Style::Rimmed, points)
            .layer(Layer::text(place, name));
    }
    Ok(panel)
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
    let frames = match request.times_s.as_slice() {
        [] => SHARES
            .map(|share| section.nearest(section.start_s + share * section.pulse_s))
            .to_vec(),
        given => section.asked(given)?,
    };
    let depths = section.depths_m();
    let depths_mm: Vec<f64> = depths.iter().map(|z| 1e3 * z).collect();
    let [first_m, last_m] = [depths[1], depths[depths.len() - 1]];
    let depth = Axis::logarithmic("depth")
        .unit("mm")
        .range(1e3 * first_m, 1e3 * last_m);
    let words = of_quantity(&quantity.name);
    let words = match quantity.has_sign() {
        true => format!("size of the {words}"),
        false => words,
    };
    let size = axis(&words, &quantity.unit, Scale::Logarithmic);
    let mut panel = Panel::new(depth, size).height(380.0);
    let (mut smallest, mut largest) = (f64::INFINITY, 0.0_f64);
    let is_first = |(i, frame): &(usize, &usize)| !frames[..*i].contains(frame);
    for (_, &frame) in frames.iter().enumerate().filter(is_first) {
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
    let force_n = section.impact.number("peak_force_n");
    let Some(force_n) = force_n.filter(|_| section.disc_radius_m > 0.0) else {
        return Ok(None);
    };
    let field = FIELDS.iter().position(|field| field.0 == quantity.name);
    let target = &section.impact.target;
    let medium = Medium::new(target.material().poisson_ratio)?;
    let kernel = Kernel::new(&medium, Profile::Hertz, 1e-10)?;
    let units = KernelUnits {
        shear_modulus_pa: target.material().shear_modulus_pa(),
        longitudinal_speed_m_s: target.longitudinal_speed_m_s(),
        disc_radius_m: section.disc_radius_m,
    };
    let unit = match quantity.unit.as_str() {
        "m" => units.displacement_m_per_n(),
        _ => units.stress_pa_per_n(),
    };
    const POINTS: u32 = 400;
    let most = section.extent_m()[1];
    let mut points = Vec::new();
    for i in 0..=POINTS {
        let z_m = most * 1e-4_f64.powf(1.0 - f64::from(i) / f64::from(POINTS));
        let six = kernel.static_field(0.0, z_m / section.disc_radius_m)?;
        let size = match (field, quantity.stress) {
            (Some(field), _) => six[field],
            (None, Some(of)) => of.of([six[2], six[3], six[4], six[5]], [1.0, 0.0]),
            (None, None) => return Ok(None),
        };
        points.push((1e3 * z_m, (force_n * unit * size).abs()));
    }
    Ok(Some(points))
}
