//! The remainder at one place as a function of time: polynomials on segments that halve toward the fronts.
//!
//! A cell average taken as a difference of int R dt carries the rounding of int R dt over the width of the cell; far from
//! the load, where R is small and cells are short beside the time of travel, nothing is left of it. Here R itself is
//! interpolated on segments that halve toward the fronts. Their number depends on the fronts and on the tolerance, not on
//! the cells.

use crate::arrivals::Arrivals;
use crate::domain::{check, check_hertz, check_place_under, check_time, check_width};
use crate::error::DomainError;
use crate::field::{Estimate, Six};
use crate::interpolation::segments;
use crate::kernel::Kernel;
use crate::segment::Segment;

/// R(t) at one place up to an end, ready for averages and first moments over any intervals.
///
/// Made by [`Kernel::trace`]. Its cost depends on the place and the tolerance, not on the number of intervals; an
/// interval then takes less than a microsecond.
///
/// ```
/// use halfspace::{Field, Kernel, Medium, Profile};
/// let kernel = Kernel::new(&Medium::new(0.3)?, Profile::Hertz, 1e-8)?;
/// // 200 radii out on the surface, where the Rayleigh wave passes at t = 402
/// let trace = kernel.trace(200.0, 0.0, 420.0)?;
/// let (average, _moment) = trace.cell(400.0, 400.1)?;
/// let middle = kernel.remainder(200.0, 0.0, 400.05)?;
/// let w = Field::DisplacementZ.index();
/// assert!((average.value[w] - middle.value[w]).abs() < 1e-6);
/// # Ok::<(), halfspace::DomainError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Trace {
    first_arrival: f64,
    end: f64,
    static_field: Six,
    segments: Vec<Segment>,
}

impl Kernel {
    /// R(t) at (r, z) for t from 0 to `end`.
    ///
    /// Accuracy: the kernel's tolerance, as a fraction of each field's peak over the time of the trace, at any distance
    /// to 1e4.
    ///
    /// # Errors
    /// [`DomainError`] for r, z or end outside [0, 1e20], and for a profile other than Hertz, whose stresses are infinite
    /// at fronts.
    pub fn trace(&self, r: f64, z: f64, end: f64) -> Result<Trace, DomainError> {
        check_place_under(self.profile(), r, z)?;
        check_time(end)?;
        check_hertz(self.profile(), "a trace")?;
        let arrivals = Arrivals::new(self.medium(), self.profile(), r, z)?;
        let static_field = self.static_field(r, z)?;
        let first_arrival = self.first_arrival(r, z);
        let segments = segments(
            &arrivals.sorted(),
            (first_arrival, end),
            &static_field,
            self.tolerance(),
            |t| self.remainder(r, z, t),
        )?;
        Ok(Trace {
            first_arrival,
            end,
            static_field,
            segments,
        })
    }
}

impl Trace {
    /// Average and first moment of R over a cell from `from` to `to`.
    ///
    /// ```text
    /// 1/width int R dt          1/width^2 int (t - centre) R dt
    /// ```
    ///
    /// # Errors
    /// [`DomainError`] for a cell that is empty or reaches beyond the trace.
    pub fn cell(&self, from: f64, to: f64) -> Result<(Estimate, Estimate), DomainError> {
        check(from >= 0.0, "from", from, "[0, to)")?;
        check(to > from, "to", to, "(from, end of the trace]")?;
        check(to <= self.end, "to", to, "(from, end of the trace]")?;
        let next = self
            .segments
            .partition_point(|segment| segment.times[1] <= from);
        Ok(self.cell_from(next, from, to))
    }

    /// The same from a segment known to be the first that the cell meets.
    fn cell_from(&self, first: usize, from: f64, to: f64) -> (Estimate, Estimate) {
        /// A cell this short in units of the rounding error of its time is an instant.
        const INSTANT: f64 = 1e4;
        let (width, centre) = (to - from, 0.5 * (from + to));
        if width < INSTANT * f64::EPSILON * to {
            return self.instant(first, centre);
        }
        let mut sums = [Six::default(); 3];
        if from < self.first_arrival {
            let until = to.min(self.first_arrival);
            let (length, arm) = (until - from, 0.5 * (until + from) - centre);
            for (f, s) in self.static_field.into_iter().enumerate() {
                let area = -length * s;
                sums[0][f] += area;
                sums[1][f] += arm * area;
                sums[2][f] += f64::EPSILON * area.abs();
            }
        }
        for segment in &self.segments[first..] {
            if segment.times[0] >= to {
                break;
            }
            let part = [from.max(segment.times[0]), to.min(segment.times[1])];
            if part[1] > part[0] {
                segment.add(part[0], part[1], centre, &mut sums);
            }
        }
        let [area, moment, error] = sums;
        let average = Estimate {
            value: area.map(|v| v / width),
            error: error.map(|v| v / width),
        };
        // |t - centre| is at most half the width
        let moment = Estimate {
            value: moment.map(|v| v / (width * width)),
            error: error.map(|v| 0.5 * v / width),
        };
        (average, moment)
    }

    /// R at an instant, as average, and no moment.
    fn instant(&self, first: usize, t: f64) -> (Estimate, Estimate) {
        let before = || Estimate {
            value: self.static_field.map(|v| -v),
            error: self.static_field.map(|v| f64::EPSILON * v.abs()),
        };
        let average = match self.segments.get(first).or(self.segments.last()) {
            Some(segment) if t > self.first_arrival => segment.at(t),
            Some(_) | None => before(),
        };
        let moment = Estimate {
            value: Six::default(),
            error: average.error,
        };
        (average, moment)
    }

    /// Calls `f` with the index, the average and the first moment of each of `count` cells of `width`, from time zero.
    ///
    /// # Errors
    /// [`DomainError`] for a width outside [1e-20, 1e20] and for cells that reach beyond the trace.
    pub fn for_each_cell(
        &self,
        width: f64,
        count: usize,
        mut f: impl FnMut(usize, Estimate, Estimate),
    ) -> Result<(), DomainError> {
        check_width(width)?;
        let end = count as f64 * width;
        check(end <= self.end, "t", end, "[0, end of the trace]")?;
        let mut first = 0;
        for j in 0..count {
            let (from, to) = (j as f64 * width, (j + 1) as f64 * width);
            while first < self.segments.len() && self.segments[first].times[1] <= from {
                first += 1;
            }
            let (average, moment) = self.cell_from(first, from, to);
            f(j, average, moment);
        }
        Ok(())
    }
}
