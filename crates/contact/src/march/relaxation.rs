//! The relaxation 1 - W of a disc: deflection still to come after an increment of force.
//!
//! Theory: `docs/theory.md` (T45, T46).

use crate::response::disc::DiscResponse;

/// The relaxation 1 - W of a step response in units of a march's step.
///
/// A force that rises by dp leaves coupling (1 - W) dp of deflection to come.
pub(crate) struct Relaxation<F> {
    /// Static deflection under Hertz's largest force over Hertz's largest approach.
    pub(crate) coupling: f64,
    /// Steps after which nothing is left to come.
    pub(crate) memory: f64,
    /// int s^k (1 - W) ds for k = 0 .. 3.
    pub(crate) moments: [f64; 4],
    /// r0/c1 in steps.
    unit: f64,
    /// int W from 0 to a time in r0/c1.
    integral: F,
}

/// Steps of memory up to which only its zeroth moment counts.
const SHORT: f64 = 0.1;

/// Steps of memory beyond which the samples resolve what happens at the touch and at the end.
pub(crate) const RESOLVED: f64 = 3.0;

impl Relaxation<()> {
    /// Of a disc's response, with r0/c1 in steps.
    ///
    /// Beyond [`RESOLVED`] nothing but its memory and coupling may be asked of it.
    pub(crate) fn of(
        response: &impl DiscResponse,
        coupling: f64,
        unit: f64,
    ) -> Relaxation<impl Fn(f64) -> f64 + '_> {
        let memory = response.memory() * unit;
        let (moments, integral) = response.relaxation(memory > RESOLVED);
        let mut power = 1.0;
        Relaxation {
            coupling,
            memory,
            moments: moments.map(|moment| {
                power *= unit;
                moment * power
            }),
            unit,
            integral,
        }
    }
}

impl<F: Fn(f64) -> f64> Relaxation<F> {
    /// K(s) = int_s^m (1 - W): zero beyond the memory m.
    pub(crate) fn remaining(&self, s: f64) -> f64 {
        self.moments[0] + self.unit * (self.integral)(s / self.unit) - s
    }

    /// Whether L = int_0^m (1 - W(s)) p'(t - s) ds may be taken as the zeroth moment times p' in the work int p' L dt.
    ///
    /// What the first moment adds to the work is zero, since p' is zero at both ends of a contact; the second adds a
    /// fraction of (m/T)^2 log(T/m) in a contact of duration T.
    pub(crate) fn is_short(&self) -> bool {
        self.memory < SHORT
    }
}
