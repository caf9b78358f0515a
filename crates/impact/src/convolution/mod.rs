//! Fields of an excitation at a point: the convolution of its force with the kernels of the point.
//!
//! ```text
//! u(t) = P(t) u_static + int P'(t') R(t - t') dt'
//! ```
//!
//! Read in this order: [`tuning`] has the numbers that were chosen, [`discs`] the radii that stand for one that follows the
//! load, [`loads`] the functions of time that are convolved, [`fronts`] the windows in which short waves pass, and [`plan`]
//! decides the road of a point. Then [`sums`] convolves over cells, [`ends`] integrates the first and last instants over the
//! traces of the discs, and [`exact`] integrates the past over the radii of the contact; [`at`](Convolution::at) puts these
//! together. Nothing is decided there but whether a cell follows a kernel.
//!
//! Theory: `docs/theory.md` (T24, T55, T60, T61).

#[cfg(test)]
mod close_tests;
pub(crate) mod discs;
pub(crate) mod echoes;
mod ends;
mod exact;
pub(crate) mod fronts;
mod loads;
pub(crate) mod mean;
pub(crate) mod plan;
mod sums;
#[cfg(test)]
mod tests;
pub(crate) mod tuning;

pub(crate) use exact::Past;

use crate::error::ImpactError;
use crate::excitation::Excitation;
use crate::grid::Grid;
use crate::kernels::{CellPlan, Cells, KernelSource};
use crate::quantity::{Derivative, Quantity};
use crate::sampled::convolve::Method;
use crate::sampled::low_passed::LowPassed;
use crate::sampled::projection::largest;
use contact::HalfSpace;
use echoes::PlateEchoes;
use halfspace::{Damping, Six};
use loads::{Forcing, Loads, Reading};
use lookup::BEYOND;
use plan::{Integrated, PointPlan, Sets};
use std::ops::Range;
use sums::{PointKernels, Sums, by_cells, by_zones, components};

/// One quantity over time, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Samples at the times of the output.
    pub samples: Vec<f64>,
    /// Estimated absolute error of every sample.
    pub error: f64,
    /// The same of each sample, where fronts have errors of their own; otherwise empty.
    pub(crate) own_errors: Vec<f64>,
}

impl Trace {
    /// Of samples with one error.
    fn new(samples: Vec<f64>, error: f64) -> Self {
        Self {
            samples,
            error,
            own_errors: Vec::new(),
        }
    }

    /// Estimated absolute error of a sample.
    pub(crate) fn error_of(&self, sample: usize) -> f64 {
        self.own_errors.get(sample).map_or(self.error, |own| *own)
    }

    /// The sample of the largest magnitude, with its sign.
    pub fn peak(&self) -> f64 {
        let larger = |most: f64, &x: &f64| if x.abs() > most.abs() { x } else { most };
        self.samples.iter().fold(0.0, larger)
    }
}

/// An excitation with a source of kernels: the common data of all points.
pub(crate) struct Convolution<'a> {
    source: &'a KernelSource,
    pub(crate) grid: &'a Grid<'a>,
    /// Samples at which the fields are wanted, ascending.
    wanted: &'a [usize],
    /// In addition to the six fields.
    pub(crate) quantities: &'a [Quantity],
    /// Called for each point that is done.
    watch: &'a (dyn Fn() + Sync),
    /// Of the fields, and of the velocities and accelerations where they are asked for.
    forcings: Vec<Forcing<'a>>,
    sets: Sets,
    /// Of a contact whose radius follows the load, with kernels that are computed.
    past: Option<Past<'a>>,
    /// Of a plate.
    echoes: Option<PlateEchoes>,
    /// Attenuation of the block, with its reference frequency in Hz.
    damping: Option<Damping>,
}

/// The kernels of a point, for sums at any instants.
pub(crate) struct Point<'a> {
    excitation: &'a Excitation,
    /// Number of the set of discs.
    set: usize,
    kernels: PointKernels<'a>,
    /// Of the echoes of a plate.
    echoes: Option<(usize, PointKernels<'a>)>,
}

impl Point<'_> {
    /// Its place in m.
    pub(crate) fn place_m(&self) -> [f64; 2] {
        self.kernels.place_m
    }

    /// The time in s that the shortest waves of looked-up kernels take to pass; none of computed ones.
    pub(crate) fn shortest_s(&self) -> Option<f64> {
        let excitation = self.excitation;
        let crossing_s = excitation.units().disc_radius_m / excitation.speeds().rayleigh;
        let smallest_s = self.kernels.discs.smallest() * crossing_s;
        (!self.kernels.are_traces()).then_some(smallest_s)
    }
}

/// Ratio of the tolerance of an integral over a part of the past, which brings a part of the field, to that of the field.
const PART_OF_PAST: f64 = 10.0;

impl<'a> Convolution<'a> {
    /// Of the excitation of a grid with the kernels of a source, at some samples.
    pub(crate) fn new(
        source: &'a KernelSource,
        grid: &'a Grid<'a>,
        wanted: &'a [usize],
        (quantities, block): (&'a [Quantity], Option<&HalfSpace>),
        watch: &'a (dyn Fn() + Sync),
    ) -> Result<Self, ImpactError> {
        let (excitation, tolerance) = (grid.excitation, grid.tolerance);
        let reach = source.table_reach();
        let mut derivatives = vec![Derivative::Field];
        // rates of a low pass are those of the fields that it shows
        let rates = quantities.iter().filter(|_| grid.low_pass_hz.is_none());
        for (derivative, _) in rates.filter_map(|one| one.rate()) {
            if !derivatives.contains(&derivative) {
                derivatives.push(derivative);
            }
        }
        let law = excitation.attenuation.as_ref();
        if let Some(law) = law.filter(|_| reach.is_some()) {
            let quality_factor = law.quality_factor();
            return Err(ImpactError::DampedTable { quality_factor });
        }
        let damping = law.map(|law| Damping::new(law, tuning::DAMPED * tolerance));
        let asked = (grid.all(), derivatives.len() > 1);
        let sets = Sets::new(excitation, tolerance, reach, asked);
        let unit_s = excitation.units().time_s();
        let ratio = excitation.medium().poisson_ratio();
        let parts = source.parts(ratio, grid.step_s / unit_s);
        let parts = parts.map(|parts| parts.min(tuning::PARTS));
        let all: Vec<usize> = match grid.low_pass_hz {
            Some(_) => (0..grid.all()).collect(),
            None => wanted.to_vec(),
        };
        let forcing = |derivative| Forcing::new(grid, &all, derivative, (sets.count(), parts));
        let past = match sets.has_windows() {
            true => Some(Past::new(excitation, PART_OF_PAST * tolerance)?),
            false => None,
        };
        Ok(Self {
            forcings: derivatives.into_iter().map(forcing).collect(),
            sets,
            past,
            echoes: match block {
                Some(block) => PlateEchoes::of(block, excitation.medium(), tolerance)?,
                None => None,
            },
            damping,
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
        match self.forcings.iter().any(Forcing::transforms) {
            true => Method::Transform,
            false => Method::Direct,
        }
    }

    /// The road of a point in m under some forcings.
    fn plan(&self, forcings: &[Forcing<'_>], place_m: [f64; 2]) -> PointPlan {
        let asked = forcings
            .iter()
            .map(|own| (own.derivative, &own.times_s[..]));
        let asked: Vec<_> = asked.collect();
        let grid = self.grid;
        PointPlan::new(
            &self.sets,
            (grid.excitation, grid.tolerance),
            &asked,
            place_m,
        )
    }

    /// The six fields at a point in m, then the quantities.
    ///
    /// # Errors
    /// [`ImpactError`] for a point outside the half-space or the table.
    pub(crate) fn at(&self, r_m: f64, z_m: f64) -> Result<Vec<Trace>, ImpactError> {
        self.sampled(&self.point([r_m, z_m])?)
    }

    /// The same at a point whose kernels are known.
    pub(crate) fn sampled(&self, point: &Point<'_>) -> Result<Vec<Trace>, ImpactError> {
        let found = self.traces_at(&self.forcings, point)?;
        (self.watch)();
        Ok(found)
    }

    /// The kernels of a point in m.
    pub(crate) fn point(&self, place_m: [f64; 2]) -> Result<Point<'_>, ImpactError> {
        let [r_m, z_m] = place_m;
        let set = self.sets.choose_for(self.grid.excitation, place_m);
        let discs = self.sets.get(set);
        let distance = r_m.hypot(z_m) / self.grid.excitation.units().disc_radius_m;
        let part = match &self.past {
            None => 1.0,
            Some(_) if distance > tuning::FAR && discs.count() > 1 => tuning::KERNELS_FAR,
            Some(_) => tuning::KERNELS,
        };
        let cells = discs.radii.iter().map(|&over| {
            let (place, disc_radius_m, wanted) = self.wanted_of(place_m, over, part);
            let ratio = self.grid.excitation.medium().poisson_ratio();
            self.source.cells(ratio, place, disc_radius_m, wanted)
        });
        let cells: Vec<Cells> = cells.collect::<Result<_, _>>()?;
        let echoes = self.echoes.as_ref();
        let echoes = echoes.map(|echoes| self.echo_kernels(echoes, place_m));
        Ok(Point {
            excitation: self.grid.excitation,
            set,
            kernels: PointKernels::new(&self.forcings[0], discs, (place_m, None), cells),
            echoes: echoes.transpose()?,
        })
    }

    /// The six fields at a point under some forcings, then the quantities.
    fn traces_at(
        &self,
        forcings: &[Forcing<'_>],
        point: &Point<'_>,
    ) -> Result<Vec<Trace>, ImpactError> {
        let kernels = &point.kernels;
        let plan = self.plan(forcings, kernels.place_m);
        let of = |(forcing, integrated): (&Forcing<'_>, &Vec<Integrated>)| {
            let loads = forcing.loads(point.set, kernels.discs);
            self.sum(forcing, loads, kernels, integrated)
        };
        let sums = forcings.iter().zip(&plan.integrated).map(of);
        let mut sums: Vec<[Trace; 6]> = sums.collect::<Result<_, _>>()?;
        if let Some((set, kernels)) = &point.echoes {
            for (all, forcing) in sums.iter_mut().zip(forcings) {
                let own = self.of_echoes(forcing, *set, kernels)?;
                add_traces(all, own);
            }
        }
        Ok(self.with_quantities(sums))
    }

    /// The fields and the quantities, of the outputs of each forcing, through the low pass of the output.
    fn with_quantities(&self, mut sums: Vec<[Trace; 6]>) -> Vec<Trace> {
        let rate = |derivative: Derivative| {
            let mut derivatives = self.forcings.iter().map(|own| own.derivative);
            derivatives.position(|own| own == derivative)
        };
        let filtered = self.grid.low_pass_hz.map(|cutoff_hz| {
            let filter = LowPassed::new(self.grid.all_s().collect(), cutoff_hz);
            (filter, sums[0].clone())
        });
        let seen = |component: usize, derivative: Derivative| {
            let (filter, fields) = filtered.as_ref()?;
            let Trace { samples, error, .. } = &fields[component];
            let order = match derivative {
                Derivative::Field => 0,
                Derivative::First => 1,
                Derivative::Second => 2,
            };
            let (samples, error) = filter.of((samples, *error), order, self.wanted);
            Some(Trace::new(samples, error))
        };
        for (component, shown) in sums[0].iter_mut().enumerate() {
            if let Some(own) = seen(component, Derivative::Field) {
                *shown = own;
            }
        }
        let mut found = sums[0].to_vec();
        found.extend(self.quantities.iter().map(|&quantity| {
            let Some((derivative, component)) = quantity.rate() else {
                return self.of_stresses(quantity, &sums[0]);
            };
            let computed = || sums[rate(derivative).unwrap_or(0)][component].clone();
            seen(component, derivative).unwrap_or_else(computed)
        }));
        found
    }

    /// Forcings of the same derivatives for samples of another grid.
    pub(crate) fn forcings_at<'g>(&self, grid: &Grid<'g>, wanted: &[usize]) -> Vec<Forcing<'g>> {
        let of = |own: &Forcing<'_>| {
            let sets = (self.sets.count(), own.parts);
            Forcing::new(grid, wanted, own.derivative, sets)
        };
        self.forcings.iter().map(of).collect()
    }

    /// The same outputs at one instant in s, between two samples of one run: all that [`Self::at`] has at a sample, since a sum over
    /// cells that end at the instant is that at a sample of a grid which begins a part of a step earlier.
    pub(crate) fn at_instant(
        &self,
        point: &Point<'_>,
        time_s: f64,
    ) -> Result<Vec<[f64; 2]>, ImpactError> {
        let (grid, last) = self.grid.ending_at(time_s);
        let forcings = self.forcings_at(&grid, &[last]);
        let found = self.traces_at(&forcings, point)?;
        Ok(found
            .iter()
            .map(|trace| [trace.samples[0], trace.error_of(0)])
            .collect())
    }

    fn of_stresses(&self, quantity: Quantity, fields: &[Trace]) -> Trace {
        let (stresses, elastic) = ([2, 3, 4, 5], self.grid.excitation.elastic);
        let of = |i: usize| quantity.of(stresses.map(|f| fields[f].samples[i]), elastic);
        let error_of = |i: usize| quantity.error(stresses.map(|f| fields[f].error_of(i)), elastic);
        let count = fields[2].samples.len();
        Trace {
            samples: (0..count).map(of).collect(),
            error: quantity.error(stresses.map(|f| fields[f].error), elastic),
            own_errors: (0..count).map(error_of).collect(),
        }
    }

    /// Axial velocity by the echoes of a plate alone, in m/s; none without a plate, or where the quantities do not have it.
    pub(crate) fn echo_velocity(&self, place_m: [f64; 2]) -> Result<Option<Trace>, ImpactError> {
        let Some(echoes) = &self.echoes else {
            return Ok(None);
        };
        let (set, kernels) = self.echo_kernels(echoes, place_m)?;
        let mut all = self.forcings.iter();
        let Some(rate) = all.find(|forcing| forcing.derivative == Derivative::First) else {
            return Ok(None);
        };
        let [_, axial, ..] = self.of_echoes(rate, set, &kernels)?;
        Ok(Some(axial))
    }

    /// The kernels of the echoes of a plate at a point, with the number of their set of discs.
    fn echo_kernels(
        &self,
        echoes: &PlateEchoes,
        place_m: [f64; 2],
    ) -> Result<(usize, PointKernels<'_>), ImpactError> {
        let image_m = echoes.image_m(place_m);
        let radius_m = self.grid.excitation.units().disc_radius_m;
        let set = self.sets.choose_for_echoes(image_m.map(|x| x / radius_m));
        let discs = self.sets.get(set);
        let cells = discs.radii.iter().map(|&over| {
            // their traces have no static part that is left over
            let (_, disc_radius_m, wanted) = self.wanted_of(image_m, over, 1.0);
            echoes.cells(place_m, disc_radius_m, &wanted)
        });
        let cells: Vec<Cells> = cells.collect::<Result<_, _>>()?;
        let placed = (place_m, Some(image_m));
        Ok((
            set,
            PointKernels::new(&self.forcings[0], discs, placed, cells),
        ))
    }

    /// The outputs of a forcing by the echoes of a plate alone.
    fn of_echoes(
        &self,
        forcing: &Forcing<'_>,
        set: usize,
        kernels: &PointKernels<'_>,
    ) -> Result<[Trace; 6], ImpactError> {
        let loads = forcing.loads(set, kernels.discs);
        let mut own = Sums::new(forcing, loads, kernels)?;
        own.integrate_zones(forcing, loads, kernels, |_| false);
        Ok(self.traces(forcing, &own))
    }

    /// The place in radii of a disc of a radius `over` the largest, this radius in m, and the cells as far as the outputs need them,
    /// to a part of their tolerance.
    fn wanted_of(&self, place_m: [f64; 2], over: f64, part: f64) -> ([f64; 2], f64, CellPlan<'_>) {
        let (excitation, grid) = (self.grid.excitation, self.grid);
        let units = excitation.units();
        let disc_radius_m = over * units.disc_radius_m;
        let differences = self.forcings.iter().map(|forcing| forcing.differences);
        // until the last front from the far edge has passed a cell
        let fronts_s = excitation
            .speeds()
            .arrivals_s(place_m[0] + disc_radius_m, place_m[1], 0.0);
        let last_s = fronts_s
            .into_iter()
            .filter(|s| s.is_finite())
            .fold(0.0, f64::max);
        let until = ((last_s / grid.step_s) as usize).saturating_add(2);
        let plan = CellPlan {
            parts: [
                self.forcings[0].parts.unwrap_or(1),
                until.min(grid.longest()),
            ],
            step: grid.step_s / (over * units.time_s()),
            count: grid.longest() + differences.max().unwrap_or(0) + BEYOND,
            pulse: excitation.pulse(over),
            rates: self.forcings.len() > 1,
            tolerance: (part * grid.tolerance).min(tuning::COARSEST),
            damping: self.damping.as_ref().map(|damping| {
                let reference_hz = damping.law().reference_frequency();
                (damping, reference_hz * over * units.time_s())
            }),
        };
        (place_m.map(|x| x / disc_radius_m), disc_radius_m, plan)
    }

    /// Values and errors of one forcing.
    fn sum(
        &self,
        forcing: &Forcing<'_>,
        loads: &Loads,
        kernels: &PointKernels<'_>,
        integrated: &[Integrated],
    ) -> Result<[Trace; 6], ImpactError> {
        let mut sums = Sums::new(forcing, loads, kernels)?;
        let is_whole = |i: usize| {
            let found = integrated.binary_search_by_key(&i, |one| one.sample);
            found.is_ok_and(|place| integrated[place].whole)
        };
        let by_zone = sums.integrate_zones(forcing, loads, kernels, is_whole);
        if let Some(past) = &self.past {
            let allowed = sums.allowed(forcing);
            for one in integrated {
                let by_zone = by_zone[one.sample];
                integrate_past(
                    &mut sums,
                    past,
                    (forcing, loads, kernels),
                    one,
                    (&allowed, by_zone),
                )?;
            }
        }
        Ok(self.traces(forcing, &sums))
    }

    /// The outputs of a forcing with their errors.
    fn traces(&self, forcing: &Forcing<'_>, sums: &Sums) -> [Trace; 6] {
        let own = tuning::FORCE_OVER_RESULTS * forcing.excitation.relative_error;
        let sensitivity = match forcing.derivative {
            Derivative::Field => 0.0,
            Derivative::First => tuning::RATE_OF_TOLERANCE,
            Derivative::Second => tuning::RATE_OF_TOLERANCE.powi(2),
        };
        let relative = own + forcing.tolerance * sensitivity;
        let per_step = (2.0 / forcing.step_s).powi(forcing.differences as i32);
        let of = |f: usize| {
            let left = sums.truncation[f].iter().zip(&sums.residual[f]);
            let left: Vec<f64> = left
                .map(|(truncation, residual)| per_step * (truncation.abs() + residual))
                .collect();
            let samples = Sums::differenced(forcing, &sums.values[f]);
            let even = sums.errors[f] + relative * largest(&samples);
            let quadrature = tuning::QUADRATURE * forcing.tolerance * largest(&sums.values[f]);
            let short = sums.short_waves[f];
            let own = |&first: &usize| {
                let of = first..=first + forcing.differences;
                let integrated = quadrature * largest(&sums.quadratures[of.clone()]);
                let short = short * sums.falls.get(first).map_or(1.0, |part| *part);
                even + largest(&left[of]) + integrated + short
            };
            Trace {
                error: even + largest(&left) + quadrature * largest(&sums.quadratures) + short,
                own_errors: forcing.outputs.iter().map(own).collect(),
                samples,
            }
        };
        std::array::from_fn(of)
    }
}

/// Adds traces to others, with their errors.
fn add_traces(all: &mut [Trace; 6], own: [Trace; 6]) {
    for (all, own) in all.iter_mut().zip(own) {
        all.error += own.error;
        for (i, sample) in all.samples.iter_mut().enumerate() {
            *sample += own.samples[i];
            all.own_errors[i] += own.error_of(i);
        }
    }
}

/// Replaces the discs in one sample by the integral over the radii of the contact: over all of the past, or over the parts whose
/// fronts pass.
fn integrate_past(
    sums: &mut Sums,
    past: &Past<'_>,
    (forcing, loads, kernels): (&Forcing<'_>, &Loads, &PointKernels<'_>),
    Integrated { sample, whole }: &Integrated,
    (allowed, by_zone): (&Six, bool),
) -> Result<(), ImpactError> {
    let (i, time_s) = (*sample, forcing.times_s[*sample]);
    let (run, _) = forcing.in_run(i);
    let run = &forcing.runs[run].run;
    let span_s = |cells: &Range<usize>| forcing.span_s(run, cells);
    let contacts = forcing.contacts(run);
    let mut parts: Vec<Range<usize>> = Vec::new();
    for contact in &contacts {
        match past
            .parts(kernels.place_m, time_s, contact, span_s)
            .filter(|_| !whole)
        {
            Some(found) => parts.extend(found),
            None => parts.push(contact.clone()),
        }
    }
    let is_all = parts == contacts;
    let (mut found, mut by_discs) = ([Six::default(); 2], Six::default());
    let part = tuning::LAST_TERMS.min(tuning::COARSEST / forcing.tolerance);
    let enough = allowed.map(|x| part / tuning::ACCEPTED * x);
    for part in &parts {
        let own = past.between(
            &enough,
            kernels.place_m,
            time_s,
            span_s(part),
            forcing.reading,
        )?;
        let cells = by_cells(forcing, loads, kernels, i, part);
        let zones = match by_zone {
            true => by_zones(forcing, loads, kernels, i, part),
            false => Six::default(),
        };
        for f in 0..6 {
            found[0][f] += own.value[f];
            found[1][f] += own.error[f];
            by_discs[f] += cells[f] + zones[f];
        }
    }
    // the last terms of the integrals of fields are counted one by one
    sums.quadratures[i] += match forcing.derivative {
        Derivative::Field => 0.0,
        Derivative::First | Derivative::Second => 1.0,
    };
    // of rates the last terms say too much: beside fronts they fall slowly, and have either sign
    let counts = forcing.reading == Reading::Force;
    for f in 0..components(forcing) {
        sums.values[f][i] += found[0][f] - by_discs[f];
        // between fronts discs serve
        sums.truncation[f][i] = 0.0;
        if is_all {
            sums.residual[f][i] = 0.0;
        }
        sums.residual[f][i] += if counts { found[1][f] } else { 0.0 };
    }
    Ok(())
}
