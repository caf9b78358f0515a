//! Question 3: how to compute fields under a given force history.
//!
//! The force is a pulse sin^4(pi t/T); one value is the six fields at one point over r0/c1 of time, so that
//! coarser cells are worth what they save; the error is relative to each field's peak, against the exact
//! convolution.

use super::interpolation::interpolations;
use super::kernels::POISSON_RATIO;
use super::pulse::{Compared, PulseReference};
use crate::StudyError;
use crate::measure::Effort;
use crate::record::Record;
use crate::tables::Density;
use halfspace::{Medium, Six};
use impact::convolve::{Convolver, Method};
use impact::kernels::{CellPlan, Pulse};
use impact::{KernelSource, Place};
use lookup::{PulseSum, Smoothness};

/// Every method is sampled at multiples of this.
const EVERY: f64 = 1.6;

/// Scenes: name, name where two ways to interpolate are compared, point and length of the pulse; the first alone in a
/// quick chart.
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
pub(crate) fn measure(
    effort: Effort,
    densities: &[Density],
    advance: &dyn Fn(),
) -> Result<Vec<Record>, StudyError> {
    let medium = Medium::new(POISSON_RATIO)?;
    let mut scenes = Vec::new();
    for (name, interpolation, place, length) in &SCENES[..effort.pick(1, 3)] {
        let count = effort.pick(8, 16);
        let pulse = PulseReference::new(&medium, *place, *length, EVERY, count)?;
        scenes.push((*name, *interpolation, pulse));
    }
    let mut records = Vec::new();
    for (name, interpolation, pulse) in &scenes {
        let mut compared = Compared {
            effort,
            scene: name,
            pulse,
            records: &mut records,
        };
        exact_cells(&medium, &mut compared)?;
        advance();
        looked_up(densities, &mut compared)?;
        advance();
        compared.scene = interpolation;
        interpolations(&medium, &mut compared)?;
        advance();
    }
    Ok(records)
}

/// The response at all samples.
fn response(convolver: &Convolver, rest: &Six, cells: &[Six]) -> Vec<Six> {
    let fields = convolver.fields(rest, cells);
    (0..fields[0].len())
        .map(|n| std::array::from_fn(|f| fields[f][n]))
        .collect()
}

/// Cells computed for the point itself, for a force that is linear or smooth between samples.
fn exact_cells(medium: &Medium, compared: &mut Compared<'_>) -> Result<(), StudyError> {
    use Smoothness::{Linear, Smooth};
    // smoothness, kernel tolerance and halvings of the step; the program's own tolerance goes with the scene's
    let settings: [(Smoothness, f64, &[i32], &[i32]); 4] = [
        (Smooth, 1e-8, &[1, 3], &[0, 1, 2, 3, 4, 5]),
        (Smooth, 1e-12, &[], &[2, 3, 4, 5]),
        (Smooth, 1e-4, &[], &[1, 2, 3]),
        (Linear, 1e-8, &[3], &[0, 1, 2, 3, 4, 5]),
    ];
    let [r, z] = compared.pulse.place;
    for (smoothness, tolerance, quick, full) in settings {
        let source = KernelSource::direct(medium, tolerance)?;
        for &halvings in compared.effort.pick(quick, full) {
            let width = EVERY * 0.5_f64.powi(halvings);
            let force = compared.force(width);
            let convolver = Convolver::new(&force);
            let pulse = Pulse::Smooth(compared.pulse.length);
            let run = || {
                let place = Place {
                    r,
                    z,
                    disc_radius_m: 1.0,
                };
                let plan = CellPlan {
                    step: width,
                    count: force.len() + lookup::BEYOND,
                    pulse,
                    rates: false,
                    tolerance,
                };
                let cells = source.cells(medium.poisson_ratio(), place, plan)?;
                let of_force = match smoothness {
                    Linear => &cells.moments.averages,
                    Smooth => &cells.smooth,
                };
                Ok(response(&convolver, &cells.static_part, of_force))
            };
            let method = match smoothness {
                Linear => "direct, linear cells",
                Smooth => "direct",
            };
            let setting = format!("step {width}, kernel {tolerance:.0e}");
            let is_own = smoothness == Smooth && tolerance < 1e-7;
            compared.add(method, setting, is_own, width, run)?;
        }
    }
    Ok(())
}

/// Tables of several densities and stencils, coarser cells, three ways to sum.
fn looked_up(densities: &[Density], compared: &mut Compared<'_>) -> Result<(), StudyError> {
    use Method::{Direct, Transform};
    use Smoothness::{Linear, Smooth};
    // for which forces, and how they are summed: none is by running sums of the two exponentials of the pulse
    let own = [
        ("table, direct sums", Smooth, Some(Direct), true),
        ("table, FFT", Smooth, Some(Transform), true),
        ("table, linear cells", Linear, Some(Transform), false),
        ("table, sums for this pulse only", Smooth, None, false),
    ];
    let method = "table, other nodes or points";
    let other = [(method, Smooth, Some(Transform), false)];
    let effort = compared.effort;
    let [r, z] = compared.pulse.place;
    for density in densities {
        for points in effort.pick(vec![Density::points()], vec![4, 6, Density::points()]) {
            let table = density.with_stencil(points)?;
            let (ways, coarsest) = if density.is_default(points) {
                (&own[..], 4)
            } else {
                (&other[..], 0)
            };
            for coarsening in (0..=coarsest).step_by(effort.pick(2, 1)) {
                let width = table.cell_width(POISSON_RATIO)? * f64::from(1_u32 << coarsening);
                let force = compared.force(width);
                let pulse = PulseSum::new(compared.pulse.length, width);
                let spacing = density.label();
                for &(method, smoothness, sum, is_own) in ways {
                    let convolver = sum.map(|sum| Convolver::by(&force, sum));
                    let run = || {
                        let mut cells = vec![[0.0; 6]; force.len()];
                        let nu = POISSON_RATIO;
                        let info = table.trace_for(smoothness, nu, r, z, coarsening, &mut cells)?;
                        Ok(match &convolver {
                            Some(convolver) => response(convolver, &info.static_part, &cells),
                            None => pulse.response(&info.static_part, &cells),
                        })
                    };
                    let setting = format!("step {width}, {spacing}, {points} points");
                    compared.add(method, setting, is_own, width, run)?;
                }
            }
        }
    }
    Ok(())
}
