//! Forces on discs of fixed radii that together stand for a load, ready to be convolved.
//!
//! Theory: `docs/theory.md` (T24, T60).

use crate::convolve::{Convolver, rises};
use crate::discs::Discs;
use crate::ends::Rough;
use crate::excitation::{Excitation, PressureRadius};
use crate::grid::Grid;
use crate::kernels::KernelSource;
use crate::nodes::CellNodes;
use crate::projection::Projection;
use crate::run::Run;
use crate::stretch::Departure;

/// Rates that are left over a cell count from this part of the tolerance of the largest rise on.
const SMOOTH: f64 = 0.1;

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
    /// Cells at the ends of a contact.
    pub(crate) rough: Vec<Rough>,
}

/// What loads are made of.
pub(crate) struct Recipe<'a> {
    pub(crate) excitation: &'a Excitation,
    pub(crate) source: &'a KernelSource,
    pub(crate) grid: &'a Grid,
    /// The force in N at the samples of the grid.
    pub(crate) force_n: &'a [f64],
    /// Samples at which the fields are wanted, ascending.
    pub(crate) wanted: &'a [usize],
    pub(crate) tolerance: f64,
}

impl Recipe<'_> {
    /// Loads on the discs.
    pub(crate) fn load(&self, discs: Discs) -> Load {
        let (runs, step_s) = (&self.grid.runs, self.grid.step_s);
        let nodes: Vec<_> = runs
            .iter()
            .map(|run| self.excitation.cell_nodes(run, step_s))
            .collect();
        let shares = (0..discs.radii.len()).map(|k| self.share(&discs, k, &nodes));
        let shares = shares.collect();
        Load { discs, shares }
    }

    /// The force on disc `k`.
    fn share(&self, discs: &Discs, k: usize, nodes: &[CellNodes]) -> Share {
        let mut share = Share {
            runs: Vec::new(),
            half_variation_n: 0.0,
            bending_n: 0.0,
            left: Departure::default(),
        };
        let bends = self.source.bends();
        let mut first = 0;
        let split = self.grid.split(self.force_n);
        for ((run, samples), nodes) in split.into_iter().zip(nodes) {
            let own = first..first + run.count;
            first = own.end;
            let inside = self.wanted.iter().filter(|n| own.contains(n));
            let wanted = inside.map(|n| n - own.start).collect();
            let made = self.run(discs, k, (&run, samples, nodes), wanted);
            if k == 0 {
                let whole = rises(run.base_n, samples);
                let of = Projection::new(samples, &whole, nodes, |p| p, f64::INFINITY, bends);
                share.left.join(of.left);
            }
            let rises = made.convolver.rises();
            share.half_variation_n += 0.5 * rises.iter().map(|d| d.abs()).sum::<f64>();
            let bending = rises.windows(2).map(|d| (d[1] - d[0]).powi(2));
            share.bending_n += bending.sum::<f64>().sqrt();
            share.runs.push(made);
        }
        share
    }

    /// The force on disc `k` during one run.
    fn run(
        &self,
        discs: &Discs,
        k: usize,
        (run, samples, nodes): (&Run, &[f64], &CellNodes),
        wanted: Vec<usize>,
    ) -> RunForce {
        let (excitation, bends) = (self.excitation, self.source.bends());
        let radius = excitation.radius();
        let of = |p: f64| discs.share(k, radius.square(p));
        let map = |p: f64| p * of(p).0;
        let forces: Vec<f64> = samples.iter().map(|&p| map(p)).collect();
        let convolver = Convolver::from_base(map(run.base_n), &forces, wanted.clone());
        let last = match radius {
            PressureRadius::Fixed(_) => None,
            PressureRadius::Following { .. } if discs.radii.len() == 1 => {
                let over = |p: f64| p * (radius.square(p) - discs.radii[0].powi(2));
                let lag = excitation.units().time_s() / excitation.medium().rayleigh_speed();
                Some(left_out(over, lag / self.grid.step_s, run.base_n, samples))
            }
            PressureRadius::Following { .. } => {
                Some(samples.iter().map(|&p| p * of(p).1).collect())
            }
        };
        let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, p| most.max(p.abs()));
        let rises = convolver.rises();
        let rough = match excitation.record() {
            None => Rough::all(
                samples,
                nodes,
                map,
                SMOOTH * self.tolerance * largest(rises),
                bends,
            ),
            Some(_) => Vec::new(),
        };
        let negligible = NEGLIGIBLE.max(1e-3 * excitation.relative_error());
        let negligible = negligible * largest(self.force_n);
        RunForce {
            projection: Projection::new(samples, rises, nodes, map, negligible, bends),
            last: last.map(|last: Vec<f64>| Convolver::at(&last, wanted.clone())),
            wanted,
            convolver,
            rough,
        }
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
