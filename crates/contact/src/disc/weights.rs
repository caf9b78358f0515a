//! Weights of the half-space's memory on a uniform step.
//!
//! The deflection under a force sampled a step h apart is
//!
//! ```text
//! w(t_n)/S = p_n - sum_j g_j (p_{n-j} - p_{n-j-1}),      S the static compliance
//! ```
//!
//! with g_j = 1 - (1/h) int_{jh}^{(j+1)h} W dt for a force that is linear in each cell, and a
//! correction for its curvature, taken from neighbouring cells, with the first moments of W.
//! g_j = 0 for cells older than the memory, so the sum is short.
//!
//! Theory: `docs/theory.md` (T41, T43).

use crate::disc::FixedDisc;
use crate::waves::response::DiscResponse;

/// The weights g_j of one step, newest first: as many as the memory has cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Weights {
    /// g_j.
    pub values: Vec<f64>,
}

impl Weights {
    /// For a force that is known at so many samples, which reach no older weights; `step` and `unit` = r0/c1 in the same
    /// unit of time.
    pub fn of_samples(response: &impl DiscResponse, step: f64, unit: f64, samples: usize) -> Self {
        Self::new(response, step / unit, f64::INFINITY, samples)
    }

    /// For the implicit march of an impact at a step in collision units; `response` is its own or that of another deflection
    /// of the same disc.
    ///
    /// The deflection is coupling [p_n - sum_j g_j (p_{n-j} - p_{n-j-1})], without the first p_n for the dynamic share.
    pub fn of<R>(impact: &FixedDisc<'_, R>, response: &impl DiscResponse, step: f64) -> Self {
        // Hertz's compliance is above 2/3; over the coupling and with a margin it is what 1 - 2 sum_j (-1)^j g_j, for the
        // full share, and 1 less without it, may fall below zero: how negative the compliance to an alternating force may
        // be before the march is unstable
        let slack = (0.5 / impact.coupling - (1.0 - impact.share.factor())).max(0.0);
        Self::new(response, step / impact.wave_time, slack, usize::MAX)
    }

    /// For a step in r0/c1.
    fn new(response: &impl DiscResponse, h: f64, slack: f64, samples: usize) -> Self {
        let mut cell = response.cells(h);
        let cells = ((response.disc().memory / h).ceil() as usize).min(samples.saturating_add(1));
        let mut values = vec![0.0; cells + 2];
        let mut newest = 0.0;
        for j in 0..cells {
            let (rise, moment) = cell(j as f64 * h, (j + 1) as f64 * h);
            values[j] += 1.0 - rise / h;
            let curvature = moment / (h * h);
            if j == 0 {
                newest = curvature;
            } else {
                values[j - 1] += 0.5 * curvature;
                values[j + 1] -= 0.5 * curvature;
            }
        }
        // the cell that ends now: its curvature continues the two before it
        // As far as that leaves the march stable: an extrapolation, it takes 8 times itself from the compliance that a force
        // meets which alternates from sample to sample, where that of the others cancels. It is whole for weak coupling and
        // for steps longer than about twice the memory, where it gives the march its second order; shorter steps have that
        // from the other cells.
        let alternating: f64 = values.iter().rev().fold(0.0, |sum, g| g - sum);
        if newest > 0.0 {
            newest *= ((1.0 + slack - 2.0 * alternating) / (8.0 * newest)).min(1.0);
        }
        values[0] += 1.5 * newest;
        values[1] -= 2.0 * newest;
        values[2] += 0.5 * newest;
        Self { values }
    }

    /// sum over all j of g_j (p_{n-j} - p_{n-j-1}), the deflection still to come; `force` holds p_0 = 0 .. p_n.
    #[inline]
    pub fn delayed(&self, force: &[f64]) -> f64 {
        let (newest, past) = match force {
            [past @ .., newest] => (*newest, past),
            [] => return 0.0,
        };
        let before = past.last().copied().unwrap_or(0.0);
        self.values[0] * (newest - before) + self.past(past)
    }

    /// sum over j >= 1 of g_j (p_{n-j} - p_{n-j-1}), the part of the past; `past` holds p_0 .. p_{n-1}.
    #[inline]
    pub(crate) fn past(&self, past: &[f64]) -> f64 {
        let first = self.values.get(past.len()).zip(past.first());
        let start = first.map_or(0.0, |(weight, force)| weight * force);
        let rises = past.windows(2).rev().map(|p| p[1] - p[0]);
        let parts = self.values[1..].iter().zip(rises);
        // four sums, none of which waits for the others
        let add = |[a, b, c, d]: [f64; 4], (g, rise)| [b, c, d, a + g * rise];
        start + parts.fold([0.0; 4], add).iter().sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::quadrature::GAUSS_4;
    use halfspace::{Deflection, Medium, SurfaceResponse};

    fn response() -> SurfaceResponse {
        SurfaceResponse::new(&Medium::new(0.3).unwrap(), Deflection::Centre)
    }

    #[test]
    fn a_parabola_is_convolved_exactly() {
        // p = t^2: w/S = 2 int W(t - s) s ds = 2 int_0^t (int W)
        let response = response();
        for h in [0.03, 0.3, 3.0] {
            let weights = Weights::of_samples(&response, h, 1.0, usize::MAX);
            let n = 60_usize;
            let p = |i: f64| (i * h).powi(2);
            let mut sum = (n as f64 * h).powi(2);
            for (j, g) in weights.values.iter().enumerate() {
                let i = n as f64 - j as f64;
                if i > 0.0 {
                    sum -= g * (p(i) - p(i - 1.0));
                }
            }
            let (t, m) = (n as f64 * h, response.disc().memory);
            let mut exact = 0.0;
            let panels = 400;
            for panel in 0..panels {
                for (x, w) in GAUSS_4 {
                    let s = m.min(t) * (f64::from(panel) + x) / f64::from(panels);
                    exact += 2.0 * w * m.min(t) / f64::from(panels) * response.step_integral(s);
                }
            }
            if t > m {
                exact += (t - m) * (t + m - 2.0 * response.disc().relaxation_time);
            }
            assert!(
                (sum / exact - 1.0).abs() < 1e-4 * h.min(1.0),
                "h = {h}: {sum} {exact}"
            );
        }
    }
}
