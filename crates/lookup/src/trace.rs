//! Remainder at any point of a table: interpolated cells, tail, exact static part and error estimate.

use crate::content::Slice;
use crate::error::LookupError;
use crate::ratio;
use crate::series::gather::PatchNodes;
use crate::series::stencil::Stencil;
use crate::series::{Moments, Numbers, Series, Smoothness, smooth};
use crate::table::Table;
use halfspace::{Medium, Profile, Six};

/// Largest coarsening: a cell of 2^20 table cells.
const MAX_COARSENING: u32 = 20;

/// Ratio of cell width to that of the table above which the moments are computed from the averages of the table's cells
/// alone. A front within a cell of the table then loses less than a thousandth of its height, and the loss is weighted
/// with the square of the time step over the length of the force. `wide_cells_need_averages_alone` fails below 8.
const COARSE: f64 = 16.0;

/// Static part, cell width and error of a trace.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct TraceInfo {
    /// Static field under a unit force, in closed form.
    pub static_part: Six,
    /// Width of the cells of the trace in r0/c1.
    pub cell_width: f64,
    /// Estimated absolute error of the response to a pulse of unit peak that is ten cells long; it is smaller for
    /// longer pulses, see [`Table::error`].
    pub error: Six,
}

impl Table {
    /// Fills `cells[j]` with the average of R over [j w, (j + 1) w], where w is 2^`coarsening` table cells, corrected
    /// for the `smoothness` of the force.
    ///
    /// `cells` may have any length: after the tabulated cells the tail continues the trace.
    ///
    /// Cells before the first arrival equal minus the static part up to the interpolation error. They are not set to it
    /// exactly: around a front the errors of neighbouring cells cancel, because the time integral of R is smooth in
    /// space behind the front, and exact cells ahead of it would spoil that cancellation.
    ///
    /// # Errors
    /// [`LookupError`] if a coordinate, Poisson's ratio or the coarsening is outside the table.
    pub fn trace(
        &self,
        smoothness: Smoothness,
        poisson_ratio: f64,
        r: f64,
        z: f64,
        coarsening: u32,
        cells: &mut [Six],
    ) -> Result<TraceInfo, LookupError> {
        self.plan(smoothness, poisson_ratio, coarsening)?
            .trace([r, z], cells)
    }

    /// [`Self::trace`] at many points (r, z); `cells` and `infos` contain the traces one after the other.
    ///
    /// The work that depends on Poisson's ratio only is done once; several threads can each fill a part of the points.
    /// Each point has an equal share of `cells`.
    ///
    /// # Errors
    /// As [`Self::trace`], and [`LookupError::Lengths`] if the lengths of `infos` or `cells` do not fit the points.
    /// The traces of the points before the failing one are filled.
    pub fn traces(
        &self,
        smoothness: Smoothness,
        poisson_ratio: f64,
        points: &[[f64; 2]],
        coarsening: u32,
        cells: &mut [Six],
        infos: &mut [TraceInfo],
    ) -> Result<(), LookupError> {
        let count = cells.len() / points.len().max(1);
        if infos.len() != points.len() || cells.len() != count * points.len() {
            return Err(LookupError::Lengths {
                points: points.len(),
                infos: infos.len(),
                cells: cells.len(),
            });
        }
        if count == 0 {
            return Ok(());
        }
        let plan = self.plan(smoothness, poisson_ratio, coarsening)?;
        let traces = cells.chunks_exact_mut(count).zip(infos);
        for (&point, (cells, info)) in points.iter().zip(traces) {
            *info = plan.trace(point, cells)?;
        }
        Ok(())
    }

    /// The interpolated remainder at a point, which can fill cells of any width.
    ///
    /// # Errors
    /// As [`Self::trace`].
    pub fn series(&self, poisson_ratio: f64, r: f64, z: f64) -> Result<Series, LookupError> {
        let plan = self.plan(Smoothness::Smooth, poisson_ratio, 0)?;
        plan.series([r, z], usize::MAX)
    }

    /// The static field at a point, and the averages and moments of the remainder over `count` cells of a `width` in
    /// r0/c1.
    ///
    /// # Errors
    /// As [`Self::trace`].
    pub fn moments(
        &self,
        poisson_ratio: f64,
        r: f64,
        z: f64,
        width: f64,
        count: usize,
    ) -> Result<(Six, Moments), LookupError> {
        let (static_part, series) = self.until(poisson_ratio, r, z, width, count)?;
        Ok((static_part, series.moments(width, count)))
    }

    /// The static field at a point, and the remainder over `count` cells that are at least `width` wide, in r0/c1.
    ///
    /// # Errors
    /// As [`Self::trace`].
    pub fn until(
        &self,
        poisson_ratio: f64,
        r: f64,
        z: f64,
        width: f64,
        count: usize,
    ) -> Result<(Six, Series), LookupError> {
        let mut plan = self.plan(Smoothness::Smooth, poisson_ratio, 0)?;
        if width >= COARSE * plan.width {
            plan.smoothness = Smoothness::Linear;
        }
        let table_cells = (count as f64 * width / plan.width).ceil() as usize;
        let series = plan.series([r, z], table_cells)?;
        Ok((plan.medium.static_field(Profile::Hertz, r, z)?, series))
    }

    fn plan(
        &self,
        smoothness: Smoothness,
        poisson_ratio: f64,
        coarsening: u32,
    ) -> Result<TraceSetting<'_>, LookupError> {
        if coarsening > MAX_COARSENING {
            return Err(LookupError::Coarsening {
                value: coarsening,
                max: MAX_COARSENING,
            });
        }
        // before the medium, so that a ratio outside the physics is reported as outside the table
        let slices = ratio::weights(&self.served, poisson_ratio)?;
        let medium = match slices[..] {
            [(tabulated, _)] => self.served[tabulated].medium.clone(),
            _ => Medium::new(poisson_ratio)?,
        };
        Ok(TraceSetting {
            table: self,
            smoothness,
            width: self.content().cell_width * ratio::scale(&medium)?,
            medium,
            coarsening,
            slices,
        })
    }
}

/// The part of a trace that does not depend on the point.
struct TraceSetting<'a> {
    table: &'a Table,
    smoothness: Smoothness,
    medium: Medium,
    coarsening: u32,
    slices: Vec<(usize, f64)>,
    width: f64,
}

impl TraceSetting<'_> {
    fn trace(&self, [r, z]: [f64; 2], cells: &mut [Six]) -> Result<TraceInfo, LookupError> {
        let series = self.series([r, z], cells.len())?;
        let static_part = self.medium.static_field(Profile::Hertz, r, z)?;
        let cell_width = self.width * f64::from(1_u32 << self.coarsening);
        let error = self
            .table
            .error(self.medium.poisson_ratio(), r, z, 10.0 * cell_width)?;
        series.fill(self.smoothness, self.coarsening, cells);
        Ok(TraceInfo {
            static_part,
            cell_width,
            error,
        })
    }

    /// The interpolated series at a place, as far as `count` cells need it.
    fn series(&self, place: [f64; 2], count: usize) -> Result<Series, LookupError> {
        let content = self.table.content();
        let mesh = self.table.mesh(place)?;
        let points = content.stencil_points;
        let across = Stencil::mirrored(&content.r, mesh[0], place[0], points);
        let down = Stencil::one_sided(&content.z, mesh[1], place[1], points);
        let cells = content.slices[self.slices[0].0].cells;
        let is_smooth = self.smoothness == Smoothness::Smooth;
        let beyond = if is_smooth { smooth::BEYOND } else { 0 };
        let wanted = count
            .saturating_add(beyond)
            .saturating_mul(1 << self.coarsening);
        let stored = wanted.min(cells);
        let terms = content.slices[self.slices[0].0].tail_terms(content.r.len() * content.z.len());
        let nodes = PatchNodes::new(&across, &down, content.z.len());
        let sum = |values: fn(&Slice) -> &[f32], length: usize, used: usize| {
            let weighted = |&(slice, weight)| (values(&content.slices[slice]), weight);
            let slices: Vec<_> = self.slices.iter().map(weighted).collect();
            nodes.sums(&slices, length, used)
        };
        let in_cells = if is_smooth { stored } else { 0 };
        let numbers: Numbers = [
            sum(|slice| &slice.remainder, cells, stored),
            sum(|slice| &slice.moment, cells, in_cells),
            sum(|slice| &slice.curvature, cells, in_cells),
            sum(|slice| &slice.tail, terms, terms),
        ];
        Ok(Series::new(self.width, cells, numbers))
    }
}
