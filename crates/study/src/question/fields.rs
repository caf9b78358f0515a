//! Question 3: how to compute fields under a given force history.
//!
//! The force is a pulse sin^4(pi t/T); one value is the six fields at one sample; the error is relative to
//! each field's peak, against the exact convolution.

use super::kernels::POISSON_RATIO;
use crate::StudyError;
use crate::convolution::{direct, transformed};
use crate::effort::Effort;
use crate::pulse_reference::PulseReference;
use crate::record::{Error, Question, Record};
use crate::tables::{DEFAULT_POINTS, Density};
use halfspace::{FIELDS, Kernel, Medium, Profile, Six};
use lookup::{PulseSum, Smoothness, Stencil, Table};
use std::hint::black_box;
use tabulator::{Axis, PointPlan};

/// A pulse at a point.
struct Scene {
    name: &'static str,
    /// Its name where two ways to interpolate are compared.
    interpolation: &'static str,
    reference: PulseReference,
}

/// Samples, and the exact kernel values that they took.
type Samples = (Vec<Six>, u64);

/// Every method is sampled at multiples of this.
const EVERY: f64 = 1.6;

/// Measures every method in every scene.
pub(crate) fn measure(
    effort: Effort,
    densities: &[Density],
    advance: &dyn Fn(),
) -> Result<Vec<Record>, StudyError> {
    let medium = Medium::new(POISSON_RATIO)?;
    let count = effort.pick(8, 16);
    let scene = |name, interpolation, place, length| -> Result<Scene, StudyError> {
        let reference = PulseReference::new(&medium, place, length, EVERY, count)?;
        Ok(Scene {
            name,
            interpolation,
            reference,
        })
    };
    let mut scenes = vec![scene(
        "under the disc, pulse of 10 r0/c1",
        "whole response against remainder, pulse of 10 r0/c1",
        [0.55, 0.65],
        10.0,
    )?];
    if effort == Effort::Full {
        scenes.push(scene(
            "under the disc, pulse of 40 r0/c1",
            "whole response against remainder, pulse of 40 r0/c1",
            [0.55, 0.65],
            40.0,
        )?);
        scenes.push(scene(
            "near the edge, pulse of 40 r0/c1",
            "whole response against remainder, near the edge",
            [1.03, 0.45],
            40.0,
        )?);
    }
    let mut records = Vec::new();
    for scene in &scenes {
        exact_cells(&medium, scene, effort, &mut records)?;
        advance();
        looked_up(scene, densities, effort, &mut records)?;
        advance();
        interpolations(&medium, scene, effort, &mut records)?;
        advance();
    }
    Ok(records)
}

/// Adds the record of a method whose samples are `width` apart.
fn add(
    records: &mut Vec<Record>,
    effort: Effort,
    scene: &Scene,
    (method, setting, default_path): (&'static str, String, bool),
    width: f64,
    run: &mut dyn FnMut() -> Samples,
) {
    let (samples, work) = run();
    let count = samples.len();
    let Some(errors) = scene.reference.errors(&samples, width) else {
        return;
    };
    let cost = effort.clock().time(count, || {
        black_box(run());
    });
    records.push(Record {
        question: Question::Fields,
        scene: if method.starts_with("interpolated") {
            scene.interpolation
        } else {
            scene.name
        },
        method,
        setting,
        default_path,
        cost,
        error: Error::of(&errors),
        work: Some(work as f64 / count as f64),
        refusal: None,
    });
}

/// Samples needed at a width.
fn sample_count(scene: &Scene, width: f64) -> usize {
    let end = scene.reference.times.last().copied().unwrap_or(0.0);
    (end / width).round() as usize + 1
}

/// Cells computed for the point itself, for a force that is linear or smooth between samples.
fn exact_cells(
    medium: &Medium,
    scene: &Scene,
    effort: Effort,
    records: &mut Vec<Record>,
) -> Result<(), StudyError> {
    let [r, z] = scene.reference.place;
    for tolerance in effort.pick(vec![1e-9], vec![1e-4, 1e-9]) {
        let kernel = Kernel::new(medium, Profile::Hertz, tolerance)?;
        let rest = kernel.static_field(r, z)?;
        for halvings in effort.pick(vec![2, 4], vec![0, 1, 2, 3, 4, 5]) {
            let width = EVERY * 0.5_f64.powi(halvings);
            let count = sample_count(scene, width);
            let pulse = PulseSum::new(scene.reference.length, width);
            let mut run = || {
                let mut cells = vec![[0.0; 6]; count];
                // the scene's point is inside every range
                let done = kernel.cell_averages(r, z, width, &mut cells);
                debug_assert!(done.is_ok());
                (pulse.response(&rest, &cells), count as u64)
            };
            let label = (
                "direct",
                format!("step {width}, kernel {tolerance:.0e}"),
                true,
            );
            add(records, effort, scene, label, width, &mut run);
        }
    }
    for halvings in effort.pick(vec![2], vec![0, 1, 2, 3, 4]) {
        let width = EVERY * 0.5_f64.powi(halvings);
        let count = sample_count(scene, width);
        let plan = PointPlan::new(medium.poisson_ratio(), 1e-9, width, count + 4, 4)?;
        let rest = plan.kernel().static_field(r, z)?;
        let pulse = PulseSum::new(scene.reference.length, width);
        let mut failure = None;
        let mut run = || {
            let cells = match plan.compute(r, z) {
                Ok(point) => series(&point, width, count),
                Err(error) => {
                    failure = Some(error);
                    vec![[f64::NAN; 6]; count]
                }
            };
            (pulse.response(&rest, &cells), 3 * count as u64)
        };
        let label = ("direct, smooth cells", format!("step {width}"), false);
        add(records, effort, scene, label, width, &mut run);
        if let Some(error) = failure {
            return Err(error.into());
        }
    }
    Ok(())
}

/// Cells corrected for the force's curvature from the numbers of one point.
fn series(point: &tabulator::PointKernels, width: f64, count: usize) -> Vec<Six> {
    let by_field = |values: &[Six]| -> Vec<f64> {
        (0..6)
            .flat_map(|f| values.iter().map(move |v| v[f]))
            .collect()
    };
    let numbers = lookup::Numbers {
        averages: by_field(&point.averages),
        moments: by_field(&point.moments),
        curvatures: by_field(&point.curvatures),
        tail: by_field(&point.tail),
    };
    let whole = lookup::Series::new(width, point.averages.len(), numbers);
    let mut cells = vec![[0.0; 6]; count];
    whole.fill(Smoothness::Smooth, 0, &mut cells);
    cells
}

/// Tables of several densities, coarser cells, three ways to sum.
fn looked_up(
    scene: &Scene,
    densities: &[Density],
    effort: Effort,
    records: &mut Vec<Record>,
) -> Result<(), StudyError> {
    for density in densities {
        for points in effort.pick(vec![DEFAULT_POINTS], vec![4, DEFAULT_POINTS, 8]) {
            let table = density.with_stencil(points)?;
            let own = density.is_default(points);
            let cell = table.cell_width(POISSON_RATIO)?;
            let ways = [
                ("table", Smoothness::Linear, own),
                ("table, smooth cells", Smoothness::Smooth, false),
            ];
            let coarsest = if points == DEFAULT_POINTS { 4 } else { 0 };
            for coarsening in (0..=coarsest).step_by(effort.pick(2, 1)) {
                for (method, smoothness, default_path) in ways {
                    let width = cell * f64::from(1_u32 << coarsening);
                    let setting =
                        format!("step {width}, {}, {points} points", density.spacing.label());
                    let mut run =
                        || lookup_run(scene, &table, smoothness, coarsening, Sum::Running);
                    let label = (method, setting, default_path);
                    add(records, effort, scene, label, width, &mut run);
                }
            }
            if own {
                for (method, sum) in [
                    ("table, direct sums", Sum::Direct),
                    ("table, FFT", Sum::Transform),
                ] {
                    let width = cell;
                    let mut run = || lookup_run(scene, &table, Smoothness::Linear, 0, sum);
                    let label = (method, format!("step {width}"), true);
                    add(records, effort, scene, label, width, &mut run);
                }
            }
        }
    }
    Ok(())
}

/// How cells and force are summed.
#[derive(Debug, Clone, Copy)]
enum Sum {
    /// Running sums of two exponentials: for this pulse only.
    Running,
    Direct,
    Transform,
}

fn lookup_run(
    scene: &Scene,
    table: &Table,
    smoothness: Smoothness,
    coarsening: u32,
    sum: Sum,
) -> Samples {
    let [r, z] = scene.reference.place;
    let Ok(cell) = table.cell_width(POISSON_RATIO) else {
        return (Vec::new(), 0);
    };
    let width = cell * f64::from(1_u32 << coarsening);
    let count = sample_count(scene, width);
    let mut cells = vec![[0.0; 6]; count];
    let Ok(info) = table.trace_for(smoothness, POISSON_RATIO, r, z, coarsening, &mut cells) else {
        return (vec![[f64::NAN; 6]; count], 0);
    };
    let pulse = PulseSum::new(scene.reference.length, width);
    let force = || (0..count).map(|n| pulse.force(n)).collect::<Vec<f64>>();
    let samples = match sum {
        Sum::Running => pulse.response(&info.static_part, &cells),
        Sum::Direct => direct(&info.static_part, &cells, &force()),
        Sum::Transform => transformed(&info.static_part, &cells, &force()),
    };
    (samples, 0)
}

/// What is interpolated between the nodes of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Interpolated {
    Whole,
    Remainder,
}

/// Interpolating the whole response against interpolating the remainder, in double precision.
fn interpolations(
    medium: &Medium,
    scene: &Scene,
    effort: Effort,
    records: &mut Vec<Record>,
) -> Result<(), StudyError> {
    let [r, z] = scene.reference.place;
    let width = 0.1;
    let count = sample_count(scene, width);
    let plan = PointPlan::new(medium.poisson_ratio(), 1e-9, width, count + 4, 4)?;
    let kernel = plan.kernel();
    let rest = kernel.static_field(r, z)?;
    let pulse = PulseSum::new(scene.reference.length, width);
    for spacing in effort.pick(vec![0.125], vec![0.25, 0.125, 0.0625]) {
        let nodes = Axis::uniform(3.0, spacing).nodes();
        for points in effort.pick(vec![6], vec![4, 6, 8]) {
            let mesh = lookup::locate(&nodes, r).zip(lookup::locate(&nodes, z));
            let Some((i, k)) = mesh else {
                continue;
            };
            let across = Stencil::mirrored(&nodes, i, r, points);
            let down = Stencil::one_sided(&nodes, k, z, points);
            let mut corners = Vec::new();
            for (a, &i) in across.nodes().iter().enumerate() {
                for (d, &k) in down.nodes().iter().enumerate() {
                    let cells = series(&plan.compute(nodes[i], nodes[k])?, width, count);
                    let weight: Six = std::array::from_fn(|f| {
                        let radial = if FIELDS[f].is_odd_in_r() {
                            across.odd()[a]
                        } else {
                            across.even()[a]
                        };
                        radial * down.even()[d]
                    });
                    corners.push((weight, cells, kernel.static_field(nodes[i], nodes[k])?));
                }
            }
            for (method, what) in [
                ("interpolated whole response", Interpolated::Whole),
                ("interpolated remainder", Interpolated::Remainder),
            ] {
                let mut run = || {
                    let mut sum = vec![[0.0; 6]; count];
                    for (weight, cells, node_rest) in &corners {
                        let shift = match what {
                            Interpolated::Whole => *node_rest,
                            Interpolated::Remainder => [0.0; 6],
                        };
                        for (total, cell) in sum.iter_mut().zip(cells) {
                            for f in 0..6 {
                                total[f] += weight[f] * (cell[f] + shift[f]);
                            }
                        }
                    }
                    let own = match what {
                        Interpolated::Whole => [0.0; 6],
                        Interpolated::Remainder => rest,
                    };
                    (pulse.response(&own, &sum), 0)
                };
                let setting = format!("spacing {spacing} r0, {points} points, step {width}");
                add(
                    records,
                    effort,
                    scene,
                    (method, setting, false),
                    width,
                    &mut run,
                );
            }
        }
    }
    Ok(())
}
