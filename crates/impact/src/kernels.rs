//! Kernels as cell averages at a point: computed, or looked up.

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
    /// Averages over parts of the first cells, as many as [`CellPlan::parts`] says, where they were looked up.
    pub fine: Vec<Six>,
    /// The remainder at any instant, where it was computed.
    pub trace: Option<Trace>,
}

impl Cells {
    /// The response to a force that jumps from zero to one, so long after it, in cells of `step` in the same unit of time.
    ///
    /// At an arrival it is that after it. Cells alone are read as in [`Self::error_at_instants`].
    pub(crate) fn step_response(&self, time: f64, step: f64) -> Six {
        let rest = match &self.trace {
            Some(trace) => trace.at(time),
            None => {
                let cell = (time / step).floor();
                match (cell as usize) < self.moments.averages.len() {
                    true => parabola(&self.moments, cell as usize, time / step - cell - 0.5),
                    false => Six::default(),
                }
            }
        };
        std::array::from_fn(|f| self.static_part[f] + rest[f])
    }

    /// How far the remainder may be off at an instant beside the error of the kernels: not at all of a trace; of cells, each
    /// of which is followed by the parabola of its moments, as far as a front that passes within one departs from it.
    ///
    /// Where the parabolas of neighbours do not meet, or have another slope or bend than the averages around, the kernel is
    /// not smooth. `looked_up_jumps_are_within_their_estimates` fails without it.
    pub(crate) fn error_at_instants(&self) -> Six {
        let mut most = Six::default();
        if self.trace.is_some() {
            return most;
        }
        let Moments {
            averages,
            first,
            second,
        } = &self.moments;
        for j in 0..averages.len().saturating_sub(1) {
            let [end, begin] =
                [(j, 0.5), (j + 1, -0.5)].map(|(j, s)| parabola(&self.moments, j, s));
            for (f, most) in most.iter_mut().enumerate() {
                let [own, after] = [j, j + 1].map(|j| averages[j][f]);
                let before = j
                    .checked_sub(1)
                    .map_or(2.0 * own - after, |j| averages[j][f]);
                let tilt = 12.0 * first[j][f] - 0.5 * (after - before);
                let bend = 180.0 * second[j][f] - 0.5 * (after - 2.0 * own + before);
                *most = most.max(tilt.abs() + bend.abs() + (end[f] - begin[f]).abs());
            }
        }
        most
    }

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

/// The remainder within a cell by its moments, s from -1/2 to 1/2.
fn parabola(moments: &Moments, cell: usize, s: f64) -> Six {
    let [average, first, second] =
        [&moments.averages, &moments.first, &moments.second].map(|own| &own[cell]);
    std::array::from_fn(|f| average[f] + 12.0 * s * first[f] + (180.0 * s * s - 15.0) * second[f])
}

/// Part of the tolerance that a trace has for a force that jumps, which shows it as it is.
///
/// `fields_under_jumps_are_those_of_steps_within_their_estimates` fails without it.
const AT_INSTANTS: f64 = 0.1;

/// Part of the tolerance that a trace has for rates, those of the displacements: with the power 1/2 a force begins steeper.
const RATES: f64 = 0.01;

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

    /// Parts of a cell of a width in r0/c1 that the cells of a table tell apart; 1 of kernels that are computed.
    pub(crate) fn parts(&self, poisson_ratio: f64, step: f64) -> usize {
        match self {
            Self::Direct(_) => 1,
            Self::Table(table) => {
                let cell = table.cell_width(poisson_ratio).unwrap_or(step);
                ((step / cell) as usize).max(1)
            }
        }
    }

    /// Largest r and z in radii of a table; none of kernels that are computed.
    pub(crate) fn table_reach(&self) -> Option<[f64; 2]> {
        match self {
            Self::Direct(_) => None,
            Self::Table(table) => Some(table.reach()),
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
        let mut fine = Vec::new();
        let (static_part, moments, error, trace) = match self {
            Self::Direct(kernel) => {
                let domain = |source| ImpactError::OutsideBlock { r_m, z_m, source };
                let has_rate = |f: usize| wanted.rates && f < 2;
                let rise = |length: f64| std::array::from_fn(|f| pulse.rise(length, has_rate(f)));
                let at_instants = if pulse.jump() > wanted.tolerance {
                    AT_INSTANTS
                } else {
                    1.0
                };
                let tolerance = std::array::from_fn(|f| {
                    wanted.tolerance * if has_rate(f) { RATES } else { at_instants }
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
                let found = table.until(poisson_ratio, r, z, step, count);
                let (static_part, series) = found.map_err(outside)?;
                let moments = series.moments(step, count);
                let [parts, until] = wanted.parts;
                fine = series.averages(
                    step / parts as f64,
                    if parts > 1 { parts * until } else { 0 },
                );
                let error = table_error(table, poisson_ratio, [r, z], pulse).map_err(outside)?;
                (static_part, moments, error, None)
            }
        };
        Ok(Cells {
            static_part,
            smooth: moments.absorbed(),
            moments,
            error,
            fine,
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
    /// Parts of each cell whose averages are looked up, too, and the number of cells of which they are.
    pub parts: [usize; 2],
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
    /// Of lines as steep as such a pulse, and of jumps, each up to this part of its peak.
    Lines {
        /// Length of the pulse.
        length: f64,
        /// Largest jump over the peak.
        jump: f64,
    },
    /// Of a contact of this duration, which begins and ends with the power 3/2.
    Contact(f64),
}

impl Pulse {
    /// Largest jump over the peak.
    fn jump(self) -> f64 {
        match self {
            Self::Smooth(_) | Self::Contact(_) => 0.0,
            Self::Lines { jump, .. } => jump,
        }
    }

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
            Self::Smooth(_) | Self::Lines { .. } if rates => 1.0,
            Self::Smooth(duration) => 1.3 * PI * length / duration,
            Self::Lines {
                length: duration,
                jump,
            } => (1.3 * PI * length / duration).max(jump),
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
    let errors = table.errors(poisson_ratio, r, z)?;
    match pulse {
        Pulse::Smooth(length) => Ok(errors.under(length)),
        Pulse::Lines { length, jump } => {
            let mut error = errors.under(length);
            if jump > 0.0 {
                // as sharp as the shortest pulse that was measured, at least
                let sharp = errors.under(table.content().pulse_lengths[0]);
                for (all, own) in error.iter_mut().zip(sharp) {
                    *all += jump * own;
                }
            }
            Ok(error)
        }
        Pulse::Contact(duration) => {
            let mut error = errors.under(duration);
            for (length, own) in errors.measured().filter(|(length, _)| *length < duration) {
                let fraction = (PI * length / duration).powf(1.5).min(1.0);
                for (all, own) in error.iter_mut().zip(own) {
                    *all += fraction * own;
                }
            }
            Ok(error)
        }
    }
}
