//! What the marches and the laws need of a disc's response.

use crate::quadrature::{GAUSS_8, gauss};
use halfspace::Deflection;

/// The step response S W(t) of a disc's deflection under unit force: S its static value, W = 1 after its memory.
///
/// Time in r0/c1, deflection in 1/(mu r0).
pub trait DiscResponse {
    /// Which deflection of the disc this is.
    fn deflection(&self) -> Deflection;

    /// S.
    fn static_compliance(&self) -> f64;

    /// int (1 - W) dt.
    fn relaxation_time(&self) -> f64;

    /// Time after which the response is static.
    fn memory(&self) -> f64;

    /// int t^k (1 - W) dt for k = 0 .. 3, and int W dt as a function of its upper limit.
    ///
    /// Where the memory is resolved by the samples only the memory itself may be asked of what is returned.
    fn relaxation(&self, resolved: bool) -> ([f64; 4], impl Fn(f64) -> f64 + '_);

    /// int W and int W (x - middle) over adjoining cells of a width, asked for from 0 on.
    fn cells(&self, width: f64) -> impl FnMut(f64, f64) -> (f64, f64) + '_;
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
