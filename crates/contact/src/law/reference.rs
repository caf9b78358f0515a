//! A reference for tests: the contact of a force law p(d, d') by Runge and Kutta's rule with a uniform step.

use crate::numeric::quadrature::peak;
use crate::units::INVERSE_MASS;

/// The contact of a force law, until its force is gone.
pub(crate) struct Course {
    pub(crate) step: f64,
    /// Force at multiples of the step, up to the last before the end.
    pub(crate) force: Vec<f64>,
    pub(crate) peak_force: f64,
    pub(crate) peak_force_time: f64,
    pub(crate) peak_displacement: f64,
    pub(crate) contact_time: f64,
    /// Velocity at the end.
    pub(crate) velocity: f64,
}

impl Course {
    pub(crate) fn new(force: &impl Fn(f64, f64) -> f64, step: f64) -> Self {
        let mut state = [0.0, 1.0];
        let (mut forces, mut displacements) = (vec![0.0], vec![0.0]);
        let inside = |[d, v]: [f64; 2]| d > 0.0 && force(d, v) > 0.0;
        loop {
            let next = advance(force, state, step, forces.len() == 1);
            if !inside(next) {
                break;
            }
            state = next;
            forces.push(force(state[0], state[1]));
            displacements.push(state[0]);
        }
        let (mut low, mut high) = (0.0, step);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            match inside(advance(force, state, middle, false)) {
                true => low = middle,
                false => high = middle,
            }
        }
        let (place, peak_force) = peak(&forces);
        Self {
            step,
            contact_time: (forces.len() - 1) as f64 * step + low,
            velocity: advance(force, state, low, false)[1],
            peak_force,
            peak_force_time: place * step,
            peak_displacement: peak(&displacements).1,
            force: forces,
        }
    }
}

/// One step of the classical rule; the first, where the force starts like a root, in doublings.
fn advance(force: &impl Fn(f64, f64) -> f64, state: [f64; 2], step: f64, first: bool) -> [f64; 2] {
    const DOUBLINGS: i32 = 14;
    let rate = |d: f64, v: f64| {
        let pressed = if d > 0.0 { force(d, v).max(0.0) } else { 0.0 };
        (v, -INVERSE_MASS * pressed)
    };
    let once = |[d, v]: [f64; 2], h: f64| {
        let (d1, v1) = rate(d, v);
        let (d2, v2) = rate(d + 0.5 * h * d1, v + 0.5 * h * v1);
        let (d3, v3) = rate(d + 0.5 * h * d2, v + 0.5 * h * v2);
        let (d4, v4) = rate(d + h * d3, v + h * v3);
        [
            d + h * (d1 + 2.0 * (d2 + d3) + d4) / 6.0,
            v + h * (v1 + 2.0 * (v2 + v3) + v4) / 6.0,
        ]
    };
    if !first {
        return once(state, step);
    }
    let least = step * 0.5_f64.powi(DOUBLINGS);
    let start = once(state, least);
    (0..DOUBLINGS).fold(start, |state, k| once(state, least * 2.0_f64.powi(k)))
}
