//! The end of contact on a disc of fixed radius.
//!
//! The contact ends where the displacement d, which is smooth, meets the deflection w that the surface keeps
//! from the force before.
//! There the force goes to zero with the power 3/2 and w, which is close to -c p', with its root, so a step longer
//! than the memory sees neither.
//! With s the time before the end and p(0) = 0, two integrations by parts leave an integral over the memory m only,
//!
//! ```text
//! w(end) = coupling int_0^m (1 - W) p'(s) ds = coupling int_0^m K(s) p''(s) ds,   K(s) = int_s^m (1 - W)
//! ```
//!
//! where p = (s g)^(3/2) with g a parabola in the root of s through the last samples of the indentation p^(2/3) over s.

use super::History;
use super::summary::first_separation;
use crate::quadrature::{GAUSS_4, GAUSS_8, Local};

/// What follows from the last samples in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Separation {
    /// When the force is zero.
    pub(crate) time: f64,
    /// Impulse from the third sample before the first free one until then.
    pub(crate) impulse: f64,
}

/// What the half-space has not yet given way of a unit force: coupling, memory and K, in collision units.
pub(crate) struct Lag<K> {
    pub(crate) coupling: f64,
    pub(crate) memory: f64,
    pub(crate) remaining: K,
}

/// Steps of memory up to which the end is found this way: beyond, the samples resolve what happens.
const RESOLVED: f64 = 3.0;

/// Where the end is sought: the march knows the force of its last sample in contact badly, and may take the one
/// after it as free.
const FIRST: f64 = 2.5;
const LAST: f64 = 5.0;

/// Improvements of a first guess at most, and the last one's size in steps; each gains more than a digit.
const ITERATIONS: usize = 4;
const ENOUGH: f64 = 1e-4;

/// The end of the first contact, where the last samples tell it: `end` is the first free sample.
pub(crate) fn separation<K: Fn(f64) -> f64>(
    history: &History,
    end: usize,
    lag: &Lag<K>,
) -> Option<Separation> {
    let step = history.step;
    if end < 5 || end + 1 > history.displacement.len() || lag.memory > RESOLVED * step {
        return None;
    }
    let displacement = Local::<5>::at(&history.displacement, end - 4);
    if displacement.value(FIRST) <= 0.0 || displacement.value(LAST) >= 0.0 {
        return None;
    }
    // place of the end in steps from the sample `end - 4`; first as if the surface kept nothing
    let mut place = displacement.root(FIRST, LAST);
    // two to four samples before the first free one: the newest is too close to the end to tell its shape
    let indentations: [f64; 3] = std::array::from_fn(|i| history.force[end - 2 - i].cbrt().powi(2));
    for _ in 0..ITERATIONS {
        let tail = Tail::new(&indentations, place)?;
        let (value, slope) = displacement.value_and_slope(place);
        if slope >= 0.0 {
            return None;
        }
        let next = (place - (value - tail.deflection(step, lag)) / slope).clamp(FIRST, LAST);
        let change = (next - place).abs();
        place = next;
        if change < ENOUGH {
            break;
        }
    }
    let tail = Tail::new(&indentations, place)?;
    Some(Separation {
        time: ((end - 4) as f64 + place) * step,
        impulse: tail.impulse(place - 1.0) * step,
    })
}

/// The force before its end: (s g)^(3/2), g = g[0] + g[1] x + g[2] x^2, x the root of s in steps.
struct Tail {
    g: [f64; 3],
}

impl Tail {
    /// Through the indentations at the places 2, 1 and 0.
    fn new(indentations: &[f64; 3], place: f64) -> Option<Self> {
        let nodes: [(f64, f64); 3] = std::array::from_fn(|i| {
            let s = place - (2.0 - i as f64);
            (s.sqrt(), indentations[i] / s)
        });
        let [(x0, y0), (x1, y1), (x2, y2)] = nodes;
        let first = (y1 - y0) / (x1 - x0);
        let second = ((y2 - y1) / (x2 - x1) - first) / (x2 - x0);
        let g = [
            y0 - x0 * first + x0 * x1 * second,
            first - (x0 + x1) * second,
            second,
        ];
        (g[0] > 0.0 && g.iter().all(|c| c.is_finite())).then_some(Self { g })
    }

    /// H = g^(3/2) with its first two derivatives in x.
    fn shape(&self, x: f64) -> [f64; 3] {
        let [a, b, c] = self.g;
        let value = (a + x * (b + x * c)).max(0.0);
        let (slope, bend) = (b + 2.0 * x * c, 2.0 * c);
        let root = value.sqrt();
        let curvature = if root > 0.0 {
            1.5 * root * bend + 0.75 * slope * slope / root
        } else {
            0.0
        };
        [value * root, 1.5 * root * slope, curvature]
    }

    /// int_0^m K p'' ds: with s = x^2, p'' ds = (3 H + 5 x H' + x^2 H'')/2 dx.
    fn deflection<K: Fn(f64) -> f64>(&self, step: f64, lag: &Lag<K>) -> f64 {
        let reach = (lag.memory / step).sqrt();
        let sum: f64 = GAUSS_4
            .iter()
            .map(|&(node, weight)| {
                let x = node * reach;
                let [h, slope, curvature] = self.shape(x);
                let force = 0.5 * (3.0 * h + x * (5.0 * slope + x * curvature));
                weight * force * (lag.remaining)(x * x * step)
            })
            .sum();
        lag.coupling * sum * reach / step
    }

    /// int p ds over the last `reach` steps, in steps: p ds = 2 x^4 H dx.
    fn impulse(&self, reach: f64) -> f64 {
        let root = reach.sqrt();
        GAUSS_8
            .iter()
            .map(|&(node, weight)| {
                let x = node * root;
                weight * 2.0 * x.powi(4) * self.shape(x)[0]
            })
            .sum::<f64>()
            * root
    }
}

impl History {
    /// Finds the end of the first contact and keeps it.
    pub(crate) fn separate<K: Fn(f64) -> f64>(&mut self, lag: &Lag<K>) {
        self.separation = separation(self, first_separation(&self.force), lag);
    }
}
