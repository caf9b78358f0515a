//! Kernels as cell averages at a point: computed, or looked up.

use crate::place::{FieldError, Place};
use halfspace::{DomainError, Kernel, Medium, Profile, Six};
use lookup::{BEYOND, LookupError, Moments, Table};
use std::f64::consts::PI;
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
    /// Averages and moments of the remainder over the cells wanted and [`lookup::BEYOND`] more.
    pub moments: Moments,
    /// The cells wanted, with what their moments are worth under a smooth force.
    pub smooth: Vec<Six>,
    /// Error of the response to a force of unit peak.
    pub error: Six,
    /// What errors of the moments add, for rises that change by one in all; zero where [`Self::error`] has it.
    pub moment_error: Six,
}

impl Cells {
    /// Total variation of the step response: the largest response to a force that is nowhere above one.
    #[must_use]
    pub fn variation(&self) -> Six {
        self.steps(0.0, |sum, step| sum + step)
    }

    /// Largest change of the step response from one cell to the next.
    #[must_use]
    pub fn largest_step(&self) -> Six {
        self.steps(0.0, f64::max)
    }

    /// The changes of the step response from cell to cell, folded.
    fn steps(&self, none: f64, fold: impl Fn(f64, f64) -> f64) -> Six {
        let averages = &self.moments.averages;
        std::array::from_fn(|f| {
            let first = averages.first().map_or(0.0, |cell| cell[f]);
            let steps = averages.windows(2).map(|c| (c[1][f] - c[0][f]).abs());
            steps.fold(fold(none, (self.static_part[f] + first).abs()), &fold)
        })
    }
}

/// First moments of direct kernels are computed to this fraction of the static field.
const MOMENT_SHARE: f64 = 1e-7;

/// Distance in radii to which pulses' fields from computed kernels have been shown to hold their tolerance.
const FARTHEST: f64 = 1e4;

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

    /// Step in r0/c1 not longer than `wanted`, unless the table has none so short.
    ///
    /// Powers of two also without a table, so that both sources give the same samples.
    #[must_use]
    pub fn step(&self, poisson_ratio: f64, wanted: f64) -> f64 {
        match self {
            Self::Direct(_) => wanted.log2().floor().exp2(),
            Self::Table(table) => {
                // A medium was made of this ratio, so that the width exists.
                let cell = table.cell_width(poisson_ratio).unwrap_or(wanted);
                let coarsening = (wanted / cell).log2().floor().clamp(0.0, 20.0) as u32;
                cell * f64::from(1_u32 << coarsening)
            }
        }
    }

    /// Whether its cells have second moments.
    #[must_use]
    pub fn bends(&self) -> bool {
        match self {
            Self::Direct(_) => false,
            Self::Table(_) => true,
        }
    }

    /// Largest r and z in radii at which its values are sure: beyond, computed ones lose digits.
    #[must_use]
    pub fn reach(&self) -> [f64; 2] {
        match self {
            Self::Direct(_) => [FARTHEST; 2],
            Self::Table(table) => [table.r_max(), table.z_max()],
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
        let CellPlan { step, count, pulse } = wanted;
        let Place { r, z, .. } = place;
        match self {
            Self::Direct(kernel) => {
                let domain = |source| place.domain(source);
                let mut moments = Moments::zero(count + BEYOND);
                let static_part = kernel.static_field(r, z).map_err(domain)?;
                let floor = static_part.map(|s| MOMENT_SHARE * s.abs());
                let both = (&mut moments.averages[..], &mut moments.first[..]);
                let [error, of_moments] = kernel.cells(r, z, step, &floor, both).map_err(domain)?;
                Ok(Cells {
                    static_part,
                    smooth: moments.absorbed(),
                    moments,
                    // the force rises and falls once
                    error: error.map(|e| 2.0 * e),
                    moment_error: of_moments,
                })
            }
            Self::Table(table) => {
                let outside = |source| place.outside(source);
                let (static_part, moments) = table
                    .moments(poisson_ratio, r, z, step, count + BEYOND)
                    .map_err(outside)?;
                let error = table_error(table, poisson_ratio, [r, z], pulse).map_err(outside)?;
                Ok(Cells {
                    static_part,
                    smooth: moments.absorbed(),
                    moments,
                    error,
                    moment_error: Six::default(),
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
    /// How many cells.
    pub count: usize,
    /// Of the force, for the table's error.
    pub pulse: Pulse,
}

/// What a table's error depends on of a force; lengths in r0/c1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pulse {
    /// As smooth as sin^4(pi t/T) of this length.
    Smooth(f64),
    /// Of a contact of this duration, which begins and ends with the power 3/2.
    Contact(f64),
}

/// Estimated absolute error of each field looked up, for a force of unit peak.
///
/// Tables are measured with pulses sin^4. Within a time L of its ends a contact of duration T reaches (pi L/T)^(3/2) of its
/// largest force, as a pulse of that length would: the errors of the shorter pulses count with that share.
///
/// # Errors
/// [`LookupError`] outside the table.
pub fn table_error(
    table: &Table,
    poisson_ratio: f64,
    [r, z]: [f64; 2],
    pulse: Pulse,
) -> Result<Six, LookupError> {
    let of = |length: f64| table.error(poisson_ratio, r, z, length);
    match pulse {
        Pulse::Smooth(length) => of(length),
        Pulse::Contact(duration) => {
            let mut error = of(duration)?;
            let lengths = &table.content().pulse_lengths;
            for &length in lengths.iter().filter(|&&length| length < duration) {
                let share = (PI * length / duration).powf(1.5).min(1.0);
                for (all, own) in error.iter_mut().zip(of(length)?) {
                    *all += share * own;
                }
            }
            Ok(error)
        }
    }
}
