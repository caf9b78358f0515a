//! Errors at some places off a grid, with nodes stored in 32 or 64 bits, without a table.

use super::uniform;
use halfspace::FIELDS;
use lookup::{Numbers, PulseSum, Series, Smoothness, Stencil, locate};
use rayon::prelude::*;
use tabulator::{BuildError, Grid, PointPlan};

/// Places: half of them anywhere, half near the disc edge or the surface.
const PLACES: u64 = 28;

/// How the numbers of a node are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Storage {
    /// In 32 bits, rounded as in a table.
    Single,
    /// In 64 bits, not rounded.
    Double,
}

/// Errors over peaks in time at sampled meshes of the slice with the largest Poisson ratio, sorted, for each length.
///
/// # Errors
/// Values of the exact kernels.
pub(crate) fn sample_errors(
    grid: &Grid,
    pulse_lengths: &[f64],
    storage: Storage,
) -> Result<Vec<Vec<f64>>, BuildError> {
    let nu = grid.poisson_ratios[grid.poisson_ratios.len() - 1];
    let plan = grid.point(nu)?;
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
                Storage::Single => lookup::round(&mut node),
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
            numbers: [cells, cells, cells, grid.tail_terms].map(|count| vec![[0.0; 6]; count]),
        })
    }

    fn added(mut self, point: &Numbers, [even, odd]: [f64; 2]) -> Self {
        for (sum, values) in self.numbers.iter_mut().zip(point) {
            for (f, field) in FIELDS.iter().enumerate() {
                let weight = if field.is_odd_in_r() { odd } else { even };
                for (s, six) in sum.iter_mut().zip(values) {
                    s[f] += weight * six[f];
                }
            }
        }
        self
    }
}
