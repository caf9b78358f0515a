//! Chooses the spacing of a grid so that errors off it stay below a tolerance.

use crate::blocks;
use crate::build::plan;
use crate::error::BuildError;
use crate::grid::Grid;
use crate::observe::uniform;
use crate::point::{PointKernels, PointPlan};
use crate::verify::quantile;
use halfspace::FIELDS;
use lookup::{Numbers, PulseSum, Series, Smoothness, Stencil, locate};
use rayon::prelude::*;

/// What was tried on the way to a grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trial {
    /// Largest spacing in r and z, in r0.
    pub spacing: f64,
    /// Nodes of the grid.
    pub nodes: usize,
    /// 99 % quantile over places and fields of the error over the peak in time.
    pub error: f64,
}

/// Places at which a trial is measured: half of them anywhere, half near the disc edge or the surface.
const PLACES: u64 = 28;
/// Trials at most.
const MOST_TRIALS: usize = 8;

/// The grid whose errors for pulses `pulse_length` long (r0/c1) are below `tolerance`, and the trials that led to it.
///
/// All spacings of `grid` are scaled alike. The errors are those of the slice with the largest Poisson ratio,
/// whose waves are the shortest.
///
/// # Errors
/// [`BuildError::Setting`] for a tolerance outside [1e-7, 0.1] or a length outside [0.5, 1000],
/// [`BuildError::TooFine`] when no spacing allowed is fine enough, or what the exact kernels say.
pub fn refine(
    grid: &Grid,
    tolerance: f64,
    pulse_length: f64,
) -> Result<(Grid, Vec<Trial>), BuildError> {
    within("tol", tolerance, 1e-7, 0.1, "[1e-7, 0.1]")?;
    within("pulse", pulse_length, 0.5, 1000.0, "[0.5, 1000]")?;
    grid.validate()?;
    let mut trials: Vec<Trial> = Vec::new();
    let mut factor = 0.25 / grid.r.spacing.max(grid.z.spacing);
    for _ in 0..MOST_TRIALS {
        let scaled = scale(grid, factor);
        if scaled.validate().is_err() {
            break;
        }
        let errors = sample_errors(&scaled, &[pulse_length], Storage::Single)?;
        let error = quantile(&errors[0], 0.99);
        let [r, z] = scaled.nodes();
        trials.push(Trial {
            spacing: scaled.r.spacing.max(scaled.z.spacing),
            nodes: r.len() * z.len(),
            error,
        });
        if error <= tolerance {
            return Ok((scaled, trials));
        }
        // Towards the spacing that the order of the stencil promises, and a little below it.
        let order = grid.stencil_points as f64;
        factor *= (0.95 * (tolerance / error).powf(1.0 / order)).clamp(0.5, 0.95);
    }
    let best = trials
        .iter()
        .fold(f64::INFINITY, |least, trial| least.min(trial.error));
    Err(BuildError::TooFine {
        tolerance,
        pulse_length,
        best,
    })
}

fn within(key: &str, x: f64, low: f64, high: f64, range: &'static str) -> Result<(), BuildError> {
    if x >= low && x <= high {
        return Ok(());
    }
    Err(BuildError::Setting {
        key: key.to_owned(),
        value: x,
        range,
    })
}

fn scale(grid: &Grid, factor: f64) -> Grid {
    let mut scaled = grid.clone();
    for axis in [&mut scaled.r, &mut scaled.z] {
        axis.spacing *= factor;
        axis.focus_spacing = axis.focus_spacing.map(|spacing| spacing * factor);
    }
    scaled
}

/// How the numbers of a node are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Storage {
    /// In 32 bits, rounded as in a table.
    Single,
    /// In 64 bits, not rounded.
    Double,
}

/// Errors over peaks in time at sampled meshes of the slice with the largest Poisson ratio, sorted, for each length.
///
/// # Errors
/// What the exact kernels say.
pub fn sample_errors(
    grid: &Grid,
    pulse_lengths: &[f64],
    storage: Storage,
) -> Result<Vec<Vec<f64>>, BuildError> {
    let nu = grid.poisson_ratios[grid.poisson_ratios.len() - 1];
    let plan = plan(grid, nu)?;
    let errors: Vec<Vec<[f64; 6]>> = (0..PLACES)
        .into_par_iter()
        .map(|i| {
            let near = i % 2 == 1;
            let draw = |k: u64| uniform(99, 2 * i + k);
            let r = if near {
                (0.6 + 0.8 * draw(0)).min(grid.r.max)
            } else {
                draw(0) * grid.r.max
            };
            let z = draw(1) * if near { 0.3 } else { 1.0 } * grid.z.max;
            errors_at(grid, &plan, [r, z], pulse_lengths, storage)
        })
        .collect::<Result<_, BuildError>>()?;
    Ok((0..pulse_lengths.len())
        .map(|length| {
            let mut all: Vec<f64> = errors.iter().flat_map(|place| place[length]).collect();
            all.sort_by(f64::total_cmp);
            all
        })
        .collect())
}

/// Errors over peaks at the centre of the mesh around a place, for each length.
fn errors_at(
    grid: &Grid,
    plan: &PointPlan,
    place: [f64; 2],
    pulse_lengths: &[f64],
    storage: Storage,
) -> Result<Vec<[f64; 6]>, BuildError> {
    let [r_nodes, z_nodes] = grid.nodes();
    let mesh = |nodes: &[f64], x: f64| {
        let i = locate(nodes, x).unwrap_or(0);
        (i, 0.5 * (nodes[i] + nodes[i + 1]))
    };
    let ((i, r), (k, z)) = (mesh(&r_nodes, place[0]), mesh(&z_nodes, place[1]));
    let across = Stencil::mirrored(&r_nodes, i, r, grid.stencil_points);
    let down = Stencil::one_sided(&z_nodes, k, z, grid.stencil_points);
    let exact = Sum::zero(grid)?.added(&plan.compute(r, z)?, [1.0, 1.0]);
    let mut found = Sum::zero(grid)?;
    let columns = across.nodes().iter().zip(across.even()).zip(across.odd());
    for ((&i, &even), &odd) in columns {
        for (&k, &weight) in down.nodes().iter().zip(down.even()) {
            let mut node = plan.compute(r_nodes[i], z_nodes[k])?;
            match storage {
                Storage::Single => blocks::round(&mut node),
                Storage::Double => {}
            }
            found = found.added(&node, [even * weight, odd * weight]);
        }
    }
    let width = grid.cell_width * lookup::cell_scale(plan.kernel().medium().poisson_ratio())?;
    let rest = plan.kernel().static_field(r, z)?;
    let (cells, arrived) = (grid.cells()?, grid.cells()? * 2 / 3);
    let series = |sum: Sum| Series::new(width, cells, sum.numbers);
    let (exact, found) = (series(exact), series(found));
    let most =
        |list: &[[f64; 6]], f: usize| list.iter().fold(0.0_f64, |m, six| m.max(six[f].abs()));
    Ok(pulse_lengths
        .iter()
        .map(|&length| {
            let mut direct = vec![[0.0; 6]; arrived + (length / width) as usize + 1];
            let mut wrong = direct.clone();
            exact.fill(Smoothness::Smooth, 0, &mut direct);
            found.fill(Smoothness::Smooth, 0, &mut wrong);
            for (a, b) in wrong.iter_mut().zip(&direct) {
                for f in 0..6 {
                    a[f] -= b[f];
                }
            }
            let pulse = PulseSum::new(length, width);
            let whole = pulse.response(&rest, &direct);
            let wrong = pulse.response(&[0.0; 6], &wrong);
            std::array::from_fn(|f| most(&wrong, f) / most(&whole, f))
        })
        .collect())
}

/// A weighted sum of the numbers of points.
struct Sum {
    numbers: Numbers,
}

impl Sum {
    fn zero(grid: &Grid) -> Result<Self, BuildError> {
        let cells = grid.cells()?;
        Ok(Self {
            numbers: Numbers {
                averages: vec![0.0; 6 * cells],
                moments: vec![0.0; 6 * cells],
                curvatures: vec![0.0; 6 * cells],
                tail: vec![0.0; 6 * grid.tail_terms],
            },
        })
    }

    fn added(mut self, point: &PointKernels, [even, odd]: [f64; 2]) -> Self {
        for (sum, values) in [
            (&mut self.numbers.averages, &point.averages),
            (&mut self.numbers.moments, &point.moments),
            (&mut self.numbers.curvatures, &point.curvatures),
            (&mut self.numbers.tail, &point.tail),
        ] {
            for (f, field) in FIELDS.iter().enumerate() {
                let weight = if field.is_odd_in_r() { odd } else { even };
                let row = &mut sum[f * values.len()..(f + 1) * values.len()];
                for (s, six) in row.iter_mut().zip(values) {
                    *s += weight * six[f];
                }
            }
        }
        self
    }
}
