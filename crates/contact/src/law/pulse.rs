//! The history of a contact without memory, from its force law and its results.
//!
//! A law p(d, d') with d'' = -(5/4) p is followed by Runge and Kutta's rule.
//! The results of a rung are those of its expansion, which leaves out what the law does not and the other way round:
//! first-order results differ from the damped equation in the second order.
//! So that a history and its results say the same, time is stretched and force is scaled, smoothly and by no more
//! than that difference:
//!
//! ```text
//! p(t) = S(q) p_law(q),   q = t (A + B t),   S = s (1 + k x^2 + m x^3),   x = (q - q_peak)/q_end
//! ```
//!
//! with A, B, s, k, m from the time and size of the largest force, contact time, impulse and largest displacement.
//! The displacement is the double integral of that force.

use crate::disc::history::History;
use crate::numeric::quadrature::peak;
use crate::summary::Summary;
use crate::units::INVERSE_MASS;

/// Samples of a contact with a force law and the results that they have to give, [`MOST_STEPS`] at most: a smaller step
/// is made as long as that.
///
/// `force` may be negative where the contact would be in tension: there it ends.
/// Peak force, its time, contact time, impulse and displacement are those of `results` to 1e-6.
/// `depth` is the displacement at the end of a contact whose last instants no expansion has: there, and zero at that
/// end, the force is a power of the time left.
pub(crate) fn pulse(
    force: impl Fn(f64, f64) -> f64,
    depth: f64,
    results: &Summary,
    step: f64,
) -> History {
    let step = step.max(results.contact_time / MOST_STEPS as f64);
    let mut course = Course::new(&force, depth, step.min(results.contact_time / LEAST_STEPS));
    course.fit(results);
    let mut last_instants: Option<[f64; 2]> = None;
    let mut history = History::at_touch(step);
    let mut state = [0.0, 1.0];
    let (mut place, mut before, mut known) = (0.0, 0.0, (0.0, 0.0));
    let (mut d, mut v) = (0.0, 1.0);
    while history.force.len() as f64 * step < results.contact_time {
        let n = history.force.len();
        let time = n as f64 * step;
        let mut at = |time: f64| {
            if let Some([size, power]) = last_instants {
                return size * (results.contact_time - time).max(0.0).powf(power);
            }
            let to = course.place(time);
            state = advance(&force, state, to - place, place == 0.0);
            place = to;
            let p = (course.scale(to) * force(state[0], state[1])).max(0.0);
            if state[1] < 0.0 && state[0] < LAYERS * depth {
                last_instants = Some(tail([known, (time, p)], results.contact_time));
            }
            known = (time, p);
            p
        };
        let middle = at(time - 0.5 * step);
        let p = at(time);
        if n == 1 {
            // like the power 3/2
            d += step * (v - INVERSE_MASS * step * p * 4.0 / 35.0);
            v -= INVERSE_MASS * step * p * 0.4;
        } else {
            d += step * (v - INVERSE_MASS * step * (before + 2.0 * middle) / 6.0);
            v -= INVERSE_MASS * step * (before + 4.0 * middle + p) / 6.0;
        }
        before = p;
        history.push(p, d, d - p.cbrt().powi(2));
    }
    let rest = results.contact_time - (history.force.len() - 1) as f64 * step;
    let last = d + rest * (v - INVERSE_MASS * rest * before * 2.0 / 7.0);
    history.push(0.0, last - results.restitution * (step - rest), last);
    history
}

/// Depths at the end of a contact over which its force is a power of the time left.
const LAYERS: f64 = 8.0;

/// The force of the last instants, a power of the time left through two of its values: its size and the power.
fn tail([(t0, p0), (t1, p1)]: [(f64, f64); 2], end: f64) -> [f64; 2] {
    let (left0, left1) = (end - t0, end - t1);
    let power = (p0 / p1).ln() / (left0 / left1).ln();
    let sound = p1 > 0.0 && left1 > 0.0 && power > 0.0 && power < STEEPEST;
    let power = if sound { power } else { 1.5 };
    let size = match left1 > 0.0 {
        true => p1 / left1.powf(power),
        false => 0.0,
    };
    [size, power]
}

/// Largest power of the time left.
const STEEPEST: f64 = 6.0;

/// Least steps in which a law is followed to find what it gives.
const LEAST_STEPS: f64 = 1000.0;

/// Steps after which a contact without an end is given up.
const MOST_STEPS: usize = 1_000_000;

/// What a law gives, and how it is stretched and scaled.
pub(crate) struct Course {
    step: f64,
    /// Force at multiples of the step, up to the last before the end.
    force: Vec<f64>,
    pub(crate) peak_force: f64,
    pub(crate) peak_force_time: f64,
    pub(crate) contact_time: f64,
    /// A and B of the fit.
    stretch: [f64; 2],
    /// s, k and m.
    scale: [f64; 3],
}

impl Course {
    /// Of a law until the force is gone, or where there is a depth until that is reached.
    pub(crate) fn new(force: &impl Fn(f64, f64) -> f64, depth: f64, step: f64) -> Self {
        let mut state = [0.0, 1.0];
        let mut forces = vec![0.0];
        let inside = |[d, v]: [f64; 2]| d > depth && (depth > 0.0 || force(d, v) > 0.0);
        loop {
            let next = advance(force, state, step, forces.len() == 1);
            // a law may start in tension over the first instants of a fast contact
            let begins = next[1] > 0.0 && next[0] > 0.0;
            if !(begins || inside(next)) || forces.len() > MOST_STEPS {
                break;
            }
            state = next;
            forces.push(force(state[0], state[1]).max(0.0));
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
            peak_force,
            peak_force_time: place * step,
            force: forces,
            stretch: [1.0, 0.0],
            scale: [1.0, 0.0, 0.0],
        }
    }

    /// Stretched and scaled to what its results are.
    fn fit(&mut self, results: &Summary) {
        let (peak, end) = (self.peak_force_time, self.contact_time);
        let rates = [peak / results.peak_force_time, end / results.contact_time];
        let bend = (rates[1] - rates[0]) / (results.contact_time - results.peak_force_time);
        self.stretch = [rates[0] - bend * results.peak_force_time, bend];
        self.scale[0] = results.peak_force / self.peak_force;
        for _ in 0..ITERATIONS {
            self.improve(results);
        }
    }

    /// Place in the course at a time.
    fn place(&self, time: f64) -> f64 {
        time * (self.stretch[0] + self.stretch[1] * time)
    }

    /// Time at a place of the course.
    fn time(&self, place: f64) -> f64 {
        let [a, b] = self.stretch;
        2.0 * place / (a + (a * a + 4.0 * b * place).max(0.0).sqrt())
    }

    fn scale(&self, place: f64) -> f64 {
        let [s, k, m] = self.scale;
        let x = (place - self.peak_force_time) / self.contact_time;
        s * (1.0 + x * x * (k + m * x))
    }

    /// Newton's step for k and m: impulse and largest displacement.
    fn improve(&mut self, results: &Summary) {
        // the force over the course, with its derivatives by k and m
        let pressed: Vec<[f64; 4]> = (0..self.force.len())
            .map(|i| {
                let place = i as f64 * self.step;
                let x = (place - self.peak_force_time) / self.contact_time;
                let p = self.scale[0] * self.force[i] * self.time_rate(place);
                let shape = 1.0 + x * x * (self.scale[1] + self.scale[2] * x);
                [p * shape, p * x * x, p * x * x * x, self.time(place)]
            })
            .collect();
        // trapezoids miss nothing where the force starts and ends with the power 3/2, but for the last cell
        let rest = self.contact_time - (pressed.len() - 1) as f64 * self.step;
        let last = pressed[pressed.len() - 1];
        let impulse: [f64; 3] = std::array::from_fn(|j| {
            let sum: f64 = pressed.iter().map(|p| p[j]).sum();
            self.step * (sum - 0.5 * last[j]) + 0.4 * rest * last[j]
        });
        let Some(turn) = self.turn(&pressed) else {
            return;
        };
        let (turn_time, before) = (self.time(turn), (turn / self.step) as usize);
        let pushed: [f64; 3] = std::array::from_fn(|j| {
            let lever = |i: usize| (turn_time - pressed[i][3]) * pressed[i][j];
            let sum: f64 = (1..before).map(lever).sum();
            let slope = (lever(before + 1) - lever(before - 1)) / (2.0 * self.step);
            let width = turn - before as f64 * self.step;
            let end = -pressed[before][j] * self.time_rate(turn);
            self.step * (sum + 0.5 * lever(before) - self.step / 12.0 * slope)
                + width * (0.5 * lever(before) + width / 12.0 * (slope - end))
        });
        let travel = turn_time - INVERSE_MASS * pushed[0];
        let miss = [
            results.impulse - impulse[0],
            (travel - results.peak_displacement) / INVERSE_MASS,
        ];
        let determinant = impulse[1] * pushed[2] - impulse[2] * pushed[1];
        if determinant != 0.0 && determinant.is_finite() {
            self.scale[1] += (miss[0] * pushed[2] - miss[1] * impulse[2]) / determinant;
            self.scale[2] += (miss[1] * impulse[1] - miss[0] * pushed[1]) / determinant;
        }
    }

    /// Where the striker turns, in the course; nothing where it does not before the last cells.
    fn turn(&self, pressed: &[[f64; 4]]) -> Option<f64> {
        let mut velocity = 1.0;
        for i in 1..pressed.len().checked_sub(1)? {
            let change = 0.5 * INVERSE_MASS * self.step * (pressed[i - 1][0] + pressed[i][0]);
            if velocity <= change {
                return Some((i as f64 - 1.0 + velocity / change) * self.step);
            }
            velocity -= change;
        }
        None
    }

    /// dt/dq.
    fn time_rate(&self, place: f64) -> f64 {
        let [a, b] = self.stretch;
        1.0 / (a * a + 4.0 * b * place).max(f64::MIN_POSITIVE).sqrt()
    }
}

/// One step of the classical rule; the first, where the force starts like a root, in doublings.
pub(crate) fn advance(
    force: &impl Fn(f64, f64) -> f64,
    state: [f64; 2],
    step: f64,
    first: bool,
) -> [f64; 2] {
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

const DOUBLINGS: i32 = 14;

/// Steps of Newton's method: the first is nearly exact.
const ITERATIONS: usize = 3;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::quasi_static::quasi_static_radiation;
    use crate::law::radiation::{damped_force, radiation};

    fn check(force: impl Fn(f64, f64) -> f64, results: &Summary, tolerance: f64) {
        let step = results.contact_time / 2048.0;
        let history = pulse(force, 0.0, results, step);
        let (place, largest) = peak(&history.force);
        let (_, travel) = peak(&history.displacement);
        let velocity = history.last_velocity();
        let free = history
            .force
            .iter()
            .skip(1)
            .position(|&p| p <= 0.0)
            .unwrap()
            + 1;
        let impulse: f64 = history.force.iter().sum::<f64>() * step;
        for (name, found, asked) in [
            ("force", largest, results.peak_force),
            ("its time", place * step, results.peak_force_time),
            ("displacement", travel, results.peak_displacement),
            ("velocity", -velocity, results.restitution),
            ("impulse", impulse, results.impulse),
        ] {
            let error = (found / asked - 1.0).abs();
            assert!(
                error < tolerance,
                "{name}: {found} {asked} {error:e} {results:?}"
            );
        }
        assert!((free as f64 * step - results.contact_time).abs() <= step);
        // the motion is that of the force
        for i in 1..free - 1 {
            let d = &history.displacement;
            let curvature = (d[i + 1] - 2.0 * d[i] + d[i - 1]) / (step * step);
            assert!(
                (curvature + INVERSE_MASS * history.force[i]).abs() < 2e-4,
                "{i}"
            );
        }
    }

    #[test]
    fn a_history_has_the_results_that_go_with_it() {
        for lag in [0.0, 1e-4, 3e-3, 0.03, 0.12] {
            check(damped_force(0.0, lag), &radiation(lag), 1e-6);
            for coupling in [0.1, 1.0, 30.0] {
                let results = quasi_static_radiation(coupling, lag);
                check(damped_force(coupling, lag), &results, 1e-6);
            }
        }
    }

    /// Velocity at the end of a contact, by its momentum.
    fn velocity(course: &Course) -> f64 {
        let (last, sum) = (
            course.force.last().unwrap(),
            course.force.iter().sum::<f64>(),
        );
        let rest = course.contact_time - (course.force.len() - 1) as f64 * course.step;
        1.0 - INVERSE_MASS * (course.step * (sum - 0.5 * last) + 0.4 * rest * last)
    }

    #[test]
    fn the_closed_form_is_the_limit_of_the_damped_contact() {
        for lag in [1e-3, 3e-3] {
            let law = radiation(lag);
            let damped = Course::new(&damped_force(0.0, lag), 0.0, 1e-3);
            assert!((damped.peak_force - law.peak_force).abs() < 7.0 * lag * lag);
            assert!((damped.peak_force_time - law.peak_force_time).abs() < 7.0 * lag * lag);
            assert!((velocity(&damped) + law.restitution).abs() < 7.0 * lag * lag);
        }
    }

    #[test]
    fn the_first_order_law_of_two_springs_is_the_limit_of_the_damped_contact() {
        for coupling in [0.1, 1.0, 4.0] {
            for lag in [1e-3, 3e-3] {
                let law = quasi_static_radiation(coupling, lag);
                let damped = Course::new(&damped_force(coupling, lag), 0.0, 1e-3);
                assert!((damped.peak_force - law.peak_force).abs() < 7.0 * lag * lag);
                assert!((damped.peak_force_time - law.peak_force_time).abs() < 7.0 * lag * lag);
                assert!((velocity(&damped) + law.restitution).abs() < 7.0 * lag * lag);
            }
        }
    }
}
