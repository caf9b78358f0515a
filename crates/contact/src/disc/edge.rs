//! The force next to an end of the contact, where it goes to zero with the power 3/2.
//!
//! With y = p^(1/3) the sum of the indentation and of the prompt deflection of the surface is y^2 + a y^3, proportional to
//! the time s from the end but for a smooth factor.
//! So s is the elementary function of y, and integrals over the edge are integrals of smooth functions over y:
//!
//! ```text
//! s = y^2 (1 + a y) G(y),     dp/ds = 3 y/R(y),     ds = y R dy,     R = (2 + 3 a y) G + (y + a y^2) G'
//! ```
//!
//! The deflection that is still to come there is the [`Relaxation`] 1 - W of the disc.
//!
//! Theory: `docs/theory.md` (T44 to T46).

use crate::numeric::quadrature::{GAUSS_4, gauss};
use crate::waves::response::DiscResponse;

/// s(y) with G a parabola; time in steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Edge {
    compliance: f64,
    g: [f64; 3],
}

/// Newton's iterations at most; the function is convex and its bounds need not be sharp.
const MOST_ITERATIONS: usize = 8;

impl Edge {
    /// Through three roots y of the force, each at its time from the end, on a surface that gives way by `compliance`.
    ///
    /// Nothing where the parabola would not let the force rise from zero.
    pub(crate) fn new(compliance: f64, y: [f64; 3], times: [f64; 3]) -> Option<Self> {
        let g: [f64; 3] =
            std::array::from_fn(|i| times[i] / (y[i] * y[i] * (1.0 + compliance * y[i])));
        let first = (g[1] - g[0]) / (y[1] - y[0]);
        let second = ((g[2] - g[1]) / (y[2] - y[1]) - first) / (y[2] - y[0]);
        let g = [
            g[0] - y[0] * first + y[0] * y[1] * second,
            first - (y[0] + y[1]) * second,
            second,
        ];
        let edge = Self { compliance, g };
        let rises = |y: f64| edge.rate(y)[0] > 0.0;
        (rises(0.0) && y.into_iter().all(rises)).then_some(edge)
    }

    /// Of a body that touches the surface with unit velocity, y^2 + a y^3 = t.
    pub(crate) fn touch(compliance: f64, step: f64) -> Self {
        Self {
            compliance,
            g: [1.0 / step, 0.0, 0.0],
        }
    }

    /// G with its first two derivatives.
    fn factor(&self, y: f64) -> [f64; 3] {
        let [a, b, c] = self.g;
        [a + y * (b + y * c), b + 2.0 * c * y, 2.0 * c]
    }

    /// s.
    fn time(&self, y: f64) -> f64 {
        y * y * (1.0 + self.compliance * y) * self.factor(y)[0]
    }

    /// R and dR/dy.
    fn rate(&self, y: f64) -> [f64; 2] {
        let (a, [g, slope, bend]) = (self.compliance, self.factor(y));
        let e = y * (1.0 + a * y);
        [
            (2.0 + 3.0 * a * y) * g + e * slope,
            3.0 * a * g + (3.0 + 5.0 * a * y) * slope + e * bend,
        ]
    }

    /// dp/ds and its derivative in y.
    #[inline]
    fn slope(&self, y: f64) -> [f64; 2] {
        let [rate, change] = self.rate(y);
        let inverse = 1.0 / rate;
        let slope = 3.0 * inverse;
        [slope * y, slope * (1.0 - y * change * inverse)]
    }

    /// y at the time s, sought from `y`.
    #[inline]
    fn root(&self, s: f64, mut y: f64) -> f64 {
        for _ in 0..MOST_ITERATIONS {
            let change = (self.time(y) - s) / (y * self.rate(y)[0]);
            let next = y - change;
            if next <= 0.0 || next.is_nan() {
                return 0.0;
            }
            y = next;
            if change.abs() < 1e-3 * y {
                break;
            }
        }
        y
    }

    /// y at a time that is `away` from s, where it is `y`.
    fn root_beside(&self, s: f64, y: f64, away: f64) -> f64 {
        self.root(s + away, y * (1.0 + away / s).sqrt())
    }

    /// int p ds until the root `reach`: p ds = y^4 R dy.
    pub(crate) fn impulse(&self, reach: f64) -> f64 {
        gauss(&GAUSS_4, 0.0, reach, |y| y.powi(4) * self.rate(y)[0])
    }
}

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
const SHORT_MEMORY: f64 = 0.1;

/// Number of memory steps above which the samples resolve the beginning and the end of the contact.
pub(crate) const RESOLVED: f64 = 3.0;

impl Relaxation<()> {
    /// Of a disc's response, with r0/c1 in steps.
    ///
    /// Beyond [`RESOLVED`] it holds its memory and coupling only.
    pub(crate) fn of(
        response: &impl DiscResponse,
        coupling: f64,
        unit: f64,
    ) -> Relaxation<impl Fn(f64) -> f64 + '_> {
        let memory = response.disc().memory * unit;
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
    fn remaining(&self, s: f64) -> f64 {
        self.moments[0] + self.unit * (self.integral)(s / self.unit) - s
    }

    /// int K p'' ds between two roots of an edge, K at an age.
    fn weighted(&self, edge: &Edge, [from, to]: [f64; 2], age: impl Fn(f64) -> f64) -> f64 {
        gauss(&GAUSS_4, from, to, |y| {
            self.remaining(age(edge.time(y))) * edge.slope(y)[1]
        })
    }

    /// int_0^m K(s) p''(s) ds of a force that ends.
    pub(crate) fn kept(&self, edge: &Edge) -> f64 {
        let first = (self.memory / edge.factor(0.0)[0]).sqrt();
        self.weighted(edge, [0.0, edge.root(self.memory, first)], |s| s)
    }

    /// int p' L ds until the root `reach` of a force that begins, or that ends: p' ds = 3 y^2 dy, L the zeroth moment times p'
    /// and, where the memory is not short, a rest.
    pub(crate) fn taken(&self, edge: &Edge, reach: f64, ends: bool) -> f64 {
        let before_end = |y: f64| {
            let s = edge.time(y);
            let oldest = edge.root_beside(s, y, self.memory);
            self.weighted(edge, [y, oldest], |x| x - s)
        };
        gauss(&GAUSS_4, 0.0, reach, |y| {
            let rest = match (self.is_short(), ends) {
                (true, _) => 0.0,
                (false, true) => before_end(y),
                (false, false) => -self.past_at_touch(edge, y),
            };
            3.0 * y * y * (self.moments[0] * edge.slope(y)[0] + rest)
        })
    }

    /// L = int_0^min(s,m) (1 - W(x)) p'(s - x) dx at the root y of a force that begins.
    pub(crate) fn delayed_at_touch(&self, edge: &Edge, y: f64) -> f64 {
        let [slope, bend] = edge.slope(y);
        let past = if self.is_short() {
            self.moments[1] * bend / (y * edge.rate(y)[0])
        } else {
            self.past_at_touch(edge, y)
        };
        self.moments[0] * slope - past
    }

    /// Difference between the zeroth moment times p' and L.
    fn past_at_touch(&self, edge: &Edge, y: f64) -> f64 {
        let s = edge.time(y);
        let oldest = if self.memory < s {
            edge.root_beside(s, y, -self.memory)
        } else {
            0.0
        };
        self.weighted(edge, [oldest, y], |x| s - x)
    }

    /// Whether L = int_0^m (1 - W(s)) p'(t - s) ds may be taken as the zeroth moment times p' in the work int p' L dt.
    ///
    /// The first moment adds nothing to the work, since p' is zero at both ends of a contact; the second adds a
    /// fraction of (m/T)^2 log(T/m) in a contact of duration T.
    pub(crate) fn is_short(&self) -> bool {
        self.memory < SHORT_MEMORY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::cubic::force_root;
    use halfspace::{Deflection, Medium, SurfaceResponse};

    /// A force y^3 with y^2 + a y^3 = s through whose roots an edge is laid.
    fn edge(a: f64) -> (Edge, impl Fn(f64) -> f64) {
        let root = move |s: f64| force_root(a, s, 0.0).unwrap();
        let times = [0.6, 1.6, 2.6];
        (Edge::new(a, times.map(root), times).unwrap(), root)
    }

    #[test]
    fn the_force_is_that_of_the_roots() {
        for a in [0.0, 0.7, 20.0] {
            let (edge, root) = edge(a);
            for s in [1e-6, 0.1, 1.0, 3.0] {
                let y = root(s);
                assert!((edge.time(y) / s - 1.0).abs() < 1e-9);
                assert!((edge.root(s, 1.5 * y) / y - 1.0).abs() < 1e-6);
                let d = 1e-4 * s;
                let slope = (root(s + d).powi(3) - root(s - d).powi(3)) / (2.0 * d);
                assert!((edge.slope(y)[0] / slope - 1.0).abs() < 1e-6);
                let exact = y.powi(5) * (0.4 + 0.5 * a * y);
                assert!((edge.impulse(y) / exact - 1.0).abs() < 1e-9);
            }
        }
    }

    /// int_0^span f by the midpoint rule in the root of the distance from 0.
    fn integral(span: f64, f: impl Fn(f64) -> f64) -> f64 {
        let n = 4000;
        (0..n)
            .map(|i| {
                let x = (f64::from(i) + 0.5) / f64::from(n);
                2.0 * x * span / f64::from(n) * f(x * x * span)
            })
            .sum()
    }

    #[test]
    fn what_lags_is_the_convolution() {
        let response = SurfaceResponse::new(&Medium::new(0.3).unwrap(), Deflection::Centre);
        for (a, memory, digits) in [(0.0, 0.01, 5e-4), (0.5, 0.5, 2e-3), (2.0, 1.5, 2e-3)] {
            let (edge, root) = edge(a);
            let unit = memory / response.disc().memory;
            let relaxation = Relaxation::of(&response, 1.0, unit);
            let force = |s: f64| root(s.max(0.0)).powi(3);
            // L = d/ds int (1 - W) p at the touch, int (1 - W)(x) p'(x) dx where the force ends
            let kernel = |x: f64| 1.0 - response.step(x / unit);
            for s in [1.0, 2.0] {
                let convolved = |s: f64| integral(memory, |x| kernel(x) * force(s - x));
                let exact = (convolved(s + 1e-3) - convolved(s - 1e-3)) / 2e-3;
                let found = relaxation.delayed_at_touch(&edge, root(s));
                assert!(
                    (found / exact - 1.0).abs() < digits,
                    "{a} {memory}: {found} {exact}"
                );
            }
            let slope = |s: f64| edge.slope(root(s))[0];
            let exact = integral(memory, |x| kernel(x) * slope(x));
            let found = relaxation.kept(&edge);
            assert!(
                (found / exact - 1.0).abs() < digits,
                "{a} {memory}: {found} {exact}"
            );
        }
    }
}
