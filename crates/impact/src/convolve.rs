//! Fields at a point under a sampled force: kernels, convolved with the force's increments.
//!
//! ```text
//! u_n = P_n u_static + sum_{m <= n} (P_m - P_{m-1}) Rbar_{n-m}
//! ```
//!
//! Exact for a force that is linear between samples; Rbar_j is the average of the remainder R over
//! the j-th cell. For a smooth force the cells are corrected by the first moments of R, see [`Smoothness`].
//! Everything is in kernel units except the force, whose unit is free.

use halfspace::{DomainError, Kernel, Medium, Profile, Six};
use lookup::{LookupError, Smoothness, Table, correct_for_curvature};
use num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::sync::Arc;
use thiserror::Error;

/// Where the cell averages come from.
#[derive(Debug, Clone)]
pub enum KernelSource {
    /// Computed for each point: any step, no table.
    Direct(Arc<Kernel>),
    /// Interpolated in a table; the step is a power of two of its cells.
    Table(Arc<Table>),
}

/// A field that could not be computed.
#[derive(Debug, Error)]
pub enum FieldError {
    /// The point is outside the table.
    #[error(
        "probe r = {r_m} m, z = {z_m} m with disc radius {disc_radius_m} m: {source}; use --kernel direct or another table"
    )]
    Table {
        /// Distance from the axis in m.
        r_m: f64,
        /// Depth in m.
        z_m: f64,
        /// Unit of length in m.
        disc_radius_m: f64,
        /// What the table says.
        source: LookupError,
    },
    /// The point is outside the half-space.
    #[error("probe r = {r_m} m, z = {z_m} m: {source}")]
    Domain {
        /// Distance from the axis in m.
        r_m: f64,
        /// Depth in m.
        z_m: f64,
        /// What the kernel says.
        source: DomainError,
    },
}

/// Cells at one point with what goes with them.
#[derive(Debug, Clone)]
pub(crate) struct Cells {
    pub(crate) static_part: Six,
    pub(crate) averages: Vec<Six>,
    /// Error of the response to a force of unit peak.
    pub(crate) error: Six,
}

impl Cells {
    /// Total variation of the step response: the largest response to a force that is nowhere above one.
    pub(crate) fn variation(&self) -> Six {
        std::array::from_fn(|f| {
            let first = self.averages.first().map_or(0.0, |cell| cell[f]);
            let steps = self.averages.windows(2).map(|c| (c[1][f] - c[0][f]).abs());
            (self.static_part[f] + first).abs() + steps.sum::<f64>()
        })
    }
}

/// How the force is taken between its samples, and the largest error of that in the force's unit.
///
/// A force whose third differences are below half of its second differences is smooth on this step; one
/// with jumps or corners is not, and is linear between samples.
pub(crate) fn between_samples(force: &[f64]) -> (Smoothness, f64) {
    let difference = |order: usize| {
        let mut samples = vec![0.0; order];
        samples.extend_from_slice(force);
        for _ in 0..order {
            for i in (1..samples.len()).rev() {
                samples[i] -= samples[i - 1];
            }
        }
        samples[order..]
            .iter()
            .fold(0.0, |most: f64, d| most.max(d.abs()))
    };
    let [second, third, fourth] = [2, 3, 4].map(difference);
    if third < 0.5 * second {
        // the cubic within a cell, and its curvature taken from the cell's ends
        (Smoothness::Smooth, 0.008 * third + 0.026 * fourth)
    } else {
        (Smoothness::Linear, second / 8.0)
    }
}

/// First moments of direct kernels are computed to this share of the static field.
const MOMENT_SHARE: f64 = 1e-7;

impl KernelSource {
    /// Kernels of a half-space computed to a relative tolerance in [1e-14, 0.1].
    ///
    /// # Errors
    /// [`DomainError`] for a tolerance outside its range.
    pub fn direct(medium: &Medium, tolerance: f64) -> Result<Self, DomainError> {
        Ok(Self::Direct(Arc::new(Kernel::new(
            medium,
            Profile::Hertz,
            tolerance,
        )?)))
    }

    /// Step in r0/c1 not longer than `wanted`, unless the table has none so short; and its coarsening.
    ///
    /// Powers of two also without a table, so that both sources give the same samples.
    pub(crate) fn step(&self, poisson_ratio: f64, wanted: f64) -> (f64, u32) {
        match self {
            Self::Direct(_) => (wanted.log2().floor().exp2(), 0),
            Self::Table(table) => {
                // A medium was made of this ratio, so that the width exists.
                let cell = table.cell_width(poisson_ratio).unwrap_or(wanted);
                let coarsening = (wanted / cell).log2().floor().clamp(0.0, 20.0) as u32;
                (cell * f64::from(1_u32 << coarsening), coarsening)
            }
        }
    }

    /// The cells at (r, z).
    pub(crate) fn cells(
        &self,
        poisson_ratio: f64,
        place: Place,
        wanted: CellPlan,
    ) -> Result<Cells, FieldError> {
        let CellPlan {
            step,
            coarsening,
            count,
            smoothness,
            pulse_length,
        } = wanted;
        let mut averages = vec![[0.0; 6]; count];
        let Place { r, z, .. } = place;
        match self {
            Self::Direct(kernel) => {
                let domain = |source| place.domain(source);
                // one more cell than asked for: the correction looks one ahead
                averages.push([0.0; 6]);
                let error = kernel
                    .cell_averages(r, z, step, &mut averages)
                    .map_err(domain)?;
                let static_part = kernel.static_field(r, z).map_err(domain)?;
                match smoothness {
                    Smoothness::Linear => averages.truncate(count),
                    Smoothness::Smooth => {
                        let floor = static_part.map(|s| MOMENT_SHARE * s.abs());
                        let mut moments = averages.clone();
                        kernel
                            .cell_moments(r, z, step, &averages, &floor, &mut moments)
                            .map_err(domain)?;
                        averages.truncate(count);
                        correct_for_curvature(&mut averages, &moments);
                    }
                }
                Ok(Cells {
                    static_part,
                    averages,
                    // the force rises and falls once
                    error: error.map(|e| 2.0 * e),
                })
            }
            Self::Table(table) => {
                let outside = |source| place.outside(source);
                let info = table
                    .trace_for(smoothness, poisson_ratio, r, z, coarsening, &mut averages)
                    .map_err(outside)?;
                let error = table
                    .error(poisson_ratio, r, z, pulse_length)
                    .map_err(outside)?;
                Ok(Cells {
                    static_part: info.static_part,
                    averages,
                    error,
                })
            }
        }
    }
}

/// Which cells a convolution needs; lengths of time in r0/c1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CellPlan {
    pub(crate) step: f64,
    /// The step is 2^coarsening cells of the table.
    pub(crate) coarsening: u32,
    pub(crate) count: usize,
    pub(crate) smoothness: Smoothness,
    /// Of the force, for the table's error.
    pub(crate) pulse_length: f64,
}

/// A point in kernel units, with its unit for messages.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    pub(crate) r: f64,
    pub(crate) z: f64,
    pub(crate) disc_radius_m: f64,
}

impl Place {
    fn outside(self, source: LookupError) -> FieldError {
        FieldError::Table {
            r_m: self.r * self.disc_radius_m,
            z_m: self.z * self.disc_radius_m,
            disc_radius_m: self.disc_radius_m,
            source,
        }
    }

    fn domain(self, source: DomainError) -> FieldError {
        FieldError::Domain {
            r_m: self.r * self.disc_radius_m,
            z_m: self.z * self.disc_radius_m,
            source,
        }
    }
}

/// A sampled force, ready to be convolved with the cells of any number of points.
pub struct Convolver {
    force: Vec<f64>,
    rise: Vec<f64>,
    /// Samples until the force has come to rest.
    live: usize,
    /// Samples at which the fields are wanted, ascending.
    wanted: Vec<usize>,
    transform: Option<Transform>,
}

/// The force's increments in the frequency domain with the plans that brought them there.
struct Transform {
    size: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
    load: Vec<Complex<f64>>,
}

/// Nanoseconds of a product of the direct sum for six fields, and of a point and stage of the twelve transforms.
///
/// Measured by the bench `fields`; only their ratio matters.
const PRODUCT_NS: f64 = 2.5;
const STAGE_NS: f64 = 9.0;

impl Convolver {
    /// Fields are wanted at all samples.
    #[must_use]
    pub fn new(force: &[f64]) -> Self {
        Self::at(force, (0..force.len()).collect())
    }

    /// Fields are wanted at all samples, in a way given.
    #[must_use]
    pub fn by(force: &[f64], method: Method) -> Self {
        let mut convolver = Self::new(force);
        match method {
            Method::Direct => convolver.transform = None,
            Method::Transform => {
                let size = (2 * force.len()).next_power_of_two();
                convolver.transform = Some(Transform::new(&convolver.rise, size));
            }
            Method::Chosen => {}
        }
        convolver
    }

    /// Fields are wanted at some samples, ascending.
    pub(crate) fn at(force: &[f64], wanted: Vec<usize>) -> Self {
        let rise = increments(force);
        let live = rise.iter().rposition(|&d| d != 0.0).map_or(0, |i| i + 1);
        let size = (2 * force.len()).next_power_of_two();
        let direct = PRODUCT_NS * wanted.len() as f64 * live as f64;
        let stages = STAGE_NS * size as f64 * f64::from(size.trailing_zeros());
        let transform = (stages < direct).then(|| Transform::new(&rise, size));
        Self {
            force: force.to_vec(),
            rise,
            live,
            wanted,
            transform,
        }
    }

    /// How the sum is done, for reports.
    pub(crate) fn method(&self) -> &'static str {
        match self.transform {
            Some(_) => "fast Fourier transform",
            None => "direct sum",
        }
    }

    /// The six fields at the samples wanted, from the static part and the averages of the remainder over as many cells
    /// as the force has samples.
    #[must_use]
    pub fn fields(&self, static_part: &Six, averages: &[Six]) -> [Vec<f64>; 6] {
        let mut out = match &self.transform {
            Some(transform) => transform.convolve(averages, self.force.len(), &self.wanted),
            None => self.direct_sum(averages),
        };
        for (field, samples) in out.iter_mut().enumerate() {
            for (value, &n) in samples.iter_mut().zip(&self.wanted) {
                *value += self.force[n] * static_part[field];
            }
        }
        out
    }

    fn direct_sum(&self, averages: &[Six]) -> [Vec<f64>; 6] {
        let mut out: [Vec<f64>; 6] = std::array::from_fn(|_| Vec::with_capacity(self.wanted.len()));
        for &n in &self.wanted {
            let mut sum = [0.0; 6];
            let past = self.rise[..self.live.min(n + 1)].iter();
            for (d, cell) in past.zip(averages[..=n].iter().rev()) {
                for (s, c) in sum.iter_mut().zip(cell) {
                    *s += d * c;
                }
            }
            for (samples, s) in out.iter_mut().zip(sum) {
                samples.push(s);
            }
        }
        out
    }
}

/// How a convolution is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Sum over the increments of the force.
    Direct,
    /// Fast Fourier transform.
    Transform,
    /// The one that is estimated to be faster.
    Chosen,
}

/// P_m - P_{m-1}, with nothing before the first sample.
fn increments(force: &[f64]) -> Vec<f64> {
    let mut before = 0.0;
    force
        .iter()
        .map(|&p| {
            let rise = p - before;
            before = p;
            rise
        })
        .collect()
}

impl Transform {
    fn new(rise: &[f64], size: usize) -> Self {
        let mut planner = RealFftPlanner::<f64>::new();
        let mut transform = Self {
            size,
            forward: planner.plan_fft_forward(size),
            backward: planner.plan_fft_inverse(size),
            load: Vec::new(),
        };
        transform.load = transform.spectrum(rise.iter().copied());
        transform
    }

    fn spectrum(&self, samples: impl Iterator<Item = f64>) -> Vec<Complex<f64>> {
        let mut time = self.forward.make_input_vec();
        for (slot, value) in time.iter_mut().zip(samples) {
            *slot = value;
        }
        let mut frequency = self.forward.make_output_vec();
        // The lengths are those of the plan, the only thing that can be wrong.
        let done = self.forward.process(&mut time, &mut frequency);
        debug_assert!(done.is_ok());
        frequency
    }

    fn convolve(&self, averages: &[Six], count: usize, wanted: &[usize]) -> [Vec<f64>; 6] {
        std::array::from_fn(|field| {
            let mut product = self.spectrum(averages.iter().take(count).map(|cell| cell[field]));
            for (a, b) in product.iter_mut().zip(&self.load) {
                *a *= b;
            }
            let mut time = self.backward.make_output_vec();
            let done = self.backward.process(&mut product, &mut time);
            debug_assert!(done.is_ok());
            wanted.iter().map(|&n| time[n] / self.size as f64).collect()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transform_agrees_with_the_sum() {
        let averages: Vec<Six> = (0..300)
            .map(|j| {
                std::array::from_fn(|f| ((j * (f + 1)) as f64 * 0.01).sin() / (1.0 + j as f64))
            })
            .collect();
        let force: Vec<f64> = (0..300)
            .map(|i| (f64::from(i) * 0.02).sin().max(0.0))
            .collect();
        for wanted in [(0..300).collect::<Vec<_>>(), vec![0, 7, 150, 299]] {
            let mut convolver = Convolver::at(&force, wanted);
            convolver.transform = Some(Transform::new(&convolver.rise, 1024));
            let b = convolver.fields(&[1.0; 6], &averages);
            convolver.transform = None;
            let a = convolver.fields(&[1.0; 6], &averages);
            for field in 0..6 {
                for (x, y) in a[field].iter().zip(&b[field]) {
                    assert!((x - y).abs() < 1e-13);
                }
            }
        }
    }
}
