//! The fields of an excitation at a point, and whatever else is asked there: one sum for all of it.
//!
//! ```text
//! u(t) = F(t) u_static + int F'(t') R(t - t') dt'
//! ```
//!
//! R, the remainder of the kernel at the point, is known as a function of time before anything is summed: as a trace, or as
//! the cells of a table. Read in this order: [`forcing`] says what F is, [`discs`] which discs stand for a load whose
//! radius varies, [`convolve`] and [`projection`] sum over cells, [`ends`] integrates where cells do not serve, and
//! [`past`] where discs do not, in [`windows`] among others; [`sum`] puts these together for a point.
//!
//! Theory: `docs/theory.md` (T24, T55, T60, T61).

#[cfg(test)]
mod close_tests;
pub mod convolve;
pub(crate) mod discs;
mod ends;
pub(crate) mod forcing;
mod past;
pub(crate) mod projection;
#[cfg(test)]
mod rate_tests;
pub(crate) mod sum;
#[cfg(test)]
mod tests;
mod windows;

pub(crate) use past::Past;

use crate::error::ImpactError;
use crate::excitation::PressureRadius;
use crate::fields::quantity::{Derivative, Quantity};
use crate::grid::Grid;
use crate::kernels::{CellPlan, Cells, KernelSource};
use convolve::Method;
use discs::Discs;
use forcing::{DiscForces, Forcing};
use lookup::BEYOND;
use std::sync::OnceLock;
use sum::Sum;

/// What is the same for all points: forces on discs, sampled.
pub(crate) struct Evaluator<'a> {
    source: &'a KernelSource,
    pub(crate) grid: &'a Grid<'a>,
    /// Samples at which the fields are wanted, ascending.
    wanted: &'a [usize],
    /// Beside the six fields.
    pub(crate) quantities: &'a [Quantity],
    /// Who is told of each point.
    watch: &'a (dyn Fn() + Sync),
    /// Of the fields, and of the velocities and accelerations where they are asked for.
    forcings: Vec<Forcing<'a>>,
    /// The discs that may stand for the load, and the forces on them that a point has needed, of each forcing.
    choices: Vec<Discs>,
    forces: Vec<OnceLock<Vec<DiscForces>>>,
    /// Of a contact whose radius follows the load.
    past: Option<Past<'a>>,
}

/// One quantity over time, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Samples at the times of the output.
    pub samples: Vec<f64>,
    /// Estimated absolute error of every sample.
    pub error: f64,
}

impl Trace {
    /// The sample of the largest magnitude, with its sign.
    pub fn peak(&self) -> f64 {
        let larger = |most: f64, &x: &f64| if x.abs() > most.abs() { x } else { most };
        self.samples.iter().fold(0.0, larger)
    }
}

/// Tolerances that a part of the past may have, which brings a part of the field.
const PART_OF_PAST: f64 = 10.0;

/// Largest radii from the load between which waves are long beside the contact and kernels of small discs have their digits.
pub(crate) const APART: f64 = 4.0;
const FAR: f64 = 30.0;

/// Samples of a disc that are summed while one is integrated.
const SUMMED: usize = 400;

/// Samples of forces on discs that are held at most.
pub(crate) const MOST_HELD: usize = 1 << 24;

impl<'a> Evaluator<'a> {
    /// Of what is asked at points, of the excitation of a grid with kernels.
    pub(crate) fn new(
        source: &'a KernelSource,
        grid: &'a Grid<'a>,
        wanted: &'a [usize],
        quantities: &'a [Quantity],
        watch: &'a (dyn Fn() + Sync),
    ) -> Result<Self, ImpactError> {
        let (excitation, tolerance) = (grid.excitation, grid.tolerance);
        let computed = matches!(source, KernelSource::Direct(_));
        let radius = excitation.radius();
        let mut choices = Discs::looked_up(radius);
        if computed {
            choices = Discs::computed(radius, tolerance);
            let held = |discs: &&Discs| discs.radii.len() * grid.count() <= MOST_HELD;
            let kept = choices.iter().take_while(held).count().max(1);
            choices.truncate(kept);
        }
        let mut derivatives = vec![Derivative::Field];
        for (derivative, _) in quantities.iter().filter_map(|one| one.rate()) {
            if !derivatives.contains(&derivative) {
                derivatives.push(derivative);
            }
        }
        let forcing = |derivative| Forcing::new(grid, wanted, derivative);
        let past = match radius {
            PressureRadius::Following { .. } if computed => {
                Some(Past::new(excitation, PART_OF_PAST * tolerance)?)
            }
            _ => None,
        };
        Ok(Self {
            forcings: derivatives.into_iter().map(forcing).collect(),
            forces: choices.iter().map(|_| OnceLock::new()).collect(),
            choices,
            past,
            source,
            grid,
            wanted,
            quantities,
            watch,
        })
    }

    /// Times in s at which the fields are wanted.
    pub(crate) fn times_s(&self) -> Vec<f64> {
        let all: Vec<f64> = self.grid.times_s().collect();
        self.wanted.iter().map(|&n| all[n]).collect()
    }

    /// How forces are summed, for reports.
    pub(crate) fn method(&self) -> Method {
        let forces = self.forces.iter().filter_map(OnceLock::get);
        let each = forces.flatten().flat_map(|forces| &forces.each);
        let mut runs = each.flat_map(|force| &force.runs);
        match runs.any(|run| run.force.convolver.transform.is_some()) {
            true => Method::Transform,
            false => Method::Direct,
        }
    }

    /// All that is asked for at a point: the six fields, then the quantities.
    ///
    /// # Errors
    /// [`ImpactError`] for a point outside the half-space or the table.
    pub(crate) fn at(&self, r_m: f64, z_m: f64) -> Result<Vec<Trace>, ImpactError> {
        let sums = self.sums([r_m, z_m])?;
        let mut found = sums[0].clone();
        found.extend(self.quantities.iter().map(|&quantity| {
            let Some((derivative, component)) = quantity.rate() else {
                return self.of_stresses(quantity, &sums[0]);
            };
            let mut derivatives = self.forcings.iter().map(|own| own.derivative);
            let place = derivatives.position(|own| own == derivative);
            sums[place.unwrap_or(0)][component].clone()
        }));
        (self.watch)();
        Ok(found)
    }

    fn of_stresses(&self, quantity: Quantity, fields: &[Trace]) -> Trace {
        let (stresses, elastic) = ([2, 3, 4, 5], self.grid.excitation.elastic);
        let of = |i: usize| quantity.of(stresses.map(|f| fields[f].samples[i]), elastic);
        Trace {
            samples: (0..fields[2].samples.len()).map(of).collect(),
            error: quantity.error(stresses.map(|f| fields[f].error), elastic),
        }
    }

    /// Values and errors of each forcing, under the first choice of discs that leaves little open, or under the one before
    /// where a choice leaves more: the kernels of small discs lose digits far away.
    fn sums(&self, place_m: [f64; 2]) -> Result<Vec<Vec<Trace>>, ImpactError> {
        let serving = self.serving(place_m);
        let mut best = self.under(place_m, serving[0], None)?;
        let open = |sums: &[Sum<'_>]| sums.iter().map(|sum| sum.open.len()).sum::<usize>();
        let worst = |sums: &[Sum<'_>]| sums.iter().map(Sum::worst).fold(0.0, f64::max);
        let is_near = self.distance(place_m) < APART;
        for pair in serving.windows(2) {
            // to integrate some samples costs less than a new disc, or than sums over all of them
            let [known, next] = [0, 1].map(|i| &self.choices[pair[i]]);
            let new = (next.radii.iter()).filter(|radius| !known.radii.contains(radius));
            let sums = next.radii.len() * self.wanted.len() / SUMMED;
            let enough = open(&best.0) <= 2 * new.count() + sums;
            // far away the kernels of the smallest discs lose digits
            if self.past.is_none() || enough || !(is_near || next.is_apart()) {
                break;
            }
            let next = self.under(place_m, pair[1], Some((pair[0], &best.1)))?;
            // steps that do not follow the forces on many discs leave more
            if open(&next.0) >= open(&best.0) || worst(&next.0) > worst(&best.0) {
                break;
            }
            best = next;
        }
        let (sums, cells) = best;
        let resolved = |sum: Sum<'_>| sum.resolved(self.past.as_ref(), &cells);
        sums.into_iter().map(resolved).collect()
    }

    /// The choices of discs that the source serves at a point in largest radii; where there is none, the last or, of
    /// kernels that are computed, the first, whose error names the place.
    fn serving(&self, place_m: [f64; 2]) -> Vec<usize> {
        let radius_m = self.grid.excitation.units().disc_radius_m;
        let [r, z] = place_m.map(|x| x / radius_m);
        let reach = self.source.reach();
        let count = self.choices.len();
        let computed = matches!(self.source, KernelSource::Direct(_));
        let served = |&choice: &usize| {
            let smallest = self.choices[choice].smallest();
            r <= smallest * reach[0] && z <= smallest * reach[1]
        };
        // whose force has a kink begins short waves where it is large, too
        let smooth = self.grid.excitation.kinks_s().is_empty();
        let apart = computed && smooth && (APART..FAR).contains(&self.distance(place_m));
        let fits = |choice: &usize| self.choices[*choice].is_apart() == apart;
        let mut found: Vec<usize> = (0..count).filter(served).collect();
        if found.iter().any(fits) {
            found.retain(fits);
        }
        match (found.is_empty(), computed) {
            (false, _) => found,
            (true, true) => vec![(0..count).find(fits).unwrap_or(0)],
            (true, false) => vec![count - 1],
        }
    }

    /// Distance from the load in largest radii.
    fn distance(&self, [r_m, z_m]: [f64; 2]) -> f64 {
        r_m.hypot(z_m) / self.grid.excitation.units().disc_radius_m
    }

    /// The sums of all forcings over the discs of one choice, with the kernels of the discs; those of another are known.
    fn under(
        &self,
        place_m: [f64; 2],
        choice: usize,
        known: Option<(usize, &[Cells])>,
    ) -> Result<(Vec<Sum<'_>>, Vec<Cells>), ImpactError> {
        let discs = &self.choices[choice];
        let of = |&over: &f64| {
            let known = known.and_then(|(choice, cells)| {
                let mut known = self.choices[choice].radii.iter().zip(cells);
                known.find(|(radius, _)| **radius == over)
            });
            match known {
                Some((_, cells)) => Ok(cells.clone()),
                None => self.cells(place_m, over, discs.tolerance(self.grid.tolerance)),
            }
        };
        let cells: Vec<Cells> = discs.radii.iter().map(of).collect::<Result<_, _>>()?;
        let in_cells = matches!(self.source, KernelSource::Table(_));
        let on_discs = |forcing: &Forcing<'_>| forcing.on_discs(discs, in_cells);
        let forces =
            self.forces[choice].get_or_init(|| self.forcings.iter().map(on_discs).collect());
        let sums = (self.forcings.iter().zip(forces))
            .map(|(forcing, forces)| Sum::new(forcing, discs, forces, place_m, &cells));
        Ok((sums.collect::<Result<_, _>>()?, cells))
    }

    /// The kernels of a disc of a radius `over` the largest, as far as the outputs need them.
    fn cells(&self, place_m: [f64; 2], over: f64, tolerance: f64) -> Result<Cells, ImpactError> {
        let (excitation, grid) = (self.grid.excitation, self.grid);
        let (ratio, units) = (excitation.medium().poisson_ratio(), excitation.units());
        let disc_radius_m = over * units.disc_radius_m;
        let place = place_m.map(|x| x / disc_radius_m);
        let rates = self.forcings.len() > 1;
        let differences = self.forcings.iter().map(|forcing| forcing.differences);
        let plan = CellPlan {
            step: grid.step_s / (over * units.time_s()),
            count: grid.longest() + differences.max().unwrap_or(0) + BEYOND,
            pulse: excitation.pulse(over),
            rates,
            tolerance,
        };
        (self.source).cells(ratio, place, disc_radius_m, plan)
    }
}
