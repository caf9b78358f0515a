//! Averages of the remainder over time cells.
//!
//! A force that is linear between samples a step apart is convolved exactly with cell averages of R. Near the load they
//! are differences of int R dt, which is the same single integral with potentials one order higher: one evaluation a
//! cell, smoother at the fronts than R, and exact. After the last arrival int R dt is a smooth function of 1/t, and a long
//! tail of cells is taken from its Chebyshev interpolant.
//!
//! The difference divides the error of int R dt, whose terms are of order one at any distance, by the width, while R
//! falls with the distance. Where the cells are short beside the distance, or many, R itself is interpolated, see
//! [`trace`](crate::trace).
//!
//! Theory: `docs/theory.md` (T22, T23).

use crate::domain::{check_place_under, check_time, check_width};
use crate::error::DomainError;
use crate::field::{Estimate, Six};
use crate::kernel::Kernel;
use crate::profile::Profile;
use crate::tail::Tail;

impl Kernel {
    /// Fills `cells[j]` with the average of R over [j width, (j + 1) width]; returns an error per field.
    ///
    /// Accuracy: about ten times the tolerance at a width of 0.1 near the load, and never less than twenty times the
    /// tolerance of each field's peak, see [`Kernel::trace`]; a smaller tolerance gives a smaller error.
    ///
    /// # Errors
    /// [`DomainError`] for r, z or the end of the last cell outside [0, 1e20], or a width outside [1e-20, 1e20].
    pub fn cell_averages(
        &self,
        r: f64,
        z: f64,
        width: f64,
        cells: &mut [Six],
    ) -> Result<Six, DomainError> {
        check_place_under(self.profile(), r, z)?;
        check_width(width)?;
        let end = cells.len() as f64 * width;
        check_time(end)?;
        if self.prefers_trace(r, z, width, end) {
            let trace = self.trace(r, z, end)?;
            let mut error = Six::default();
            trace.for_each_cell(width, cells.len(), |j, average, _| {
                cells[j] = average.value;
                for (largest, e) in error.iter_mut().zip(average.error) {
                    *largest = largest.max(e);
                }
            })?;
            return Ok(error);
        }
        let rest = self.static_field(r, z)?;
        let arrival = self.first_arrival(r, z);
        let mut error = rest.map(|s| f64::EPSILON * s.abs());
        let tail = Tail::new(self, r, z, width, end)?;
        let mut before: Option<Estimate> = None;
        for (j, cell) in cells.iter_mut().enumerate() {
            let (from, to) = (j as f64 * width, (j + 1) as f64 * width);
            if to <= arrival {
                *cell = rest.map(|s| -s);
                continue;
            }
            let start = match before {
                Some(start) => start,
                None => self.step_integral(r, z, from)?,
            };
            let end = match &tail {
                Some(tail) if to >= tail.from => tail.value(to),
                Some(_) | None => self.step_integral(r, z, to)?,
            };
            for f in 0..6 {
                cell[f] = (end.value[f] - start.value[f]) / width;
                error[f] = error[f].max((end.error[f] + start.error[f]) / width);
            }
            before = Some(end);
        }
        Ok(error)
    }

    /// Whether cells of `width` up to `end` are better taken from R than from differences of its integral.
    ///
    /// With R of the order of 1/distance, the difference has a relative error of the tolerance times distance over width.
    pub(crate) fn prefers_trace(&self, r: f64, z: f64, width: f64, end: f64) -> bool {
        /// Least width over the distance for differences.
        const NARROW: f64 = 2e-3;
        /// Cells from the first arrival on whose edges cost more than the panels of a trace.
        const MANY: f64 = 1000.0;
        let moving = end - self.first_arrival(r, z);
        match self.profile() {
            Profile::Hertz => {
                moving > 0.0 && (width < NARROW * (1.0 + r.hypot(z)) || moving > MANY * width)
            }
            Profile::Punch | Profile::Point => false,
        }
    }
}
