//! What is interpolated: the whole response, or the remainder beside the exact static part.
//!
//! Both by the same stencils over the same exact kernels in double precision.

use super::pulse::Compared;
use crate::StudyError;
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

/// Interpolating the whole response against interpolating the remainder, in double precision.
pub(super) fn interpolations(
    medium: &Medium,
    compared: &mut Compared<'_>,
) -> Result<(), StudyError> {
    let [r, z] = compared.pulse.place;
    let width = 0.1;
    let count = compared.pulse.count(width);
    let plan = PointPlan::new(medium.poisson_ratio(), 1e-9, width, count + 4, 4)?;
    let kernel = plan.kernel();
    let rest = kernel.static_field(r, z)?;
    let pulse = PulseSum::new(compared.pulse.length, width);
    let effort = compared.effort;
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
                    let weight = FIELDS.map(|field| {
                        let radial = if field.is_odd_in_r() {
                            across.odd()[a]
                        } else {
                            across.even()[a]
                        };
                        radial * down.even()[d]
                    });
                    corners.push((weight, cells, kernel.static_field(nodes[i], nodes[k])?));
                }
            }
            // what of the static part is interpolated
            for (method, inside) in [
                ("interpolated whole response", 1.0),
                ("interpolated remainder", 0.0),
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
                    Ok(pulse.response(&rest.map(|rest| (1.0 - inside) * rest), &sum))
                };
                let setting = format!("spacing {spacing} r0, {points} points, step {width}");
                compared.add(method, setting, false, width, run)?;
            }
        }
    }
    Ok(())
}
