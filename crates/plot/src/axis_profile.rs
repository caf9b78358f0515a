//! A field along the axis at some instants, beside the static one.
//!
//! Sizes on logarithmic axes: the static field falls with the square of the depth, and waves run ahead of it.

use crate::error::PlotError;
use crate::history::curve;
use crate::number::with_unit;
use crate::quantity::Quantity;
use crate::request::Request;
use crate::section::Section;
use contact::KernelUnits;
use figure::{Axis, Panel, Style};
use formats::results::schema::FIELDS;
use formats::stored::StoredImpact;
use halfspace::{Kernel, Medium, Profile};
use impact::FieldsError;

/// Instants without times that are asked for: these shares of the pulse.
const SHARES: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Smallest size that is shown, over the largest.
const DECADES: f64 = 1e-6;

/// The field on the axis, and what would be there if the largest force lay on the disc for ever.
pub(crate) fn axis_profile(impact: &StoredImpact, request: &Request) -> Result<Panel, PlotError> {
    let mut section = Section::of(impact)?;
    let quantity = section.quantity(impact, &request.quantities, "stress_zz")?;
    let times_s: Vec<f64> = if request.times_s.is_empty() {
        SHARES
            .iter()
            .map(|share| section.start_s + share * section.pulse_s)
            .collect()
    } else {
        request.times_s.clone()
    };
    let depths = section.depths_m();
    let depths_mm: Vec<f64> = depths.iter().map(|z| 1e3 * z).collect();
    let [first_m, last_m] = [depths[1], depths[depths.len() - 1]];
    let depth = Axis::logarithmic("depth")
        .unit("mm")
        .range(1e3 * first_m, 1e3 * last_m);
    let size = Axis::logarithmic(&format!("size of the {}", quantity.words)).si(&quantity.unit);
    let mut panel = Panel::new(depth, size).height(380.0);
    let mut largest = 0.0_f64;
    let mut drawn = Vec::new();
    for time_s in times_s {
        let known = &section.stored.time_s;
        let frame = known.partition_point(|&t| t < time_s).min(known.len() - 1);
        if drawn.contains(&frame) {
            continue;
        }
        drawn.push(frame);
        let name = with_unit(known[frame], "s");
        let values = quantity.at(&mut section, frame)?;
        let width = section.stored.r_m.len();
        let column: Vec<f64> = section
            .image(&values)
            .iter()
            .step_by(width)
            .copied()
            .collect();
        let sizes: Vec<f64> = column.iter().map(|value| value.abs()).collect();
        largest = sizes[1..].iter().copied().fold(largest, f64::max);
        panel = panel.line(
            &name,
            Style::Plain,
            curve(&depths_mm, &sizes, f64::INFINITY),
        );
    }
    if let Some(points) = static_points(impact, &section, &quantity)? {
        let shown = points.iter().filter(|(z_mm, _)| *z_mm >= 1e3 * first_m);
        largest = shown.map(|(_, size)| *size).fold(largest, f64::max);
        panel = panel.line("static, largest force", Style::HeavyDashed, points);
    }
    if largest > 0.0 {
        panel.y = panel.y.range(DECADES * largest, 2.0 * largest);
    }
    Ok(panel)
}

/// Sizes of the static field on the axis under the largest force, over depths in mm; none for what is not one of the six fields.
fn static_points(
    impact: &StoredImpact,
    section: &Section,
    quantity: &Quantity,
) -> Result<Option<Vec<(f64, f64)>>, PlotError> {
    let field = FIELDS.iter().position(|field| field.0 == quantity.name);
    let (Some(field), Some(force_n)) = (field, impact.number("peak_force_n")) else {
        return Ok(None);
    };
    if section.disc_radius_m <= 0.0 {
        return Ok(None);
    }
    let target = &impact.scene.target;
    let fault = |error| PlotError::Fields(FieldsError::Domain(error));
    let medium = Medium::new(target.material().poisson_ratio).map_err(fault)?;
    let kernel = Kernel::new(&medium, Profile::Hertz, 1e-10).map_err(fault)?;
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
        let six = kernel
            .static_field(0.0, z_m / section.disc_radius_m)
            .map_err(fault)?;
        points.push((1e3 * z_m, (force_n * unit * six[field]).abs()));
    }
    Ok(Some(points))
}
