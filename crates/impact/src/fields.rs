//! Fields of an excitation at points of the half-space.

use crate::convolve::Convolver;
use crate::excitation::Excitation;
use crate::grid::{Grid, TooManySamples, Wanted};
use crate::kernels::{CellPlan, KernelSource};
use crate::place::{FieldError, Place};
use crate::samples::{between_samples, half_variation};
use crate::stretch::Departure;
use crate::watch::{Unwatched, Watch};
use halfspace::{Arrivals, DomainError, Field, Profile};
use lookup::Smoothness;
use std::ops::Index;
use thiserror::Error;

/// Fields that could not be computed.
#[derive(Debug, Error)]
pub enum FieldsError {
    /// More samples than memory should hold.
    #[error(transparent)]
    TooManySamples(#[from] TooManySamples),
    /// A point without fields.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A number outside the physics.
    #[error(transparent)]
    Domain(#[from] DomainError),
}

/// The sampled force of an excitation with kernels: all that fields at points need.
pub(crate) struct Sampled<'a> {
    excitation: &'a Excitation,
    source: &'a KernelSource,
    grid: &'a Grid,
    /// Half of the force's total variation in N: its peak where it rises and falls once.
    half_variation_n: f64,
    smoothness: Smoothness,
    /// What the samples leave of the force.
    left: Departure,
    /// Who is told of each point.
    watch: &'a dyn Watch,
}

/// The forces of the runs of a grid, ready to be convolved.
pub(crate) type Convolvers = Vec<Convolver>;

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

impl<'a> Sampled<'a> {
    /// `force_n` holds the samples of the excitation on the grid.
    pub(crate) fn new(
        excitation: &'a Excitation,
        source: &'a KernelSource,
        grid: &'a Grid,
        force_n: &[f64],
    ) -> Self {
        let (mut smoothness, mut left, mut half_variation_n) =
            (Smoothness::Smooth, Departure::default(), 0.0);
        for (run, force_n) in grid.split(force_n) {
            let to_s = run.start_s + (run.count - 1) as f64 * grid.step_s;
            let known = excitation.departure(run.start_s, to_s, grid.step_s);
            let (own, departure) = between_samples(force_n, known);
            if own == Smoothness::Linear {
                smoothness = own;
            }
            left.join(departure);
            half_variation_n += half_variation(run.base_n, force_n);
        }
        Self {
            excitation,
            source,
            grid,
            half_variation_n,
            smoothness,
            left,
            watch: &Unwatched,
        }
    }

    /// With somebody who is told of each point.
    pub(crate) fn watched(self, watch: &'a dyn Watch) -> Self {
        Self { watch, ..self }
    }

    /// The forces of the runs for fields at some samples of all, ascending.
    pub(crate) fn convolvers(&self, force_n: &[f64], wanted: &[usize]) -> Convolvers {
        let mut first = 0;
        let parts = self.grid.split(force_n).into_iter();
        parts
            .map(|(run, force_n)| {
                let own = first..first + run.count;
                first = own.end;
                let wanted = wanted.iter().filter(|n| own.contains(n));
                let wanted = wanted.map(|n| n - own.start).collect();
                Convolver::from_base(run.base_n, force_n, wanted)
            })
            .collect()
    }

    /// The fields at a point, at the samples that the convolvers want.
    pub(crate) fn point(
        &self,
        convolvers: &[Convolver],
        r_m: f64,
        z_m: f64,
    ) -> Result<Point, FieldsError> {
        let (excitation, grid) = (self.excitation, self.grid);
        let (units, medium) = (excitation.units(), excitation.medium());
        let radius = units.disc_radius_m;
        let place = Place {
            r: r_m / radius,
            z: z_m / radius,
            disc_radius_m: radius,
        };
        let plan = CellPlan {
            step: grid.step_s / units.time_s(),
            coarsening: grid.coarsening,
            count: grid.longest(),
            smoothness: self.smoothness,
            pulse_length: excitation.pulse_s() / units.time_s(),
        };
        let cells = self.source.cells(medium.poisson_ratio(), place, plan)?;
        let arrivals = Arrivals::new(medium, Profile::Hertz, place.r, place.z)?;
        let direct = arrivals.above.unwrap_or([arrivals.p[0], arrivals.s[0]]);
        let first = [direct[0], direct[1], arrivals.rayleigh[0]];
        let mut values: [Vec<f64>; 6] = Default::default();
        for convolver in convolvers {
            let own = convolver.fields(&cells.static_part, &cells.averages);
            for (all, own) in values.iter_mut().zip(own) {
                all.extend(own);
            }
        }
        let (variation, steps) = (cells.variation(), cells.largest_step());
        let (settled, changed_n) = grid.left_out();
        let rest = cells.averages.get(settled).copied().unwrap_or_default();
        let mut errors = [0.0; 6];
        for (field, samples) in values.iter_mut().enumerate() {
            let unit = if field < 2 {
                units.displacement_m_per_n()
            } else {
                units.stress_pa_per_n()
            };
            let mut largest = 0.0_f64;
            for value in samples {
                *value *= unit;
                largest = largest.max(value.abs());
            }
            let kernel = cells.error[field] * self.half_variation_n
                + self.left.moves(variation[field], steps[field])
                + changed_n * rest[field].abs();
            errors[field] = kernel * unit + excitation.relative_error() * largest;
        }
        self.watch.advance();
        Ok(Point {
            arrival_s: first.map(|t| t * units.time_s()),
            values,
            errors,
        })
    }
}

/// Fields of an excitation, asked for point by point.
#[derive(Debug, Clone)]
pub struct Fields<'a> {
    excitation: &'a Excitation,
    source: KernelSource,
    /// Relative tolerance that the samples in time are as dense as.
    tolerance: f64,
    duration_s: Option<f64>,
}

impl Excitation {
    /// The fields by kernels computed to a relative tolerance in [1e-14, 0.1].
    ///
    /// # Errors
    /// [`DomainError`] for a tolerance outside its range.
    pub fn fields(&self, tolerance: f64) -> Result<Fields<'_>, DomainError> {
        let source = KernelSource::direct(self.medium(), tolerance)?;
        Ok(self.fields_from(source))
    }

    /// The fields by kernels of a source, such as a table.
    #[must_use]
    pub fn fields_from(&self, source: KernelSource) -> Fields<'_> {
        Fields {
            excitation: self,
            source,
            tolerance: 1e-4,
            duration_s: None,
        }
    }
}

impl Fields<'_> {
    /// With samples until a time in s; otherwise until the last wave has passed a point.
    #[must_use]
    pub fn until(mut self, duration_s: f64) -> Self {
        self.duration_s = Some(duration_s);
        self
    }

    /// With samples in time as dense as a relative tolerance needs, 1e-4 otherwise.
    #[must_use]
    pub fn to_tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// The six fields over time at the distance `r_m` from the axis and the depth `z_m`.
    ///
    /// # Errors
    /// [`FieldsError`] for a point outside the half-space or the table.
    pub fn at(&self, r_m: f64, z_m: f64) -> Result<FieldHistory, FieldsError> {
        let wanted = Wanted {
            tolerance: self.tolerance,
            step_s: None,
            duration_s: self.duration_s,
            frames: None,
            farthest_m: Some(r_m.hypot(z_m)),
        };
        let grid = Grid::new(&wanted, self.excitation, Some(&self.source))?;
        let time_s: Vec<f64> = grid.times_s().collect();
        let force_n: Vec<f64> = time_s.iter().map(|&t| self.excitation.force_n(t)).collect();
        let sampled = Sampled::new(self.excitation, &self.source, &grid, &force_n);
        let all: Vec<usize> = (0..force_n.len()).collect();
        let point = sampled.point(&sampled.convolvers(&force_n, &all), r_m, z_m)?;
        let Point {
            arrival_s,
            values,
            errors,
        } = point;
        let mut errors = errors.into_iter();
        let traces = values.map(|samples| Trace {
            samples,
            error: errors.next().unwrap_or(f64::NAN),
        });
        Ok(FieldHistory {
            time_s,
            arrival_s,
            traces,
        })
    }
}

/// The fields over time at one point.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldHistory {
    /// Times in s.
    pub time_s: Vec<f64>,
    /// First P, S and Rayleigh arrival in s.
    pub arrival_s: [f64; 3],
    traces: [Trace; 6],
}

impl Index<Field> for FieldHistory {
    type Output = Trace;

    fn index(&self, field: Field) -> &Trace {
        &self.traces[field.index()]
    }
}

/// One field over time, in m or Pa.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Samples at the times of the history.
    pub samples: Vec<f64>,
    /// Estimated absolute error of every sample.
    pub error: f64,
}

impl Trace {
    /// The sample of the largest magnitude, with its sign.
    #[must_use]
    pub fn peak(&self) -> f64 {
        let larger = |most: f64, &x: &f64| if x.abs() > most.abs() { x } else { most };
        self.samples.iter().fold(0.0, larger)
    }
}
