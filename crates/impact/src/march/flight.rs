//! The striker's motion under a sampled force: Numerov's double sum.
//!
//! ```text
//! d(t) = t - (5/4) int_0^t (t - t') p(t') dt'
//!      = t - (5/4) { h^2 [ sum_{j<n} (n - j) p_j + p_n/12 ] - c [ zeta(-3/2) h^(5/2) t - zeta(-5/2) h^(7/2) ] } + O(h^4)
//! ```
//!
//! The bracket with zeta is the generalised Euler-Maclaurin term of the start p ~ c t^(3/2), which
//! would otherwise leave an error of order 5/2.
//! Everything is in collision units.

use crate::units::INVERSE_MASS;

/// Riemann's zeta at -3/2.
pub(crate) const ZETA_3_2: f64 = -0.025_485_201_889_833_036;
/// Riemann's zeta at -5/2.
pub(crate) const ZETA_5_2: f64 = 0.008_516_928_777_850_55;

/// Running sums of the force samples.
#[derive(Debug, Clone)]
pub(crate) struct Flight {
    step: f64,
    samples: usize,
    /// sum of all samples so far.
    sum: f64,
    /// sum over the samples so far of (n - j) p_j, n the next sample.
    double_sum: f64,
    /// c of the start.
    start: f64,
}

impl Flight {
    /// At the instant of touch: one sample, p = 0, and the start p = t^(3/2).
    pub(crate) fn new(step: f64) -> Self {
        Self {
            step,
            samples: 1,
            sum: 0.0,
            double_sum: 0.0,
            start: 1.0,
        }
    }

    /// d at the next sample as if its force were zero.
    pub(crate) fn free_displacement(&self) -> f64 {
        let h = self.step;
        let t = self.samples as f64 * h;
        let root = h.sqrt();
        let start = self.start * h * h * root * (ZETA_3_2 * t - ZETA_5_2 * h);
        t - INVERSE_MASS * (h * h * self.double_sum - start)
    }

    /// What a unit force at the next sample takes from d.
    pub(crate) fn newest_weight(&self) -> f64 {
        INVERSE_MASS * self.step * self.step / 12.0
    }

    /// Takes the force at the next sample.
    pub(crate) fn push(&mut self, force: f64) {
        if self.samples == 1 {
            // Where the step does not resolve the 3/2-power, do not correct for it.
            self.start = (force / (self.step * self.step.sqrt())).min(1.0);
        }
        self.sum += force;
        self.double_sum += self.sum;
        self.samples += 1;
    }
}

/// int_0^{t_k} p dt for a sample k that has two neighbours on both sides, error O(h^4).
pub(crate) fn impulse_until(force: &[f64], step: f64, k: usize) -> f64 {
    let sum: f64 = force[..k].iter().sum::<f64>() + 0.5 * force[k];
    impulse_from_sum(force, step, k, sum)
}

fn impulse_from_sum(force: &[f64], step: f64, k: usize, sum: f64) -> f64 {
    let start = if force.len() > 1 {
        (force[1] / (step * step.sqrt())).min(1.0)
    } else {
        0.0
    };
    let at = |i: usize| force.get(i).copied().unwrap_or(0.0);
    // h p' by central differences
    let slope = match k {
        0 => 0.0,
        1 => 0.5 * (at(2) - at(0)),
        _ => (8.0 * (at(k + 1) - at(k - 1)) - (at(k + 2) - at(k - 2))) / 12.0,
    };
    step * (sum - slope / 12.0) - start * ZETA_3_2 * step * step * step.sqrt()
}

/// The striker's velocity at every sample.
pub(crate) fn velocities(force: &[f64], step: f64) -> Vec<f64> {
    let mut sum = 0.0;
    let mut velocity = Vec::with_capacity(force.len());
    for (k, &p) in force.iter().enumerate() {
        let impulse = if k == 0 {
            0.0
        } else {
            impulse_from_sum(force, step, k, sum + 0.5 * p)
        };
        velocity.push(1.0 - INVERSE_MASS * impulse);
        sum += p;
    }
    velocity
}

#[cfg(test)]
mod tests {
    use super::*;

    /// p = t^(3/2) - t^3/5: both integrals are known.
    fn error(step: f64) -> (f64, f64) {
        let p = |t: f64| t.powf(1.5) - 0.2 * t.powi(3);
        let n = (1.0 / step).round() as usize;
        let force: Vec<f64> = (0..=n + 2).map(|i| p(i as f64 * step)).collect();
        let mut flight = Flight::new(step);
        for &value in &force[1..n] {
            flight.push(value);
        }
        let d = flight.free_displacement() - flight.newest_weight() * force[n];
        let exact = 1.0 - 1.25 * (4.0 / 35.0 - 0.2 / 20.0);
        let impulse = impulse_until(&force, step, n);
        ((d - exact).abs(), (impulse - 0.4 + 0.05).abs())
    }

    #[test]
    fn displacement_and_impulse_are_better_than_third_order() {
        let (coarse, fine) = (error(1.0 / 20.0), error(1.0 / 40.0));
        assert!(coarse.0 < 2e-6 && coarse.1 < 2e-6, "{coarse:?}");
        assert!(coarse.0 / fine.0 > 10.0, "{coarse:?} {fine:?}");
        assert!(coarse.1 / fine.1 > 10.0, "{coarse:?} {fine:?}");
    }
}
