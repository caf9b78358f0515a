//! A running sum of six fields that carries its own error estimate.

use crate::field::Six;
use crate::strength::RelativeError;

/// Six fields and their likely errors.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Sum {
    pub(crate) value: Six,
    pub(crate) error: Six,
}

impl Sum {
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
            self.error[f] += relative * x.abs();
        }
    }
}
