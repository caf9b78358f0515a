//! What is interpolated: the whole response, or the remainder beside the exact static part.
//!
//! Both by the same stencils over the same exact kernels in double precision.

use super::pulse_scene::{Label, Scene, add, sample_count};
use crate::StudyError;
use crate::effort::Effort;
use crate::record::Record;
use halfspace::{FIELDS, Medium, Six};
use lookup::{PulseSum, Smoothness, Stencil};
use tabulator::{Axis, PointPlan};

/// Cells corrected for the force's curvature from the numbers of one point.
pub(crate) fn series(point: &tabulator::PointKernels, width: f64, count: usize) -> Vec<Six> {
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

/// What is interpolated between the nodes of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Interpolated {
    Whole,
    Remainder,
}

/// Interpolating the whole response against interpolating the remainder, in double precision.
pub(super) fn interpolations(
    medium: &Medium,
    scene: &Scene,
    effort: Effort,
    records: &mut Vec<Record>,
) -> Result<(), StudyError> {
    let reference = &scene.reference;
    let [r, z] = reference.place;
    let width = 0.1;
    let count = sample_count(reference, width);
    let plan = PointPlan::new(medium.poisson_ratio(), 1e-9, width, count + 4, 4)?;
    let kernel = plan.kernel();
    let rest = kernel.static_field(r, z)?;
    let pulse = PulseSum::new(reference.length, width);
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
                    pulse.response(&own, &sum)
                };
                let label = Label {
                    scene: scene.interpolation,
                    method,
                    setting: format!("spacing {spacing} r0, {points} points, step {width}"),
                    default_path: false,
                };
                add(records, effort, reference, label, width, &mut run);
            }
        }
    }
    Ok(())
}
