//! The sampled force of an excitation, ready to be convolved with the kernels of any number of points.
//!
//! Theory: `docs/theory.md` (T24, T55, T60).

use crate::at_rest::static_si;
use crate::convolve::Method;
use crate::discs::Discs;
use crate::ends::unresolved;
use crate::error::FieldsError;
use crate::excitation::{Excitation, PressureRadius};
use crate::grid::Grid;
use crate::kernels::{CellPlan, Cells, KernelSource};
use crate::loads::{Load, Recipe, Share};
use crate::place::Place;
use crate::superposition::Superposition;
use crate::watch::{Unwatched, Watch};
use halfspace::{Arrivals, Kernel, Profile, Six};
use std::sync::OnceLock;

/// The sampled force of an excitation with kernels: all that fields at points need.
pub(crate) struct Sampled<'a> {
    excitation: &'a Excitation,
    source: &'a KernelSource,
    grid: &'a Grid,
    tolerance: f64,
    /// For static fields alone.
    kernel: Kernel,
    /// Times in s and forces in N at which the fields are wanted.
    wanted: Vec<[f64; 2]>,
    force_n: &'a [f64],
    samples: Vec<usize>,
    /// The discs that may stand for the load, and the loads on them that a point has needed.
    choices: Vec<Discs>,
    loads: Vec<OnceLock<Load>>,
    /// For samples that cells and discs do not resolve.
    superposition: Option<Superposition<'a>>,
    /// Who is told of each point.
    watch: &'a dyn Watch,
}

/// The fields at one point, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Point {
    /// First P, S and Rayleigh arrival in s.
    pub(crate) arrival_s: [f64; 3],
    /// Samples of each field.
    pub(crate) values: [Vec<f64>; 6],
    /// Estimated absolute error of each field.
    pub(crate) errors: [f64; 6],
}

/// The fields under the discs of one choice.
struct Sum {
    point: Point,
    /// What the two highest powers of the radius, a disc alone, and the cells at the ends of a contact leave out.
    lasts: [Vec<f64>; 6],
    /// Samples that are not resolved, the worst first.
    anew: Vec<(usize, f64)>,
}

/// Errors of moments that add up at random, in their standard deviations.
const ROUNDING: f64 = 3.0;

/// Error of an integral over the radii, in tolerances.
const QUADRATURE: f64 = 0.05;

/// What a disc alone leaves out of the waves besides their travel, as a fraction of them times the squared distance in radii.
const NEAR: f64 = 2.0;

/// Part of the tolerance up to which what is left of a sample is let be.
const SURE: f64 = 0.5;

/// Samples of a point that are integrated anew at most.
const MOST_ANEW: usize = 64;

/// Samples of forces on discs that are held at most.
const MOST_HELD: usize = 1 << 24;

impl<'a> Sampled<'a> {
    /// `force_n` holds the samples of the excitation on the grid; the fields are wanted at some of them, ascending.
    pub(crate) fn new(
        excitation: &'a Excitation,
        source: &'a KernelSource,
        grid: &'a Grid,
        force_n: &'a [f64],
        wanted: &[usize],
        tolerance: f64,
    ) -> Result<Self, FieldsError> {
        let times_s: Vec<f64> = grid.times_s().collect();
        let mut choices = match source {
            KernelSource::Direct(_) => Discs::computed(excitation.radius(), tolerance, force_n),
            KernelSource::Table(_) => Discs::looked_up(excitation.radius()),
        };
        let held = |discs: &Discs| discs.radii.len() * force_n.len() <= MOST_HELD;
        let kept = choices.iter().filter(|discs| held(discs)).count().max(1);
        if let KernelSource::Direct(_) = source {
            choices.truncate(kept);
        }
        let kernel = Kernel::new(excitation.medium(), Profile::Hertz, 1e-6)?;
        let superposition = match (excitation.record(), source) {
            (None, KernelSource::Direct(_)) => Some(Superposition::new(excitation, tolerance)?),
            (Some(_), _) | (_, KernelSource::Table(_)) => None,
        };
        Ok(Self {
            excitation,
            source,
            grid,
            tolerance,
            kernel,
            wanted: wanted.iter().map(|&n| [times_s[n], force_n[n]]).collect(),
            force_n,
            samples: wanted.to_vec(),
            loads: choices.iter().map(|_| OnceLock::new()).collect(),
            choices,
            superposition,
            watch: &Unwatched,
        })
    }

    /// With somebody who is told of each point.
    pub(crate) fn watched(self, watch: &'a dyn Watch) -> Self {
        Self { watch, ..self }
    }

    /// Times in s at which the fields are wanted.
    pub(crate) fn times_s(&self) -> impl Iterator<Item = f64> + '_ {
        self.wanted.iter().map(|&[time_s, _]| time_s)
    }

    /// How forces are summed, for reports.
    pub(crate) fn method(&self) -> Method {
        let loads = self.loads.iter().filter_map(OnceLock::get);
        let shares = loads.flat_map(|load| &load.shares);
        let mut runs = shares.flat_map(|share| &share.runs);
        if runs.any(|run| run.convolver.method() == Method::Transform) {
            Method::Transform
        } else {
            Method::Direct
        }
    }

    /// The fields at a point, at the samples that are wanted.
    pub(crate) fn point(&self, r_m: f64, z_m: f64) -> Result<Point, FieldsError> {
        let (units, medium) = (self.excitation.units(), self.excitation.medium());
        let radius_m = units.disc_radius_m;
        let (r, z) = (r_m / radius_m, z_m / radius_m);
        let arrivals = Arrivals::new(medium, Profile::Hertz, r, z)?;
        let direct = arrivals.above.unwrap_or([arrivals.p[0], arrivals.s[0]]);
        let first = [direct[0], direct[1], arrivals.rayleigh[0]];

        let arrival_s = first.map(|t| t * units.time_s());
        let mut point = self.under([r_m, z_m], arrival_s, &self.serving(r, z))?;
        for (samples, error) in point.values.iter().zip(&mut point.errors) {
            *error += self.excitation.relative_error() * peak(samples);
        }
        self.watch.advance();
        Ok(point)
    }

    /// The loads whose discs the source serves at a point in largest radii, and to which it is far enough for a disc alone;
    /// where there is none, the last or, of kernels that are computed, the first, whose error names the place.
    fn serving(&self, r: f64, z: f64) -> Vec<usize> {
        let reach = self.source.reach();
        let count = self.choices.len();
        let computed = matches!(self.source, KernelSource::Direct(_));
        let near = computed && count > 1 && NEAR / (r * r + z * z) > self.tolerance;
        let served = |&choice: &usize| {
            let discs = &self.choices[choice];
            let smallest = discs.smallest();
            let reached = r <= smallest * reach[0] && z <= smallest * reach[1];
            reached && !(near && discs.radii.len() == 1)
        };
        let found: Vec<usize> = (0..count).filter(served).collect();
        match (found.is_empty(), computed) {
            (false, _) => found,
            (true, true) => vec![0],
            (true, false) => vec![count - 1],
        }
    }

    /// The loads on one choice of discs.
    fn load(&self, choice: usize) -> &Load {
        self.loads[choice].get_or_init(|| {
            let recipe = Recipe {
                excitation: self.excitation,
                source: self.source,
                grid: self.grid,
                force_n: self.force_n,
                wanted: &self.samples,
                tolerance: self.tolerance,
            };
            recipe.load(self.choices[choice].clone())
        })
    }

    /// The fields under the first of some choices that leaves little to be integrated over the radii, or under the one before
    /// where a choice leaves more: the kernels of small discs lose digits far away.
    fn under(
        &self,
        place_m: [f64; 2],
        arrival_s: [f64; 3],
        choices: &[usize],
    ) -> Result<Point, FieldsError> {
        let mut best = self.sum(place_m, arrival_s, choices[0])?;
        for &choice in &choices[1..] {
            // to integrate a sample costs less than a disc
            let many = best.anew.len() > 2 * self.choices[choice].radii.len();
            if self.superposition.is_none() || !many {
                break;
            }
            let next = self.sum(place_m, arrival_s, choice)?;
            if next.anew.len() >= best.anew.len() {
                break;
            }
            best = next;
        }
        let Sum {
            mut point,
            mut lasts,
            mut anew,
        } = best;
        if let (Some(superposition), false) = (&self.superposition, anew.is_empty()) {
            for (f, error) in point.errors.iter_mut().enumerate() {
                *error += QUADRATURE * self.tolerance * peak(&point.values[f]);
            }
            anew.truncate(MOST_ANEW);
            for &(i, _) in &anew {
                let exact = superposition.at(place_m, self.wanted[i])?;
                for (f, value) in exact.into_iter().enumerate() {
                    point.values[f][i] = value;
                    lasts[f][i] = 0.0;
                }
            }
        }
        for (error, last) in point.errors.iter_mut().zip(&lasts) {
            *error += peak(last);
        }
        Ok(point)
    }

    /// The sum over the discs of one choice.
    fn sum(
        &self,
        place_m: [f64; 2],
        arrival_s: [f64; 3],
        choice: usize,
    ) -> Result<Sum, FieldsError> {
        let blank = || std::array::from_fn(|_| vec![0.0; self.wanted.len()]);
        let load = self.load(choice);
        let mut point = Point {
            arrival_s,
            values: blank(),
            errors: [0.0; 6],
        };
        let mut lasts = blank();
        let mut cells = Vec::with_capacity(load.shares.len());
        for (share, &over) in load.shares.iter().zip(&load.discs.radii) {
            cells.push(self.add_disc(share, over, place_m, &mut point, &mut lasts)?);
        }
        if let PressureRadius::Following { largest_m, .. } = self.excitation.radius() {
            if load.discs.radii.len() == 1 {
                let near = NEAR * (largest_m / place_m[0].hypot(place_m[1])).powi(2);
                for (error, samples) in point.errors.iter_mut().zip(&point.values) {
                    *error += near * peak(samples);
                }
            }
            self.add_following_static(place_m, &mut point)?;
            self.still_before_arrival(&mut point, &mut lasts);
        }
        let mut moved = vec![Six::default(); self.wanted.len()];
        for (k, cells) in cells.iter().enumerate() {
            self.add_ends(load, k, cells, &mut moved);
        }
        for (i, moved) in moved.into_iter().enumerate() {
            for f in 0..6 {
                lasts[f][i] = lasts[f][i].abs() + moved[f];
            }
        }
        let anew = self.not_resolved(&point, &lasts);
        Ok(Sum { point, lasts, anew })
    }

    /// Sets to zero what the sum over the discs leaves before the first wave from the largest of them has arrived.
    fn still_before_arrival(&self, point: &mut Point, lasts: &mut [Vec<f64>; 6]) {
        let still = self.times_s().take_while(|&t| t <= point.arrival_s[0]);
        let count = still.count();
        for samples in point.values.iter_mut().chain(lasts) {
            samples[..count].fill(0.0);
        }
    }

    /// The samples that the discs leave with more than the tolerance of a field's peak, the worst first.
    fn not_resolved(&self, point: &Point, lasts: &[Vec<f64>; 6]) -> Vec<(usize, f64)> {
        let allowed: [f64; 6] = std::array::from_fn(|f| self.tolerance * peak(&point.values[f]));
        let off = |i: usize| {
            let over = |f: usize| match lasts[f][i].abs() {
                0.0 => 0.0,
                last => last / allowed[f],
            };
            (i, (0..6).map(over).fold(0.0, f64::max))
        };
        let mut found: Vec<(usize, f64)> = (0..self.wanted.len()).map(off).collect();
        // before the first wave nothing moves
        let first_s = point.arrival_s[0];
        found.retain(|&(i, off)| off > SURE && self.wanted[i][0] > first_s);
        found.sort_by(|a, b| b.1.total_cmp(&a.1));
        found
    }

    /// Adds the fields under one disc of a radius `over` the largest.
    fn add_disc(
        &self,
        share: &Share,
        over: f64,
        [r_m, z_m]: [f64; 2],
        point: &mut Point,
        lasts: &mut [Vec<f64>; 6],
    ) -> Result<Cells, FieldsError> {
        let (excitation, grid) = (self.excitation, self.grid);
        let (units, medium) = (excitation.units(), excitation.medium());
        let place = self.place([r_m, z_m], over);
        let time_s = over * units.time_s();
        let plan = CellPlan {
            step: grid.step_s / time_s,
            count: grid.longest(),
            pulse: excitation.pulse(over),
        };
        let cells = self.source.cells(medium.poisson_ratio(), place, plan)?;
        let unit = self.units(over);
        // the static part of a pressure that follows the load is added as a whole
        let rest = match excitation.radius() {
            PressureRadius::Fixed(_) => cells.static_part,
            PressureRadius::Following { .. } => Six::default(),
        };
        let mut first = 0;
        for run in &share.runs {
            let mut own = run.convolver.fields(&rest, &cells.smooth);
            run.projection.add(&cells.moments, &run.wanted, &mut own);
            let last = run
                .last
                .as_ref()
                .map(|last| last.fields(&Six::default(), &cells.smooth));
            for field in 0..6 {
                for (i, value) in own[field].iter().enumerate() {
                    point.values[field][first + i] += unit[field] * value;
                }
                for (i, value) in last.iter().flat_map(|last| last[field].iter().enumerate()) {
                    lasts[field][first + i] += unit[field] * value;
                }
            }
            first += run.wanted.len();
        }
        let errors = self.errors(share, &cells);
        for (field, error) in errors.into_iter().enumerate() {
            point.errors[field] += unit[field] * error;
        }
        Ok(cells)
    }

    /// A point in radii of a disc of a radius `over` the largest.
    fn place(&self, [r_m, z_m]: [f64; 2], over: f64) -> Place {
        let radius_m = over * self.excitation.units().disc_radius_m;
        Place {
            r: r_m / radius_m,
            z: z_m / radius_m,
            disc_radius_m: radius_m,
        }
    }

    /// Units of the fields under that disc, by a force in N.
    fn units(&self, over: f64) -> Six {
        let units = self.excitation.units();
        std::array::from_fn(|field| {
            if field < 2 {
                units.displacement_m_per_n() / over
            } else {
                units.stress_pa_per_n() / (over * over)
            }
        })
    }

    /// What the ends of a contact may move a sample by, in tolerances of the peaks, where kernels change within a cell under
    /// disc `k` of a load: added up for each sample that is wanted.
    fn add_ends(&self, load: &Load, k: usize, cells: &Cells, moved: &mut [Six]) {
        let share = &load.shares[k];
        if share.runs.iter().all(|run| run.rough.is_empty()) {
            return;
        }
        let unit = self.units(load.discs.radii[k]);
        let unresolved = unresolved(&cells.moments);
        let mut first = 0;
        for run in &share.runs {
            for (moved, &n) in moved[first..].iter_mut().zip(&run.wanted) {
                let before = run.rough.iter().filter(|rough| rough.cell <= n);
                for rough in before {
                    let open = &unresolved[n - rough.cell];
                    for f in 0..6 {
                        moved[f] += unit[f] * open[f] * rough.rate_n;
                    }
                }
            }
            first += run.wanted.len();
        }
    }

    /// Errors of the kernels, of the force within the cells and of what the grid leaves out, in kernel units times N.
    fn errors(&self, share: &Share, cells: &Cells) -> Six {
        let (variation, steps) = (cells.variation(), cells.largest_step());
        let (settled, changed_n) = self.grid.left_out();
        let rest = cells.smooth.get(settled).copied().unwrap_or_default();
        std::array::from_fn(|f| {
            cells.error[f] * share.half_variation_n
                // rounding, of any sign
                + ROUNDING * cells.moment_error[f] * share.bending_n
                + share.left.moves(variation[f], steps[f])
                + changed_n * rest[f].abs()
        })
    }

    /// Adds the static field of the radius of each instant.
    fn add_following_static(
        &self,
        place_m: [f64; 2],
        point: &mut Point,
    ) -> Result<(), FieldsError> {
        for (i, &[_, force_n]) in self.wanted.iter().enumerate() {
            let fixed = static_si(self.excitation, &self.kernel, place_m, force_n)?;
            for (samples, value) in point.values.iter_mut().zip(fixed) {
                samples[i] += value;
            }
        }
        Ok(())
    }
}

/// Largest magnitude.
fn peak(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |most, v| most.max(v.abs()))
}
