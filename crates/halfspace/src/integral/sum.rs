//! A running sum of six fields that carries its own error estimate.

use crate::field::Six;
use crate::numeric::lanes::{WIDTH, total};

/// Six fields and the squares of their likely errors, in blocks that are added up at the end.
///
/// The errors of panels and of rounding are as often positive as negative: their squares add up.
#[derive(Debug, Default)]
pub(crate) struct Sum {
    pub(crate) values: [[f64; WIDTH]; 6],
    pub(crate) squares: [[f64; WIDTH]; 6],
}

impl Sum {
    pub(crate) fn value(&self) -> Six {
        self.values.map(|block| total(&block))
    }

    /// Likely error of each field.
    pub(crate) fn error(&self) -> Six {
        self.squares.map(|block| total(&block).sqrt())
    }

    /// Adds `weight` times `term`, of relative errors of displacements and stresses.
    #[inline]
    pub(crate) fn add(&mut self, weight: f64, [d, s]: [f64; 2], term: Six) {
        let relative = [d, d, s, s, s, s];
        for (f, relative) in relative.into_iter().enumerate() {
            let x = weight * term[f];
            self.values[f][0] += x;
            self.squares[f][0] += (relative * x) * (relative * x);
        }
    }
}
