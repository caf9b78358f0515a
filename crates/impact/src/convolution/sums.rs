//! Sums of the loads of one forcing over the kernels of a point, with truncation bounds.
//!
//! Theory: `docs/theory.md` (T24, T60).

use super::discs::Discs;
use super::ends::departures;
use super::fronts::Fronts;
use super::loads::{Forcing, Loads, SampledRun};
use super::tuning;
use crate::excitation::PressureRadius;
use crate::kernels::Cells;
use crate::quantity::Derivative;
use crate::record::jump::rounded_up;
use crate::sampled::projection::largest;
use halfspace::{DomainError, Six};
use lookup::Moments;
use std::ops::Range;

/// The kernels of a point.
pub(crate) struct PointKernels<'a> {
    pub(crate) place_m: [f64; 2],
    /// Where the waves come from: the place itself, or its image where they are the echoes of a plate, which have no static
    /// part.
    pub(crate) image_m: Option<[f64; 2]>,
    pub(crate) discs: &'a Discs,
    /// Of each disc, in kernel units.
    pub(crate) cells: Vec<Cells>,
    /// Divided differences of them, in SI units; that of order zero is the kernel of the first disc, and is left out, where shares are
    /// not prescribed.
    differences: Vec<Difference>,
    /// Units of each disc.
    units: Vec<Six>,
}

/// A divided difference of the kernels of discs in the squares of their radii, in SI units.
struct Difference {
    static_part: Six,
    smooth: Vec<Six>,
    moments: Moments,
}

impl<'a> PointKernels<'a> {
    /// Of the cells of each disc.
    pub(crate) fn new(
        forcing: &Forcing<'_>,
        discs: &'a Discs,
        (place_m, image_m): ([f64; 2], Option<[f64; 2]>),
        cells: Vec<Cells>,
    ) -> Self {
        let units = discs
            .radii
            .iter()
            .map(|over| forcing.excitation.units_si(*over));
        let units: Vec<Six> = units.collect();
        let mut made = Self {
            place_m,
            image_m,
            discs,
            differences: Vec::new(),
            units,
            cells,
        };
        let of = |order: usize| Difference {
            static_part: made.static_blend(order),
            smooth: made.blend(order, |own| &own.smooth),
            moments: Moments {
                averages: made.blend(order, |own| &own.moments.averages),
                first: made.blend(order, |own| &own.moments.first),
                second: made.blend(order, |own| &own.moments.second),
            },
        };
        made.differences = (made.left_out()..discs.orders()).map(of).collect();
        made
    }

    /// The divided difference of an order of some list of the kernels, in SI units.
    fn blend(&self, order: usize, list: fn(&Cells) -> &Vec<Six>) -> Vec<Six> {
        let mut sum = vec![Six::default(); list(&self.cells[0]).len()];
        for (k, (cells, unit)) in self.cells.iter().zip(&self.units).enumerate() {
            let weight = self.discs.weight(order, k);
            if weight == 0.0 {
                continue;
            }
            let unit = unit.map(|unit| weight * unit);
            for (sum, own) in sum.iter_mut().zip(list(cells)) {
                for f in 0..6 {
                    sum[f] += unit[f] * own[f];
                }
            }
        }
        sum
    }

    /// Orders of differences that are the kernel of the first disc.
    fn left_out(&self) -> usize {
        usize::from(!self.discs.are_prescribed())
    }

    /// The divided difference of an order of the static parts, in SI units.
    fn static_blend(&self, order: usize) -> Six {
        let mut sum = Six::default();
        for (k, (cells, unit)) in self.cells.iter().zip(&self.units).enumerate() {
            let weight = self.discs.weight(order, k);
            for f in 0..6 {
                sum[f] += weight * unit[f] * cells.static_part[f];
            }
        }
        sum
    }

    /// The static part of the difference of an order, in its unit.
    fn static_part(&self, order: usize) -> Six {
        match order.checked_sub(self.left_out()) {
            Some(place) => self.differences[place].static_part,
            None => self.cells[0].static_part,
        }
    }

    /// The difference of an order: cells for a smooth load, moments, and their unit.
    fn difference(&self, order: usize) -> (&[Six], &Moments, Six) {
        match order
            .checked_sub(self.left_out())
            .map(|place| &self.differences[place])
        {
            Some(own) => (&own.smooth, &own.moments, [1.0; 6]),
            None => (&self.cells[0].smooth, &self.cells[0].moments, self.units[0]),
        }
    }

    /// Whether kernels are known at each instant, rather than in cells alone.
    pub(crate) fn are_traces(&self) -> bool {
        self.cells.iter().all(|cells| cells.trace.is_some())
    }
}

/// A divided difference of the kernels as the sharp cells of a load meet it, in SI units.
struct SharpKernel {
    /// How far it departs from a parabola in each cell.
    departures: Vec<Six>,
    /// Averages over parts of the first cells, where a table has them.
    fine: Vec<Six>,
    /// Parts of a cell.
    parts: usize,
}

impl SharpKernel {
    fn new(kernels: &PointKernels<'_>, order: usize, parts: usize) -> Self {
        let (_, moments, unit) = kernels.difference(order);
        let mut departures = departures(moments);
        for own in &mut departures {
            *own = std::array::from_fn(|f| unit[f] * own[f]);
        }
        Self {
            departures,
            fine: kernels.blend(order, |own| &own.fine),
            parts,
        }
    }

    /// Adds the response to the residual of a load in a cell `lag` cells before, summed over the parts of the cell if
    /// the kernel has them, and an error bound: the residual times the departure from a parabola, or its rises over the
    /// parts times the changes of the kernel to both sides.
    fn add(&self, lag: usize, (residual, rises): (f64, &[f64]), [sum, bound]: &mut [Six; 2]) {
        if (lag + 1) * self.parts > self.fine.len() {
            for (bound, departure) in bound.iter_mut().zip(self.departures[lag]) {
                *bound += residual * departure;
            }
            return;
        }
        for (m, rise) in rises.iter().rev().enumerate() {
            let place = lag * self.parts + m;
            let next = &self.fine[(place + 1).min(self.fine.len() - 1)];
            let before = &self.fine[place.saturating_sub(1)];
            for f in 0..6 {
                sum[f] += rise * self.fine[place][f];
                bound[f] += tuning::WITHIN_PARTS * rise.abs() * (next[f] - before[f]).abs();
            }
        }
    }
}

/// Samples of the six fields, or of rates of the first two, with their truncation errors.
pub(crate) struct Sums {
    /// At the samples needed.
    pub(crate) values: [Vec<f64>; 6],
    /// The first term that the discs leave out.
    pub(crate) truncation: [Vec<f64>; 6],
    /// Bound on the error of the parabolas in the cells.
    pub(crate) residual: [Vec<f64>; 6],
    /// Errors of every sample.
    pub(crate) errors: Six,
    /// How many integrals each sample has whose error is that of a quadrature.
    pub(crate) quadratures: Vec<f64>,
    /// Errors of looked-up fields at fronts of the first and last instants, and which part of them each sample has.
    pub(crate) short_waves: Six,
    pub(crate) falls: Vec<f64>,
}

/// How many components a forcing has.
pub(crate) fn components(forcing: &Forcing<'_>) -> usize {
    match forcing.derivative {
        Derivative::Field => 6,
        Derivative::First | Derivative::Second => 2,
    }
}

impl Sums {
    /// Of the loads of a forcing.
    pub(crate) fn new(
        forcing: &Forcing<'_>,
        loads: &Loads,
        kernels: &PointKernels<'_>,
    ) -> Result<Self, DomainError> {
        let blank = || std::array::from_fn(|_| vec![0.0; forcing.times_s.len()]);
        // damped waves are summed over discs where fronts pass, too, and are as uncertain as an integral
        // (`without_attenuation_fields_are_elastic`)
        let damped = f64::from(u8::from(forcing.excitation.attenuation.is_some()));
        let mut sums = Self {
            values: blank(),
            truncation: blank(),
            residual: blank(),
            errors: Six::default(),
            quadratures: vec![damped; forcing.times_s.len()],
            short_waves: Six::default(),
            falls: Vec::new(),
        };
        sums.add_cells(forcing, loads, kernels);
        sums.add_sharp(forcing, loads, kernels);
        sums.add_jumps(forcing, kernels);
        sums.add_errors(forcing, loads, kernels);
        let radius = forcing.excitation.radius();
        if let PressureRadius::Following { largest_m, .. } = radius
            && !kernels.discs.are_prescribed()
        {
            if kernels.discs.count() == 1 {
                let [r_m, z_m] = kernels.image_m.unwrap_or(kernels.place_m);
                let part = tuning::ONE_DISC * (largest_m / r_m.hypot(z_m)).powi(2);
                for (error, samples) in sums.errors.iter_mut().zip(&sums.values) {
                    *error += part * largest(samples);
                }
            }
            if kernels.image_m.is_none() {
                sums.add_still(forcing, kernels.place_m)?;
            }
        }
        sums.add_short_waves(forcing, kernels);
        sums.still_before_arrival(forcing, kernels.place_m);
        Ok(sums)
    }

    fn add_cells(&mut self, forcing: &Forcing<'_>, loads: &Loads, kernels: &PointKernels<'_>) {
        // the static part of a pressure that follows the load is that of its instant
        let is_of_instant = forcing.follows() && !kernels.discs.are_prescribed();
        let count = components(forcing);
        let mut first = 0;
        for (run, sampled) in loads.runs.iter().zip(&forcing.runs) {
            let add = |target: &mut [Vec<f64>; 6], found: [Vec<f64>; 6], unit: Six| {
                for f in 0..count {
                    for (target, found) in target[f][first..].iter_mut().zip(&found[f]) {
                        *target += unit[f] * found;
                    }
                }
            };
            for (order, load) in run.each.iter().enumerate() {
                let (smooth, moments, unit) = kernels.difference(order);
                let fixed = match is_of_instant {
                    true => Six::default(),
                    false => kernels.static_part(order),
                };
                let mut found = load.convolver.fields(&fixed, smooth);
                load.projection.add(moments, &sampled.needed, &mut found);
                add(&mut self.values, found, unit);
            }
            if let Some(next) = &run.next {
                let (_, moments, unit) = kernels.difference(kernels.discs.count() - 1);
                let found = next.convolver.fields(&Six::default(), &moments.averages);
                add(&mut self.truncation, found, unit);
            }
            first += sampled.needed.len();
        }
    }

    /// Adds the residuals of the load in sharp cells, and a bound on the remaining error.
    fn add_sharp(&mut self, forcing: &Forcing<'_>, loads: &Loads, kernels: &PointKernels<'_>) {
        if loads.runs.iter().all(|run| run.sharp.is_empty()) {
            return;
        }
        let orders = 0..kernels.discs.orders();
        let of = |order: usize| SharpKernel::new(kernels, order, forcing.parts.unwrap_or(1));
        let orders: Vec<SharpKernel> = orders.map(of).collect();
        let mut first = 0;
        for (run, sampled) in loads.runs.iter().zip(&forcing.runs) {
            for (i, &n) in sampled.needed.iter().enumerate() {
                let mut found = [Six::default(); 2];
                for sharp in run.sharp.iter().take_while(|sharp| sharp.cell <= n) {
                    for (order, kernel) in orders.iter().enumerate() {
                        let residual = run.each[order].projection.taken(sharp.cell).left;
                        let rises = &sharp.rises[order];
                        kernel.add(n - sharp.cell, (residual, rises), &mut found);
                    }
                }
                let [sum, bound] = found;
                for f in 0..components(forcing) {
                    self.values[f][first + i] += sum[f];
                    self.residual[f][first + i] = bound[f];
                }
            }
            first += sampled.needed.len();
        }
    }

    /// Adds the response to each jump of the force, a step, at the instants after it; at an arrival it is that after it.
    fn add_jumps(&mut self, forcing: &Forcing<'_>, kernels: &PointKernels<'_>) {
        let excitation = forcing.excitation;
        let shares: Vec<f64> = (0..kernels.cells.len())
            .map(|k| kernels.discs.share(k, 1.0))
            .collect();
        for jump in excitation.jumps() {
            for (i, &time_s) in forcing.times_s.iter().enumerate() {
                if !jump.is_past(time_s) {
                    continue;
                }
                // at the jump itself after it
                let since_s = (rounded_up(time_s) - jump.time_s).max(f64::MIN_POSITIVE);
                for (k, (cells, share)) in kernels.cells.iter().zip(&shares).enumerate() {
                    let unit_s = kernels.discs.radii[k] * excitation.units().time_s();
                    let response = cells.step_response(since_s / unit_s, forcing.step_s / unit_s);
                    let rise_n = share * jump.rise_n;
                    let values = self
                        .values
                        .iter_mut()
                        .zip(kernels.units[k].iter().zip(response));
                    for (values, (unit, response)) in values.take(components(forcing)) {
                        values[i] += rise_n * unit * response;
                    }
                }
            }
        }
    }

    /// Adds the errors of the kernels, those of the discs as independent ones, and of the force within the cells.
    fn add_errors(&mut self, forcing: &Forcing<'_>, loads: &Loads, kernels: &PointKernels<'_>) {
        let excitation = forcing.excitation;
        let (settled, changed_n) = forcing.left_out;
        for (k, cells) in kernels.cells.iter().enumerate() {
            let unit = kernels.units[k];
            let tail = cells.smooth.get(settled).copied().unwrap_or_default();
            let read = match excitation.jumps() {
                [] => Six::default(),
                _ => cells
                    .error_at_instants()
                    .map(|own| 2.0 * own * forcing.half_jumps()),
            };
            for (f, error) in loads.errors(k, cells).into_iter().enumerate() {
                let error = error + read[f] + changed_n * tail[f].abs();
                self.errors[f] = self.errors[f].hypot(unit[f] * error);
            }
        }
    }

    /// Adds the static field of the pressure of each instant.
    fn add_still(&mut self, forcing: &Forcing<'_>, place_m: [f64; 2]) -> Result<(), DomainError> {
        let pressures = forcing.runs.iter().flat_map(SampledRun::needed_pressures);
        for (i, pressures) in pressures.enumerate() {
            let still = forcing.still(place_m, pressures)?;
            for (samples, value) in self.values.iter_mut().zip(still) {
                samples[i] += value;
            }
        }
        Ok(())
    }

    /// Adds the errors of looked-up fields and of echoes by the first and last instants of a contact.
    fn add_short_waves(&mut self, forcing: &Forcing<'_>, kernels: &PointKernels<'_>) {
        let of_echoes = kernels.image_m.is_some() && forcing.follows();
        if kernels.are_traces() && !of_echoes {
            return;
        }
        let fronts = Fronts::new(forcing.excitation, kernels.place_m);
        let peaks = self.values.each_ref().map(|samples| largest(samples));
        let kinds = [&peaks[..2], &peaks[2..]].map(largest);
        let of_kind = |f: usize| usize::from(f >= 2);
        if kernels.are_traces() {
            let parts = fronts.echo_errors(forcing.derivative);
            for (f, error) in self.errors.iter_mut().enumerate() {
                *error += parts[of_kind(f)] * kinds[of_kind(f)];
            }
            return;
        }
        let power = forcing.derivative.power();
        let smallest = kernels.discs.smallest();
        let [_, part] = fronts.looked_up_errors(smallest, forcing.step_s, power);
        // a fixed disc has none
        if part > 0.0 {
            self.short_waves = std::array::from_fn(|f| part * kinds[of_kind(f)]);
            let falls = |&time_s: &f64| fronts.falls(time_s, kernels.discs.count());
            self.falls = forcing.times_s.iter().map(falls).collect();
        }
    }

    /// Sets the fields to zero before the first wave from the largest disc has arrived. With attenuation waves of high frequencies
    /// are faster than those of the elastic block, and their kernels themselves are zero before.
    fn still_before_arrival(&mut self, forcing: &Forcing<'_>, [r_m, z_m]: [f64; 2]) {
        let excitation = forcing.excitation;
        let radius_m = excitation.units().disc_radius_m;
        if excitation.attenuation.is_some() {
            return;
        }
        let travel_s = excitation.speeds().arrivals_s(r_m, z_m, radius_m)[0];
        let first_s = excitation.first_s() + travel_s;
        let early = forcing.times_s.iter().filter(|&&t| rounded_up(t) < first_s);
        let still = early.count();
        for samples in [&mut self.values, &mut self.truncation, &mut self.residual] {
            samples.iter_mut().for_each(|own| own[..still].fill(0.0));
        }
    }

    /// Errors that are allowed in a sample of each field.
    pub(crate) fn allowed(&self, forcing: &Forcing<'_>) -> Six {
        let differences = 0.1_f64.powi(forcing.differences as i32);
        let part = tuning::ACCEPTED * forcing.tolerance * differences;
        let peaks = self.values.each_ref().map(|samples| largest(samples));
        let kinds = [&peaks[..2], &peaks[2..]].map(largest);
        std::array::from_fn(|f| match f < components(forcing) {
            true => part * peaks[f].max(tuning::SMALL_FIELD * kinds[usize::from(f >= 2)]),
            false => f64::INFINITY,
        })
    }

    /// Replaces the cells of the zones by integrals over them, where the cells may leave out more than is allowed: all but those
    /// of samples that are integrated as a whole.
    pub(crate) fn integrate_zones(
        &mut self,
        forcing: &Forcing<'_>,
        loads: &Loads,
        kernels: &PointKernels<'_>,
        is_whole: impl Fn(usize) -> bool,
    ) -> Vec<bool> {
        let allowed = self.allowed(forcing);
        let is_open = |i: usize| (0..6).any(|f| self.residual[f][i] > allowed[f]);
        let mut done: Vec<bool> = (0..forcing.times_s.len())
            .map(|i| !is_whole(i) && is_open(i))
            .collect();
        if !kernels.are_traces() {
            done.fill(false);
        }
        for i in (0..done.len()).filter(|&i| done[i]) {
            self.quadratures[i] += 1.0;
            let change = by_zones(forcing, loads, kernels, i, &(0..usize::MAX));
            for (f, change) in change.into_iter().enumerate().take(components(forcing)) {
                self.values[f][i] += change;
                self.residual[f][i] = 0.0;
            }
        }
        done
    }

    /// Samples of the outputs from those needed.
    pub(crate) fn differenced(forcing: &Forcing<'_>, samples: &[f64]) -> Vec<f64> {
        let step_s = forcing.step_s;
        let of = |&i: &usize| match forcing.differences {
            0 => samples[i],
            1 => (samples[i + 1] - samples[i]) / step_s,
            _ => (samples[i + 2] - 2.0 * samples[i + 1] + samples[i]) / (step_s * step_s),
        };
        forcing.outputs.iter().map(of).collect()
    }
}

/// The change of a sample where the integrals over the zones take the place of some cells.
pub(crate) fn by_zones(
    forcing: &Forcing<'_>,
    loads: &Loads,
    kernels: &PointKernels<'_>,
    i: usize,
    among: &Range<usize>,
) -> Six {
    let (run, _) = forcing.in_run(i);
    let mut change = Six::default();
    for zone in &loads.runs[run].zones {
        let part = zone.cells.start.max(among.start)..zone.cells.end.min(among.end);
        if part.is_empty() {
            continue;
        }
        let past_s = forcing.span_s(&forcing.runs[run].run, &part);
        for (k, cells) in kernels.cells.iter().enumerate() {
            let Some(trace) = &cells.trace else {
                continue;
            };
            let unit = kernels.units[k];
            let unit_s = kernels.discs.radii[k] * forcing.excitation.units().time_s();
            let exact = zone.by_trace(k, forcing.times_s[i], past_s, (trace, unit_s));
            for f in 0..6 {
                change[f] += unit[f] * exact[f];
            }
        }
        let by_cells = by_cells(forcing, loads, kernels, i, &part);
        for f in 0..6 {
            change[f] -= by_cells[f];
        }
    }
    change
}

/// The contribution of some cells to a sample.
pub(crate) fn by_cells(
    forcing: &Forcing<'_>,
    loads: &Loads,
    kernels: &PointKernels<'_>,
    i: usize,
    part: &Range<usize>,
) -> Six {
    let (run, n) = forcing.in_run(i);
    let mut sum = Six::default();
    for (order, load) in loads.runs[run].each.iter().enumerate() {
        let (_, moments, unit) = kernels.difference(order);
        let found = load.projection.by_cells(n, part, moments);
        sum = std::array::from_fn(|f| sum[f] + unit[f] * found[f]);
    }
    sum
}
