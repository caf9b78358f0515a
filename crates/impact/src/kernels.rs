//! Kernels as cell averages at a point: computed, or looked up.

use crate::error::ImpactError;
use halfspace::{Damping, DomainError, Kernel, Medium, Profile, Six, Trace};
use lookup::{LookupError, Moments, Table};
use std::f64::consts::PI;
use std::sync::Arc;

/// Source of the cell averages.
#[derive(Debug, Clone)]
pub enum KernelSource {
    /// Computed for each point: any step, no table.
    Direct(Arc<Kernel>),
    /// Interpolated in a table; the step is a power of two of its cells.
    Table(Arc<Table>),
}

/// Cells at one point with their errors.
#[derive(Debug, Clone)]
pub struct Cells {
    /// Static field under unit force.
    pub static_part: Six,
    /// Averages and moments of the remainder over the cells wanted and [`lookup::BEYOND`] more.
    pub moments: Moments,
    /// The requested cells, with the weights of their moments under a smooth force.
    pub smooth: Vec<Six>,
    /// Error of the response to a force of unit peak.
    pub error: Six,
    /// Averages over parts of the first cells, as many as [`CellPlan::parts`], if they were looked up.
    pub fine: Vec<Six>,
    /// The remainder at any time, if it was computed.
    pub trace: Option<Trace>,
}

impl Cells {
    /// Of a trace that is added to a static part.
    pub(crate) fn of_trace(
        trace: Trace,
        static_part: Six,
        wanted: &CellPlan<'_>,
    ) -> Result<Self, DomainError> {
        let mut moments = Moments::with_capacity(wanted.count);
        let keep = |_, cell| moments.push(cell);
        trace.for_each_cell(wanted.step, wanted.count, keep)?;
        Ok(Self {
            static_part,
            smooth: moments.absorbed(),
            moments,
            // the force rises and falls once
            error: trace.error.map(|e| 2.0 * e),
            fine: Vec::new(),
            trace: Some(trace),
        })
    }

    /// The response at a time after a jump of the force from zero to one, in cells of `step` in the same unit of time.
    ///
    /// At an arrival it is the later value. Cells alone are read as in [`Self::error_at_instants`].
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

    /// Error of the remainder at a single time in addition to the error of the kernels: zero for a trace; for cells,
    /// whose moments define parabolas, the deviation of a front within the cell from its parabola.
    ///
    /// The kernel is not smooth where neighbouring parabolas do not meet, or their slope or bend differs from that of
    /// the averages. `looked_up_jumps_are_within_their_estimates` fails without it.
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

    /// Total variation of each field's step response, which is the largest response to a force with values up to one,
    /// and the largest change between neighbouring cells.
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

/// The remainder within a cell from its moments, s from -1/2 to 1/2.
fn parabola(moments: &Moments, cell: usize, s: f64) -> Six {
    let [average, first, second] =
        [&moments.averages, &moments.first, &moments.second].map(|own| &own[cell]);
    std::array::from_fn(|f| average[f] + 12.0 * s * first[f] + (180.0 * s * s - 15.0) * second[f])
}

/// Fraction of the tolerance for a trace under a force that jumps, which shows the trace itself.
///
/// `fields_under_jumps_are_those_of_steps_within_their_estimates` fails without it.
const AT_INSTANTS: f64 = 0.1;

/// Fraction of the tolerance for a trace of rates of the displacements: a force begins more steeply, with the power
/// 1/2.
const RATES: f64 = 0.01;

impl KernelSource {
    /// Kernels of a half-space computed to a relative tolerance in [1e-14, 0.1].
    ///
    /// # Errors
    /// [`DomainError`] for a tolerance outside its range.
    pub fn direct(medium: &Medium, tolerance: f64) -> Result<Self, DomainError> {
        Ok(Self::Direct(Arc::new(Self::kernel(medium, tolerance)?)))
    }

    /// The exact kernels of a half-space under Hertz's pressure.
    fn kernel(medium: &Medium, tolerance: f64) -> Result<Kernel, DomainError> {
        Kernel::new(medium, Profile::Hertz, tolerance)
    }

    /// The kernels for fields of a tolerance: far away the waves of a slow contact nearly cancel.
    pub(crate) fn for_fields(medium: &Medium, tolerance: f64) -> Result<Arc<Kernel>, DomainError> {
        let tolerance = (1e-1 * tolerance).clamp(1e-12, 1e-3);
        Ok(Arc::new(Self::kernel(medium, tolerance)?))
    }

    /// Step in r0/c1 of at most `wanted`, unless the table has no step so short.
    ///
    /// Powers of two even without a table, so that both sources have the same samples.
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

    /// Number of parts of a cell of a width in r0/c1 that the cells of a table resolve; none for computed kernels.
    pub(crate) fn parts(&self, poisson_ratio: f64, step: f64) -> Option<usize> {
        match self {
            Self::Direct(_) => None,
            Self::Table(table) => {
                let cell = table.cell_width(poisson_ratio).unwrap_or(step);
                Some(((step / cell) as usize).max(1))
            }
        }
    }

    /// Largest r and z in radii of a table; none for computed kernels.
    pub(crate) fn table_reach(&self) -> Option<[f64; 2]> {
        match self {
            Self::Direct(_) => None,
            Self::Table(table) => Some(table.reach()),
        }
    }

    /// The cells at (r, z) in radii of a disc; its radius in m is used in messages.
    ///
    /// # Errors
    /// [`ImpactError`] for a point outside the half-space or the table.
    pub fn cells(
        &self,
        poisson_ratio: f64,
        [r, z]: [f64; 2],
        disc_radius_m: f64,
        wanted: CellPlan<'_>,
    ) -> Result<Cells, ImpactError> {
        let (step, count, pulse) = (wanted.step, wanted.count, wanted.pulse);
        let [r_m, z_m] = [r, z].map(|x| x * disc_radius_m);
        match self {
            Self::Direct(kernel) => {
                let domain = |source| ImpactError::OutsideBlock { r_m, z_m, source };
                let static_part = kernel.static_field(r, z).map_err(domain)?;
                let trace = wanted.trace(&static_part, |end, wanted| {
                    kernel.trace_under(r, z, end, wanted)
                });
                let trace = trace.map_err(domain)?;
                Cells::of_trace(trace, static_part, &wanted).map_err(domain)
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
                let fine = series.averages(
                    step / parts as f64,
                    if parts > 1 { parts * until } else { 0 },
                );
                let error = table_error(table, poisson_ratio, [r, z], pulse).map_err(outside)?;
                Ok(Cells {
                    static_part,
                    smooth: moments.absorbed(),
                    moments,
                    error,
                    fine,
                    trace: None,
                })
            }
        }
    }
}

/// Cells that a convolution needs; lengths of time in r0/c1.
#[derive(Debug, Clone, Copy)]
pub struct CellPlan<'a> {
    /// Width of a cell.
    pub step: f64,
    /// Number of cells, including [`lookup::BEYOND`].
    pub count: usize,
    /// Number of parts of each cell with looked-up averages, and number of cells that are divided.
    pub parts: [usize; 2],
    /// Of the force.
    pub pulse: Pulse,
    /// Whether rates of the fields are requested as well.
    pub rates: bool,
    /// Relative tolerance on the fields.
    pub tolerance: f64,
    /// Attenuation, and its reference frequency.
    pub damping: Option<(&'a Damping, f64)>,
}

impl CellPlan<'_> {
    /// A trace until the last cell ends, made `of` that end, and of tolerances and rises for each field; damped, if there is
    /// attenuation, as the rest of a static part.
    pub(crate) fn trace(
        &self,
        static_part: &Six,
        of: impl FnOnce(f64, (Six, &dyn Fn(f64) -> Six)) -> Result<Trace, DomainError>,
    ) -> Result<Trace, DomainError> {
        let has_rate = |f: usize| self.rates && f < 2;
        let rise = |length: f64| std::array::from_fn(|f| self.pulse.rise(length, has_rate(f)));
        let at_instants = if self.pulse.jump() > self.tolerance {
            AT_INSTANTS
        } else {
            1.0
        };
        let part = |f: usize| if has_rate(f) { RATES } else { at_instants };
        let tolerance = std::array::from_fn(|f| self.tolerance * part(f));
        // the last cell ends a rounding error before the trace
        let end = self.step * self.count as f64;
        let Some((damping, reference)) = self.damping else {
            return of(end, (tolerance, &rise));
        };
        let elastic = of(damping.reach(end, reference), (tolerance, &rise))?;
        elastic.damped(static_part, (damping, reference), end, (tolerance, &rise))
    }
}

/// Properties of a force that determine a table's error; lengths in r0/c1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pulse {
    /// As smooth as sin^4(pi t/T) of this length.
    Smooth(f64),
    /// Piecewise linear, as steep as such a pulse, with jumps of at most a fraction of its peak.
    Lines {
        /// Length of the pulse.
        length: f64,
        /// Largest jump relative to the peak.
        jump: f64,
    },
    /// A contact of this duration, which begins and ends with the power 3/2.
    Contact(f64),
}

impl Pulse {
    /// Largest jump relative to the peak.
    fn jump(self) -> f64 {
        match self {
            Self::Smooth(_) | Self::Contact(_) => 0.0,
            Self::Lines { jump, .. } => jump,
        }
    }

    /// Largest change of the force, and of its rate if `rates`, within a time, relative to its peak.
    fn rise(self, length: f64, rates: bool) -> f64 {
        let part = match self {
            // the remainder of R has either sign, so that the slope in the middle counts only in part
            Self::Contact(duration) => {
                const LINE: f64 = 0.6;
                let power = if rates { 0.5 } else { 1.5 };
                let part = PI * length / duration;
                part.powf(power).max(LINE * part)
            }
            // the rates of lines jump
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
/// Tables are measured with pulses sin^4. Within a time L of its ends a contact of duration T reaches (pi L/T)^(3/2) of
/// its largest force, like a pulse of that length, so the errors of the shorter pulses are weighted by that fraction.
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
                // at least as sharp as the shortest measured pulse
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
