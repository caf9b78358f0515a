//! Velocities and accelerations of particles: the rate of the force convolved with the kernels.
//!
//! The waves under a fixed disc are linear in its force, so that those of its rate are the rate of the waves,
//!
//! ```text
//! v_n = P'_n u_static + sum_{m <= n} (P'_m - P'_{m-1}) Rbar_{n-m}
//! ```
//!
//! with slope and bend of P' within the cells as for the force itself; nothing of the output is differenced.
//! Under a pressure that follows the load each disc has the force P phi_k(a^2), whose rate is
//! (phi_k + (2/3) a^2 phi_k') P', and the static field of the instant has that of the chain rule.
//! P'' of a contact is infinite where it begins and ends (the force has the power 3/2 there): accelerations are means
//! over one step of the output, the rates of P' over a step convolved. So are both of a record, which is made of lines.
//!
//! Theory: `docs/theory.md` (T24, T60, T61).

use crate::at_rest::static_si;
use crate::discs::Discs;
use crate::ends::unresolved;
use crate::error::FieldsError;
use crate::excitation::{Excitation, PressureRadius};
use crate::grid::Grid;
use crate::kernels::{CellPlan, Cells, KernelSource};
use crate::place::Place;
use crate::rate_loads::{Order, RateRecipe, Share};
use crate::superposition::Superposition;
use halfspace::{Kernel, Profile, Six};
use std::sync::OnceLock;

/// What becomes of samples that cells and discs do not resolve: those near fronts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Resolved {
    /// They are integrated over the past of the force, some milliseconds each.
    Anew,
    /// The error counts them.
    Estimated,
}

/// A rate of the radial and the axial displacement at one point, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Motion {
    /// Samples of both components.
    pub(crate) values: [Vec<f64>; 2],
    /// Their estimated absolute errors.
    pub(crate) errors: [f64; 2],
}

/// The rate of a sampled force with kernels.
pub(crate) struct Rates<'a> {
    of: RateRecipe<'a>,
    /// For static fields alone.
    kernel: Kernel,
    /// Samples at which the rates are wanted, and their times in s.
    samples: Vec<usize>,
    times_s: Vec<f64>,
    choices: Vec<Discs>,
    loads: Vec<OnceLock<Vec<Share>>>,
    /// For samples that cells and discs do not resolve.
    superposition: Option<Superposition<'a>>,
}

/// Both components under the discs of one choice.
struct Sum {
    motion: Motion,
    /// What the two highest powers of the radius and the ends of a contact may move each sample by.
    open: [Vec<f64>; 2],
    /// Samples that are not resolved, the worst first.
    anew: Vec<usize>,
}

/// Samples of a point that are integrated anew at most: under a short contact, or far from it, most of them are beside
/// fronts, and what is left out makes an estimate of no use.
const MOST_ANEW: usize = 512;

/// Tolerances that what is left over within the other cells, and samples integrated anew, may take of a velocity; the
/// square of it of an acceleration.
const WITHIN: f64 = 4.0;

/// Part of a step over which the integral over the past is differenced. The velocity behind a Rayleigh wave varies over
/// the time in which a contact that has just begun outgrows it, which is far shorter than a step; twice the part shows
/// what is left.
const PART_OF_STEP: f64 = 0.002;

/// Discs for each digit of the tolerance, the first of these that leave no more than it.
const A_DIGIT: [f64; 3] = [1.0, 2.0, 4.0];

impl<'a> Rates<'a> {
    /// Of an excitation on a grid, at some of its samples, ascending.
    pub(crate) fn new(
        (excitation, source, grid): (&'a Excitation, &'a KernelSource, &'a Grid),
        samples: &[usize],
        (order, resolved): (Order, Resolved),
        tolerance: f64,
    ) -> Result<Self, FieldsError> {
        let all_s: Vec<f64> = grid.times_s().collect();
        let choices = choices(excitation.radius(), source, tolerance);
        let superposition = match (excitation.record(), source, resolved) {
            (None, KernelSource::Direct(_), Resolved::Anew) => {
                Some(Superposition::new(excitation, tolerance)?)
            }
            (Some(_), _, _) | (_, KernelSource::Table(_), _) | (_, _, Resolved::Estimated) => None,
        };
        Ok(Self {
            of: RateRecipe {
                excitation,
                source,
                grid,
                order,
                tolerance,
            },
            kernel: Kernel::new(excitation.medium(), Profile::Hertz, 1e-6)?,
            samples: samples.to_vec(),
            times_s: samples.iter().map(|&n| all_s[n]).collect(),
            loads: choices.iter().map(|_| OnceLock::new()).collect(),
            choices,
            superposition,
        })
    }

    /// Both components at a point.
    ///
    /// # Errors
    /// [`FieldsError`] for a point outside the half-space or the table.
    pub(crate) fn at(&self, place_m: [f64; 2]) -> Result<Motion, FieldsError> {
        let serving = self.serving(place_m);
        let mut best = self.sum(place_m, serving[0])?;
        for &choice in &serving[1..] {
            if best.anew.len() <= 2 * self.choices[choice].radii.len() {
                break;
            }
            let next = self.sum(place_m, choice)?;
            if next.anew.len() >= best.anew.len() {
                break;
            }
            best = next;
        }
        let Sum {
            mut motion,
            mut open,
            mut anew,
        } = best;
        if let Some(superposition) = &self.superposition {
            anew.truncate(MOST_ANEW);
            for i in anew {
                let [exact, doubt] = self.integrated(superposition, place_m, self.times_s[i])?;
                for c in 0..2 {
                    motion.values[c][i] = exact[c];
                    open[c][i] = doubt[c];
                }
            }
        }
        // a rate is as much more sensitive than the force as its pulse is shorter
        let within = match self.of.order {
            Order::First => WITHIN,
            Order::Second => WITHIN * WITHIN,
        };
        let relative = self.of.excitation.relative_error() + within * self.of.tolerance;
        let components = motion.errors.iter_mut().zip(&motion.values);
        for ((error, samples), open) in components.zip(&open) {
            *error += peak(open) + relative * peak(samples);
        }
        Ok(motion)
    }

    /// The rate by differences of the integral over the past of the force, over a small part of a step, and their change
    /// when the part is doubled.
    fn integrated(
        &self,
        superposition: &Superposition<'_>,
        place_m: [f64; 2],
        time_s: f64,
    ) -> Result<[[f64; 2]; 2], FieldsError> {
        let step_s = self.of.grid.step_s;
        let difference = |at_s: f64, apart_s: f64| -> Result<[f64; 2], FieldsError> {
            let of =
                |at_s: f64| superposition.at(place_m, [at_s, self.of.excitation.force_n(at_s)]);
            let from_s = (at_s - apart_s).max(0.0);
            let (after, before) = (of(at_s + apart_s)?, of(from_s)?);
            Ok([0, 1].map(|c| (after[c] - before[c]) / (at_s + apart_s - from_s)))
        };
        let velocity = |at_s: f64| -> Result<[[f64; 2]; 2], FieldsError> {
            let apart_s = PART_OF_STEP * step_s;
            let (narrow, wide) = (difference(at_s, apart_s)?, difference(at_s, 2.0 * apart_s)?);
            Ok([narrow, [0, 1].map(|c| (narrow[c] - wide[c]).abs())])
        };
        match self.of.order {
            Order::First => velocity(time_s),
            Order::Second => {
                let after = velocity(time_s + 0.5 * step_s)?;
                let before = velocity((time_s - 0.5 * step_s).max(0.0))?;
                Ok([
                    [0, 1].map(|c| (after[0][c] - before[0][c]) / step_s),
                    [0, 1].map(|c| (after[1][c] + before[1][c]) / step_s),
                ])
            }
        }
    }

    /// Samples that are open by more than the tolerance of a component's peak, the worst first.
    fn not_resolved(&self, motion: &Motion, open: &[Vec<f64>; 2]) -> Vec<usize> {
        let allowed = [0, 1].map(|c| self.of.tolerance * peak(&motion.values[c]));
        let off = |i: usize| {
            let over = |c: usize| match open[c][i] {
                0.0 => 0.0,
                left => left / allowed[c],
            };
            (i, over(0).max(over(1)))
        };
        let mut found: Vec<(usize, f64)> = (0..self.samples.len()).map(off).collect();
        found.retain(|&(_, off)| off > 1.0);
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        found.into_iter().map(|(i, _)| i).collect()
    }

    /// The choices of discs that the source serves at a point, or the one whose error names it.
    fn serving(&self, [r_m, z_m]: [f64; 2]) -> Vec<usize> {
        let (reach, largest_m) = (
            self.of.source.reach(),
            self.of.excitation.units().disc_radius_m,
        );
        let served = |&choice: &usize| {
            let radii = &self.choices[choice].radii;
            let smallest_m = radii[radii.len() - 1] * largest_m;
            r_m <= smallest_m * reach[0] && z_m <= smallest_m * reach[1]
        };
        let count = self.choices.len();
        let found: Vec<usize> = (0..count).filter(served).collect();
        match (found.is_empty(), self.of.source) {
            (false, _) => found,
            (true, KernelSource::Direct(_)) => vec![0],
            (true, KernelSource::Table(_)) => vec![count - 1],
        }
    }

    /// Both components under one choice of discs.
    fn sum(&self, place_m: [f64; 2], choice: usize) -> Result<Sum, FieldsError> {
        let shares =
            self.loads[choice].get_or_init(|| self.of.shares(&self.choices[choice], &self.samples));
        let blank = || std::array::from_fn(|_| vec![0.0; self.samples.len()]);
        let mut motion = Motion {
            values: blank(),
            errors: [0.0; 2],
        };
        let mut lasts: [Vec<f64>; 2] = blank();
        let discs = &self.choices[choice];
        let mut cells = Vec::with_capacity(shares.len());
        for (share, &over) in shares.iter().zip(&discs.radii) {
            cells.push(self.add_disc(share, over, place_m, &mut motion, &mut lasts)?);
        }
        for samples in &mut lasts {
            samples.iter_mut().for_each(|left| *left = left.abs());
        }
        if let PressureRadius::Following { .. } = self.of.excitation.radius() {
            for (i, &time_s) in self.times_s.iter().enumerate() {
                let rate = self.static_rate(place_m, time_s)?;
                for (samples, rate) in motion.values.iter_mut().zip(rate) {
                    samples[i] += rate;
                }
            }
        }
        let half_step = match self.of.order {
            Order::First => 0.0,
            Order::Second => 0.5 * self.of.grid.step_s,
        };
        let first_s = self.of.excitation.arrivals_s(place_m)[0] - half_step;
        let still = self.times_s.iter().filter(|&&t| t <= first_s).count();
        for samples in motion.values.iter_mut().chain(&mut lasts) {
            samples[..still].fill(0.0);
        }
        let mut open = lasts;
        for ((own, cells), &over) in shares.iter().zip(&cells).zip(&discs.radii) {
            self.add_ends(own, cells, over, &mut open);
        }
        for samples in &mut open {
            samples[..still].fill(0.0);
        }
        let anew = self.not_resolved(&motion, &open);
        Ok(Sum { motion, open, anew })
    }

    /// Adds to what is open what the ends of a contact may move each sample by under one disc.
    fn add_ends(&self, share: &Share, cells: &Cells, over: f64, open: &mut [Vec<f64>; 2]) {
        if share.runs.iter().all(|run| run.rough.is_empty()) {
            return;
        }
        let unit = self.of.excitation.units().displacement_m_per_n() / over;
        let unresolved = unresolved(&cells.moments);
        let mut first = 0;
        for run in &share.runs {
            for (i, &n) in run.wanted.iter().enumerate() {
                for rough in run.rough.iter().take_while(|rough| rough.cell <= n) {
                    let kernel = &unresolved[n - rough.cell];
                    for c in 0..2 {
                        open[c][first + i] += unit * kernel[c] * rough.left;
                    }
                }
            }
            first += run.wanted.len();
        }
    }

    fn add_disc(
        &self,
        share: &Share,
        over: f64,
        [r_m, z_m]: [f64; 2],
        motion: &mut Motion,
        lasts: &mut [Vec<f64>; 2],
    ) -> Result<Cells, FieldsError> {
        let (excitation, units) = (self.of.excitation, self.of.excitation.units());
        let disc_radius_m = over * units.disc_radius_m;
        let place = Place {
            r: r_m / disc_radius_m,
            z: z_m / disc_radius_m,
            disc_radius_m,
        };
        let plan = CellPlan {
            step: self.of.grid.step_s / (over * units.time_s()),
            count: self.of.grid.longest(),
            pulse: excitation.pulse(over),
        };
        let nu = excitation.medium().poisson_ratio();
        let cells = self.of.source.cells(nu, place, plan)?;
        let unit = units.displacement_m_per_n() / over;
        let rest = match excitation.radius() {
            PressureRadius::Fixed(_) => cells.static_part,
            PressureRadius::Following { .. } => Six::default(),
        };
        let mut first = 0;
        for run in &share.runs {
            let mut own = run.convolver.fields(&rest, &cells.smooth);
            run.projection.add(&cells.moments, &run.wanted, &mut own);
            let last = run.last.as_ref();
            let last = last.map(|last| last.fields(&Six::default(), &cells.smooth));
            for c in 0..2 {
                for (i, value) in own[c].iter().enumerate() {
                    motion.values[c][first + i] += unit * value;
                }
                for (i, value) in last.iter().flat_map(|last| last[c].iter().enumerate()) {
                    lasts[c][first + i] += unit * value;
                }
            }
            first += run.wanted.len();
        }
        let errors = share.errors(&cells);
        for (own, error) in motion.errors.iter_mut().zip(errors) {
            *own += unit * error;
        }
        Ok(cells)
    }

    /// The rate of the static displacements under the pressure of the instant.
    fn static_rate(&self, place_m: [f64; 2], time_s: f64) -> Result<[f64; 2], FieldsError> {
        let step_s = self.of.grid.step_s;
        match self.of.order {
            Order::First => self.first_static_rate(place_m, time_s),
            Order::Second => {
                let after = self.first_static_rate(place_m, time_s + 0.5 * step_s)?;
                let before = self.first_static_rate(place_m, time_s - 0.5 * step_s)?;
                Ok([0, 1].map(|c| (after[c] - before[c]) / step_s))
            }
        }
    }

    fn first_static_rate(&self, place_m: [f64; 2], time_s: f64) -> Result<[f64; 2], FieldsError> {
        /// Part of the force over which the static field is differenced: a smooth function of it.
        const PART: f64 = 1e-4;
        let Some([force_n, rate]) = self.of.excitation.force_and_rate(time_s) else {
            return Ok([0.0; 2]);
        };
        if force_n <= 0.0 || rate == 0.0 {
            return Ok([0.0; 2]);
        }
        let of = |part: f64| {
            static_si(
                self.of.excitation,
                &self.kernel,
                place_m,
                force_n * (1.0 + part),
            )
        };
        let (more, less) = (of(PART)?, of(-PART)?);
        Ok([0, 1].map(|c| rate * (more[c] - less[c]) / (2.0 * PART * force_n)))
    }
}

/// Discs that may stand for the load.
fn choices(radius: PressureRadius, source: &KernelSource, tolerance: f64) -> Vec<Discs> {
    match (radius, source) {
        (PressureRadius::Fixed(_), _) => vec![Discs::one()],
        (PressureRadius::Following { .. }, KernelSource::Table(_)) => Discs::looked_up(radius),
        (PressureRadius::Following { .. }, KernelSource::Direct(_)) => {
            let digits = (-tolerance.log10()).clamp(3.0, 8.0);
            A_DIGIT
                .map(|d| Discs::following((d * digits).round() as usize, 0.0))
                .into()
        }
    }
}

/// Largest magnitude.
fn peak(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |most, v| most.max(v.abs()))
}
