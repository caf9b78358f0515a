//! What is convolved with the kernels: a force or its rate, sampled on discs that together stand for the load.
//!
//! The waves are linear in the force, so that those of its rate are the rates of the waves: velocities are the same sum as
//! the fields with P' in place of P.
//! P'' of a contact is infinite where it begins and ends, and P' of a record jumps at each row: accelerations, and the
//! velocities of records, are means over one step of the output, differences of sums half a step before and after.
//!
//! A record may jump. The samples are those of its continuous part; each jump is a term of its own, a step response
//! ([`Cells::step_response`]).
//!
//! Theory: `docs/theory.md` (T24, T60, T61).

use super::convolve::Convolver;
use super::discs::Discs;
use super::ends::{Zone, zones};
use super::projection::{CellNodes, Node, Projection, taken_between};
use crate::excitation::{Excitation, Pressed, PressureRadius, Run};
use crate::fields::quantity::Derivative;
use crate::grid::Grid;
use crate::kernels::Cells;
use crate::record::stretch::{Departure, largest};
use halfspace::Six;
use lookup::Moments;
use std::collections::BTreeSet;
use std::convert::Infallible;
use std::ops::Range;

/// What is read of an excitation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reading {
    /// The force in N.
    Force,
    /// Its rate in N/s.
    Rate,
}

/// A force or its rate at times a step apart.
pub(crate) struct Forcing<'a> {
    pub(crate) excitation: &'a Excitation,
    /// What the sums with it are.
    pub(crate) derivative: Derivative,
    pub(crate) reading: Reading,
    /// How often the sums are differenced over a step.
    pub(crate) differences: usize,
    pub(crate) step_s: f64,
    pub(crate) tolerance: f64,
    /// Samples, begun half a step earlier for each difference.
    pub(crate) runs: Vec<Run>,
    /// Of each run the samples that the outputs need, ascending.
    pub(crate) needed: Vec<Vec<usize>>,
    /// Their times, of all runs.
    pub(crate) times_s: Vec<f64>,
    /// Of a contact that follows its load the pressures then.
    pub(crate) pressures: Vec<[Pressed; 2]>,
    /// The first that each output is made of, among those of all runs.
    pub(crate) outputs: Vec<usize>,
    /// The cell from which on the runs leave out what earlier ones have changed for good, and the sum of these changes.
    pub(crate) left_out: (usize, f64),
}

/// The force on one disc.
pub(crate) struct DiscForce {
    pub(crate) runs: Vec<RunForce>,
    /// Half of the total variation: the peak where it rises and falls once.
    half_variation: f64,
    /// What rise, slope and bend of the cells leave of the whole force, counted with the largest disc.
    left: Departure,
}

/// The force on one disc during one run.
pub(crate) struct RunForce {
    pub(crate) force: Sampled,
    /// The part that the highest power of the radius brings; of a disc alone what it leaves out.
    pub(crate) last: Option<Sampled>,
    /// Cells that the samples do not resolve.
    pub(crate) zones: Vec<Zone>,
}

/// Forces on the discs of a choice.
pub(crate) struct DiscForces {
    pub(crate) each: Vec<DiscForce>,
    /// Of each run the cells of the zones, where kernels are known in cells alone.
    pub(crate) rough: Vec<Vec<Rough>>,
}

/// Residual of the load in a cell of a zone, once the parabola that the cell takes of its rate is subtracted.
pub(crate) struct Rough {
    pub(crate) cell: usize,
    /// Largest residual rate over a cell in N, of the load times each polynomial of the radius.
    pub(crate) left: Vec<f64>,
}

impl RunForce {
    /// What some of the cells brought to sample n, in kernel units times the force, and the last of it.
    pub(crate) fn by_cells(&self, n: usize, part: &Range<usize>, cells: &Moments) -> [Six; 2] {
        let of = |force: &Sampled| force.projection.by_cells(n, part, cells);
        [
            of(&self.force),
            self.last.as_ref().map_or(Six::default(), of),
        ]
    }
}

/// A force for sums over cells.
pub(crate) struct Sampled {
    pub(crate) convolver: Convolver,
    pub(crate) projection: Projection,
}

impl Sampled {
    /// Of samples and of the forces within the cells, after a force that was `base` for long; what is below `least` of the
    /// largest is left out.
    fn new(
        base: f64,
        samples: &[f64],
        nodes: &CellNodes,
        (needed, least): (&[usize], f64),
    ) -> Self {
        let convolver = Convolver::from_base(base, samples, needed.to_vec());
        let negligible = NEGLIGIBLE.max(least) * largest(samples);
        Self {
            projection: Projection::new(
                samples,
                &convolver.rises,
                nodes,
                (needed.len(), negligible),
            ),
            convolver,
        }
    }

    /// The fields at the samples wanted.
    pub(crate) fn fields(&self, fixed: &Six, cells: &Cells, wanted: &[usize]) -> [Vec<f64>; 6] {
        let mut found = self.convolver.fields(fixed, &cells.smooth);
        self.projection.add(&cells.moments, wanted, &mut found);
        found
    }
}

/// Times its estimate that a kernel may be off at an instant: estimates are for convolutions, in which what is left of a
/// series has either sign; 3.2 was seen.
///
/// `fields_under_jumps_are_those_of_steps_within_their_estimates` fails without it.
const AT_INSTANTS: f64 = 4.0;

/// Part of the force over which a polynomial of the radius is differenced (T61).
const PART: f64 = 1e-6;

/// Slopes and bends below this fraction of the largest sample are left to the differences of the samples.
const NEGLIGIBLE: f64 = 1e-9;

impl<'a> Forcing<'a> {
    /// For a derivative at some samples of a grid, ascending.
    pub(crate) fn new(grid: &Grid<'a>, wanted: &[usize], derivative: Derivative) -> Self {
        let excitation = grid.excitation;
        let (reading, differences) = match (derivative, excitation.record()) {
            (Derivative::Field, _) => (Reading::Force, 0),
            (Derivative::First, None) => (Reading::Rate, 0),
            (Derivative::First, Some(_)) => (Reading::Force, 1),
            (Derivative::Second, None) => (Reading::Rate, 1),
            (Derivative::Second, Some(_)) => (Reading::Force, 2),
        };
        let (mut runs, mut needed) = (Vec::new(), Vec::new());
        let (mut outputs, mut times_s, mut first) = (Vec::new(), Vec::new(), 0);
        for run in &grid.runs {
            let own = first..first + run.count;
            first = own.end;
            let inside = wanted.iter().filter(|n| own.contains(n));
            let inside = inside.map(|n| n - own.start);
            let with_next = inside.clone().flat_map(|n| n..=n + differences);
            let mut samples: Vec<usize> = with_next.collect();
            samples.sort_unstable();
            samples.dedup();
            let before = times_s.len();
            outputs.extend(inside.map(|n| before + samples.partition_point(|&m| m < n)));
            let start_s = run.start_s - 0.5 * differences as f64 * grid.step_s;
            times_s.extend(samples.iter().map(|&n| start_s + n as f64 * grid.step_s));
            needed.push(samples);
            runs.push(Run {
                start_s,
                base_n: run.base_n,
                count: run.count + differences,
            });
        }
        let follows = matches!(excitation.radius(), PressureRadius::Following { .. });
        let followed = times_s.iter().filter(|_| follows);
        Self {
            excitation,
            derivative,
            reading,
            differences,
            step_s: grid.step_s,
            tolerance: grid.tolerance,
            runs,
            needed,
            pressures: followed.map(|&t| excitation.pressures(t)).collect(),
            times_s,
            outputs,
            left_out: match derivative {
                Derivative::Field => grid.left_out(),
                Derivative::First | Derivative::Second => (0, 0.0),
            },
        }
    }

    /// The force on disc `k` at a time, and the part that the highest power of the radius brings.
    pub(crate) fn on_disc(&self, discs: &Discs, k: usize, time_s: f64) -> [f64; 2] {
        if self.reading == Reading::Rate && discs.radii.len() == 1 {
            let [one, other] = self.excitation.pressures(time_s);
            return [one.rate + other.rate, 0.0];
        }
        let of = |one: Pressed| discs.share(k, one.square).map(|share| one.force_n * share);
        self.sum(time_s, of)
    }

    /// What a function of the pressures, or its rate, sums up to over those of a time.
    fn sum<const N: usize>(&self, time_s: f64, of: impl Fn(Pressed) -> [f64; N]) -> [f64; N] {
        let pressures = self.excitation.pressures(time_s);
        let Ok(sum) = self.try_sum(pressures, PART, |one| Ok::<_, Infallible>(of(one)));
        sum
    }

    /// The same of a function that may fail, its rate by its difference over a part of the force.
    pub(crate) fn try_sum<const N: usize, E>(
        &self,
        pressures: [Pressed; 2],
        part: f64,
        of: impl Fn(Pressed) -> Result<[f64; N], E>,
    ) -> Result<[f64; N], E> {
        let read = |one: Pressed| match self.reading {
            Reading::Force => of(one),
            Reading::Rate => one.rate_of(part, &of),
        };
        let [one, other] = pressures.map(read);
        let (one, other) = (one?, other?);
        Ok(std::array::from_fn(|i| one[i] + other[i]))
    }

    /// When some cells of a run begin and end, in s.
    pub(crate) fn span_s(&self, run: &Run, cells: &Range<usize>) -> [f64; 2] {
        [cells.start - 1, cells.end - 1].map(|n| run.start_s + n as f64 * self.step_s)
    }

    /// Forces on the discs of a choice, with kernels that are known at each instant or, `in_cells`, in cells alone.
    pub(crate) fn on_discs(&self, discs: &Discs, in_cells: bool) -> DiscForces {
        let nodes = |run| self.excitation.cell_nodes(run, self.step_s);
        let nodes: Vec<CellNodes> = self.runs.iter().map(nodes).collect();
        let of = |k| {
            let mut force = DiscForce {
                runs: Vec::new(),
                half_variation: 0.0,
                left: Departure::default(),
            };
            for (i, nodes) in nodes.iter().enumerate() {
                self.add_run(&mut force, (discs, k), i, nodes);
            }
            force.half_variation += AT_INSTANTS * self.half_jumps();
            let per_step = self.step_s.recip().powi(self.differences as i32);
            let Departure { most_n, sum_n } = &mut force.left;
            (*most_n, *sum_n) = (per_step * *most_n, per_step * *sum_n);
            force
        };
        let each: Vec<DiscForce> = (0..discs.radii.len()).map(of).collect();
        let rough = match in_cells {
            true => (0..self.runs.len()).map(|i| self.rough(discs, &each, i, &nodes[i])),
            false => {
                return DiscForces {
                    each,
                    rough: Vec::new(),
                };
            }
        };
        DiscForces {
            rough: rough.collect(),
            each,
        }
    }

    /// Residuals of the load in the zones of all discs during a run.
    fn rough(&self, discs: &Discs, each: &[DiscForce], i: usize, nodes: &CellNodes) -> Vec<Rough> {
        let run = &self.runs[i];
        let zones = each.iter().flat_map(|force| &force.runs[i].zones);
        let cells: BTreeSet<usize> = zones.flat_map(|zone| zone.cells.clone()).collect();
        let of = |cell: usize| {
            let left = |j: usize| {
                let at = |x: f64| {
                    let time_s = run.start_s + (cell as f64 - 0.5 + x) * self.step_s;
                    match discs.radii.len() {
                        1 => self.on_disc(discs, 0, time_s)[0],
                        _ => self.sum(
                            time_s,
                            |one| [one.force_n * discs.polynomial(j, one.square)],
                        )[0],
                    }
                };
                let own = nodes.of(cell - 1).iter().map(|node| Node {
                    force: at(node.x),
                    ..*node
                });
                let own: Vec<Node> = own.collect();
                taken_between([at(-0.5), at(0.5)], &own).left
            };
            let left = (0..discs.radii.len()).map(left).collect();
            Rough { cell, left }
        };
        cells.into_iter().map(of).collect()
    }

    fn add_run(
        &self,
        force: &mut DiscForce,
        (discs, k): (&Discs, usize),
        i: usize,
        nodes: &CellNodes,
    ) {
        let (run, needed) = (&self.runs[i], &self.needed[i]);
        let both = |t: f64| self.on_disc(discs, k, t);
        let sample = |n: usize| both(run.start_s + n as f64 * self.step_s);
        let samples: Vec<[f64; 2]> = (0..run.count).map(sample).collect();
        let in_cells: Vec<[f64; 2]> = if discs.radii.len() == 1 && self.reading == Reading::Force {
            nodes.forces().map(|force| [force, 0.0]).collect()
        } else {
            let at = |x: f64| both(run.start_s + x * self.step_s);
            nodes.places().map(at).collect()
        };
        let base = match self.reading {
            Reading::Force => {
                let base_n = self.excitation.continuous_base_n(run);
                discs.share(k, 1.0).map(|share| base_n * share)
            }
            Reading::Rate => [0.0; 2],
        };
        let of = |i: usize, least: f64| {
            let samples: Vec<f64> = samples.iter().map(|both| both[i]).collect();
            let nodes = nodes.with(|node| in_cells[node][i]);
            Sampled::new(base[i], &samples, &nodes, (needed, least))
        };
        let own = of(0, 1e-3 * self.excitation.relative_error);
        // of a contact's rate what is left stands in the zones
        if k == 0 && self.reading == Reading::Force {
            force.left.join(own.projection.left);
        }
        let rises = &own.convolver.rises;
        // of the outputs: differenced as they are
        let mut changes = rises.to_vec();
        for _ in 0..self.differences {
            let next = changes.windows(2).map(|d| (d[1] - d[0]) / self.step_s);
            changes = next.collect();
        }
        force.half_variation += 0.5 * changes.iter().map(|d| d.abs()).sum::<f64>();
        let last = match (self.excitation.radius(), discs.omitted.get(k)) {
            (PressureRadius::Fixed(_), _) => None,
            (PressureRadius::Following { .. }, Some(count)) => {
                // as its samples are
                let nodes = CellNodes::new(run.count.saturating_sub(1), |_, _| {});
                let beyond = |one: Pressed| [one.force_n * discs.product(one.square)];
                let left = self.bent(*count, |t| self.sum(t, beyond)[0], run);
                Some(Sampled::new(0.0, &left, &nodes, (needed, 1.0)))
            }
            (PressureRadius::Following { .. }, None) => Some(of(1, 1e-3)),
        };
        let mut run_zones = Vec::new();
        if self.excitation.record().is_none() {
            let span_s = |cells: &Range<usize>| self.span_s(run, cells);
            let counts = (run.count, self.tolerance * largest(rises));
            let spans = self.excitation.smooth_s();
            run_zones = zones(&spans, &span_s, &own.projection, counts, both);
        }
        force.runs.push(RunForce {
            force: own,
            last,
            zones: run_zones,
        });
    }

    /// Half of the total variation of the jumps, differenced as the outputs are.
    pub(crate) fn half_jumps(&self) -> f64 {
        let jumps = self.excitation.jumps().iter();
        let sum: f64 = jumps.map(|jump| jump.rise_n.abs()).sum();
        0.5 * sum * (2.0 / self.step_s).powi(self.differences as i32)
    }

    /// The cells of each contact during a run.
    pub(crate) fn contacts(&self, run: &Run) -> Vec<Range<usize>> {
        let cell = |at_s: f64| (at_s - run.start_s) / self.step_s;
        let of = |[begin_s, end_s]: &[f64; 2]| {
            let from = cell(*begin_s).floor().max(0.0) as usize + 1;
            from..(cell(*end_s).ceil().max(0.0) as usize + 1).min(run.count)
        };
        let found = self.excitation.contacts_s().iter().map(of);
        found.filter(|cells| !cells.is_empty()).collect()
    }

    /// A number times (a_max/c_R)^2 times the second derivative of a function of time.
    fn bent(&self, count: f64, over: impl Fn(f64) -> f64, run: &Run) -> Vec<f64> {
        let excitation = self.excitation;
        let lag_s = excitation.units().time_s() / excitation.medium().rayleigh_speed();
        let steps = lag_s / self.step_s;
        let at = |n: isize| over(run.start_s + n as f64 * self.step_s);
        let values: Vec<f64> = (-1..=run.count as isize).map(at).collect();
        let second = values.windows(3).map(|v| v[2] - 2.0 * v[1] + v[0]);
        second.map(|bend| count * steps * steps * bend).collect()
    }
}

impl DiscForce {
    /// Errors of the kernels and of the force within the cells, in kernel units times the unit of the force.
    pub(crate) fn errors(&self, cells: &Cells) -> Six {
        let steps = cells.steps();
        std::array::from_fn(|f| cells.error[f] * self.half_variation + self.left.moves(steps[f]))
    }
}
