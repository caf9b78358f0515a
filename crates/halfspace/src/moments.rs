//! First moments of the remainder over time cells.
//!
//! With them a convolution is exact for a force that is a parabola over a cell, where averages alone take
//! it as linear. Where R is smooth over five cells the moment follows from the averages around it; where a
//! front crosses them it comes from int R dt and its own integral, and far from the load from R itself, as averages do.
//!
//! Theory: `docs/theory.md` (T24).

use crate::domain::{check_hertz, check_place_under, check_time, check_width};
use crate::error::DomainError;
use crate::field::{Estimate, Six};
use crate::kernel::Kernel;

impl Kernel {
    /// [`Self::cell_averages`] and [`Self::cell_moments`] at once, the errors of both: far from the load, where both follow
    /// from one trace, in half the time.
    ///
    /// # Errors
    /// [`DomainError`] as both.
    pub fn cells(
        &self,
        r: f64,
        z: f64,
        width: f64,
        floor: &Six,
        (averages, moments): (&mut [Six], &mut [Six]),
    ) -> Result<[Six; 2], DomainError> {
        check_hertz(self.profile(), "a cell moment")?;
        check_place_under(self.profile(), r, z)?;
        check_width(width)?;
        let end = moments.len() as f64 * width;
        check_time(end)?;
        if averages.len() == moments.len() && self.prefers_trace(r, z, width, end) {
            let mut errors = [Six::default(); 2];
            let trace = self.trace(r, z, end)?;
            trace.for_each_cell(width, moments.len(), |j, average, moment| {
                averages[j] = average.value;
                moments[j] = moment.value;
                raise(&mut errors[0], &average.error);
                raise(&mut errors[1], &moment.error);
            })?;
            return Ok(errors);
        }
        let error = self.cell_averages(r, z, width, averages)?;
        let of_moments = self.cell_moments(r, z, width, averages, floor, moments)?;
        Ok([error, of_moments])
    }

    /// Fills `moments[j]` with the first moment of R over cell j of `width`; returns an error per field.
    ///
    /// ```text
    /// M_j = 1/width^2 int (t - t_j) R dt,   t_j the middle of the cell
    /// ```
    ///
    /// `averages` are those of [`Self::cell_averages`] at the same point and width, and as many; `floor` is
    /// the absolute error, field by field, to which moments of smooth cells may be taken from their neighbours.
    ///
    /// # Errors
    /// [`DomainError`] as [`Self::cell_averages`], for a profile other than Hertz, and for slices of different lengths.
    pub fn cell_moments(
        &self,
        r: f64,
        z: f64,
        width: f64,
        averages: &[Six],
        floor: &Six,
        moments: &mut [Six],
    ) -> Result<Six, DomainError> {
        check_hertz(self.profile(), "a cell moment")?;
        check_place_under(self.profile(), r, z)?;
        check_width(width)?;
        check_time(moments.len() as f64 * width)?;
        if averages.len() != moments.len() {
            return Err(DomainError::Lengths {
                averages: averages.len(),
                moments: moments.len(),
            });
        }
        let end = moments.len() as f64 * width;
        let mut error = Six::default();
        if self.prefers_trace(r, z, width, end) {
            let trace = self.trace(r, z, end)?;
            trace.for_each_cell(width, moments.len(), |j, _, moment| {
                moments[j] = moment.value;
                raise(&mut error, &moment.error);
            })?;
            return Ok(error);
        }
        let quiet = (self.first_arrival(r, z) / width) as usize;
        let mut before: Option<Edge> = None;
        for (j, moment) in moments.iter_mut().enumerate() {
            if j < quiet {
                *moment = Six::default();
                continue;
            }
            if let Some(smooth) = smooth_moment(averages, j, floor) {
                *moment = smooth.value;
                raise(&mut error, &smooth.error);
                before = None;
                continue;
            }
            let start = match before {
                Some(edge) => edge,
                None => self.edge(r, z, j as f64 * width)?,
            };
            let end = self.edge(r, z, (j + 1) as f64 * width)?;
            let exact = exact_moment(&start, &end, width);
            *moment = exact.value;
            raise(&mut error, &exact.error);
            before = Some(end);
        }
        Ok(error)
    }

    fn edge(&self, r: f64, z: f64, t: f64) -> Result<Edge, DomainError> {
        Ok(Edge {
            first: self.step_integral(r, z, t)?,
            second: self.second_integral(r, z, t)?,
        })
    }
}

/// S = int R dt and int S dt at the edge of a cell.
#[derive(Clone, Copy)]
struct Edge {
    first: Estimate,
    second: Estimate,
}

/// width (S_0 + S_1)/2 - int S dt, over width^2.
fn exact_moment(start: &Edge, end: &Edge, width: f64) -> Estimate {
    let value = std::array::from_fn(|f| {
        // relative to S at the start, which may hold a large constant
        let trapezoid = 0.5 * width * (end.first.value[f] - start.first.value[f]);
        let area = end.second.value[f] - start.second.value[f] - width * start.first.value[f];
        (trapezoid - area) / (width * width)
    });
    let error = std::array::from_fn(|f| {
        let once = 0.5 * (end.first.error[f] + start.first.error[f]);
        let twice = end.second.error[f] + start.second.error[f];
        (once + twice / width) / width
    });
    Estimate { value, error }
}

/// Raises each field of `largest` to `error`.
fn raise(largest: &mut Six, error: &Six) {
    for (largest, e) in largest.iter_mut().zip(error) {
        *largest = largest.max(*e);
    }
}

/// Moment of cell `j` to fourth order from the averages around it, where R is smooth over five cells.
fn smooth_moment(averages: &[Six], j: usize, floor: &Six) -> Option<Estimate> {
    if j < 2 || j + 2 >= averages.len() {
        return None;
    }
    let (mut moment, mut error) = (Six::default(), Six::default());
    for f in 0..6 {
        let near = averages[j + 1][f] - averages[j - 1][f];
        let far = averages[j + 2][f] - averages[j - 2][f];
        moment[f] = near * 41.0 / 720.0 - far * 11.0 / 1440.0;
        // the second term is what a lower order leaves out: where it is small, what is left out here is smaller
        error[f] = (moment[f] - near / 24.0).abs();
        if error[f] > 8.0 * floor[f] {
            return None;
        }
    }
    Some(Estimate {
        value: moment,
        error,
    })
}
