//! Loads of the kernels: a force history or its rate, sampled, with the radius of its pressure.
//!
//! Waves are linear in the force, so that those of its rate are the rates of the waves: velocities are the same sum as the
//! fields with P' in place of P.
//! P'' of a contact is infinite where it begins and ends, and P' of a record jumps at each row: accelerations, and the
//! velocities of records, are means over one step of the output, differences of sums half a step before and after.
//!
//! The samples of a record that jumps are those of its continuous part; each jump is a term of its own, a step response.
//!
//! Theory: `docs/theory.md` (T24, T60, T61).

use super::discs::Discs;
use super::ends::{Zone, ends_within, unresolved};
use super::tuning;
use crate::excitation::{Excitation, Pressed, PressureRadius, Samples};
use crate::grid::Grid;
use crate::quantity::Derivative;
use crate::sampled::convolve::Convolver;
use crate::sampled::projection::{CellNodes, Departure, Projection, largest};
use halfspace::Six;
use std::ops::Range;
use std::sync::OnceLock;

/// The function of time that is read of an excitation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reading {
    /// The force in N.
    Force,
    /// Its rate in N/s.
    Rate,
}

/// The samples of a run, the ones needed, and the pressures at all of them.
pub(crate) struct SampledRun {
    pub(crate) run: Samples,
    /// Numbers of the samples that the outputs need, ascending.
    pub(crate) needed: Vec<usize>,
    /// Places in the cells between samples, with the force there.
    nodes: CellNodes,
    /// Pressures of a contact at the samples, and at the nodes; none of a record, which may be long.
    pressures: Option<[Vec<[Pressed; 2]>; 2]>,
}

/// A force or its rate at times a step apart.
pub(crate) struct Forcing<'a> {
    pub(crate) excitation: &'a Excitation,
    /// Of the fields: themselves, or a rate.
    pub(crate) derivative: Derivative,
    pub(crate) reading: Reading,
    /// How often the sums are differenced over a step.
    pub(crate) differences: usize,
    pub(crate) step_s: f64,
    pub(crate) tolerance: f64,
    /// Runs of samples, begun half a step earlier for each difference.
    pub(crate) runs: Vec<SampledRun>,
    /// Times in s of the samples needed, of all runs.
    pub(crate) times_s: Vec<f64>,
    /// The first sample that each output is made of, among those needed.
    pub(crate) outputs: Vec<usize>,
    /// The cell from which on the runs leave out what earlier ones have changed for good, and the sum of these changes in N.
    pub(crate) left_out: (usize, f64),
    /// Parts of a cell of which a table has averages; none where kernels are computed, whose traces are integrated over zones.
    pub(crate) parts: Option<usize>,
    /// Loads of each set of discs, once a point has needed them.
    loads: Vec<OnceLock<Loads>>,
}

/// Loads of a set of discs.
pub(crate) struct Loads {
    /// Of each run.
    pub(crate) runs: Vec<RunLoads>,
    /// Half of the total variation of the force on each disc: its peak where it rises and falls once.
    half_variation: Vec<f64>,
    /// Residual of the load in the cells, once rise, slope and bend are subtracted.
    residual: Departure,
}

/// Loads of a set of discs during a run.
pub(crate) struct RunLoads {
    /// The load times each of Newton's polynomials.
    pub(crate) each: Vec<Sampled>,
    /// The load of the term that the discs leave out; none on a fixed disc.
    pub(crate) next: Option<Sampled>,
    /// Cells that the samples do not resolve, with the forces on the discs within them.
    pub(crate) zones: Vec<Zone>,
    /// Those of them whose residuals count, ascending.
    pub(crate) sharp: Vec<SharpCell>,
}

/// A cell that its parabola does not follow.
pub(crate) struct SharpCell {
    /// It ends at the sample of this number.
    pub(crate) cell: usize,
    /// Rises over its parts, the oldest first, less those of the parabola, of the load times each of Newton's polynomials.
    pub(crate) rises: Vec<Vec<f64>>,
}

/// A load for sums over cells.
pub(crate) struct Sampled {
    pub(crate) convolver: Convolver,
    pub(crate) projection: Projection,
    /// The largest sample.
    largest: f64,
}

impl Sampled {
    /// Of samples and of the loads at the nodes of the cells, after a load that was `base` for long.
    fn new(base: f64, samples: &[f64], nodes: &CellNodes, needed: &[usize], least: f64) -> Self {
        let convolver = Convolver::from_base(base, samples, needed.to_vec());
        let most = largest(samples);
        let negligible = tuning::NEGLIGIBLE_SLOPE.max(least) * most;
        let wanted = (needed.len(), negligible);
        Self {
            projection: Projection::new(samples, &convolver.rises, nodes, wanted),
            convolver,
            largest: most,
        }
    }
}

impl<'a> Forcing<'a> {
    /// For a derivative at some samples of a grid, ascending, with so many sets of discs and parts of a cell.
    pub(crate) fn new(
        grid: &Grid<'a>,
        wanted: &[usize],
        derivative: Derivative,
        (sets, parts): (usize, Option<usize>),
    ) -> Self {
        let excitation = grid.excitation;
        let (reading, differences) = match (derivative, excitation.record()) {
            (Derivative::Field, _) => (Reading::Force, 0),
            (Derivative::First, None) => (Reading::Rate, 0),
            (Derivative::First, Some(_)) => (Reading::Force, 1),
            (Derivative::Second, None) => (Reading::Rate, 1),
            (Derivative::Second, Some(_)) => (Reading::Force, 2),
        };
        let mut runs = Vec::new();
        let (mut outputs, mut times_s, mut first) = (Vec::new(), Vec::new(), 0);
        for run in &grid.runs {
            let own = first..first + run.count;
            first = own.end;
            let inside = wanted.iter().filter(|n| own.contains(n));
            let inside = inside.map(|n| n - own.start);
            let with_next = inside.clone().flat_map(|n| n..=n + differences);
            let mut needed: Vec<usize> = with_next.collect();
            needed.sort_unstable();
            needed.dedup();
            let before = times_s.len();
            outputs.extend(inside.map(|n| before + needed.partition_point(|&m| m < n)));
            let run = Samples {
                start_s: run.start_s - 0.5 * differences as f64 * grid.step_s,
                base_n: run.base_n,
                count: run.count + differences,
            };
            times_s.extend(needed.iter().map(|&n| run.start_s + n as f64 * grid.step_s));
            runs.push(SampledRun::new(excitation, run, needed, grid.step_s));
        }
        Self {
            excitation,
            derivative,
            reading,
            differences,
            step_s: grid.step_s,
            tolerance: grid.tolerance,
            runs,
            times_s,
            outputs,
            left_out: match derivative {
                Derivative::Field => grid.left_out(),
                Derivative::First | Derivative::Second => (0, 0.0),
            },
            parts,
            loads: (0..sets).map(|_| OnceLock::new()).collect(),
        }
    }

    /// The load times Newton's polynomial of a degree, under some pressures.
    fn load(&self, discs: &Discs, degree: usize, pressures: &[Pressed; 2]) -> f64 {
        let of = |one: &Pressed| match self.reading {
            Reading::Force => one.force_n * discs.newton(degree, one.square),
            Reading::Rate => {
                let [value, slope] = discs.newton_with_slope(degree, one.square);
                one.rate * value + one.force_n * slope * one.square_rate
            }
        };
        pressures.iter().map(of).sum()
    }

    /// The same at a time.
    fn load_at(&self, discs: &Discs, degree: usize, time_s: f64) -> f64 {
        self.load(discs, degree, &self.excitation.pressures(time_s))
    }

    /// The force on disc `k` at a time.
    pub(crate) fn on_disc(&self, discs: &Discs, k: usize, time_s: f64) -> f64 {
        let pressures = self.excitation.pressures(time_s);
        let terms =
            (0..discs.orders()).map(|j| discs.weight(j, k) * self.load(discs, j, &pressures));
        terms.sum()
    }

    /// When some cells of a run begin and end, in s.
    pub(crate) fn span_s(&self, run: &Samples, cells: &Range<usize>) -> [f64; 2] {
        [cells.start - 1, cells.end - 1].map(|n| run.start_s + n as f64 * self.step_s)
    }

    /// The loads of set number `set` of discs.
    pub(crate) fn loads(&self, set: usize, discs: &Discs) -> &Loads {
        self.loads[set].get_or_init(|| self.loads_of(discs))
    }

    /// Whether a sum by transforms has been prepared for any loads.
    pub(crate) fn transforms(&self) -> bool {
        let loads = self.loads.iter().filter_map(OnceLock::get);
        let mut each = loads
            .flat_map(|loads| &loads.runs)
            .flat_map(|run| &run.each);
        each.any(|load| load.convolver.transform.is_some())
    }

    /// The loads of other discs, which are not kept.
    pub(crate) fn loads_of(&self, discs: &Discs) -> Loads {
        let mut found = Loads {
            runs: Vec::new(),
            half_variation: vec![tuning::AT_INSTANTS * self.half_jumps(); discs.count()],
            residual: Departure::default(),
        };
        for run in &self.runs {
            let loads = self.loads_in(run, discs);
            let rises: Vec<&[f64]> = (loads.each.iter())
                .map(|load| &load.convolver.rises[..])
                .collect();
            for (k, half_variation) in found.half_variation.iter_mut().enumerate() {
                let weights = (0..discs.orders()).map(|j| discs.weight(j, k));
                let weights: Vec<f64> = weights.collect();
                let rise = |n: usize| weights.iter().zip(&rises).map(|(w, own)| w * own[n]).sum();
                let mut changes: Vec<f64> = (0..run.run.count).map(rise).collect();
                // of the outputs: differenced as they are
                for _ in 0..self.differences {
                    let next = changes.windows(2).map(|d| (d[1] - d[0]) / self.step_s);
                    changes = next.collect();
                }
                *half_variation += 0.5 * changes.iter().map(|d| d.abs()).sum::<f64>();
            }
            // the residual of a contact's rate stands in the zones
            if self.reading == Reading::Force {
                found.residual.join(loads.each[0].projection.left);
            }
            found.runs.push(loads);
        }
        let per_step = self.step_s.recip().powi(self.differences as i32);
        let Departure { most_n, sum_n } = &mut found.residual;
        (*most_n, *sum_n) = (per_step * *most_n, per_step * *sum_n);
        found
    }

    fn loads_in(&self, sampled: &SampledRun, discs: &Discs) -> RunLoads {
        let (run, needed) = (&sampled.run, &sampled.needed);
        let base_n = match self.reading {
            Reading::Force => self.excitation.continuous_base_n(run),
            Reading::Rate => 0.0,
        };
        let least = tuning::NEGLIGIBLE_OF_ERROR * self.excitation.relative_error;
        let each = (0..discs.orders()).map(|j| {
            let base = base_n * discs.newton(j, 1.0);
            let Some([samples, nodes]) = &sampled.pressures else {
                let at = |n: usize| self.load_at(discs, j, run.start_s + n as f64 * self.step_s);
                let samples: Vec<f64> = (0..run.count).map(at).collect();
                return Sampled::new(base, &samples, &sampled.nodes, needed, least);
            };
            let load = |pressures: &[Pressed; 2]| self.load(discs, j, pressures);
            let samples: Vec<f64> = samples.iter().map(load).collect();
            let nodes = sampled.nodes.with(|node| load(&nodes[node]));
            Sampled::new(base, &samples, &nodes, needed, least)
        });
        let each: Vec<Sampled> = each.collect();
        let next = (self.follows() && !discs.are_prescribed()).then(|| self.next(sampled, discs));
        let (mut zones, mut sharp): (Vec<Zone>, Vec<SharpCell>) = Default::default();
        if self.excitation.record().is_none() {
            let smooth_s = self.excitation.smooth_s();
            let (rise, force) = (largest(&each[0].convolver.rises), &each[0].projection);
            let span_s = |cells: &Range<usize>| self.span_s(run, cells);
            let has_end = |cells: &Range<usize>| !ends_within(span_s(cells), &smooth_s).is_empty();
            let mut open = unresolved(force, (run.count, self.tolerance * rise), has_end);
            if self.parts.is_none() {
                let of = |cells: Range<usize>| {
                    let span_s = span_s(&cells);
                    let (steepness, count) = ((rise, self.tolerance), discs.count());
                    let on_disc = |k, time_s| self.on_disc(discs, k, time_s);
                    Zone::new((cells, span_s), &smooth_s, steepness, count, on_disc)
                };
                zones = open.into_iter().filter_map(of).collect();
                open = zones.iter().map(|zone| zone.cells.clone()).collect();
            }
            let least = tuning::SHARP * self.tolerance * each[0].largest;
            let counts = |cell: &usize| force.taken(*cell).left > least;
            let of = |cell: usize| SharpCell {
                cell,
                rises: self.residual_rises(run, cell, discs, &each),
            };
            sharp = open.into_iter().flatten().filter(counts).map(of).collect();
        }
        RunLoads {
            each,
            next,
            zones,
            sharp,
        }
    }

    /// Rises over the parts of a cell, the oldest first, less those of the parabola, of the load times each of Newton's polynomials.
    fn residual_rises(
        &self,
        run: &Samples,
        cell: usize,
        discs: &Discs,
        each: &[Sampled],
    ) -> Vec<Vec<f64>> {
        let parts = self.parts.unwrap_or(1);
        let edge = |m: usize| m as f64 / parts as f64 - 0.5;
        let at_s = |m: usize| run.start_s + (cell as f64 - 0.5 + edge(m)) * self.step_s;
        let times_s: Vec<f64> = (0..=parts).map(at_s).collect();
        let pressures = self.excitation.pressures_at(&times_s);
        let of = |(j, load): (usize, &Sampled)| {
            let at = |m: usize| self.load(discs, j, &pressures[m]);
            let taken = load.projection.taken(cell);
            let rise = |m: usize| at(m + 1) - at(m) - taken.between(edge(m), edge(m + 1));
            (0..parts).map(rise).collect()
        };
        each.iter().enumerate().map(of).collect()
    }

    /// The load of the term left out: so many times (a_max/c_R)^2 the second derivative of Newton's next polynomial of it, at
    /// the samples alone.
    fn next(&self, sampled: &SampledRun, discs: &Discs) -> Sampled {
        let (excitation, run) = (self.excitation, &sampled.run);
        let lag_s = excitation.units().time_s() / excitation.medium().rayleigh_speed();
        let factor = discs.next() * (lag_s / self.step_s).powi(2);
        let load = |pressures: &[Pressed; 2]| self.load(discs, discs.count(), pressures);
        let beyond = |n: f64| load(&excitation.pressures(run.start_s + n * self.step_s));
        let inside = sampled.pressures.iter().flat_map(|[samples, _]| samples);
        let all = std::iter::once(beyond(-1.0)).chain(inside.map(load));
        let all: Vec<f64> = all.chain([beyond(run.count as f64)]).collect();
        let bends = all.windows(3).map(|v| factor * (v[2] - 2.0 * v[1] + v[0]));
        let bends: Vec<f64> = bends.collect();
        let nodes = CellNodes::new(run.count.saturating_sub(1), |_, _| {});
        Sampled::new(0.0, &bends, &nodes, &sampled.needed, 1.0)
    }

    /// Half of the total variation of the jumps, differenced as the outputs are.
    pub(crate) fn half_jumps(&self) -> f64 {
        let jumps = self.excitation.jumps().iter();
        let sum: f64 = jumps.map(|jump| jump.rise_n.abs()).sum();
        0.5 * sum * (2.0 / self.step_s).powi(self.differences as i32)
    }

    /// The cells of each contact during a run.
    pub(crate) fn contacts(&self, run: &Samples) -> Vec<Range<usize>> {
        let cell = |at_s: f64| (at_s - run.start_s) / self.step_s;
        let of = |[begin_s, end_s]: &[f64; 2]| {
            let from = cell(*begin_s).floor().max(0.0) as usize + 1;
            from..(cell(*end_s).ceil().max(0.0) as usize + 1).min(run.count)
        };
        let found = self.excitation.contacts_s().iter().map(of);
        found.filter(|cells| !cells.is_empty()).collect()
    }

    /// The static field of some pressures in SI units, or its rate by a difference over a part of the force.
    pub(crate) fn still(
        &self,
        place_m: [f64; 2],
        pressures: [Pressed; 2],
    ) -> Result<Six, halfspace::DomainError> {
        let of = |one| self.excitation.static_si(place_m, [one]);
        let read = |one: Pressed| match self.reading {
            Reading::Force => of(one),
            Reading::Rate => one.rate_of(tuning::STATIC_DIFFERENCE, of),
        };
        let [one, other] = pressures.map(read);
        let (one, other) = (one?, other?);
        Ok(std::array::from_fn(|f| one[f] + other[f]))
    }

    /// Whether the radius follows the load.
    pub(crate) fn follows(&self) -> bool {
        matches!(self.excitation.radius(), PressureRadius::Following { .. })
    }

    /// The run of one of the samples needed, and its number there.
    pub(crate) fn in_run(&self, i: usize) -> (usize, usize) {
        let (mut place, mut run) = (i, 0);
        while place >= self.runs[run].needed.len() {
            place -= self.runs[run].needed.len();
            run += 1;
        }
        (run, self.runs[run].needed[place])
    }
}

impl SampledRun {
    fn new(excitation: &Excitation, run: Samples, needed: Vec<usize>, step_s: f64) -> Self {
        let samples = excitation.contact().map(|_| {
            let times_s = (0..run.count).map(|n| run.start_s + n as f64 * step_s);
            excitation.pressures_at(&times_s.collect::<Vec<f64>>())
        });
        let force = |[one, other]: &[Pressed; 2]| one.force_n + other.force_n;
        let force_n: Vec<f64> = samples.iter().flatten().map(force).collect();
        let mut nodes = excitation.unread_nodes(&run, step_s, &force_n);
        let pressures = samples.map(|samples| {
            let own = excitation.pressures_at(&nodes.times_s(run.start_s, step_s));
            nodes.read(|node| force(&own[node]));
            [samples, own]
        });
        Self {
            run,
            needed,
            nodes,
            pressures,
        }
    }

    /// Pressures of a contact at the samples needed.
    pub(crate) fn needed_pressures(&self) -> impl Iterator<Item = [Pressed; 2]> {
        let samples = self.pressures.iter().map(|[samples, _]| samples);
        samples.flat_map(|samples| self.needed.iter().map(|&n| samples[n]))
    }
}

impl Loads {
    /// Errors of the kernel of disc `k` and of the force within the cells, in kernel units times the unit of the force.
    pub(crate) fn errors(&self, k: usize, cells: &crate::kernels::Cells) -> Six {
        let steps = cells.steps();
        let residual = if k == 0 {
            self.residual
        } else {
            Departure::default()
        };
        std::array::from_fn(|f| cells.error[f] * self.half_variation[k] + residual.moves(steps[f]))
    }
}
