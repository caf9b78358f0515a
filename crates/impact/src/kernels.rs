//! Kernels as cell averages at a point: computed, or looked up.

use crate::place::{FieldError, Place};
use halfspace::{DomainError, Kernel, Medium, Profile, Six};
use lookup::{Smoothness, Table, correct_for_curvature};
use std::sync::Arc;

/// Where the cell averages come from.
#[derive(Debug, Clone)]
pub enum KernelSource {
    /// Computed for each point: any step, no table.
    Direct(Arc<Kernel>),
    /// Interpolated in a table; the step is a power of two of its cells.
    Table(Arc<Table>),
}

/// Cells at one point with what goes with them.
#[derive(Debug, Clone)]
pub struct Cells {
    /// Static field under unit force.
    pub static_part: Six,
    /// Averages of the remainder over the cells, corrected for the force's curvature where it is smooth.
    pub averages: Vec<Six>,
    /// Error of the response to a force of unit peak.
    pub error: Six,
}

impl Cells {
    /// Total variation of the step response: the largest response to a force that is nowhere above one.
    #[must_use]
    pub fn variation(&self) -> Six {
        std::array::from_fn(|f| {
            let first = self.averages.first().map_or(0.0, |cell| cell[f]);
            let steps = self.averages.windows(2).map(|c| (c[1][f] - c[0][f]).abs());
            (self.static_part[f] + first).abs() + steps.sum::<f64>()
        })
    }

    /// Largest change of the step response from one cell to the next.
    #[must_use]
    pub fn largest_step(&self) -> Six {
        std::array::from_fn(|f| {
            let first = self.averages.first().map_or(0.0, |cell| cell[f]);
            let steps = self.averages.windows(2).map(|c| (c[1][f] - c[0][f]).abs());
            steps.fold((self.static_part[f] + first).abs(), f64::max)
        })
    }
}

/// First moments of direct kernels are computed to this fraction of the static field.
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
    #[must_use]
    pub fn step(&self, poisson_ratio: f64, wanted: f64) -> (f64, u32) {
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
    ///
    /// # Errors
    /// [`FieldError`] for a point outside the half-space or the table.
    pub fn cells(
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
                let mut error = kernel
                    .cell_averages(r, z, step, &mut averages)
                    .map_err(domain)?;
                let static_part = kernel.static_field(r, z).map_err(domain)?;
                match smoothness {
                    Smoothness::Linear => averages.truncate(count),
                    Smoothness::Smooth => {
                        let floor = static_part.map(|s| MOMENT_SHARE * s.abs());
                        let mut moments = averages.clone();
                        let of_moments = kernel
                            .cell_moments(r, z, step, &averages, &floor, &mut moments)
                            .map_err(domain)?;
                        for (all, own) in error.iter_mut().zip(of_moments) {
                            *all += own;
                        }
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
pub struct CellPlan {
    /// Width of a cell.
    pub step: f64,
    /// The step is 2^coarsening cells of the table.
    pub coarsening: u32,
    /// How many cells.
    pub count: usize,
    /// How the force is taken within a cell.
    pub smoothness: Smoothness,
    /// Of the force, for the table's error.
    pub pulse_length: f64,
}
