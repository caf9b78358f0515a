//! Response of a disc as the marches and the laws use it: exact, and as a table of its time integrals.
//!
//! One table serves every impact on half-spaces of the same Poisson's ratio, whatever the units.

use crate::numeric::quadrature::{GAUSS_4, GAUSS_8, gauss, hermite, quintic};
use crate::waves::compliance::negative_compliance;
use halfspace::{Deflection, LoadedDisc, SurfaceResponse};

/// The step response S W(t) of a disc's deflection under unit force: S its static value, W = 1 after its memory.
///
/// Time in r0/c1, deflection in 1/(mu r0).
pub trait DiscResponse {
    /// S and the memory, of which deflection.
    fn disc(&self) -> &LoadedDisc;

    /// Memory of a flat punch in a/c1: the slowest wave across its diameter.
    fn punch_memory(&self) -> f64 {
        match self.disc().deflection {
            Deflection::Centre => 2.0 * self.disc().memory,
            Deflection::Mean => self.disc().memory,
        }
    }

    /// int t^k (1 - W) dt for k = 0 .. 3, and int W dt as a function of its upper limit.
    ///
    /// If the samples resolve the memory, only the memory itself of the result may be used.
    fn relaxation(&self, resolved: bool) -> ([f64; 4], impl Fn(f64) -> f64 + '_);

    /// int W and int W (x - middle) over adjoining cells of a width, in ascending order from 0.
    fn cells(&self, width: f64) -> impl FnMut(f64, f64) -> (f64, f64) + '_;

    /// The largest -C(i w) at frequencies at which the dynamic compliance C, over the static one, is real; zero where it is
    /// nowhere negative. To 1e-3.
    fn negative_compliance(&self) -> f64;
}

/// int s^k (1 - W) ds for k = 0 .. 3, from int W ds.
fn moments(response: &SurfaceResponse, integral: impl Fn(f64) -> f64) -> [f64; 4] {
    let relaxation = response.disc.relaxation_time;
    // by parts: k int s^(k-1) K ds
    let moment = |k: i32| {
        gauss(&GAUSS_8, 0.0, response.disc.memory, |s| {
            f64::from(k) * s.powi(k - 1) * (relaxation + integral(s) - s)
        })
    };
    [relaxation, moment(1), moment(2), moment(3)]
}

/// Number of cells of the memory, between which int W is a cubic: it is evaluated often, at small arguments.
const COARSE_CELLS: usize = 6;

impl DiscResponse for SurfaceResponse {
    fn disc(&self) -> &LoadedDisc {
        &self.disc
    }

    fn relaxation(&self, resolved: bool) -> ([f64; 4], impl Fn(f64) -> f64 + '_) {
        let memory = self.disc.memory;
        let width = memory / COARSE_CELLS as f64;
        let nodes: [[f64; 2]; COARSE_CELLS + 1] = if resolved {
            [[0.0; 2]; COARSE_CELLS + 1]
        } else {
            std::array::from_fn(|i| {
                let t = i as f64 * width;
                [self.step_integral(t), width * self.step(t)]
            })
        };
        let integral = move |t: f64| {
            let place = (t / width).max(0.0);
            if place >= COARSE_CELLS as f64 {
                return nodes[COARSE_CELLS][0] + t - memory;
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
            // Beyond the memory int W = t - relaxation, whose integral is elementary.
            let live = self.disc.memory.clamp(from, to);
            let area = gauss(&GAUSS_4, from, live, |t| self.step_integral(t))
                + (to - live) * (0.5 * (to + live) - self.disc.relaxation_time);
            let moment = 0.5 * (to - from) * (before + after) - area;
            let rise = after - before;
            before = after;
            (rise, moment)
        }
    }

    fn negative_compliance(&self) -> f64 {
        negative_compliance(self.disc.memory, self.cells(0.0))
    }
}

/// Step response of a disc's deflection with its first and second time integral, by quintic interpolation.
///
/// Time in r0/c1. Accuracy 1e-9 of the memory and its square, for nu in [-0.5, 0.4999].
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseTable {
    /// That of the response.
    pub disc: LoadedDisc,
    /// int t^k (1 - W) dt for k = 0 .. 3, the first of them the relaxation time.
    moments: [f64; 4],
    /// See [`DiscResponse::negative_compliance`].
    negative_compliance: f64,
    /// W, int W/memory and int int W/memory^2 at equal steps of the memory.
    nodes: Vec<[f64; 3]>,
}

/// Cells of the table, and the width of one in the memory.
const CELLS_OF_TABLE: usize = 512;
const CELL_OF_TABLE: f64 = 1.0 / CELLS_OF_TABLE as f64;

impl ResponseTable {
    /// Tabulates a response.
    pub fn new(response: &SurfaceResponse) -> Self {
        let memory = response.disc.memory;
        let mut nodes = vec![[0.0; 3]];
        let mut twice = 0.0;
        let (mut step, mut once) = (0.0, 0.0);
        for i in 1..=CELLS_OF_TABLE {
            let t = i as f64 * CELL_OF_TABLE * memory;
            // at the end of the memory the limit from below is exact too: the response is continuous
            let (next_step, next_once) = (response.step(t), response.step_integral(t) / memory);
            // trapezoid with the end correction of Euler and Maclaurin: fourth order
            twice += 0.5 * CELL_OF_TABLE * (once + next_once)
                - CELL_OF_TABLE * CELL_OF_TABLE / 12.0 * (next_step - step);
            (step, once) = (next_step, next_once);
            nodes.push([step, once, twice]);
        }
        Self {
            disc: response.disc,
            negative_compliance: match response.disc.deflection {
                Deflection::Centre => response.negative_compliance(),
                Deflection::Mean => 0.0,
            },
            moments: moments(response, |t| response.step_integral(t)),
            nodes,
        }
    }

    /// The table of a Poisson's ratio between those of two others, linear in all its numbers.
    ///
    /// At equal fractions of the memory the response changes smoothly with Poisson's ratio, so the
    /// error is that of linear interpolation, of second order in the distance.
    pub fn between(near: &Self, far: &Self, fraction: f64) -> Self {
        let (one, other) = (&near.disc, &far.disc);
        debug_assert_eq!(one.deflection, other.deflection);
        let mix = |a: f64, b: f64| a + fraction * (b - a);
        let mixed = |(a, b): (&[f64; 3], &[f64; 3])| std::array::from_fn(|k| mix(a[k], b[k]));
        Self {
            disc: LoadedDisc {
                static_compliance: mix(one.static_compliance, other.static_compliance),
                relaxation_time: mix(one.relaxation_time, other.relaxation_time),
                memory: mix(one.memory, other.memory),
                ..*one
            },
            moments: std::array::from_fn(|k| mix(near.moments[k], far.moments[k])),
            negative_compliance: mix(near.negative_compliance, far.negative_compliance),
            nodes: near.nodes.iter().zip(&far.nodes).map(mixed).collect(),
        }
    }

    /// int W dt from 0 to t, in r0/c1, by cubic interpolation: accuracy 1e-8 of the memory.
    #[inline]
    pub fn integral(&self, t: f64) -> f64 {
        let Some(([[w0, v0, _], [w1, v1, _]], x)) = self.cell(t) else {
            return self.nodes[CELLS_OF_TABLE][1] * self.disc.memory + t - self.disc.memory;
        };
        hermite([*v0, w0 * CELL_OF_TABLE], [*v1, w1 * CELL_OF_TABLE], x) * self.disc.memory
    }

    /// The cell that holds a time, its nodes and the place in it; none beyond the memory.
    #[inline]
    fn cell(&self, t: f64) -> Option<(&[[f64; 3]; 2], f64)> {
        let place = (t / self.disc.memory * CELLS_OF_TABLE as f64).max(0.0);
        let i = place as usize;
        Some((self.nodes.get(i..)?.first_chunk()?, place - i as f64))
    }

    /// int W dt and int int W dt^2 from 0 to t, in r0/c1 and its square.
    #[inline]
    pub fn integrals(&self, t: f64) -> [f64; 2] {
        let m = self.disc.memory;
        let jet = |[w, v, u]: &[f64; 3]| [*u, v * CELL_OF_TABLE, w * CELL_OF_TABLE * CELL_OF_TABLE];
        let Some(([before, after], x)) = self.cell(t) else {
            let [_, once, twice] = self.nodes[CELLS_OF_TABLE];
            let beyond = t - m;
            return [
                once * m + beyond,
                twice * m * m + beyond * (once * m + 0.5 * beyond),
            ];
        };
        let [twice, once, _] = quintic(jet(before), jet(after), x);
        [once * CELLS_OF_TABLE as f64 * m, twice * m * m]
    }
}

impl DiscResponse for ResponseTable {
    fn disc(&self) -> &LoadedDisc {
        &self.disc
    }

    fn relaxation(&self, _resolved: bool) -> ([f64; 4], impl Fn(f64) -> f64 + '_) {
        (self.moments, |t| self.integral(t))
    }

    fn cells(&self, width: f64) -> impl FnMut(f64, f64) -> (f64, f64) + '_ {
        let mut before = [0.0; 2];
        move |_, to| {
            let after = self.integrals(to);
            let moment = 0.5 * width * (before[0] + after[0]) - (after[1] - before[1]);
            let rise = after[0] - before[0];
            before = after;
            (rise, moment)
        }
    }

    fn negative_compliance(&self) -> f64 {
        self.negative_compliance
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfspace::Medium;

    fn response(nu: f64, deflection: Deflection) -> SurfaceResponse {
        SurfaceResponse::new(&Medium::new(nu).unwrap(), deflection)
    }

    #[test]
    fn the_table_holds_its_accuracy() {
        for nu in [-0.5, 0.0, 0.263_082_06, 0.3, 0.45, 0.4999] {
            for deflection in [Deflection::Centre, Deflection::Mean] {
                let exact = response(nu, deflection);
                let table = ResponseTable::new(&exact);
                let m = exact.disc.memory;
                let (mut worst, mut twice, mut before) = (0.0_f64, 0.0, 0.0);
                let fine = 20_000;
                for i in 1..=fine {
                    let t = 1.2 * m * f64::from(i) / f64::from(fine);
                    let once = exact.step_integral(t);
                    twice += 0.6 * m / f64::from(fine) * (once + before);
                    before = once;
                    let found = table.integrals(t);
                    worst = worst.max((found[0] - once).abs() / m);
                    assert!((table.integral(t) - once).abs() < 1e-8 * m);
                    // the trapezoid next to it is accurate to 1e-9
                    assert!(
                        (found[1] - twice).abs() < 3e-9 * m * m,
                        "nu = {nu}, t = {t}"
                    );
                }
                println!("nu = {nu}, {deflection:?}: {worst:.1e}");
                assert!(worst < 1e-9, "nu = {nu}, {deflection:?}: {worst:e}");
            }
        }
    }
}
