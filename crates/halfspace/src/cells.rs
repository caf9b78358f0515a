//! Averages of the remainder over time cells.
//!
//! A force that is linear between samples a step apart is convolved exactly with cell averages of R. They
//! are differences of int R dt, which is the same single integral with potentials one order higher: one
//! evaluation a cell, smoother at the fronts than R, and exact. Quadrature in time would take several
//! evaluations a cell and more in those with an arrival, where R has roots, logarithms and jumps,
//! so exact integration is faster at any accuracy; what it costs is the difference,
//! which divides the error of int R dt by the width. After the last arrival int R dt is a smooth function of
//! 1/t, and a long tail of cells is taken from its Chebyshev interpolant.

use crate::arrivals::Arrivals;
use crate::error::DomainError;
use crate::field::{Estimate, Six};
use crate::fronts::Point;
use crate::kernel::{FARTHEST, Kernel, NEAREST, check_time};
use std::f64::consts::PI;

impl Kernel {
    /// int R dt up to t, with a constant of integration that is the same for all t at one (r, z).
    ///
    /// # Errors
    /// [`DomainError`] for r, z or t outside [0, 1e20].
    pub fn step_integral(&self, r: f64, z: f64, t: f64) -> Result<Estimate, DomainError> {
        self.check_place(r, z)?;
        check_time(t)?;
        let arrival = self.first_arrival(r, z);
        let mut estimate = self.evaluate::<1>(Point {
            r,
            z,
            t: t.max(arrival),
        });
        self.impose_surface(z, &mut estimate);
        if t < arrival {
            let rest = self.static_field(r, z)?;
            for (value, s) in estimate.value.iter_mut().zip(rest) {
                *value += s * (arrival - t);
            }
        }
        Ok(estimate)
    }

    /// int dt of [`Self::step_integral`] up to t: differences of it give first moments over time cells.
    ///
    /// # Errors
    /// [`DomainError`] for r, z or t outside [0, 1e20], and for a profile other than Hertz.
    pub fn second_integral(&self, r: f64, z: f64, t: f64) -> Result<Estimate, DomainError> {
        self.check_place(r, z)?;
        check_time(t)?;
        self.check_hertz()?;
        let arrival = self.first_arrival(r, z);
        let mut estimate = self.evaluate::<2>(Point {
            r,
            z,
            t: t.max(arrival),
        });
        self.impose_surface(z, &mut estimate);
        if t < arrival {
            let gap = arrival - t;
            let rest = self.static_field(r, z)?;
            let slope = self.step_integral(r, z, arrival)?;
            for (f, rest) in rest.iter().enumerate() {
                estimate.value[f] -= gap * (slope.value[f] + 0.5 * gap * rest);
                estimate.error[f] += gap * slope.error[f];
            }
        }
        Ok(estimate)
    }

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
        self.check_place(r, z)?;
        let range = NEAREST..=FARTHEST;
        DomainError::unless(range.contains(&width), "width", width, "[1e-20, 1e20]")?;
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

/// int R dt after the last arrival: a Chebyshev series in 1/t for each field.
struct Tail {
    from: f64,
    /// Middle and half width of the interval in 1/t.
    middle: f64,
    half: f64,
    coefficients: [Six; Self::TERMS],
    error: Six,
}

impl Tail {
    const TERMS: usize = 24;

    /// The series starts at this multiple of the last arrival, beyond the reach of its singularity.
    const START: f64 = 1.3;

    /// The tail of a trace, if it holds enough cells to be worth its evaluations.
    fn new(
        kernel: &Kernel,
        r: f64,
        z: f64,
        width: f64,
        end: f64,
    ) -> Result<Option<Self>, DomainError> {
        let arrivals = Arrivals::new(kernel.medium(), kernel.profile(), r, z)?;
        let from = Self::START * arrivals.last();
        if from == 0.0 || end - from < 1.5 * width * Self::TERMS as f64 {
            return Ok(None);
        }
        let (middle, half) = (
            0.5 * (1.0 / from + 1.0 / end),
            0.5 * (1.0 / from - 1.0 / end),
        );
        let angle = |i: usize| PI * (i as f64 + 0.5) / Self::TERMS as f64;
        let mut values = [Six::default(); Self::TERMS];
        let mut error = Six::default();
        for (i, value) in values.iter_mut().enumerate() {
            let estimate = kernel.step_integral(r, z, 1.0 / (middle + half * angle(i).cos()))?;
            *value = estimate.value;
            for (largest, e) in error.iter_mut().zip(estimate.error) {
                *largest = largest.max(e);
            }
        }
        let mut coefficients = [Six::default(); Self::TERMS];
        for (k, coefficient) in coefficients.iter_mut().enumerate() {
            let scale = if k == 0 { 1.0 } else { 2.0 } / Self::TERMS as f64;
            for (i, value) in values.iter().enumerate() {
                let weight = scale * (k as f64 * angle(i)).cos();
                for (c, v) in coefficient.iter_mut().zip(value) {
                    *c += weight * v;
                }
            }
        }
        for (f, e) in error.iter_mut().enumerate() {
            // what the series leaves out is about its last terms
            let last = coefficients[Self::TERMS - 2..].iter().map(|c| c[f].abs());
            *e += last.sum::<f64>();
        }
        Ok(Some(Self {
            from,
            middle,
            half,
            coefficients,
            error,
        }))
    }

    /// Clenshaw's sum at t.
    fn value(&self, t: f64) -> Estimate {
        let x = (1.0 / t - self.middle) / self.half;
        let (mut b1, mut b2) = (Six::default(), Six::default());
        for c in self.coefficients[1..].iter().rev() {
            let mut b0 = Six::default();
            for f in 0..6 {
                b0[f] = 2.0 * x * b1[f] - b2[f] + c[f];
            }
            (b1, b2) = (b0, b1);
        }
        let mut value = Six::default();
        for f in 0..6 {
            value[f] = x * b1[f] - b2[f] + self.coefficients[0][f];
        }
        Estimate {
            value,
            error: self.error,
        }
    }
}
