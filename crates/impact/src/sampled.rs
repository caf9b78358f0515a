//! The sampled force of an excitation, ready to be convolved with the kernels of any number of points.
//!
//! Theory: `docs/theory.md` (T24, T55, T60).

use crate::at_rest::static_si;
use crate::convolve::{Convolver, Method};
use crate::discs::Discs;
use crate::error::FieldsError;
use crate::excitation::{Excitation, PressureRadius};
use crate::following::Following;
use crate::grid::Grid;
use crate::kernels::{CellPlan, Cells, KernelSource};
use crate::place::Place;
use crate::projection::Projection;
use crate::stretch::Departure;
use crate::watch::{Unwatched, Watch};
use halfspace::{Arrivals, Kernel, Profile, Six};
use std::ops::Range;
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
    following: Option<Following<'a>>,
    /// Who is told of each point.
    watch: &'a dyn Watch,
}

/// Loads on discs of fixed radii that together are the excitation's.
struct Load {
    discs: Discs,
    /// Of each disc.
    shares: Vec<Share>,
}

/// A force on one disc.
struct Share {
    /// Of each run of the grid.
    runs: Vec<RunForce>,
    /// Half of the force's total variation in N: its peak where it rises and falls once.
    half_variation_n: f64,
    /// Root of the sum of the squares of its rises' changes from cell to cell, in N.
    bending_n: f64,
    /// What rise, slope and bend of the cells leave of the whole force, counted with the largest disc.
    left: Departure,
}

/// A force during one run, on one disc.
struct RunForce {
    wanted: Vec<usize>,
    convolver: Convolver,
    /// The part that the two highest powers bring.
    last: Option<Convolver>,
    projection: Projection,
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

/// Errors of moments that add up at random, in their standard deviations.
const ROUNDING: f64 = 3.0;

/// Error of an integral over the radii, in tolerances.
const QUADRATURE: f64 = 0.2;

/// Samples of a point that are integrated over the radii at most.
const MOST_ANEW: usize = 64;

/// Samples of forces on discs that are held at most.
const MOST_HELD: usize = 1 << 24;

/// Slopes and bends below this fraction of the largest force are left to the differences of its samples.
const NEGLIGIBLE: f64 = 1e-9;

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
            KernelSource::Direct(_) => Discs::computed(excitation.radius(), tolerance),
            KernelSource::Table(_) => Discs::looked_up(excitation.radius()),
        };
        let held = |discs: &Discs| discs.radii.len() * force_n.len() <= MOST_HELD;
        let kept = choices.iter().filter(|discs| held(discs)).count().max(1);
        if let KernelSource::Direct(_) = source {
            choices.truncate(kept);
        }
        let kernel = Kernel::new(excitation.medium(), Profile::Hertz, 1e-6)?;
        let following = match (excitation.radius(), source) {
            (PressureRadius::Following { .. }, KernelSource::Direct(_)) => {
                Some(Following::new(excitation, tolerance)?)
            }
            (PressureRadius::Following { .. } | PressureRadius::Fixed(_), _) => None,
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
            following,
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
        let mut point = self.under([r_m, z_m], arrival_s, self.serving(r, z))?;
        for (samples, error) in point.values.iter().zip(&mut point.errors) {
            *error += self.excitation.relative_error() * peak(samples);
        }
        self.watch.advance();
        Ok(point)
    }

    /// The loads whose discs the source serves at a point in largest radii; where none is, the largest disc alone, whose
    /// error names the place.
    fn serving(&self, r: f64, z: f64) -> Range<usize> {
        let reach = self.source.reach();
        let served = |discs: &Discs| {
            let smallest = discs.radii[discs.radii.len() - 1];
            r <= smallest * reach[0] && z <= smallest * reach[1]
        };
        let (first, count) = (self.choices.iter().position(served), self.choices.len());
        first.unwrap_or(count - 1)..count
    }

    /// The loads on one choice of discs.
    fn load(&self, choice: usize) -> &Load {
        self.loads[choice].get_or_init(|| {
            let discs = self.choices[choice].clone();
            let (excitation, source, grid) = (self.excitation, self.source, self.grid);
            Load::new(discs, excitation, source, grid, self.force_n, &self.samples)
        })
    }

    /// The fields under the first of some choices that leaves little to be integrated over the radii.
    fn under(
        &self,
        place_m: [f64; 2],
        arrival_s: [f64; 3],
        choices: Range<usize>,
    ) -> Result<Point, FieldsError> {
        let blank = || std::array::from_fn(|_| vec![0.0; self.wanted.len()]);
        let last = choices.end - 1;
        for choice in choices {
            let load = self.load(choice);
            let mut point = Point {
                arrival_s,
                values: blank(),
                errors: [0.0; 6],
            };
            let mut lasts = blank();
            for (share, &over) in load.shares.iter().zip(&load.discs.radii) {
                self.add_disc(share, over, place_m, &mut point, &mut lasts)?;
            }
            let PressureRadius::Following { .. } = self.excitation.radius() else {
                return Ok(point);
            };
            self.add_following_static(place_m, &mut point)?;
            self.still_before_arrival(&mut point, &mut lasts);
            let mut anew = self.not_resolved(&point, &lasts);
            // to integrate a sample costs as much as a disc or two
            let many = anew.len() > load.discs.radii.len();
            if self.following.is_some() && many && choice < last {
                continue;
            }
            if let (Some(following), false) = (&self.following, anew.is_empty()) {
                for (f, error) in point.errors.iter_mut().enumerate() {
                    *error += QUADRATURE * self.tolerance * peak(&point.values[f]);
                }
                anew.truncate(MOST_ANEW);
                for &(i, _) in &anew {
                    let exact = following.at(place_m, self.wanted[i])?;
                    for (f, value) in exact.into_iter().enumerate() {
                        point.values[f][i] = value;
                        lasts[f][i] = 0.0;
                    }
                }
            }
            for (error, last) in point.errors.iter_mut().zip(&lasts) {
                *error += peak(last);
            }
            return Ok(point);
        }
        unreachable!("there is a load")
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
        found.retain(|&(_, off)| off > 1.0);
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
    ) -> Result<(), FieldsError> {
        let (excitation, grid) = (self.excitation, self.grid);
        let (units, medium) = (excitation.units(), excitation.medium());
        let radius_m = over * units.disc_radius_m;
        let place = Place {
            r: r_m / radius_m,
            z: z_m / radius_m,
            disc_radius_m: radius_m,
        };
        let time_s = over * units.time_s();
        let plan = CellPlan {
            step: grid.step_s / time_s,
            count: grid.longest(),
            pulse: excitation.pulse(over),
        };
        let cells = self.source.cells(medium.poisson_ratio(), place, plan)?;
        let unit = |field: usize| {
            if field < 2 {
                units.displacement_m_per_n() / over
            } else {
                units.stress_pa_per_n() / (over * over)
            }
        };
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
                    point.values[field][first + i] += unit(field) * value;
                }
                for (i, value) in last.iter().flat_map(|last| last[field].iter().enumerate()) {
                    lasts[field][first + i] += unit(field) * value;
                }
            }
            first += run.wanted.len();
        }
        let errors = self.errors(share, &cells);
        for (field, error) in errors.into_iter().enumerate() {
            point.errors[field] += unit(field) * error;
        }
        Ok(())
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

impl Load {
    fn new(
        discs: Discs,
        excitation: &Excitation,
        source: &KernelSource,
        grid: &Grid,
        force_n: &[f64],
        wanted: &[usize],
    ) -> Self {
        let radius = excitation.radius();
        let nodes: Vec<_> = grid
            .runs
            .iter()
            .map(|run| excitation.cell_nodes(run, grid.step_s))
            .collect();
        let most_n = force_n.iter().fold(0.0, |most: f64, p| most.max(p.abs()));
        let negligible = most_n * NEGLIGIBLE.max(1e-3 * excitation.relative_error());
        let share = |k: usize| {
            let of = |p: f64| discs.share(k, radius.square(p));
            let (mut first, mut runs) = (0, Vec::new());
            let (mut half_variation_n, mut bending_n, mut left) = (0.0, 0.0, Departure::default());
            for ((run, samples), nodes) in grid.split(force_n).into_iter().zip(&nodes) {
                let own = first..first + run.count;
                first = own.end;
                let inside = wanted.iter().filter(|n| own.contains(n));
                let wanted: Vec<usize> = inside.map(|n| n - own.start).collect();
                let map = |p: f64| p * of(p).0;
                let forces: Vec<f64> = samples.iter().map(|&p| map(p)).collect();
                let convolver = Convolver::from_base(map(run.base_n), &forces, wanted.clone());
                let last = (discs.radii.len() > 1).then(|| {
                    let last: Vec<f64> = samples.iter().map(|&p| p * of(p).1).collect();
                    Convolver::at(&last, wanted.clone())
                });
                let rises = convolver.rises();
                let bends = source.bends();
                let projection = Projection::new(samples, rises, nodes, map, negligible, bends);
                if k == 0 {
                    let whole = crate::convolve::rises(run.base_n, samples);
                    let of = Projection::new(samples, &whole, nodes, |p| p, f64::INFINITY, bends);
                    left.join(of.left);
                }
                half_variation_n += 0.5 * rises.iter().map(|d| d.abs()).sum::<f64>();
                let bends = rises.windows(2).map(|d| (d[1] - d[0]).powi(2));
                bending_n += bends.sum::<f64>().sqrt();
                runs.push(RunForce {
                    wanted,
                    convolver,
                    last,
                    projection,
                });
            }
            Share {
                runs,
                half_variation_n,
                bending_n,
                left,
            }
        };
        let shares = (0..discs.radii.len()).map(share).collect();
        Self { discs, shares }
    }
}
