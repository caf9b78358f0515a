//! What the marches and the laws need of a disc's response, and the exact response as they need it.

use crate::numeric::quadrature::{GAUSS_4, GAUSS_8, gauss, hermite};
use halfspace::{Deflection, SurfaceResponse};

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

    /// Memory of a flat punch in a/c1: the slowest wave across its diameter.
    fn punch_memory(&self) -> f64 {
        match self.deflection() {
            Deflection::Centre => 2.0 * self.memory(),
            Deflection::Mean => self.memory(),
        }
    }

    /// int t^k (1 - W) dt for k = 0 .. 3, and int W dt as a function of its upper limit.
    ///
    /// Where the memory is resolved by the samples only the memory itself may be asked of what is returned.
    fn relaxation(&self, resolved: bool) -> ([f64; 4], impl Fn(f64) -> f64 + '_);

    /// int W and int W (x - middle) over adjoining cells of a width, asked for from 0 on.
    fn cells(&self, width: f64) -> impl FnMut(f64, f64) -> (f64, f64) + '_;
}

/// int s^k (1 - W) ds for k = 0 .. 3, from int W ds.
pub(crate) fn moments(response: &SurfaceResponse, integral: impl Fn(f64) -> f64) -> [f64; 4] {
    let relaxation = response.relaxation_time();
    // by parts: k int s^(k-1) K ds
    let moment = |k: i32| {
        gauss(&GAUSS_8, 0.0, response.memory(), |s| {
            f64::from(k) * s.powi(k - 1) * (relaxation + integral(s) - s)
        })
    };
    [relaxation, moment(1), moment(2), moment(3)]
}

/// Cells of the memory between which int W is a cubic: what it is asked for is small and asked for often.
const CELLS: usize = 6;

impl DiscResponse for SurfaceResponse {
    fn deflection(&self) -> Deflection {
        self.deflection()
    }

    fn static_compliance(&self) -> f64 {
        self.static_compliance()
    }

    fn relaxation_time(&self) -> f64 {
        self.relaxation_time()
    }

    fn memory(&self) -> f64 {
        self.memory()
    }

    fn relaxation(&self, resolved: bool) -> ([f64; 4], impl Fn(f64) -> f64 + '_) {
        let memory = self.memory();
        let width = memory / CELLS as f64;
        let nodes: [[f64; 2]; CELLS + 1] = if resolved {
            [[0.0; 2]; CELLS + 1]
        } else {
            std::array::from_fn(|i| {
                let t = i as f64 * width;
                [self.step_integral(t), width * self.step(t)]
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
        (moments(self, integral), integral)
    }

    fn cells(&self, _width: f64) -> impl FnMut(f64, f64) -> (f64, f64) + '_ {
        let mut before = 0.0;
        move |from, to| {
            let after = self.step_integral(to);
            let moment = first_moment(self, from, to, before, after);
            let rise = after - before;
            before = after;
            (rise, moment)
        }
    }
}

/// int W(x) (x - mid) dx over a cell, from the ends of int W and Gauss points inside.
fn first_moment(response: &SurfaceResponse, from: f64, to: f64, before: f64, after: f64) -> f64 {
    let memory = response.memory();
    let width = to - from;
    // Beyond the memory int W = t - relaxation, whose integral is elementary.
    let live = memory.clamp(from, to);
    let area = gauss(&GAUSS_4, from, live, |t| response.step_integral(t))
        + (to - live) * (0.5 * (to + live) - response.relaxation_time());
    0.5 * width * (before + after) - area
}
