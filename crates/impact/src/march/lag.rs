//! What the half-space has not yet given way of a force.

use super::tabulated::ResponseTable;
use crate::quadrature::{GAUSS_8, gauss, hermite};
use halfspace::SurfaceResponse;

/// The lag 1 - W of a step response in units of a march's step.
///
/// A force that rises by dp leaves coupling (1 - W) dp to come.
pub(crate) struct Lag<F> {
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

impl<F: Fn(f64) -> f64> Lag<F> {
    /// `unit` is r0/c1 in steps, `moments` are in r0/c1.
    fn new(coupling: f64, unit: f64, memory: f64, moments: [f64; 4], integral: F) -> Self {
        let mut power = 1.0;
        Self {
            coupling,
            memory: memory * unit,
            moments: moments.map(|moment| {
                power *= unit;
                moment * power
            }),
            unit,
            integral,
        }
    }

    /// K(s) = int_s^m (1 - W): zero beyond the memory m.
    pub(crate) fn remaining(&self, s: f64) -> f64 {
        self.moments[0] + self.unit * (self.integral)(s / self.unit) - s
    }

    /// Whether L = int_0^m (1 - W(s)) p'(t - s) ds may be taken as the zeroth moment times p' in the work int p' L dt.
    ///
    /// What the first moment adds to the work is zero, since p' is zero at both ends of a contact; the second adds a
    /// share of (m/T)^2 log(T/m) in a contact of duration T.
    pub(crate) fn is_short(&self) -> bool {
        self.memory < SHORT
    }
}

/// Cells of the memory between which int W is a cubic: what it is asked for is small and asked for often.
const CELLS: usize = 6;

/// Of a disc's response, with r0/c1 in steps.
///
/// Beyond [`RESOLVED`] nothing but its memory and coupling may be asked of it.
pub(crate) fn lag(
    response: &SurfaceResponse,
    coupling: f64,
    unit: f64,
) -> Lag<impl Fn(f64) -> f64> {
    let memory = response.memory();
    let width = memory / CELLS as f64;
    let nodes: [[f64; 2]; CELLS + 1] = if memory * unit > RESOLVED {
        [[0.0; 2]; CELLS + 1]
    } else {
        std::array::from_fn(|i| {
            let t = i as f64 * width;
            [response.step_integral(t), width * response.step(t)]
        })
    };
    let integral = move |t: f64| {
        let place = (t / width).max(0.0);
        if place >= CELLS as f64 {
            return nodes[CELLS][0] + t - memory;
        }
        let i = place as usize;
        hermite(nodes[i], nodes[i + 1], place - i as f64)
    };
    let moments = moments(memory, response.relaxation_time(), integral);
    Lag::new(coupling, unit, memory, moments, integral)
}

/// Of a tabulated response.
pub(crate) fn tabulated_lag(
    table: &ResponseTable,
    coupling: f64,
    unit: f64,
) -> Lag<impl Fn(f64) -> f64> {
    let integral = |t| table.integral(t);
    Lag::new(coupling, unit, table.memory(), table.moments(), integral)
}

/// int s^k (1 - W) ds for k = 0 .. 3, from int W ds; all in one unit of time.
pub(super) fn moments(memory: f64, relaxation: f64, integral: impl Fn(f64) -> f64) -> [f64; 4] {
    // by parts: k int s^(k-1) K ds
    let moment = |k: i32| {
        gauss(&GAUSS_8, 0.0, memory, |s| {
            f64::from(k) * s.powi(k - 1) * (relaxation + integral(s) - s)
        })
    };
    [relaxation, moment(1), moment(2), moment(3)]
}
