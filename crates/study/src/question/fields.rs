//! Question 3: how to compute fields under a given force history.
//!
//! The force is a pulse sin^4(pi t/T); one value is the six fields at one point over r0/c1 of time, so that
//! coarser cells are worth what they save; the error is relative to each field's peak, against the exact
//! convolution.

use super::interpolation::interpolations;
use super::kernels::POISSON_RATIO;
use super::pulse_scene::{EVERY, Label, Scene, add, sample_count, scenes};
use crate::StudyError;
use crate::effort::Effort;
use crate::pulse_reference::PulseReference;
use crate::record::Record;
use crate::tables::Density;
use halfspace::{Medium, Six};
use impact::convolve::{Convolver, Method};
use impact::kernels::{CellPlan, Pulse};
use impact::{KernelSource, Place};
use lookup::{PulseSum, Smoothness, Table};

/// Measures every method in every scene.
pub(crate) fn measure(
    effort: Effort,
    densities: &[Density],
    advance: &dyn Fn(),
) -> Result<Vec<Record>, StudyError> {
    let medium = Medium::new(POISSON_RATIO)?;
    let scenes = scenes(&medium, effort)?;
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

/// Samples of the pulse.
fn force(reference: &PulseReference, width: f64) -> Vec<f64> {
    let pulse = PulseSum::new(reference.length, width);
    let count = sample_count(reference, width);
    (0..count).map(|n| pulse.force(n)).collect()
}

/// The response at all samples.
fn response(convolver: &Convolver, rest: &Six, cells: &[Six]) -> Vec<Six> {
    let fields = convolver.fields(rest, cells);
    (0..fields[0].len())
        .map(|n| std::array::from_fn(|f| fields[f][n]))
        .collect()
}

/// Shapes of the force between its samples for which cells can be computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    /// A line: averages alone.
    Linear,
    /// A cubic, by first and second moments: what the program takes for a smooth force.
    Cubic,
}

/// Cells computed for the point itself, for a force that is linear or smooth between samples.
fn exact_cells(
    medium: &Medium,
    scene: &Scene,
    effort: Effort,
    records: &mut Vec<Record>,
) -> Result<(), StudyError> {
    let reference = &scene.reference;
    let [r, z] = reference.place;
    for (shape, tolerance, halvings) in settings(effort) {
        let source = KernelSource::direct(medium, tolerance)?;
        for halvings in halvings {
            let width = EVERY * 0.5_f64.powi(halvings);
            let force = force(reference, width);
            let count = force.len();
            let direct = || {
                let place = Place {
                    r,
                    z,
                    disc_radius_m: 1.0,
                };
                let plan = CellPlan {
                    step: width,
                    count: count + lookup::BEYOND,
                    pulse: Pulse::Smooth(reference.length),
                    rates: false,
                    tolerance,
                };
                source.cells(medium.poisson_ratio(), place, plan)
            };
            let cells = || -> Result<Vec<Six>, StudyError> {
                match shape {
                    Shape::Linear => Ok(direct()?.moments.averages),
                    Shape::Cubic => Ok(direct()?.smooth),
                }
            };
            cells()?;
            let rest = direct()?.static_part;
            let convolver = Convolver::new(&force);
            let mut run = || match cells() {
                Ok(cells) => response(&convolver, &rest, &cells),
                // not after the first time
                Err(_) => vec![[f64::NAN; 6]; count],
            };
            let label = Label {
                scene: scene.name,
                method: match shape {
                    Shape::Linear => "direct, linear cells",
                    Shape::Cubic => "direct",
                },
                setting: format!("step {width}, kernel {tolerance:.0e}"),
                default_path: shape == Shape::Cubic && tolerance < 1e-7,
            };
            add(records, effort, reference, label, width, &mut run);
        }
    }
    Ok(())
}

/// Shape, kernel tolerance and halvings of the step of cells computed for a point.
fn settings(effort: Effort) -> [(Shape, f64, Vec<i32>); 4] {
    // the program's own tolerance of kernels goes with the scene's
    [
        (
            Shape::Cubic,
            1e-8,
            effort.pick(vec![1, 3], vec![0, 1, 2, 3, 4, 5]),
        ),
        (Shape::Cubic, 1e-12, effort.pick(vec![], vec![2, 3, 4, 5])),
        (Shape::Cubic, 1e-4, effort.pick(vec![], vec![1, 2, 3])),
        (
            Shape::Linear,
            1e-8,
            effort.pick(vec![3], vec![0, 1, 2, 3, 4, 5]),
        ),
    ]
}

/// Tables of several densities and stencils, coarser cells, three ways to sum.
fn looked_up(
    scene: &Scene,
    densities: &[Density],
    effort: Effort,
    records: &mut Vec<Record>,
) -> Result<(), StudyError> {
    use Smoothness::{Linear, Smooth};
    for density in densities {
        for points in effort.pick(vec![Density::points()], vec![4, 6, Density::points()]) {
            let table = density.with_stencil(points)?;
            let mut add =
                |method, smoothness, coarsening, sum, default_path| -> Result<(), StudyError> {
                    let lookup = Lookup::new(scene, &table, smoothness, coarsening, sum)?;
                    let label = Label {
                        scene: scene.name,
                        method,
                        setting: format!(
                            "step {}, {}, {points} points",
                            lookup.width,
                            density.spacing.label()
                        ),
                        default_path,
                    };
                    lookup.run()?;
                    let mut run = || lookup.run().unwrap_or_default();
                    add(
                        records,
                        effort,
                        &scene.reference,
                        label,
                        lookup.width,
                        &mut run,
                    );
                    Ok(())
                };
            if !density.is_default(points) {
                add(
                    "table, other nodes or points",
                    Smooth,
                    0,
                    Sum::By(Method::Transform),
                    false,
                )?;
                continue;
            }
            for coarsening in (0..=4).step_by(effort.pick(2, 1)) {
                for (way, name) in [
                    (Method::Direct, "table, direct sums"),
                    (Method::Transform, "table, FFT"),
                ] {
                    add(name, Smooth, coarsening, Sum::By(way), true)?;
                }
                add(
                    "table, linear cells",
                    Linear,
                    coarsening,
                    Sum::By(Method::Transform),
                    false,
                )?;
                add(
                    "table, sums for this pulse only",
                    Smooth,
                    coarsening,
                    Sum::Running,
                    false,
                )?;
            }
        }
    }
    Ok(())
}

/// How cells and force are summed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sum {
    By(Method),
    /// Running sums of the two exponentials of the pulse.
    Running,
}

/// A lookup with everything that does not depend on the point.
struct Lookup<'a> {
    table: &'a Table,
    place: [f64; 2],
    smoothness: Smoothness,
    coarsening: u32,
    width: f64,
    count: usize,
    /// None: running sums.
    convolver: Option<Convolver>,
    pulse: PulseSum,
}

impl<'a> Lookup<'a> {
    fn new(
        scene: &Scene,
        table: &'a Table,
        smoothness: Smoothness,
        coarsening: u32,
        sum: Sum,
    ) -> Result<Self, StudyError> {
        let width = table.cell_width(POISSON_RATIO)? * f64::from(1_u32 << coarsening);
        let force = force(&scene.reference, width);
        Ok(Self {
            table,
            place: scene.reference.place,
            smoothness,
            coarsening,
            width,
            count: force.len(),
            convolver: match sum {
                Sum::By(method) => Some(Convolver::by(&force, method)),
                Sum::Running => None,
            },
            pulse: PulseSum::new(scene.reference.length, width),
        })
    }

    fn run(&self) -> Result<Vec<Six>, StudyError> {
        let [r, z] = self.place;
        let mut cells = vec![[0.0; 6]; self.count];
        let info = self.table.trace_for(
            self.smoothness,
            POISSON_RATIO,
            r,
            z,
            self.coarsening,
            &mut cells,
        )?;
        Ok(match &self.convolver {
            Some(convolver) => response(convolver, &info.static_part, &cells),
            None => self.pulse.response(&info.static_part, &cells),
        })
    }
}
