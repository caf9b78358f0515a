//! A running sum of six fields that carries its own error estimate.

use crate::field::Six;
use crate::integral::strength::RelativeError;
use crate::numeric::lanes::WIDTH;

/// Six fields and their likely errors.
///
/// The errors of panels and of rounding are as often positive as negative: their squares add up.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Sum {
    pub(crate) value: Six,
    pub(crate) square: Six,
}

impl Sum {
    /// Likely error of each field.
    pub(crate) fn error(&self) -> Six {
        self.square.map(f64::sqrt)
    }

    /// Adds `weight` times `term` of a relative error.
    #[inline]
    pub(crate) fn add(&mut self, weight: f64, error: impl Into<RelativeError>, term: Six) {
        let RelativeError {
            displacement: d,
            stress: s,
        } = error.into();
        let relative = [d, d, s, s, s, s];
        for (f, relative) in relative.into_iter().enumerate() {
            let x = weight * term[f];
            self.value[f] += x;
            self.square[f] += (relative * x) * (relative * x);
        }
    }

    /// Adds what lanes have summed of one field, and the squares of the errors.
    #[inline(always)]
    pub(crate) fn add_lanes(&mut self, field: usize, terms: [f64; WIDTH], squares: [f64; WIDTH]) {
        self.value[field] += (terms[0] + terms[1]) + (terms[2] + terms[3]);
        self.square[field] += (squares[0] + squares[1]) + (squares[2] + squares[3]);
    }
}
