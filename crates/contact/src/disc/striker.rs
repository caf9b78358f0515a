//! The striker's motion under a sampled force: Numerov's double sum.
//!
//! ```text
//! d(t) = t - (5/4) int_0^t (t - t') p(t') dt'
//!      = t - (5/4) { h^2 [ sum_{j<n} (n - j) p_j + p_n/12 ] + E_0 t - E_1 } + O(h^4)
//! ```
//!
//! E_0 and E_1 are the errors of the sums of p and t p at the touch, where the force starts with the power 3/2 as
//! y^2 + sigma y^3 = t, p = y^3, on a surface of compliance sigma; without them the error would be of order 5/2.
//! Everything is in collision units.
//!
//! Theory: `docs/theory.md` (T40).

use crate::numeric::cubic::force_root;
use crate::units::INVERSE_MASS;

/// Samples after which Euler and Maclaurin's expansion at the upper end is good to 1e-5 of the constants.
pub(crate) const STARTING: usize = 4;

/// Roots y of the force p = y^3 at the first samples, from y^2 + sigma y^3 = t.
pub(crate) fn starting_roots(step: f64, compliance: f64) -> [f64; STARTING] {
    let mut y = 0.0;
    std::array::from_fn(|j| {
        y = force_root(compliance.max(0.0), (j + 1) as f64 * step, y).unwrap_or(0.0);
        y
    })
}

/// Running sums of the force samples.
#[derive(Debug, Clone)]
pub(crate) struct StrikerMotion {
    step: f64,
    samples: usize,
    /// sum of all samples so far.
    sum: f64,
    /// sum over the samples so far of (n - j) p_j, n the next sample.
    double_sum: f64,
    /// Error of the trapezoidal rule at the touch in int p dt and in int t p dt.
    pub(crate) missed: [f64; 2],
}

impl StrikerMotion {
    /// At the instant of touch, one sample, p = 0, on a surface that gives way by `compliance` times the force at once, with
    /// the first roots of the force.
    pub(crate) fn new(step: f64, compliance: f64, roots: &[f64; STARTING]) -> Self {
        Self {
            step,
            samples: 1,
            sum: 0.0,
            double_sum: 0.0,
            missed: missed(step, compliance, roots),
        }
    }

    /// d at the next sample as if its force were zero.
    pub(crate) fn free_displacement(&self) -> f64 {
        let h = self.step;
        let t = self.samples as f64 * h;
        let start = self.missed[0] * t - self.missed[1];
        t - INVERSE_MASS * (h * h * self.double_sum + start)
    }

    /// Decrease of d by a unit force at the next sample.
    pub(crate) fn newest_weight(&self) -> f64 {
        INVERSE_MASS * self.step * self.step / 12.0
    }

    /// Takes the force at the next sample.
    pub(crate) fn push(&mut self, force: f64) {
        self.sum += force;
        self.double_sum += self.sum;
        self.samples += 1;
    }
}

/// Error of the trapezoidal rule at the touch in int p dt and in int t p dt: the constants of Euler and Maclaurin.
///
/// t = y^2 + sigma y^3 makes both integrals and the derivatives at the upper end elementary.
fn missed(step: f64, compliance: f64, roots: &[f64; STARTING]) -> [f64; 2] {
    let sigma = compliance.max(0.0);
    let (mut force, mut moment) = (0.0, 0.0);
    for (j, y) in roots.iter().enumerate() {
        let weight = if j + 1 == STARTING { 0.5 } else { 1.0 };
        let p = y * y * y * step * weight;
        force += p;
        moment += (j + 1) as f64 * step * p;
    }
    let (t, y) = (STARTING as f64 * step, roots[STARTING - 1]);
    let (y2, u) = (y * y, 2.0 + 3.0 * sigma * y);
    let p = [
        y2 * y,
        3.0 * y / u,
        6.0 / (y * u * u * u),
        -6.0 * (u + 9.0 * sigma * y) / (y2 * y * u.powi(5)),
    ];
    let end = |first: f64, third: f64| step * step / 12.0 * (first - step * step / 60.0 * third);
    let exact = y2 * y2 * y * (0.4 + 0.5 * sigma * y);
    let exact_moment = y2 * y2 * y2 * y * (2.0 / 7.0 + sigma * y * (5.0 / 8.0 + sigma * y / 3.0));
    [
        exact - force + end(p[1], p[3]),
        exact_moment - moment + end(p[0] + t * p[1], 3.0 * p[2] + t * p[3]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::history::History;

    /// Errors of d and of the impulse at t = 1 for a force p of known integrals int p and int (1 - t) p.
    fn errors(step: f64, compliance: f64, p: impl Fn(f64) -> f64, exact: [f64; 2]) -> [f64; 2] {
        let n = (1.0 / step).round() as usize;
        let mut history = History::at_touch(step);
        let mut striker = StrikerMotion::new(step, compliance, &starting_roots(step, compliance));
        history.start = striker.missed[0];
        for i in 1..=n + 2 {
            let force = p(i as f64 * step);
            history.push(force, 0.0, 0.0);
            if i < n {
                striker.push(force);
            }
        }
        let d = striker.free_displacement() - striker.newest_weight() * history.force[n];
        [
            (d - (1.0 - INVERSE_MASS * exact[1])).abs(),
            (history.impulse_until(n) - exact[0]).abs(),
        ]
    }

    #[test]
    fn displacement_and_impulse_are_better_than_third_order() {
        // t^(3/2) - t^3/5
        let power = |step: f64| {
            let exact = [0.4 - 0.05, 4.0 / 35.0 - 0.2 / 20.0];
            errors(step, 0.0, |t| t.powf(1.5) - 0.2 * t.powi(3), exact)
        };
        // y^2 + sigma y^3 = t on a soft surface
        let soft = |step: f64| {
            let sigma: f64 = 3.0;
            let root = |t: f64| force_root(sigma, t, 0.0).unwrap();
            let y = root(1.0);
            let impulse = y.powi(5) * (0.4 + 0.5 * sigma * y);
            let moment = y.powi(7) * (2.0 / 7.0 + sigma * y * (5.0 / 8.0 + sigma * y / 3.0));
            errors(
                step,
                sigma,
                |t| root(t).powi(3),
                [impulse, impulse - moment],
            )
        };
        for error in [&power as &dyn Fn(f64) -> [f64; 2], &soft] {
            let (coarse, fine) = (error(1.0 / 20.0), error(1.0 / 40.0));
            for (coarse, fine) in coarse.into_iter().zip(fine) {
                assert!(coarse < 2e-6, "{coarse:e}");
                assert!(coarse / fine > 10.0 || fine < 1e-9, "{coarse:e} {fine:e}");
            }
        }
    }
}
