//! Kernels as cell averages at a point: computed, or looked up.
//!
//! Which kernels a scene takes is chosen in [`source`].

pub mod source;

use crate::error::ImpactError;
use halfspace::{DomainError, Kernel, Medium, Profile, Six, Trace};
use lookup::{LookupError, Moments, Table};
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
    /// The remainder at any instant, where it was computed.
    pub trace: Option<Trace>,
}

impl Cells {
    /// Of each field's step response the total variation, which is the largest response to a force that is nowhere above
    /// one, and the largest change from one cell to the next.
    pub(crate) fn steps(&self) -> [[f64; 2]; 6] {
        let averages = &self.moments.averages;
        std::array::from_fn(|f| {
            let first = self.static_part[f] + averages.first().map_or(0.0, |cell| cell[f]);
            let steps = averages.windows(2).map(|c| (c[1][f] - c[0][f]).abs());
            steps.fold([first.abs(); 2], |[sum, most], step| {
                [sum + step, most.max(step)]
            })
        })
    }
}

/// Part of the tolerance that a trace has for rates, those of the displacements: with the power 1/2 a force begins steeper.
const RATES: f64 = 0.01;

/// Distance in radii to which pulses' fields from computed kernels have been shown to hold their tolerance.
const FARTHEST: f64 = 1e4;

impl KernelSource {
    /// Kernels of a half-space computed to a relative tolerance in [1e-14, 0.1].
    ///
    /// # Errors
    /// [`DomainError`] for a tolerance outside its range.
    pub fn direct(medium: &Medium, tolerance: f64) -> Result<Self, DomainError> {
        let kernel = Kernel::new(medium, Profile::Hertz, tolerance)?;
        Ok(Self::Direct(Arc::new(kernel)))
    }

    /// Step in r0/c1 not longer than `wanted`, unless the table has none so short.
    ///
    /// Powers of two also without a table, so that both sources give the same samples.
    pub(crate) fn step(&self, poisson_ratio: f64, wanted: f64) -> f64 {
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

    /// Largest r and z in radii at which its values are sure: beyond, computed ones lose digits.
    pub(crate) fn reach(&self) -> [f64; 2] {
        match self {
            Self::Direct(_) => [FARTHEST; 2],
            Self::Table(table) => [table.content().r_max, table.content().z_max],
        }
    }

    /// The cells at (r, z) in radii of a disc, whose radius in m is for messages.
    ///
    /// # Errors
    /// [`ImpactError`] for a point outside the half-space or the table.
    pub fn cells(
        &self,
        poisson_ratio: f64,
        [r, z]: [f64; 2],
        disc_radius_m: f64,
        wanted: CellPlan,
    ) -> Result<Cells, ImpactError> {
        let (step, count, pulse) = (wanted.step, wanted.count, wanted.pulse);
        let [r_m, z_m] = [r, z].map(|x| x * disc_radius_m);
        let (static_part, moments, error, trace) = match self {
            Self::Direct(kernel) => {
                let domain = |source| ImpactError::OutsideBlock { r_m, z_m, source };
                let has_rate = |f: usize| wanted.rates && f < 2;
                let rise = |length: f64| std::array::from_fn(|f| pulse.rise(length, has_rate(f)));
                let tolerance = std::array::from_fn(|f| {
                    wanted.tolerance * if has_rate(f) { RATES } else { 1.0 }
                });
                // the last cell ends a rounding error before the trace
                let end = step * count as f64;
                let trace = kernel.trace_under(r, z, end, (tolerance, &rise));
                let trace = trace.map_err(domain)?;
                let mut moments = Moments::with_capacity(count);
                let keep = |_, cell| moments.push(cell);
                trace.for_each_cell(step, count, keep).map_err(domain)?;
                let static_part = kernel.static_field(r, z).map_err(domain)?;
                // the force rises and falls once
                let error = trace.error.map(|e| 2.0 * e);
                (static_part, moments, error, Some(trace))
            }
            Self::Table(table) => {
                let outside = |source| ImpactError::OutsideTable {
                    r_m,
                    z_m,
                    disc_radius_m,
                    source,
                };
                let found = table.moments(poisson_ratio, r, z, step, count);
                let (static_part, moments) = found.map_err(outside)?;
                let error = table_error(table, poisson_ratio, [r, z], pulse).map_err(outside)?;
                (static_part, moments, error, None)
            }
        };
        Ok(Cells {
            static_part,
            smooth: moments.absorbed(),
            moments,
            error,
            trace,
        })
    }
}

/// Which cells a convolution needs; lengths of time in r0/c1.
#[derive(Debug, Clone, Copy)]
pub struct CellPlan {
    /// Width of a cell.
    pub step: f64,
    /// How many cells, [`lookup::BEYOND`] among them.
    pub count: usize,
    /// Of the force.
    pub pulse: Pulse,
    /// Whether rates of the fields are asked for, too.
    pub rates: bool,
    /// Relative tolerance on the fields.
    pub tolerance: f64,
}

/// What a table's error depends on of a force; lengths in r0/c1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pulse {
    /// As smooth as sin^4(pi t/T) of this length.
    Smooth(f64),
    /// Of a contact of this duration, which begins and ends with the power 3/2.
    Contact(f64),
}

impl Pulse {
    /// The most by which the force, and its rate where `rates`, may change within a time, over its peak.
    fn rise(self, length: f64, rates: bool) -> f64 {
        let part = match self {
            // what is left of R is of either sign, so that the slope in the middle counts for a part
            Self::Contact(duration) => {
                const LINE: f64 = 0.6;
                let power = if rates { 0.5 } else { 1.5 };
                let part = PI * length / duration;
                part.powf(power).max(LINE * part)
            }
            // lines have rates that jump
            Self::Smooth(_) if rates => 1.0,
            Self::Smooth(duration) => 1.3 * PI * length / duration,
        };
        part.min(1.0)
    }
}

/// Estimated absolute error of each field looked up, for a force of unit peak.
///
/// Tables are measured with pulses sin^4. Within a time L of its ends a contact of duration T reaches (pi L/T)^(3/2) of its
/// largest force, as a pulse of that length would: the errors of the shorter pulses count by that fraction.
///
/// # Errors
/// [`LookupError`] outside the table.
pub(crate) fn table_error(
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
                let fraction = (PI * length / duration).powf(1.5).min(1.0);
                for (all, own) in error.iter_mut().zip(of(length)?) {
                    *all += fraction * own;
                }
            }
            Ok(error)
        }
    }
}
