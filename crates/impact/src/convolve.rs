//! Fields at a point under a sampled force: kernels, convolved with the force's increments.
//!
//! ```text
//! u_n = P_n u_static + sum_{m <= n} (P_m - P_{m-1}) Rbar_{n-m}
//! ```
//!
//! Exact for a force that is linear between samples; Rbar_j is the average of the remainder R over
//! the j-th cell. Everything is in kernel units except the force, whose unit is free.

use halfspace::{DomainError, Kernel, Medium, Profile, Six};
use lookup::{LookupError, Table};
use realfft::RealFftPlanner;
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

/// Cell averages at one point with what goes with them.
#[derive(Debug, Clone)]
pub(crate) struct Cells {
    pub(crate) static_part: Six,
    pub(crate) averages: Vec<Six>,
    /// Error of the response to a force of unit peak.
    pub(crate) error: Six,
}

/// Samples beyond which the transform is faster than the sum.
const DIRECT_PRODUCTS: usize = 60_000;

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
    pub(crate) fn step(&self, wanted: f64) -> (f64, u32) {
        match self {
            Self::Direct(_) => (wanted.log2().floor().exp2(), 0),
            Self::Table(table) => {
                let cell = table.cell_width();
                let coarsening = (wanted / cell).log2().floor().clamp(0.0, 20.0) as u32;
                (cell * f64::from(1_u32 << coarsening), coarsening)
            }
        }
    }

    /// Fills `count` cells of `step` at (r, z).
    pub(crate) fn cells(
        &self,
        poisson_ratio: f64,
        place: Place,
        step: f64,
        coarsening: u32,
        count: usize,
        pulse_length: f64,
    ) -> Result<Cells, FieldError> {
        let mut averages = vec![[0.0; 6]; count];
        let Place { r, z, .. } = place;
        match self {
            Self::Direct(kernel) => {
                let domain = |source| place.domain(source);
                let error = kernel
                    .cell_averages(r, z, step, &mut averages)
                    .map_err(domain)?;
                Ok(Cells {
                    static_part: kernel.static_field(r, z).map_err(domain)?,
                    averages,
                    // the force rises and falls once
                    error: error.map(|e| 2.0 * e),
                })
            }
            Self::Table(table) => {
                let outside = |source| place.outside(source);
                let info = table
                    .trace(poisson_ratio, r, z, coarsening, &mut averages)
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

/// The six fields at the times of the force samples.
pub(crate) fn convolve(cells: &Cells, force: &[f64]) -> [Vec<f64>; 6] {
    let rise = increments(force);
    let live = rise.iter().rposition(|&d| d != 0.0).map_or(0, |i| i + 1);
    let mut out: [Vec<f64>; 6] = if live * force.len() <= DIRECT_PRODUCTS {
        direct_sum(&cells.averages, &rise[..live], force.len())
    } else {
        transformed(&cells.averages, &rise, force.len())
    };
    for (field, samples) in out.iter_mut().enumerate() {
        for (value, p) in samples.iter_mut().zip(force) {
            *value += p * cells.static_part[field];
        }
    }
    out
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

fn direct_sum(averages: &[Six], rise: &[f64], count: usize) -> [Vec<f64>; 6] {
    let mut sums = vec![[0.0; 6]; count];
    for (m, &d) in rise.iter().enumerate() {
        for (sum, cell) in sums[m..].iter_mut().zip(averages) {
            for (s, c) in sum.iter_mut().zip(cell) {
                *s += d * c;
            }
        }
    }
    std::array::from_fn(|field| sums.iter().map(|s| s[field]).collect())
}

fn transformed(averages: &[Six], rise: &[f64], count: usize) -> [Vec<f64>; 6] {
    let size = (2 * count).next_power_of_two();
    let mut planner = RealFftPlanner::<f64>::new();
    let (forward, backward) = (
        planner.plan_fft_forward(size),
        planner.plan_fft_inverse(size),
    );
    let spectrum = |samples: &mut dyn Iterator<Item = f64>| {
        let mut time = forward.make_input_vec();
        for (slot, value) in time.iter_mut().zip(samples) {
            *slot = value;
        }
        let mut frequency = forward.make_output_vec();
        // The lengths are those of the plan, the only thing that can be wrong.
        let done = forward.process(&mut time, &mut frequency);
        debug_assert!(done.is_ok());
        frequency
    };
    let load = spectrum(&mut rise.iter().copied());
    std::array::from_fn(|field| {
        let mut product = spectrum(&mut averages.iter().take(count).map(|cell| cell[field]));
        for (a, b) in product.iter_mut().zip(&load) {
            *a *= b;
        }
        let mut time = backward.make_output_vec();
        let done = backward.process(&mut product, &mut time);
        debug_assert!(done.is_ok());
        time.truncate(count);
        for value in &mut time {
            *value /= size as f64;
        }
        time
    })
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
        let rise = increments(&force);
        let (a, b) = (
            direct_sum(&averages, &rise, 300),
            transformed(&averages, &rise, 300),
        );
        for field in 0..6 {
            for (x, y) in a[field].iter().zip(&b[field]) {
                assert!((x - y).abs() < 1e-13);
            }
        }
    }
}
