//! The time integral of the remainder long after the last arrival, where it is a smooth function of 1/t.

use crate::arrivals::Arrivals;
use crate::chebyshev;
use crate::error::DomainError;
use crate::field::{Estimate, Six};
use crate::kernel::Kernel;

/// int R dt after the last arrival: a Chebyshev series in 1/t for each field.
pub(crate) struct Tail {
    pub(crate) from: f64,
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
    pub(crate) fn new(
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
        let mut values = [Six::default(); Self::TERMS];
        let mut error = Six::default();
        for (i, value) in values.iter_mut().enumerate() {
            let estimate = kernel.step_integral(
                r,
                z,
                1.0 / (middle + half * chebyshev::node(i, Self::TERMS)),
            )?;
            *value = estimate.value;
            for (largest, e) in error.iter_mut().zip(estimate.error) {
                *largest = largest.max(e);
            }
        }
        let coefficients = chebyshev::fit(&values);
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
    pub(crate) fn value(&self, t: f64) -> Estimate {
        let x = (1.0 / t - self.middle) / self.half;
        let value = chebyshev::value(&self.coefficients, x);
        Estimate {
            value,
            error: self.error,
        }
    }
}
