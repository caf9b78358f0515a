//! A running sum of six fields that carries its own error estimate.

use crate::field::Six;
use crate::numeric::lanes::{WIDTH, total};

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

    /// Adds `weight` times `term`, of relative errors of displacements and stresses.
    #[inline]
    pub(crate) fn add(&mut self, weight: f64, [d, s]: [f64; 2], term: Six) {
        let relative = [d, d, s, s, s, s];
        for (f, relative) in relative.into_iter().enumerate() {
            let x = weight * term[f];
            self.value[f] += x;
            self.square[f] += (relative * x) * (relative * x);
        }
    }

    /// Adds blocks of values of each field, and of squares of the errors.
    #[inline(always)]
    pub(crate) fn add_blocks(&mut self, values: &[[f64; WIDTH]; 6], squares: &[[f64; WIDTH]; 6]) {
        for f in 0..6 {
            self.value[f] += total(&values[f]);
            self.square[f] += total(&squares[f]);
        }
    }
}
