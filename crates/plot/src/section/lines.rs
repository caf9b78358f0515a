//! Fields along the surface and down the axis of a section: distance over time, and the axis compared with the static
//! field.

use super::frames::{SectionQuantity, SectionView, between};
use crate::error::{Drawn, PlotError};
use crate::request::{PictureKind, Request};
use crate::series::curve;
use crate::words::{axis, of_quantity, with_unit};
use contact::KernelUnits;
use figure::{Axis, Image, Layer, Legend, Panel, Scale, Style};
use formats::quantities::FIELDS;
use formats::stored::StoredImpact;
use halfspace::{Kernel, Medium, Profile};

/// Largest number of times that are drawn.
const MOST_INSTANTS: usize = 600;

/// Frames per pulse below which a picture of distance over time is not smooth.
const SMOOTH_FRAMES: f64 = 8.0;

/// Distances along the surface over time, or depths on the axis, with the fronts that pass there.
pub(crate) fn space_time(
    impact: &StoredImpact,
    request: &Request,
    kind: PictureKind,
) -> Drawn<Panel> {
    let is_surface = kind == PictureKind::Surface;
    let section = SectionView::of(impact)?;
    let width = section.stored.r_m.len();
    let speeds = section.speeds;
    let distance = Axis::linear("distance from the axis").si("m");
    // the interpolation between nodes follows the largest wave
    let (usual, nodes, distance, start_m, fronts, speed) = match is_surface {
        true => {
            let (r_m, start_m) = (section.stored.r_m.clone(), section.disc_radius_m);
            (section.usual(), r_m, distance, start_m, 3, speeds.rayleigh)
        }
        false => {
            let depth = Axis::linear("depth").si("m").reversed();
            ("stress_zz", section.depths_m(), depth, 0.0, 2, speeds.p)
        }
    };
    let quantity = section.quantity(request, usual)?;
    let known = &section.stored.time_s;
    let span_s = request.span_within([known[0], known[known.len() - 1]])?;
    let (mut rows, mut times): (Vec<Vec<f64>>, Vec<f64>) = (Vec::new(), Vec::new());
    for frame in chosen(known, span_s, nodes[nodes.len() - 1] / speed) {
        let image = section.values(&quantity, frame)?;
        times.push(known[frame]);
        rows.push(match is_surface {
            true => image[..width].to_vec(),
            false => image.iter().step_by(width).copied().collect(),
        });
    }
    let most = nodes[nodes.len() - 1];
    let near_m = section.near_m(most);
    let is_far: Vec<bool> = nodes.iter().map(|d| *d > near_m).collect();
    let (colours, map) = section.colours(&quantity, &rows, &is_far);
    let seen = Seen {
        slowness: 1.0 / speed,
        near: (section.disc_radius_m, quantity.near_power()),
        nodes: &nodes,
        times: &times,
        rows: &rows,
    };
    let (distances, values) = seen.finer();
    let [from_s, to_s] = span_s;
    let time = Axis::linear("time").si("s").range(from_s, to_s);
    let notes = coarse(&section, &times);
    let image = Image::new(times, distances, values, colours, map);
    let mut panel = Panel::new(time, distance.range(0.0, most))
        .height(380.0)
        .legend(Legend::Off)
        .layer(Layer::Image(image));
    // S and R are close together, so their names differ in position
    let named = [
        ("P", speeds.p, 0.8),
        ("S", speeds.s, 0.9),
        ("R", speeds.rayleigh, 0.68),
    ];
    for (name, speed, share) in named.into_iter().take(fronts) {
        let at = |time_s: f64| (time_s, start_m + speed * (time_s - section.start_s));
        let first_s = section.start_s.max(from_s);
        let end_s = to_s.min(section.start_s + (most - start_m) / speed);
        if first_s >= end_s {
            continue;
        }
        panel = panel
            .line("", Style::Rimmed, vec![at(first_s), at(end_s)])
            .layer(Layer::text(at(first_s + share * (end_s - first_s)), name));
    }
    Ok((panel, notes))
}

/// Frames within a span, extended on both sides by the travel time between nodes; at most [`MOST_INSTANTS`].
fn chosen(known: &[f64], [from_s, to_s]: [f64; 2], around_s: f64) -> impl Iterator<Item = usize> {
    let first = known
        .partition_point(|&t| t <= from_s - around_s)
        .saturating_sub(1);
    let end = (known.partition_point(|&t| t < to_s + around_s) + 1).min(known.len());
    (first..end).step_by((end - first).div_ceil(MOST_INSTANTS))
}

/// Note for the user if the frames are too far apart.
fn coarse(section: &SectionView<'_>, times: &[f64]) -> Vec<String> {
    let Some(step_s) = times
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .reduce(f64::max)
    else {
        return Vec::new();
    };
    let (needed_s, known) = (section.pulse_s / SMOOTH_FRAMES, &section.stored.time_s);
    let needed = ((known[known.len() - 1] - known[0]) / needed_s).ceil() + 1.0;
    let [step, pulse] = [step_s, section.pulse_s].map(|time_s| with_unit(time_s, "s"));
    let note = format!(
        "the frames are {step} apart but the pulse lasts {pulse}, so waves look like dots: use [map] frames = {needed} or more"
    );
    Vec::from_iter((step_s > needed_s && known.len() > 2).then_some(note))
}

/// A field along a line at some times.
struct Seen<'a> {
    /// Slowness in s/m of the wave that the interpolation follows.
    slowness: f64,
    /// Radius of the contact in m, and the power of 1/distance with which the field grows towards it.
    near: (f64, f64),
    /// Distances in m.
    nodes: &'a [f64],
    times: &'a [f64],
    /// Values at the nodes, one row per time.
    rows: &'a [Vec<f64>],
}

impl Seen<'_> {
    /// Distances at and between the nodes, and the values there at all times; time varies fastest.
    ///
    /// A wave arrives at a place between two nodes later than at the first and earlier than at the second, so values
    /// are interpolated along its path. Interpolating at equal times would turn a wave that is narrower than a cell
    /// into a row of dots.
    fn finer(&self) -> (Vec<f64>, Vec<f64>) {
        let last = self.nodes.len() - 1;
        let weight = |d: f64| (d * d + self.near.0.powi(2)).powf(0.5 * self.near.1);
        let (mut distances, mut values) = (Vec::new(), Vec::new());
        for (i, part) in between(self.nodes) {
            let next = (i + 1).min(last);
            let width = self.nodes[next] - self.nodes[i];
            let distance = self.nodes[i] + part * width;
            let shares = [
                (i, part * width, 1.0 - part),
                (next, (part - 1.0) * width, part),
            ];
            let scaled = shares.map(|(node, further_m, share)| {
                let scale = weight(self.nodes[node]) / weight(distance);
                (node, further_m * self.slowness, scale, share)
            });
            values.extend(self.times.iter().map(|time_s| {
                let (mut sum, mut total) = (0.0, 0.0);
                for (node, later_s, scale, share) in scaled {
                    if let Some(value) = self.at(node, time_s - later_s).filter(|_| share > 0.0) {
                        sum += share * scale * value;
                        total += share;
                    }
                }
                if total > 0.0 { sum / total } else { f64::NAN }
            }));
            distances.push(distance);
        }
        (distances, values)
    }

    /// The value at a node at a time, linear between samples; the first value before them, none after them.
    fn at(&self, node: usize, time_s: f64) -> Option<f64> {
        let after = self.times.partition_point(|&t| t < time_s);
        let known = self.times.get(after)?;
        let Some(before) = after.checked_sub(1) else {
            return Some(self.rows[0][node]);
        };
        let part = (time_s - self.times[before]) / (known - self.times[before]);
        let [a, b] = [before, after].map(|frame| self.rows[frame][node]);
        Some(a + part * (b - a))
    }
}

/// Default times as fractions of the pulse.
const SHARES: [f64; 4] = [0.2, 0.4, 0.6, 0.8];

/// Smallest ratio of the lower end of the axis to the largest value.
const DECADES: f64 = 1e-6;

/// The field on the axis at some times, and the static field of the largest force on the disc.
///
/// Magnitudes on logarithmic axes: the static field falls with the square of the depth, and waves run ahead of it.
pub(crate) fn axis_profile(impact: &StoredImpact, request: &Request) -> Result<Panel, PlotError> {
    let section = SectionView::of(impact)?;
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
        true => format!("magnitude of the {words}"),
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
        let points = curve(&depths_mm, &sizes, [0.0, f64::INFINITY]);
        panel = panel.line(&name, Style::Plain, points);
    }
    if let Some(points) = static_points(&section, &quantity)? {
        let shown = points.iter().filter(|(z_mm, _)| *z_mm >= 1e3 * first_m);
        largest = shown.map(|(_, size)| *size).fold(largest, f64::max);
        panel = panel.line("static, largest force", Style::HeavyDashed, points);
    }
    if largest > 0.0 {
        // values before the first wave are not visible
        let low = (0.5 * smallest.min(largest)).max(DECADES * largest);
        panel.y = panel.y.range(low, 2.0 * largest);
    }
    Ok(panel)
}

/// Magnitudes of the static field on the axis under the largest force, over depths in mm; none for rates.
fn static_points(
    section: &SectionView<'_>,
    quantity: &SectionQuantity,
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
    const STATIC_POINTS: u32 = 400;
    let most = section.extent_m()[1];
    let mut points = Vec::new();
    for i in 0..=STATIC_POINTS {
        let z_m = most * 1e-4_f64.powf(1.0 - f64::from(i) / f64::from(STATIC_POINTS));
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
