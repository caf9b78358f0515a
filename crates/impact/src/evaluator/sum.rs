//! The sum of one forcing over the discs of a choice, at one point.

use super::Trace;
use super::discs::{COARSEST, Discs};
use super::ends::open;
use super::forcing::{DiscForce, DiscForces, Forcing, Rough};
use super::past::Past;
use super::windows::Windows;
use crate::error::ImpactError;
use crate::excitation::{Excitation, PressureRadius};
use crate::fields::quantity::Derivative;
use crate::kernels::Cells;
use crate::record::jump::rounded_up;
use crate::record::stretch::largest;
use halfspace::Six;
use lookup::Moments;
use std::ops::Range;

/// Samples of six fields, or of the rates of the first two, with what the samples leave open.
pub(crate) struct Sum<'a> {
    forcing: &'a Forcing<'a>,
    discs: &'a Discs,
    forces: &'a [DiscForce],
    place_m: [f64; 2],
    /// At the samples that the forcing needs, of all runs.
    values: [Vec<f64>; 6],
    errors: Six,
    /// What the discs may leave of each sample.
    left: [Vec<f64>; 6],
    /// What the cells may leave.
    rough: [Vec<f64>; 6],

    /// Samples whose zones are integrated.
    integrated: Vec<bool>,
    /// Samples in which the discs may leave more than the tolerance.
    pub(crate) open: Vec<usize>,
}

/// What a disc alone leaves out of the waves besides their travel, as a fraction of them times the squared distance in radii.
const NEAR: f64 = 2.0;

/// Part of the tolerance up to which what is left of a sample is let be; a tenth of it for each difference.
const SURE: f64 = 0.5;
/// Of more than a few discs the highest power says little of those below it: less is let be, and what is left counts for more.
const FEW: usize = 5;
const OF_MANY: f64 = 0.2;
const UNDER: f64 = 0.1;
/// Some radii away, no deeper than a radius, the waves of Rayleigh are short.
const SHALLOW: f64 = 0.4;

/// What is left has a sign: a sample beside one that is left with more may have met a zero of it, and counts with a part.
/// Beside are those within a part of the time of a longitudinal wave over the radius and of the contact, one at least, or so
/// many times as far under the contact.
const BESIDE: f64 = 0.5;
const BESIDE_UNDER: usize = 3;
const REACH: f64 = 0.7;
const OF_CONTACT: f64 = 0.005;
const MOST_BESIDE: f64 = 16.0;

/// Samples of a point for which a whole contact is integrated at most, of fields and of rates: those that the discs leave
/// open in its middle. Of fields to more than four digits so many times more for each.
const MOST_WHOLE: [usize; 2] = [24, 192];
const MORE_WHOLE: f64 = 3.0;

/// Times that a longitudinal wave takes over the radius, from which on the middle of a contact is smooth: fields away from
/// it are integrated where the fronts of its ends pass and nowhere else. Between them the discs have more digits than the
/// integral has, of tractions just below the surface three more.
const LONG: f64 = 100.0;

/// Error of an integral over a zone, in tolerances, and last terms of a series over the past, whose integral is nearer.
const QUADRATURE: f64 = 0.7;
const LAST_TERMS: f64 = 3.0;

impl<'a> Sum<'a> {
    /// Of the forces on some discs with the kernels of each.
    pub(crate) fn new(
        forcing: &'a Forcing<'a>,
        discs: &'a Discs,
        forces: &'a DiscForces,
        place_m: [f64; 2],
        cells: &[Cells],
    ) -> Result<Self, ImpactError> {
        let DiscForces { each, rough } = forces;
        let samples = forcing.times_s.len();
        let blank = || std::array::from_fn(|_| vec![0.0; samples]);
        let mut sum = Self {
            forcing,
            discs,
            forces: each,
            place_m,
            values: blank(),
            errors: Six::default(),
            left: blank(),
            rough: blank(),
            integrated: vec![false; samples],
            open: Vec::new(),
        };
        for (k, cells) in cells.iter().enumerate() {
            sum.add_disc(k, cells);
        }
        sum.add_omitted(cells);
        sum.add_rough(cells, rough);
        if let PressureRadius::Following { largest_m, .. } = forcing.excitation.radius() {
            if discs.radii.len() == 1 {
                let near = NEAR * (largest_m / place_m[0].hypot(place_m[1])).powi(2);
                for (error, samples) in sum.errors.iter_mut().zip(&sum.values) {
                    *error += near * largest(samples);
                }
            }
            sum.add_following_static()?;
        }
        sum.still_before_arrival();
        // what the highest power leaves is in the zones, too
        if discs.omitted.is_empty() && are_traces(cells) {
            sum.integrate_rough(cells);
            for i in sum.not_resolved(&sum.left, BESIDE) {
                sum.integrate_zones(i, cells);
            }
        }
        sum.open = sum.not_resolved(&sum.left, BESIDE);
        if discs.radii.len() > 1 {
            let blurred = sum.blurred();
            sum.open.extend(blurred);
        }
        Ok(sum)
    }

    /// More samples that are open, at which waves of the first or last instants of a contact pass.
    fn blurred(&self) -> Vec<usize> {
        let times_s = &self.forcing.times_s;
        let windows = self.windows();
        let is_in = |t: f64| windows.front_passes(t) || windows.is_of_small_contact(t);
        let more = |&i: &usize| !self.open.contains(&i) && is_in(times_s[i]);
        (0..times_s.len()).filter(more).collect()
    }

    fn windows(&self) -> Windows<'_> {
        Windows {
            excitation: self.forcing.excitation,
            place_m: self.place_m,
            tolerance: self.forcing.tolerance,
            of_fields: self.forcing.derivative == Derivative::Field,
        }
    }

    /// The largest index of a component.
    fn components(&self) -> usize {
        match self.forcing.derivative {
            Derivative::Field => 6,
            Derivative::First | Derivative::Second => 2,
        }
    }

    /// Adds the fields under one disc.
    fn add_disc(&mut self, k: usize, cells: &Cells) {
        let (excitation, force) = (self.forcing.excitation, &self.forces[k]);
        let unit = excitation.units_si(self.discs.radii[k]);
        // the static part of a pressure that follows the load is added as a whole
        let rest = match excitation.radius() {
            PressureRadius::Fixed(_) => cells.static_part,
            PressureRadius::Following { .. } => Six::default(),
        };
        let has_zones = force.runs.iter().any(|run| !run.zones.is_empty()) && cells.trace.is_some();
        let open = if has_zones {
            open(&cells.moments)
        } else {
            Vec::new()
        };
        let mut first = 0;
        for (run, needed) in force.runs.iter().zip(&self.forcing.needed) {
            let own = run.force.fields(&rest, cells, needed);
            let last = run.last.as_ref().filter(|_| self.discs.omitted.is_empty());
            let last = last.map(|last| last.fields(&Six::default(), cells, needed));
            for f in 0..self.components() {
                for (i, value) in own[f].iter().enumerate() {
                    self.values[f][first + i] += unit[f] * value;
                }
                for (i, value) in last.iter().flat_map(|last| last[f].iter().enumerate()) {
                    self.left[f][first + i] += unit[f] * value;
                }
            }
            let traced = cells.trace.as_ref();
            for zone in traced.iter().flat_map(|_| &run.zones) {
                for (i, &n) in needed.iter().enumerate() {
                    let rough = run.force.projection.left_by(n, &zone.cells, &open);
                    for f in 0..self.components() {
                        self.rough[f][first + i] += unit[f] * rough[f];
                    }
                }
            }
            first += needed.len();
        }
        self.add_jumps(k, cells);
        let (settled, changed) = self.forcing.left_out;
        let rest = cells.smooth.get(settled).copied().unwrap_or_default();
        let read = match excitation.jumps() {
            [] => Six::default(),
            _ => cells
                .error_at_instants()
                .map(|own| 2.0 * own * self.forcing.half_jumps()),
        };
        for (f, error) in force.errors(cells).into_iter().enumerate() {
            let error = error + read[f] + changed * rest[f].abs();
            // those of the discs are independent
            self.errors[f] = self.errors[f].hypot(unit[f] * error);
        }
    }

    /// Adds the response to each jump of the force, a step, at the instants after it; at an arrival it is that after it.
    fn add_jumps(&mut self, k: usize, cells: &Cells) {
        let (forcing, over) = (self.forcing, self.discs.radii[k]);
        let (unit, unit_s) = (
            forcing.excitation.units_si(over),
            over * forcing.excitation.units().time_s(),
        );
        for jump in forcing.excitation.jumps() {
            for (i, &time_s) in forcing.times_s.iter().enumerate() {
                if !jump.is_past(time_s) {
                    continue;
                }
                // at the jump itself after it
                let since_s = (rounded_up(time_s) - jump.time_s).max(f64::MIN_POSITIVE);
                let response = cells.step_response(since_s / unit_s, forcing.step_s / unit_s);
                for f in 0..self.components() {
                    self.values[f][i] += jump.rise_n * unit[f] * response[f];
                }
            }
        }
    }

    /// Adds a bound on the error of the zones where no trace integrates them: for each polynomial of the radius, with the kernel
    /// on which it acts. Summed disc by disc it was thousands of times the error (`scripts/measure-lookups`), because the shares
    /// of a load that is smaller than the discs are large and cancel.
    fn add_rough(&mut self, cells: &[Cells], rough: &[Vec<Rough>]) {
        if rough.iter().all(Vec::is_empty) {
            return;
        }
        let count = self.discs.radii.len();
        let open: Vec<Vec<Six>> = (0..count).map(|j| open(&self.moments(j, cells))).collect();
        let (components, mut first) = (self.components(), 0);
        for (rough, needed) in rough.iter().zip(&self.forcing.needed) {
            for (i, &n) in needed.iter().enumerate() {
                for Rough { cell, left } in rough.iter().filter(|one| one.cell <= n) {
                    for (left, open) in left.iter().zip(&open) {
                        let fields = self.rough.iter_mut().zip(open[n - cell]);
                        for (rough, open) in fields.take(components) {
                            rough[first + i] += left * open;
                        }
                    }
                }
            }
            first += needed.len();
        }
    }

    /// In SI units the kernel on which polynomial `j` of the load acts.
    fn moments(&self, j: usize, cells: &[Cells]) -> Moments {
        let zero = || vec![Six::default(); cells[0].moments.averages.len()];
        let mut sum = Moments {
            averages: zero(),
            first: zero(),
            second: zero(),
        };
        for (k, (cells, over)) in cells.iter().zip(&self.discs.radii).enumerate() {
            let count = self.discs.kernel(j, k);
            let unit = self
                .forcing
                .excitation
                .units_si(*over)
                .map(|unit| count * unit);
            let own = &cells.moments;
            let lists = [
                (&mut sum.averages, &own.averages),
                (&mut sum.first, &own.first),
                (&mut sum.second, &own.second),
            ];
            for (sum, own) in lists {
                for (sum, own) in sum.iter_mut().zip(own) {
                    *sum = std::array::from_fn(|f| sum[f] + unit[f] * own[f]);
                }
            }
        }
        sum
    }

    /// Adds what discs leave that stand for the load away from it: of each so many times what the first one has.
    fn add_omitted(&mut self, cells: &[Cells]) {
        let Some(first) = self.discs.omitted.first() else {
            return;
        };
        let mut all = vec![Six::default(); cells[0].smooth.len()];
        let discs = self.discs.omitted.iter().zip(&self.discs.radii);
        for ((count, over), cells) in discs.zip(cells) {
            let unit = self.forcing.excitation.units_si(*over);
            for (sum, cell) in all.iter_mut().zip(&cells.smooth) {
                *sum = std::array::from_fn(|f| sum[f] + count / first * unit[f] * cell[f]);
            }
        }
        let (components, mut before) = (self.components(), 0);
        for (run, needed) in self.forces[0].runs.iter().zip(&self.forcing.needed) {
            if let Some(last) = &run.last {
                let found = last.convolver.fields(&Six::default(), &all);
                for (left, found) in self.left.iter_mut().zip(&found).take(components) {
                    left[before..before + needed.len()].copy_from_slice(found);
                }
            }
            before += needed.len();
        }
    }

    /// Adds the static field of the pressures of each instant, or its rate.
    fn add_following_static(&mut self) -> Result<(), ImpactError> {
        /// Part of the force over which the static field is differenced: a smooth function of it.
        const PART: f64 = 1e-4;
        let excitation = self.forcing.excitation;
        for (i, &pressures) in self.forcing.pressures.iter().enumerate() {
            let of = |one| excitation.static_si(self.place_m, [one]);
            let fixed = self.forcing.try_sum(pressures, PART, of)?;
            for (samples, value) in self.values.iter_mut().zip(fixed) {
                samples[i] += value;
            }
        }
        Ok(())
    }

    /// Sets to zero what the sum leaves before the first wave from the largest disc has arrived.
    fn still_before_arrival(&mut self) {
        let excitation = self.forcing.excitation;
        let (radius_m, [r_m, z_m]) = (excitation.units().disc_radius_m, self.place_m);
        let travel_s = excitation.speeds().arrivals_s(r_m, z_m, radius_m)[0];
        let first_s = excitation.first_s() + travel_s;
        let early = self
            .forcing
            .times_s
            .iter()
            .filter(|&&t| rounded_up(t) < first_s);
        let still = early.count();
        for samples in [&mut self.values, &mut self.left, &mut self.rough] {
            samples.iter_mut().for_each(|own| own[..still].fill(0.0));
        }
    }

    /// Whether the contact's edge passes close over the point: there powers fall slowly.
    fn is_under(&self) -> bool {
        self.place_m[0].max(self.place_m[1]) < self.forcing.excitation.units().disc_radius_m
    }

    /// Samples for which a whole contact is integrated at most.
    fn whole(&self) -> usize {
        match self.forcing.derivative {
            Derivative::Field => {
                let own = self.forcing;
                most_whole(own.excitation, own.step_s, own.tolerance)
            }
            Derivative::First | Derivative::Second => MOST_WHOLE[1],
        }
    }

    /// Part of what may be left that the discs tell.
    fn sure(&self) -> f64 {
        let radius_m = self.forcing.excitation.units().disc_radius_m;
        match self.discs.radii.len() {
            2.. if self.is_under() => UNDER,
            _ if self.discs.is_apart() && self.place_m[1] < radius_m => SHALLOW,
            0..=FEW => 1.0,
            _ => OF_MANY,
        }
    }

    /// What may be left of a sample of each field.
    fn allowed(&self) -> Vec<f64> {
        let differences = 0.1_f64.powi(self.forcing.differences as i32);
        let part = self.sure() * SURE * self.forcing.tolerance * differences;
        /// Fields that are smaller beside their kind are not resolved on their own: just below the surface tractions vanish.
        const SMALL: f64 = 1e-4;
        let peaks = self.values.each_ref().map(|samples| largest(samples));
        let kinds = [&peaks[..2], &peaks[2..]].map(largest);
        let least = |f: usize| SMALL * kinds[usize::from(f >= 2)];
        let allowed = |f: usize| part * peaks[f].max(least(f));
        (0..self.components()).map(allowed).collect()
    }

    /// The most that is left of a sample over what is allowed, but for as many as may be integrated as a whole.
    pub(crate) fn worst(&self) -> f64 {
        let allowed = self.allowed();
        let next = self.open.get(self.whole());
        next.map_or(0.0, |&i| over(&allowed, |f| self.left[f][i]))
    }

    /// The samples that are left with more than is allowed, the worst first; what is left of those beside counts with a
    /// part.
    fn not_resolved(&self, left: &[Vec<f64>; 6], part: f64) -> Vec<usize> {
        let allowed = self.allowed();
        let each = |i: usize| over(&allowed, |f| left[f][i]);
        let each: Vec<f64> = (0..self.forcing.times_s.len()).map(each).collect();
        let reach = beside(self.forcing.excitation, self.forcing.step_s)
            * if self.is_under() { BESIDE_UNDER } else { 1 };
        let off = |i: usize| {
            let steps = |j: usize| {
                (self.forcing.times_s[i] - self.forcing.times_s[j]).abs() / self.forcing.step_s
            };
            let near = |&j: &usize| steps(j) < reach as f64 + 0.5;
            let next = (i.saturating_sub(reach)..(i + reach + 1).min(each.len())).filter(near);
            (i, next.fold(each[i], |most, j| most.max(part * each[j])))
        };
        // nothing is left before the first wave
        let waves = (0..each.len()).filter(|&i| each[i] > 0.0);
        let mut found: Vec<(usize, f64)> = waves.map(off).collect();
        found.retain(|&(_, off)| off > 1.0);
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        found.into_iter().map(|(i, _)| i).collect()
    }

    /// Values and errors once what is open is integrated.
    pub(crate) fn resolved(
        mut self,
        past: Option<&Past<'_>>,
        cells: &[Cells],
    ) -> Result<Vec<Trace>, ImpactError> {
        if are_traces(cells) {
            self.integrate_rough(cells);
        }
        let radius = self.forcing.excitation.radius();
        let follows = matches!(radius, PressureRadius::Following { .. });
        // cells that are looked up are summed, not integrated
        let zones = follows && are_traces(cells) || self.integrated.contains(&true);
        let anew = past.filter(|_| !self.open.is_empty());
        // over the past as much as its last terms may be
        let over_past = match (&anew, self.forcing.derivative) {
            (None, _) => 0.0,
            (Some(_), Derivative::Field) => LAST_TERMS,
            (Some(_), Derivative::First | Derivative::Second) => 1.0,
        };
        let integrals = f64::from(u8::from(zones)) + over_past;
        for f in 0..6 {
            self.errors[f] +=
                integrals * QUADRATURE * self.forcing.tolerance * largest(&self.values[f]);
        }
        if let Some(past) = anew {
            let allowed = self.allowed();
            let near = usize::from(!past.is_far(self.place_m));
            let mut whole = near * self.whole();
            for i in std::mem::take(&mut self.open) {
                self.integrate_past(i, past, cells, (&allowed, &mut whole))?;
            }
        }
        let sure = self.sure();
        let per_step = (2.0 / self.forcing.step_s).powi(self.forcing.differences as i32);
        // a rate is as much more sensitive than the force as its pulse is shorter; that of a march with steps ends with a root at
        // an instant that is off as the power 3/2 is by what the force is
        const WITHIN: f64 = 4.0;
        const END: f64 = 0.07;
        let own = self.forcing.excitation.relative_error;
        let end = if follows { 0.0 } else { END * own.cbrt() };
        let relative = own
            + (self.forcing.tolerance + end)
                * match self.forcing.derivative {
                    Derivative::Field => 0.0,
                    Derivative::First => WITHIN,
                    Derivative::Second => WITHIN * WITHIN,
                };
        let of = |f: usize| {
            let left = self.left[f].iter().zip(&self.rough[f]);
            let left = left.map(|(left, rough)| left.abs() / sure + rough);
            let samples = self.differenced(&self.values[f]);
            let left = left.fold(0.0, f64::max) * per_step;
            let error = self.errors[f] + left + relative * largest(&samples);
            Trace { samples, error }
        };
        Ok((0..6).map(of).collect())
    }

    /// The run of a sample and its number there.
    fn in_run(&self, i: usize) -> (usize, usize) {
        let (mut place, mut run) = (i, 0);
        while place >= self.forcing.needed[run].len() {
            place -= self.forcing.needed[run].len();
            run += 1;
        }
        (run, self.forcing.needed[run][place])
    }

    /// What the integrals over the zones of a disc change in one sample, as far as they are among some cells, of the force
    /// and of the part that is the last.
    fn by_zones(&self, i: usize, k: usize, cells: &Cells, among: &Range<usize>) -> [Six; 2] {
        let (run, n) = self.in_run(i);
        let over = self.discs.radii[k];
        let unit = self.forcing.excitation.units_si(over);
        let unit_s = over * self.forcing.excitation.units().time_s();
        let own = &self.forces[k].runs[run];
        let mut change = [Six::default(); 2];
        for zone in &own.zones {
            let part = zone.cells.start.max(among.start)..zone.cells.end.min(among.end);
            let (Some(trace), false) = (&cells.trace, part.is_empty()) else {
                continue;
            };
            let past_s = self.forcing.span_s(&self.forcing.runs[run], &part);
            let exact = zone.by_trace(self.forcing.times_s[i], past_s, (trace, unit_s));
            let mut by_cells = own.by_cells(n, &part, &cells.moments);
            if self.discs.is_apart() {
                // some radii away the last is known at the samples alone
                by_cells[1] = Six::default();
            }
            for ((change, exact), by_cells) in change.iter_mut().zip(exact).zip(by_cells) {
                for f in 0..6 {
                    change[f] += unit[f] * (exact[f] - by_cells[f]);
                }
            }
        }
        change
    }

    /// Replaces the cells of the zones by integrals in the samples in which they leave more than is allowed.
    fn integrate_rough(&mut self, cells: &[Cells]) {
        for i in self.not_resolved(&self.rough, 0.0) {
            self.integrate_zones(i, cells);
        }
    }

    /// Replaces the cells of the zones in one sample by integrals.
    fn integrate_zones(&mut self, i: usize, cells: &[Cells]) {
        if std::mem::replace(&mut self.integrated[i], true) {
            return;
        }
        for (k, cells) in cells.iter().enumerate() {
            let [change, last] = self.by_zones(i, k, cells, &(0..usize::MAX));
            for f in 0..self.components() {
                self.values[f][i] += change[f];
                self.left[f][i] += last[f];
                self.rough[f][i] = 0.0;
            }
        }
    }

    /// Replaces the discs for parts of the past in one sample by the integral over the radii: where the waves of the first
    /// and the last instants pass, and the whole contact where that leaves too much and a budget allows it.
    fn integrate_past(
        &mut self,
        i: usize,
        past: &Past<'_>,
        cells: &[Cells],
        (allowed, whole): (&[f64], &mut usize),
    ) -> Result<(), ImpactError> {
        let time_s = self.forcing.times_s[i];
        let (run, _) = self.in_run(i);
        let grid = &self.forcing.runs[run];
        let span_s = |cells: &Range<usize>| self.forcing.span_s(grid, cells);
        let contacts = self.forcing.contacts(grid);
        let mut parts: Vec<Range<usize>> = Vec::new();
        let long_s = LONG * self.forcing.excitation.units().time_s();
        let mut near = self.forcing.derivative != Derivative::Field;
        for contact in &contacts {
            let found = past.parts(self.place_m, time_s, contact, span_s);
            let [begin_s, end_s] = span_s(contact);
            near |= found.is_none() || end_s - begin_s < long_s;
            parts.extend(found.into_iter().flatten());
        }
        let mut by_discs = self.by_discs(i, &parts, cells);
        let known = self.windows().is_of_small_contact(time_s);
        let is_open = || over(allowed, |f| self.left[f][i] - by_discs[1][f]) > 1.0;
        if known || near && *whole > 0 && is_open() {
            *whole -= usize::from(!known);
            parts = contacts;
            by_discs = self.by_discs(i, &parts, cells);
            for (f, last) in by_discs[1].into_iter().enumerate() {
                (self.left[f][i], self.rough[f][i]) = (last, 0.0);
            }
        }
        let tolerance = self.forcing.tolerance;
        let part = (LAST_TERMS * tolerance).min(COARSEST) / (SURE * self.sure() * tolerance);
        let enough = std::array::from_fn(|f| allowed.get(f).map_or(f64::INFINITY, |x| part * x));
        let mut exact = Six::default();
        for part in &parts {
            let (place_m, reading) = (self.place_m, self.forcing.reading);
            let found = past.between(&enough, place_m, time_s, span_s(part), reading)?;
            // of rates the last terms say too much: beside fronts they fall slowly, and have either sign
            let counts = self.forcing.derivative == Derivative::Field;
            for (f, exact) in exact.iter_mut().enumerate().take(self.components()) {
                *exact += found.value[f];
                self.rough[f][i] += if counts { found.error[f] } else { 0.0 };
            }
        }
        let [by_discs, last] = by_discs;
        for (f, exact) in exact.into_iter().enumerate().take(self.components()) {
            self.values[f][i] += exact - by_discs[f];
            self.left[f][i] -= last[f];
        }
        Ok(())
    }

    /// What the discs brought to one sample from some cells, and what the last of it is.
    fn by_discs(&self, i: usize, parts: &[Range<usize>], cells: &[Cells]) -> [Six; 2] {
        let (run, n) = self.in_run(i);
        let mut sums = [Six::default(); 2];
        for part in parts {
            for (k, cells) in cells.iter().enumerate() {
                let unit = self.forcing.excitation.units_si(self.discs.radii[k]);
                let zones = match self.integrated[i] {
                    true => self.by_zones(i, k, cells, part),
                    false => [Six::default(); 2],
                };
                let by_cells = self.forces[k].runs[run].by_cells(n, part, &cells.moments);
                for ((sum, zones), by_cells) in sums.iter_mut().zip(zones).zip(by_cells) {
                    for f in 0..6 {
                        sum[f] += unit[f] * by_cells[f] + zones[f];
                    }
                }
            }
        }
        sums
    }

    /// Samples of the outputs from those that the forcing needs.
    fn differenced(&self, samples: &[f64]) -> Vec<f64> {
        let step_s = self.forcing.step_s;
        let of = |&i: &usize| match self.forcing.differences {
            0 => samples[i],
            1 => (samples[i + 1] - samples[i]) / step_s,
            _ => (samples[i + 2] - 2.0 * samples[i + 1] + samples[i]) / (step_s * step_s),
        };
        self.forcing.outputs.iter().map(of).collect()
    }
}

/// Whether kernels are known at each instant, not in cells alone.
fn are_traces(cells: &[Cells]) -> bool {
    cells.iter().all(|cells| cells.trace.is_some())
}

/// Samples a step apart that are beside one.
fn beside(excitation: &Excitation, step_s: f64) -> usize {
    let reach_s = (REACH * excitation.units().time_s()).min(OF_CONTACT * excitation.end_s());
    (reach_s / step_s).round().clamp(1.0, MOST_BESIDE) as usize
}

/// Samples of a point's fields for which a whole contact is integrated at most.
pub(crate) fn most_whole(excitation: &Excitation, step_s: f64, tolerance: f64) -> usize {
    let more = MORE_WHOLE.powf((-tolerance.log10() - 4.0).max(0.0));
    (MOST_WHOLE[0] as f64 * more.max(beside(excitation, step_s) as f64)) as usize
}

/// The largest of what is left of the fields over what is allowed.
fn over(allowed: &[f64], left: impl Fn(usize) -> f64) -> f64 {
    let each = allowed.iter().enumerate();
    each.map(|(f, allowed)| match left(f).abs() {
        0.0 => 0.0,
        left => left / allowed,
    })
    .fold(0.0, f64::max)
}
