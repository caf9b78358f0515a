//! Averages of the remainder over time cells.
//!
//! A force that is linear between samples a step apart is convolved exactly with cell averages of R. They
//! are differences of int R dt, which is the same single integral with potentials one order higher: one
//! evaluation a cell, smoother at the fronts than R, and exact. Quadrature in time would take several
//! evaluations a cell and more in those with an arrival, where R has roots, logarithms and jumps,
//! so exact integration is faster at any accuracy; what it costs is the difference,
//! which divides the error of int R dt by the width. After the last arrival int R dt is a smooth function of
//! 1/t, and a long tail of cells is taken from its Chebyshev interpolant.

use crate::domain::{check_place_under, check_time, check_width};
use crate::error::DomainError;
use crate::field::{Estimate, Six};
use crate::kernel::Kernel;
use crate::tail::Tail;

impl Kernel {
    /// Fills `cells[j]` with the average of R over [j width, (j + 1) width]; returns an error per field.
    ///
    /// The error grows as 1/width, since averages are differences over the width: at a width of 0.1 it is
    /// about ten times the tolerance.
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
}
