//! The rate of a force on discs of fixed radii, ready to be convolved.
//!
//! Theory: `docs/theory.md` (T24, T60, T61).

use crate::convolve::{Convolver, rises};
use crate::discs::Discs;
use crate::excitation::{Excitation, PressureRadius};
use crate::grid::Grid;
use crate::kernels::{Cells, KernelSource};
use crate::nodes::{CellNodes, Node};
use crate::projection::{Projection, followed, slope_and_bend};
use crate::run::Run;
use crate::stretch::Departure;
use halfspace::{Six, gauss};

/// Which derivative of the displacement is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    /// Velocity.
    First,
    /// Acceleration, as a mean over one step.
    Second,
}

/// The rate of the force on one disc.
pub(crate) struct Share {
    pub(crate) runs: Vec<RunRate>,
    pub(crate) half_variation: f64,
    pub(crate) bending: f64,
    pub(crate) left: Departure,
}

pub(crate) struct RunRate {
    pub(crate) wanted: Vec<usize>,
    pub(crate) convolver: Convolver,
    pub(crate) last: Option<Convolver>,
    pub(crate) projection: Projection,
    /// Cells of a contact whose rate rise, slope and bend do not follow.
    pub(crate) rough: Vec<Rough>,
}

/// A cell and the most that is left of the rate's own rate in it, in N/s over a cell.
pub(crate) struct Rough {
    pub(crate) cell: usize,
    pub(crate) left: f64,
}

/// Rates that are left over a cell count from this part of the tolerance of the largest on.
const SMOOTH: f64 = 0.1;

/// Slopes and bends below this fraction of the largest rate are left to the differences of its samples.
const NEGLIGIBLE: f64 = 1e-9;

/// Errors of moments that add up at random, in their standard deviations.
const ROUNDING: f64 = 3.0;

/// What rates of forces are made of.
#[derive(Clone, Copy)]
pub(crate) struct RateRecipe<'a> {
    pub(crate) excitation: &'a Excitation,
    pub(crate) source: &'a KernelSource,
    pub(crate) grid: &'a Grid,
    pub(crate) order: Order,
    pub(crate) tolerance: f64,
}

impl RateRecipe<'_> {
    /// Rates of the forces on the discs of a choice.
    pub(crate) fn shares(&self, discs: &Discs, samples: &[usize]) -> Vec<Share> {
        (0..discs.radii.len())
            .map(|k| {
                let mut share = Share {
                    runs: Vec::new(),
                    half_variation: 0.0,
                    bending: 0.0,
                    left: Departure::default(),
                };
                let mut first = 0;
                for run in &self.grid.runs {
                    let own = first..first + run.count;
                    first = own.end;
                    let inside = samples.iter().filter(|n| own.contains(n));
                    let wanted = inside.map(|n| n - own.start).collect();
                    self.add_run(&mut share, (discs, k), run, wanted);
                }
                share
            })
            .collect()
    }

    fn add_run(
        &self,
        share: &mut Share,
        (discs, k): (&Discs, usize),
        run: &Run,
        wanted: Vec<usize>,
    ) {
        let step_s = self.grid.step_s;
        let bends = self.source.bends();
        let at = |n: f64| run.start_s + n * step_s;
        let rates: Vec<[f64; 2]> = (0..run.count)
            .map(|n| self.rate(Some((discs, k)), at(n as f64)))
            .collect();
        let own: Vec<f64> = rates.iter().map(|rate| rate[0]).collect();
        let convolver = Convolver::from_base(0.0, &own, wanted.clone());
        let nodes = self.nodes(run, Some((discs, k)));
        let largest = own.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
        let negligible = NEGLIGIBLE * largest;
        let changes = convolver.rises();
        let projection = Projection::new(&own, changes, &nodes, |p| p, negligible, bends);
        let sure = SMOOTH * self.tolerance * largest;
        let rough = match self.excitation.record() {
            None => rough(&own, &nodes, bends, sure),
            // lines have corners everywhere, which `left` counts; the first may jump
            Some(_) => rough(&own[..1], &nodes, bends, sure),
        };
        if k == 0 && self.excitation.record().is_some() {
            let whole: Vec<f64> = (0..run.count)
                .map(|n| self.rate(None, at(n as f64))[0])
                .collect();
            let nodes = self.nodes(run, None);
            let changes = rises(0.0, &whole);
            let of = Projection::new(&whole, &changes, &nodes, |p| p, f64::INFINITY, bends);
            share.left.join(of.left);
        }
        share.half_variation += 0.5 * changes.iter().map(|d| d.abs()).sum::<f64>();
        let bending = changes.windows(2).map(|d| (d[1] - d[0]).powi(2));
        share.bending += bending.sum::<f64>().sqrt();
        let last = (discs.radii.len() > 1).then(|| {
            let last: Vec<f64> = rates.iter().map(|rate| rate[1]).collect();
            Convolver::at(&last, wanted.clone())
        });
        share.runs.push(RunRate {
            wanted,
            convolver,
            last,
            projection,
            rough,
        });
    }

    /// Where the rate is read within the cells of a run.
    fn nodes(&self, run: &Run, disc: Option<(&Discs, usize)>) -> CellNodes {
        const NODES: usize = 8;
        let step_s = self.grid.step_s;
        let of_force = self.excitation.cell_nodes(run, step_s);
        CellNodes::new(run.count.saturating_sub(1), |cell, nodes| {
            let at = |x: f64| {
                let time_s = run.start_s + (cell as f64 + 0.5 + x) * step_s;
                self.rate(disc, time_s)[0]
            };
            let graded = of_force.of(cell);
            if self.order == Order::First && !graded.is_empty() {
                nodes.extend(graded.iter().map(|node| Node {
                    force: at(node.x),
                    ..*node
                }));
                return;
            }
            if at(-0.5) == 0.0 && at(0.0) == 0.0 && at(0.5) == 0.0 {
                return;
            }
            // means over a step have corners in the middle
            for (from, to) in [(-0.5, 0.0), (0.0, 0.5)] {
                let rule = gauss::rule(NODES).on(from, to);
                nodes.extend(rule.map(|(x, weight)| Node {
                    x,
                    weight,
                    force: at(x),
                }));
            }
        })
    }

    /// The rate of the force on disc k of some, or of the whole force, and the part that the two highest powers bring.
    fn rate(&self, disc: Option<(&Discs, usize)>, time_s: f64) -> [f64; 2] {
        let step_s = self.grid.step_s;
        match self.order {
            Order::First => self.first_rate(disc, time_s),
            Order::Second => {
                let [after, before] =
                    [0.5, -0.5].map(|x| self.first_rate(disc, time_s + x * step_s));
                [0, 1].map(|i| (after[i] - before[i]) / step_s)
            }
        }
    }

    fn first_rate(&self, disc: Option<(&Discs, usize)>, time_s: f64) -> [f64; 2] {
        let Some([force_n, rate]) = self.excitation.force_and_rate(time_s) else {
            let half_s = 0.5 * self.grid.step_s;
            let [after, before] =
                [half_s, -half_s].map(|lag_s| self.excitation.force_n(time_s + lag_s));
            return [(after - before) / (2.0 * half_s), 0.0];
        };
        let following = match self.excitation.radius() {
            PressureRadius::Fixed(_) => None,
            PressureRadius::Following { .. } => disc,
        };
        let (Some((discs, k)), true) = (following, rate != 0.0) else {
            return [rate, 0.0];
        };
        // phi + (2/3) a^2 phi' of a polynomial in a^2 (T61)
        const APART: f64 = 1e-6;
        let square = self.excitation.radius().square(force_n);
        let here = discs.share(k, square);
        let [above, below] = [APART, -APART].map(|d| discs.share(k, square + d));
        let chain = |value: f64, above: f64, below: f64| {
            rate * (value + 2.0 / 3.0 * square * (above - below) / (2.0 * APART))
        };
        [
            chain(here.0, above.0, below.0),
            chain(here.1, above.1, below.1),
        ]
    }
}

/// Cells in which more than `sure` is left of what samples do.
///
/// The first ends at the first sample: a rate that has begun to rise before it jumps there.
fn rough(samples: &[f64], nodes: &CellNodes, bends: bool, sure: f64) -> Vec<Rough> {
    let left = |cell: usize| {
        if cell == 0 {
            return samples[0].abs();
        }
        let (ends, own) = ([samples[cell - 1], samples[cell]], nodes.of(cell - 1));
        let [slope, bend] = slope_and_bend(ends, own, |rate| rate);
        let taken = [slope, if bends { bend } else { 0.0 }];
        let mut places: Vec<[f64; 2]> = (own.iter())
            .map(|node| [node.x, node.force - followed(ends, taken, node.x)])
            .chain([[-0.5, 0.0], [0.5, 0.0]])
            .collect();
        places.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let pairs = places.windows(2).filter(|pair| pair[1][0] > pair[0][0]);
        pairs
            .map(|pair| ((pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0])).abs())
            .fold(0.0, f64::max)
    };
    (0..samples.len())
        .map(|cell| Rough {
            cell,
            left: left(cell),
        })
        .filter(|rough| rough.left > sure)
        .collect()
}

impl Share {
    /// Errors of the kernels and of the rate within the cells, in kernel units times N/s.
    pub(crate) fn errors(&self, cells: &Cells) -> Six {
        let (variation, steps) = (cells.variation(), cells.largest_step());
        std::array::from_fn(|f| {
            cells.error[f] * self.half_variation
                + ROUNDING * cells.moment_error[f] * self.bending
                + self.left.moves(variation[f], steps[f])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Wanted;
    use crate::sampled_tests::contact;

    /// Rates of the discs' forces against differences of P phi(a^2), first and second, over steps of 1e-3 and of a sample.
    #[test]
    fn rates_of_shares_are_those_of_their_forces() -> Result<(), Box<dyn std::error::Error>> {
        const APART: f64 = 1e-3;
        let (duration, tolerance) = (30.0, 1e-3);
        let excitation = contact(0.29, duration);
        let source = KernelSource::direct(excitation.medium(), 1e-6)?;
        let wanted = Wanted {
            tolerance,
            step_s: None,
            duration_s: Some(duration),
            frames: None,
            farthest_m: Some(1.0),
        };
        let grid = Grid::new(&wanted, &excitation, Some(&source))?;
        let step_s = grid.step_s;
        let discs = Discs::following(6, 0.0);
        for order in [Order::First, Order::Second] {
            let recipe = RateRecipe {
                excitation: &excitation,
                source: &source,
                grid: &grid,
                order,
                tolerance,
            };
            for k in 0..discs.radii.len() {
                let force = |t: f64| {
                    let force_n = excitation.force_n(t);
                    force_n * discs.share(k, excitation.radius().square(force_n)).0
                };
                let slope = |t: f64| (force(t + APART) - force(t - APART)) / (2.0 * APART);
                for t in [0.1, 0.23, 0.4, 0.61, 0.9].map(|part| part * duration) {
                    let exact = match order {
                        Order::First => slope(t),
                        Order::Second => {
                            (slope(t + 0.5 * step_s) - slope(t - 0.5 * step_s)) / step_s
                        }
                    };
                    let found = recipe.rate(Some((&discs, k)), t)[0];
                    // forces of one over a contact of 30 have rates of 0.1
                    assert!(
                        (found - exact).abs() < 1e-5,
                        "{order:?} {k} {t}: {found} {exact}"
                    );
                }
            }
        }
        Ok(())
    }
}
