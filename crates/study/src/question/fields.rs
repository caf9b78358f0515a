//! Question 3: how to compute fields under a given force history.
//!
//! The force is a pulse sin^4(pi t/T). One value is the six fields at one point over a time of r0/c1, so that coarser
//! cells count as cheaper. The error is relative to the peak of each field; the reference is the exact convolution.
//!
//! The exact convolution is computed by Gauss rules between the arrivals, without cells or samples of the force:
//!
//! ```text
//! u(t) = P(t) static + int_0^t P'(t - x) R(x) dx,     P = sin^4(pi t/T)
//! ```

use super::kernels::{ALL_FIELDS, POISSON_RATIO};
use crate::measure::{Effort, Found, MeasuredScene, Rows};
use crate::method::ComparedMethod;
use crate::record::{Question, off, peaks};
use crate::scenes::Density;
use fault::AnyError;
use halfspace::gauss::Rule;
use halfspace::{Arrivals, FIELDS, Kernel, Medium, Profile, Six};
use impact::KernelSource;
use impact::convolve::{Convolver, Method};
use impact::kernels::{CellPlan, Cells, Pulse};
use lookup::Smoothness::{Linear, Smooth};
use lookup::{PulseSum, Stencil};
use std::f64::consts::PI;
use tabulator::{Axis, PointPlan};

/// Interval in r0/c1 at which every method is sampled.
const EVERY: f64 = 1.6;

/// Scenes: name, name in the comparison of two interpolations, point, and length of the pulse; a quick chart has the
/// first only.
const SCENES: [(&str, &str, [f64; 2], f64); 3] = [
    (
        "under the disc, pulse of 10 r0/c1",
        "whole response against remainder, pulse of 10 r0/c1",
        [0.55, 0.65],
        10.0,
    ),
    (
        "under the disc, pulse of 40 r0/c1",
        "whole response against remainder, pulse of 40 r0/c1",
        [0.55, 0.65],
        40.0,
    ),
    (
        "near the edge, pulse of 40 r0/c1",
        "whole response against remainder, near the edge",
        [1.03, 0.45],
        40.0,
    ),
];

/// Measures every method in every scene.
pub(crate) fn measure(effort: Effort, densities: &[Density], advance: &dyn Fn()) -> Rows {
    let medium = Medium::new(POISSON_RATIO)?;
    let count = effort.pick(8, 16);
    let mut records = Vec::new();
    for (name, interpolation, place, length) in &SCENES[..effort.pick(1, 3)] {
        let pulse = &PulseReference::new(&medium, *place, *length, EVERY, count)?;
        let mut rows = MeasuredScene {
            effort,
            question: Question::Fields,
            name,
            values: pulse.end(),
            errors: &|samples: &Vec<Six>| Ok(pulse.errors(samples)),
            records: &mut records,
        };
        exact_cells(pulse, &mut rows)?;
        advance();
        looked_up(densities, pulse, &mut rows)?;
        advance();
        rows.name = interpolation;
        interpolations(pulse, &mut rows)?;
        advance();
    }
    Ok(records)
}

/// Samples, and their number as the work.
fn counted(samples: Vec<Six>) -> Found<Vec<Six>> {
    let count = samples.len() as u64;
    Ok((samples, Some(count)))
}

/// The response at all samples.
fn response(convolver: &Convolver, rest: &Six, cells: &[Six]) -> Vec<Six> {
    let fields = convolver.fields(rest, cells);
    let samples = 0..fields[0].len();
    samples.map(|n| fields.each_ref().map(|f| f[n])).collect()
}

/// Cells computed for a point in r0, for samples of a pulse.
pub(crate) fn computed(
    source: &KernelSource,
    place: [f64; 2],
    (samples, step): (usize, f64),
    length: f64,
    tolerance: f64,
) -> Result<Cells, AnyError> {
    let plan = CellPlan {
        parts: [1, 0],
        step,
        count: samples + lookup::BEYOND,
        pulse: Pulse::Smooth(length),
        rates: false,
        tolerance,
        damping: None,
    };
    Ok(source.cells(POISSON_RATIO, place, 1.0, plan)?)
}

/// Cells computed for the point itself, for a force that is linear or smooth between samples.
fn exact_cells(
    pulse: &PulseReference,
    rows: &mut MeasuredScene<'_, Vec<Six>>,
) -> Result<(), AnyError> {
    use ComparedMethod::{Direct, DirectLinear};
    let medium = Medium::new(POISSON_RATIO)?;
    // method, smoothness, kernel tolerance and halvings of the step; the program's own tolerance depends on the scene's
    let settings: [(_, _, f64, [&[i32]; 2]); 4] = [
        (Direct, Smooth, 1e-8, [&[1, 3], &[0, 1, 2, 3, 4, 5]]),
        (Direct, Smooth, 1e-12, [&[], &[2, 3, 4, 5]]),
        (Direct, Smooth, 1e-4, [&[], &[1, 2, 3]]),
        (DirectLinear, Linear, 1e-8, [&[3], &[0, 1, 2, 3, 4, 5]]),
    ];
    for (method, smoothness, tolerance, [quick, full]) in settings {
        let source = KernelSource::direct(&medium, tolerance)?;
        for &halvings in rows.effort.pick(quick, full) {
            let width = EVERY * 0.5_f64.powi(halvings);
            let force = pulse.force(width);
            let convolver = Convolver::new(&force);
            let run = || {
                let samples = (force.len(), width);
                let cells = computed(&source, pulse.place, samples, pulse.length, tolerance)?;
                let of_force = match smoothness {
                    Linear => &cells.moments.averages,
                    Smooth => &cells.smooth,
                };
                counted(response(&convolver, &cells.static_part, of_force))
            };
            let setting = format!("step {width}, kernel {tolerance:.0e}");
            let row = rows.add(method, setting, run)?;
            row.default_path = smoothness == Smooth && tolerance < 1e-7;
        }
    }
    Ok(())
}

/// Tables of several densities and stencils, coarser cells, three ways to sum.
fn looked_up(
    densities: &[Density],
    pulse: &PulseReference,
    rows: &mut MeasuredScene<'_, Vec<Six>>,
) -> Result<(), AnyError> {
    use Method::{Direct, Transform};
    // smoothness of the force and method of summation; none means running sums of the two exponentials of the pulse
    let own = [
        (ComparedMethod::TableDirectSums, Smooth, Some(Direct), true),
        (
            ComparedMethod::TableTransform,
            Smooth,
            Some(Transform),
            true,
        ),
        (ComparedMethod::TableLinear, Linear, Some(Transform), false),
        (ComparedMethod::TableOfPulse, Smooth, None, false),
    ];
    let method = ComparedMethod::TableOther;
    let other = [(method, Smooth, Some(Transform), false)];
    let (effort, [r, z]) = (rows.effort, pulse.place);
    for density in densities {
        for points in effort.pick(vec![Density::points()], vec![4, 6, Density::points()]) {
            let table = density.with_stencil(points)?;
            let is_default = density.is_default(points);
            let (ways, coarsest) = if is_default {
                (&own[..], 4)
            } else {
                (&other[..], 0)
            };
            for coarsening in (0..=coarsest).step_by(effort.pick(2, 1)) {
                let width = table.cell_width(POISSON_RATIO)? * f64::from(1_u32 << coarsening);
                let force = pulse.force(width);
                let sums = PulseSum::new(pulse.length, width);
                let spacing = density.label();
                for &(method, smoothness, sum, is_own) in ways {
                    let convolver = sum.map(|sum| Convolver::by(&force, sum));
                    let run = || {
                        let mut cells = vec![[0.0; 6]; force.len()];
                        let nu = POISSON_RATIO;
                        let info = table.trace(smoothness, nu, r, z, coarsening, &mut cells)?;
                        counted(match &convolver {
                            Some(convolver) => response(convolver, &info.static_part, &cells),
                            None => sums.response(&info.static_part, &cells),
                        })
                    };
                    let setting = format!("step {width}, {spacing}, {points} points");
                    rows.add(method, setting, run)?.default_path = is_own;
                }
            }
        }
    }
    Ok(())
}

/// A pulse at a point and its exact response at a few times.
struct PulseReference {
    place: [f64; 2],
    length: f64,
    times: Vec<f64>,
    exact: Vec<Six>,
    peak: Six,
}

impl PulseReference {
    /// The reference at `count` multiples of `every`, until some time after pulse and waves have passed.
    fn new(
        medium: &Medium,
        [r, z]: [f64; 2],
        length: f64,
        every: f64,
        count: usize,
    ) -> Result<Self, AnyError> {
        let kernel = Kernel::new(medium, Profile::Hertz, 1e-12)?;
        let arrivals = Arrivals::new(medium, Profile::Hertz, r, z)?;
        let rest = kernel.static_field(r, z)?;
        let last = (0.5 * length).max(arrivals.last()) + 0.7 * length;
        let stride = (last / every / count as f64).ceil().max(1.0);
        let times: Vec<f64> = (1..=count).map(|i| i as f64 * stride * every).collect();
        let end = times[count - 1];
        let mut cuts = arrivals.sorted();
        cuts.extend([0.0, end]);
        // panels of at most 1/16 of the pulse
        let panels = (1..).map(|i| f64::from(i) * length / 16.0);
        cuts.extend(panels.take_while(|&x| x < end));
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
        cuts.retain(|&x| x <= end);
        let rule = Rule::new(14);
        let at_rest = |&t: &f64| rest.map(|s| sine(t, length)[0] * s);
        let mut exact: Vec<Six> = times.iter().map(at_rest).collect();
        for pair in cuts.windows(2) {
            let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
            for (x, weight) in rule.on(-1.0, 1.0) {
                // a substitution that absorbs square roots at the arrivals
                let place = middle + half * 0.5 * x * (3.0 - x * x);
                let weight = weight * half * 1.5 * (1.0 - x * x);
                let value = kernel.remainder(r, z, place)?.value;
                for (u, &t) in exact.iter_mut().zip(&times) {
                    let slope = weight * sine(t - place, length)[1];
                    for f in 0..6 {
                        u[f] += slope * value[f];
                    }
                }
            }
        }
        Ok(Self {
            place: [r, z],
            length,
            times,
            peak: peaks(&exact),
            exact,
        })
    }

    /// The last of the times.
    fn end(&self) -> f64 {
        self.times[self.times.len() - 1]
    }

    /// Samples of the pulse, `width` apart, as many as are needed.
    fn force(&self, width: f64) -> Vec<f64> {
        let pulse = PulseSum::new(self.length, width);
        let count = (self.end() / width).round() as usize + 1;
        (0..count).map(|n| pulse.force(n)).collect()
    }

    /// Relative errors of the samples at the times of the reference.
    fn errors(&self, samples: &[Six]) -> Vec<f64> {
        let width = self.end() / (samples.len() - 1) as f64;
        let at = |t: &f64| {
            let place = (t / width).round();
            debug_assert!((place * width - t).abs() <= 1e-9 * t, "no sample at {t}");
            samples[place as usize]
        };
        let found: Vec<Six> = self.times.iter().map(at).collect();
        off(&found, &self.exact, &self.peak, &ALL_FIELDS)
    }
}

/// sin^4(pi t/T) on [0, T], and its slope.
fn sine(t: f64, length: f64) -> [f64; 2] {
    if !(0.0..=length).contains(&t) {
        return [0.0; 2];
    }
    let (sine, cosine) = (PI * t / length).sin_cos();
    [sine.powi(4), 4.0 * PI / length * sine.powi(3) * cosine]
}

/// Cells corrected for the curvature of the force, from the numbers of one point.
pub(crate) fn series(point: &lookup::Numbers, width: f64, count: usize) -> Vec<Six> {
    let whole = lookup::Series::new(width, point[0].len(), point.clone());
    let mut cells = vec![[0.0; 6]; count];
    whole.fill(Smooth, 0, &mut cells);
    cells
}

/// Compares interpolation of the whole response with interpolation of the remainder plus the exact static part, with
/// the same stencils and the same exact kernels in double precision.
fn interpolations(
    pulse: &PulseReference,
    rows: &mut MeasuredScene<'_, Vec<Six>>,
) -> Result<(), AnyError> {
    let [r, z] = pulse.place;
    let width = 0.1;
    let count = pulse.force(width).len();
    let plan = PointPlan::new(POISSON_RATIO, 1e-9, width, count + 4, 4)?;
    let kernel = plan.kernel();
    let rest = kernel.static_field(r, z)?;
    let pulse = PulseSum::new(pulse.length, width);
    let effort = rows.effort;
    for spacing in effort.pick(vec![0.125], vec![0.25, 0.125, 0.0625]) {
        let nodes = Axis::uniform(3.0, spacing).nodes();
        for points in effort.pick(vec![6], vec![4, 6, 8]) {
            let mesh = lookup::locate(&nodes, r).zip(lookup::locate(&nodes, z));
            let (i, k) = mesh.ok_or("a point outside the nodes")?;
            let across = Stencil::mirrored(&nodes, i, r, points);
            let down = Stencil::one_sided(&nodes, k, z, points);
            let mut corners = Vec::new();
            for (a, &i) in across.nodes().iter().enumerate() {
                for (d, &k) in down.nodes().iter().enumerate() {
                    let cells = series(&plan.compute(nodes[i], nodes[k])?, width, count);
                    let radial = [across.even()[a], across.odd()[a]];
                    let parity = FIELDS.map(|field| usize::from(field.is_odd_in_r()));
                    let weight = parity.map(|parity| radial[parity] * down.even()[d]);
                    corners.push((weight, cells, kernel.static_field(nodes[i], nodes[k])?));
                }
            }
            // fraction of the static part that is interpolated
            for (method, inside) in [
                (ComparedMethod::WholeResponse, 1.0),
                (ComparedMethod::RemainderAlone, 0.0),
            ] {
                let run = || {
                    let mut sum = vec![[0.0; 6]; count];
                    for (weight, cells, rest) in &corners {
                        let shift = rest.map(|rest| inside * rest);
                        for (total, cell) in sum.iter_mut().zip(cells) {
                            for f in 0..6 {
                                total[f] += weight[f] * (cell[f] + shift[f]);
                            }
                        }
                    }
                    let outside = rest.map(|rest| (1.0 - inside) * rest);
                    counted(pulse.response(&outside, &sum))
                };
                let setting = format!("spacing {spacing} r0, {points} points, step {width}");
                rows.add(method, setting, run)?;
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_independent_reference() {
        // tests/golden/fields.csv: Durbin inversion with direct Hankel quadrature, 1e-10 absolute
        let golden = include_str!("../../../../tests/golden/fields.csv");
        let mut seen = 0;
        for line in golden.lines().skip(1) {
            let row: Vec<f64> = line.split(',').filter_map(|x| x.parse().ok()).collect();
            let [nu, r, z, length, t] = row[..5] else {
                continue;
            };
            if z < 0.2 || length > 20.0 || seen >= 12 {
                continue;
            }
            // the first time is that of the row
            let found =
                PulseReference::new(&Medium::new(nu).unwrap(), [r, z], length, t, 100).unwrap();
            assert_eq!(found.times[0], t);
            seen += 1;
            // the columns are w, u, szz, srz, srr, stt
            for (column, field) in [(5, 1), (6, 0), (7, 4), (8, 5), (9, 2), (10, 3)] {
                let error = (found.exact[0][field] - row[column]).abs();
                assert!(error < 1e-9, "{line}: {field} off by {error:e}");
            }
        }
        assert_eq!(seen, 12);
    }
}
