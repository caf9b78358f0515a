//! Forces on discs of fixed radii that together stand for a load, ready to be convolved.
//!
//! Theory: `docs/theory.md` (T24, T60).

use crate::convolve::Convolver;
use crate::discs::Discs;
use crate::excitation::{Excitation, PressureRadius};
use crate::grid::Grid;
use crate::kernels::KernelSource;
use crate::projection::Projection;
use crate::stretch::Departure;

/// Slopes and bends below this fraction of the largest force are left to the differences of its samples.
const NEGLIGIBLE: f64 = 1e-9;

/// Loads on discs of fixed radii that together are the excitation's.
pub(crate) struct Load {
    pub(crate) discs: Discs,
    /// Of each disc.
    pub(crate) shares: Vec<Share>,
}

/// A force on one disc.
pub(crate) struct Share {
    /// Of each run of the grid.
    pub(crate) runs: Vec<RunForce>,
    /// Half of the force's total variation in N: its peak where it rises and falls once.
    pub(crate) half_variation_n: f64,
    /// Root of the sum of the squares of its rises' changes from cell to cell, in N.
    pub(crate) bending_n: f64,
    /// What rise, slope and bend of the cells leave of the whole force, counted with the largest disc.
    pub(crate) left: Departure,
}

/// A force during one run, on one disc.
pub(crate) struct RunForce {
    pub(crate) wanted: Vec<usize>,
    pub(crate) convolver: Convolver,
    /// The part that the two highest powers of the radius bring; of a disc alone what it leaves out.
    pub(crate) last: Option<Convolver>,
    pub(crate) projection: Projection,
}

impl Load {
    pub(crate) fn new(
        discs: Discs,
        excitation: &Excitation,
        source: &KernelSource,
        grid: &Grid,
        force_n: &[f64],
        wanted: &[usize],
    ) -> Self {
        let radius = excitation.radius();
        let nodes: Vec<_> = grid
            .runs
            .iter()
            .map(|run| excitation.cell_nodes(run, grid.step_s))
            .collect();
        let most_n = force_n.iter().fold(0.0, |most: f64, p| most.max(p.abs()));
        let negligible = most_n * NEGLIGIBLE.max(1e-3 * excitation.relative_error());
        let share = |k: usize| {
            let of = |p: f64| discs.share(k, radius.square(p));
            let (mut first, mut runs) = (0, Vec::new());
            let (mut half_variation_n, mut bending_n, mut left) = (0.0, 0.0, Departure::default());
            for ((run, samples), nodes) in grid.split(force_n).into_iter().zip(&nodes) {
                let own = first..first + run.count;
                first = own.end;
                let inside = wanted.iter().filter(|n| own.contains(n));
                let wanted: Vec<usize> = inside.map(|n| n - own.start).collect();
                let map = |p: f64| p * of(p).0;
                let forces: Vec<f64> = samples.iter().map(|&p| map(p)).collect();
                let convolver = Convolver::from_base(map(run.base_n), &forces, wanted.clone());
                let last = match radius {
                    PressureRadius::Fixed(_) => None,
                    PressureRadius::Following { .. } if discs.radii.len() == 1 => {
                        let over = |p: f64| p * (radius.square(p) - discs.radii[0].powi(2));
                        let lag =
                            excitation.units().time_s() / excitation.medium().rayleigh_speed();
                        Some(left_out(over, lag / grid.step_s, run.base_n, samples))
                    }
                    PressureRadius::Following { .. } => {
                        Some(samples.iter().map(|&p| p * of(p).1).collect())
                    }
                };
                let last = last.map(|last: Vec<f64>| Convolver::at(&last, wanted.clone()));
                let rises = convolver.rises();
                let bends = source.bends();
                let projection = Projection::new(samples, rises, nodes, map, negligible, bends);
                if k == 0 {
                    let whole = crate::convolve::rises(run.base_n, samples);
                    let of = Projection::new(samples, &whole, nodes, |p| p, f64::INFINITY, bends);
                    left.join(of.left);
                }
                half_variation_n += 0.5 * rises.iter().map(|d| d.abs()).sum::<f64>();
                let bends = rises.windows(2).map(|d| (d[1] - d[0]).powi(2));
                bending_n += bends.sum::<f64>().sqrt();
                runs.push(RunForce {
                    wanted,
                    convolver,
                    last,
                    projection,
                });
            }
            Share {
                runs,
                half_variation_n,
                bending_n,
                left,
            }
        };
        let shares = (0..discs.radii.len()).map(share).collect();
        Self { discs, shares }
    }
}

/// The force whose waves one disc of radius b leaves out, far from it: (a_max/c_R)^2/10 times the second derivative of
/// P (a^2 - b^2)/a_max^2, which `over` gives; `lag` is a_max/c_R in steps.
fn left_out(over: impl Fn(f64) -> f64, lag: f64, base_n: f64, samples: &[f64]) -> Vec<f64> {
    let at = |i: usize| over(samples[i.min(samples.len() - 1)]);
    let before = |i: usize| if i == 0 { over(base_n) } else { at(i - 1) };
    (0..samples.len())
        .map(|i| 0.1 * lag * lag * (at(i + 1) - 2.0 * at(i) + before(i)))
        .collect()
}
