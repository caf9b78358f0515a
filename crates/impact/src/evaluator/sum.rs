//! The sum of one forcing over the discs of a choice, at one point.

use super::NEAR;
use super::at_rest::{static_si, units_si};
use super::discs::Discs;
use super::ends::open;
use super::forcing::{Derivative, DiscForce, Forcing, Reading};
use super::past::Past;
use crate::error::FieldsError;
use crate::excitation::PressureRadius;
use crate::kernels::Cells;
use halfspace::{Kernel, Six};

/// Samples of six fields, or of the rates of the first two, with what the samples leave open.
pub(crate) struct Sum<'a> {
    derivative: Derivative,
    forcing: &'a Forcing<'a>,
    discs: &'a Discs,
    forces: &'a [DiscForce],
    place_m: [f64; 2],
    /// At the samples that the forcing needs, of all runs.
    times_s: Vec<f64>,
    values: [Vec<f64>; 6],
    errors: Six,
    /// What discs and cells may leave of each sample.
    left: [Vec<f64>; 6],
    /// Samples in which more than the tolerance may be left.
    pub(crate) open: Vec<usize>,
}

/// Part of the tolerance up to which what is left of a sample is let be; a tenth of it for each difference.
const SURE: f64 = 0.3;

/// Samples of a point for which a whole contact is integrated at most, of fields and of rates: those that the discs leave
/// open in its middle.
const MOST_WHOLE: [usize; 2] = [64, 512];

/// Error of an integral over a zone, in tolerances.
const QUADRATURE: f64 = 0.7;

impl<'a> Sum<'a> {
    /// Of the forces on some discs with the kernels of each.
    pub(crate) fn new(
        (derivative, forcing): (Derivative, &'a Forcing<'a>),
        discs: &'a Discs,
        forces: &'a [DiscForce],
        kernel: &Kernel,
        place_m: [f64; 2],
        cells: &[Cells],
    ) -> Result<Self, FieldsError> {
        let runs = forcing.runs.iter().zip(&forcing.needed);
        let times = runs.flat_map(|(run, needed)| {
            needed
                .iter()
                .map(|&n| run.start_s + n as f64 * forcing.step_s)
        });
        let times_s: Vec<f64> = times.collect();
        let blank = || std::array::from_fn(|_| vec![0.0; times_s.len()]);
        let mut sum = Self {
            derivative,
            forcing,
            discs,
            forces,
            place_m,
            values: blank(),
            errors: Six::default(),
            left: blank(),
            open: Vec::new(),
            times_s,
        };
        for (k, cells) in cells.iter().enumerate() {
            sum.add_disc(k, cells);
        }
        if let PressureRadius::Following { largest_m, .. } = forcing.excitation.radius() {
            if discs.radii.len() == 1 {
                let near = NEAR * (largest_m / place_m[0].hypot(place_m[1])).powi(2);
                for (error, samples) in sum.errors.iter_mut().zip(&sum.values) {
                    *error += near * peak(samples);
                }
            }
            sum.add_following_static(kernel)?;
            sum.still_before_arrival();
        }
        sum.open = sum.not_resolved();
        Ok(sum)
    }

    /// The largest index of a component.
    fn components(&self) -> usize {
        match self.derivative {
            Derivative::Field => 6,
            Derivative::First | Derivative::Second => 2,
        }
    }

    /// Adds the fields under one disc.
    fn add_disc(&mut self, k: usize, cells: &Cells) {
        let (excitation, force) = (self.forcing.excitation, &self.forces[k]);
        let unit = units_si(excitation, self.discs.radii[k]);
        // the static part of a pressure that follows the load is added as a whole
        let rest = match excitation.radius() {
            PressureRadius::Fixed(_) => cells.static_part,
            PressureRadius::Following { .. } => Six::default(),
        };
        let zones = force.runs.iter().any(|run| !run.zones.is_empty());
        let open = if zones {
            open(&cells.moments)
        } else {
            Vec::new()
        };
        let mut first = 0;
        for (run, needed) in force.runs.iter().zip(&self.forcing.needed) {
            let mut own = run.convolver.fields(&rest, &cells.smooth);
            run.projection.add(&cells.moments, needed, &mut own);
            let last = run
                .last
                .as_ref()
                .map(|last| last.fields(&Six::default(), &cells.smooth));
            for f in 0..self.components() {
                for (i, value) in own[f].iter().enumerate() {
                    self.values[f][first + i] += unit[f] * value;
                }
                for (i, value) in last.iter().flat_map(|last| last[f].iter().enumerate()) {
                    self.left[f][first + i] += unit[f] * value;
                }
            }
            for zone in &run.zones {
                for (i, &n) in needed.iter().enumerate() {
                    let left = zone.left(n, &open);
                    for f in 0..self.components() {
                        let own = &mut self.left[f][first + i];
                        *own += unit[f] * left[f] * if *own < 0.0 { -1.0 } else { 1.0 };
                    }
                }
            }
            first += needed.len();
        }
        let (settled, changed) = self.forcing.left_out;
        let rest = cells.smooth.get(settled).copied().unwrap_or_default();
        for (f, error) in force.errors(cells).into_iter().enumerate() {
            self.errors[f] += unit[f] * (error + changed * rest[f].abs());
        }
    }

    /// Adds the static field of the radius of each instant, or its rate.
    fn add_following_static(&mut self, kernel: &Kernel) -> Result<(), FieldsError> {
        /// Part of the force over which the static field is differenced: a smooth function of it.
        const PART: f64 = 1e-4;
        let excitation = self.forcing.excitation;
        for (i, &time_s) in self.times_s.iter().enumerate() {
            let of = |force_n: f64| static_si(excitation, kernel, self.place_m, force_n);
            let fixed = match self.forcing.reading {
                Reading::Force => of(excitation.force_n(time_s))?,
                Reading::Rate => {
                    let [force_n, rate] = excitation.force_and_rate(time_s);
                    if force_n <= 0.0 || rate == 0.0 {
                        continue;
                    }
                    let (more, less) = (of(force_n * (1.0 + PART))?, of(force_n * (1.0 - PART))?);
                    std::array::from_fn(|f| rate * (more[f] - less[f]) / (2.0 * PART * force_n))
                }
            };
            for (samples, value) in self.values.iter_mut().zip(fixed) {
                samples[i] += value;
            }
        }
        Ok(())
    }

    /// Sets to zero what the sum over the discs leaves before the first wave from the largest of them has arrived.
    fn still_before_arrival(&mut self) {
        let first_s = self.forcing.excitation.arrivals_s(self.place_m)[0];
        let still = self.times_s.iter().filter(|&&t| t <= first_s).count();
        for samples in self.values.iter_mut().chain(&mut self.left) {
            samples[..still].fill(0.0);
        }
    }

    /// The samples that are left with more than the tolerance of a field's peak, the worst first.
    fn not_resolved(&self) -> Vec<usize> {
        let sure = SURE * self.forcing.tolerance * 0.1_f64.powi(self.forcing.differences as i32);
        let allowed: Vec<f64> = (self.values.iter())
            .take(self.components())
            .map(|samples| sure * peak(samples))
            .collect();
        let off = |i: usize| {
            let parts = allowed.iter().zip(&self.left);
            let over = parts.map(|(allowed, left)| match left[i].abs() {
                0.0 => 0.0,
                left => left / allowed,
            });
            (i, over.fold(0.0, f64::max))
        };
        let mut found: Vec<(usize, f64)> = (0..self.times_s.len()).map(off).collect();
        found.retain(|&(_, off)| off > 1.0);
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        found.into_iter().map(|(i, _)| i).collect()
    }

    /// Values and errors once what is open is integrated.
    pub(crate) fn resolved(
        mut self,
        past: Option<&Past<'_>>,
        cells: &[Cells],
    ) -> Result<([Vec<f64>; 6], [f64; 6]), FieldsError> {
        let traced = cells.iter().all(|cells| cells.trace.is_some());
        if let PressureRadius::Following { .. } = self.forcing.excitation.radius() {
            for f in 0..6 {
                self.errors[f] += QUADRATURE * self.forcing.tolerance * peak(&self.values[f]);
            }
        }
        if traced && !self.open.is_empty() {
            for f in 0..6 {
                self.errors[f] += QUADRATURE * self.forcing.tolerance * peak(&self.values[f]);
            }
            if let (Some(past), 1) = (past, self.discs.radii.len()) {
                // a disc alone has waves where the contact has just begun or ended
                let span_s = 2.0 * self.forcing.step_s;
                let touched =
                    |&i: &usize| past.begins_or_ends(self.place_m, self.times_s[i], span_s);
                let more: Vec<usize> = (0..self.times_s.len())
                    .filter(|i| touched(i) && !self.open.contains(i))
                    .collect();
                self.open.extend(more);
            }
            let mut whole = MOST_WHOLE[usize::from(self.derivative != Derivative::Field)];
            for i in std::mem::take(&mut self.open) {
                self.integrate(i, past, cells, &mut whole)?;
            }
        }
        for (error, left) in self.errors.iter_mut().zip(&self.left) {
            *error +=
                peak(left) * (2.0 / self.forcing.step_s).powi(self.forcing.differences as i32);
        }
        let values = std::mem::take(&mut self.values).map(|samples| self.differenced(&samples));
        // a rate is as much more sensitive than the force as its pulse is shorter
        const WITHIN: f64 = 4.0;
        let relative = self.forcing.excitation.relative_error()
            + self.forcing.tolerance
                * match self.derivative {
                    Derivative::Field => 0.0,
                    Derivative::First => WITHIN,
                    Derivative::Second => WITHIN * WITHIN,
                };
        for (error, samples) in self.errors.iter_mut().zip(&values) {
            *error += relative * peak(samples);
        }
        Ok((values, self.errors))
    }

    /// Replaces the cells of the zones in one sample by the integral.
    fn integrate(
        &mut self,
        i: usize,
        past: Option<&Past<'_>>,
        cells: &[Cells],
        whole: &mut usize,
    ) -> Result<(), FieldsError> {
        let excitation = self.forcing.excitation;
        let time_s = self.times_s[i];
        let (mut place, mut run) = (i, 0);
        while place >= self.forcing.needed[run].len() {
            place -= self.forcing.needed[run].len();
            run += 1;
        }
        let n = self.forcing.needed[run][place];
        let grid = &self.forcing.runs[run];
        let (mut change, mut replaced) = (Six::default(), false);
        for (z, zone) in self.forces[0].runs[run].zones.iter().enumerate() {
            let parts = match past {
                None => vec![zone.cells.clone()],
                // of the waves of a disc alone no instant is that of the contact
                Some(_) if self.discs.radii.len() == 1 => vec![zone.cells.clone()],
                Some(past) => past.parts(self.place_m, time_s, &zone.cells, |cells| {
                    self.forcing.span_s(grid, cells)
                }),
            };
            let parts = if parts.is_empty() && *whole > 0 {
                *whole -= 1;
                vec![zone.cells.clone()]
            } else {
                parts
            };
            replaced |= !parts.is_empty();
            for part in &parts {
                if let Some(past) = past {
                    let span_s = self.forcing.span_s(grid, part);
                    let exact = match self.forcing.reading {
                        Reading::Force => past.between(self.place_m, time_s, span_s)?,
                        Reading::Rate => {
                            past.rate_between(self.place_m, time_s, span_s, self.forcing.step_s)?
                        }
                    };
                    for f in 0..6 {
                        change[f] += exact[f];
                    }
                }
                for (k, cells) in cells.iter().enumerate() {
                    let over = self.discs.radii[k];
                    let unit = units_si(excitation, over);
                    let unit_s = over * excitation.units().time_s();
                    let zone = &self.forces[k].runs[run].zones[z];
                    let by_cells = zone.by_cells(n, part, &cells.moments);
                    let exact = match (past, &cells.trace) {
                        (None, Some(trace)) => zone.by_trace(time_s, trace, unit_s),
                        (_, _) => Six::default(),
                    };
                    for f in 0..6 {
                        change[f] += unit[f] * (exact[f] - by_cells[f]);
                    }
                }
            }
        }
        for (f, change) in change.into_iter().enumerate().take(self.components()) {
            self.values[f][i] += change;
            if replaced {
                self.left[f][i] = 0.0;
            }
        }
        Ok(())
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

/// Largest magnitude.
fn peak(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |most, v| most.max(v.abs()))
}
