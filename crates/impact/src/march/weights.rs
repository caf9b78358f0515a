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

use super::tabulated::ResponseTable;
use super::{FixedDisc, StaticShare};
use crate::quadrature::GAUSS_4;
use halfspace::SurfaceResponse;

/// The weights g_j of one step, and the memory they span.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Weights {
    pub(crate) lag: Vec<f64>,
}

impl Weights {
    /// For a force that is known; `step` and `unit` = r0/c1 in the same unit of time.
    pub(crate) fn new(response: &SurfaceResponse, step: f64, unit: f64) -> Self {
        Self::limited(response, step, unit, f64::INFINITY)
    }

    fn limited(response: &SurfaceResponse, step: f64, unit: f64, slack: f64) -> Self {
        let h = step / unit;
        let mut weights = Self::default();
        let mut before = 0.0;
        weights.fill(response.memory(), h, slack, |from, to| {
            let after = response.step_integral(to);
            let moment = first_moment(response, from, to, before, after);
            let rise = after - before;
            before = after;
            (rise, moment)
        });
        weights
    }

    /// For the march of an impact; `response` is its own or that of another deflection of the same disc.
    pub(crate) fn of(impact: &FixedDisc<'_>, response: &SurfaceResponse, step: f64) -> Self {
        let slack = slack(impact.coupling, impact.share);
        Self::limited(response, step, impact.wave_time, slack)
    }

    /// For a march with tabulated responses, in the place of whatever weights were held before.
    pub(crate) fn read(&mut self, table: &ResponseTable, step: f64, unit: f64, slack: f64) {
        let h = step / unit;
        let mut before = [0.0; 2];
        self.fill(table.memory(), h, slack, |_, to| {
            let after = table.integrals(to);
            let moment = 0.5 * h * (before[0] + after[0]) - (after[1] - before[1]);
            let rise = after[0] - before[0];
            before = after;
            (rise, moment)
        });
    }

    /// `cell` gives int W and int W (x - mid) over each cell in turn.
    fn fill(
        &mut self,
        memory: f64,
        h: f64,
        slack: f64,
        mut cell: impl FnMut(f64, f64) -> (f64, f64),
    ) {
        let cells = (memory / h).ceil() as usize;
        let lag = &mut self.lag;
        lag.clear();
        lag.resize(cells + 2, 0.0);
        let mut newest = 0.0;
        for j in 0..cells {
            let (rise, moment) = cell(j as f64 * h, (j + 1) as f64 * h);
            lag[j] += 1.0 - rise / h;
            let curvature = moment / (h * h);
            if j == 0 {
                newest = curvature;
            } else {
                lag[j - 1] += 0.5 * curvature;
                lag[j + 1] -= 0.5 * curvature;
            }
        }
        // the cell that ends now: its curvature continues the two before it
        newest *= stable_share(lag, newest, slack);
        lag[0] += 1.5 * newest;
        lag[1] -= 2.0 * newest;
        lag[2] += 0.5 * newest;
    }

    /// sum over all j of g_j (p_{n-j} - p_{n-j-1}); `force` holds p_0 = 0 .. p_n.
    pub(crate) fn lagging(&self, force: &[f64]) -> f64 {
        let (newest, past) = match force {
            [past @ .., newest] => (*newest, past),
            [] => return 0.0,
        };
        let before = past.last().copied().unwrap_or(0.0);
        self.lag[0] * (newest - before) + self.past(past)
    }

    /// sum over j >= 1 of g_j (p_{n-j} - p_{n-j-1}), the part of the past; `past` holds p_0 .. p_{n-1}.
    pub(crate) fn past(&self, past: &[f64]) -> f64 {
        let start = match (self.lag.get(past.len()), past.first()) {
            (Some(weight), Some(first)) => weight * first,
            (Some(_) | None, _) => 0.0,
        };
        let rises = past.windows(2).rev().map(|p| p[1] - p[0]);
        start
            + self.lag[1..]
                .iter()
                .zip(rises)
                .map(|(g, rise)| g * rise)
                .sum::<f64>()
    }
}

/// The weights g_j of the implicit march of an impact at a step in collision units, newest first.
///
/// The deflection is coupling [p_n - sum_j g_j (p_{n-j} - p_{n-j-1})], without the first p_n for the dynamic share.
#[must_use]
pub fn memory_weights(impact: &FixedDisc<'_>, step: f64) -> Vec<f64> {
    Weights::of(impact, impact.response, step).lag
}

/// Stiffness of the contact, (2/3) p^(-1/3) > 2/3, over the coupling, with a margin: what the compliance that an
/// alternating force meets may fall below zero, 1 - 2 sum_j (-1)^j g_j for the full share and 1 less without it.
pub(crate) fn slack(coupling: f64, share: StaticShare) -> f64 {
    (0.5 / coupling - (1.0 - share.factor())).max(0.0)
}

/// Share of the newest cell's curvature that leaves the march stable.
///
/// The curvature of the newest cell, an extrapolation, takes 8 times itself from the compliance that a force
/// meets which alternates from sample to sample; that of the others cancels.
/// The share is 1 for weak coupling and for steps longer than about twice the memory, where the extrapolation
/// gives the march its second order; shorter steps have it from the other cells.
fn stable_share(lag: &[f64], curvature: f64, slack: f64) -> f64 {
    let alternating: f64 = lag.iter().rev().fold(0.0, |sum, g| g - sum);
    if curvature > 0.0 {
        ((1.0 + slack - 2.0 * alternating) / (8.0 * curvature)).min(1.0)
    } else {
        1.0
    }
}

/// int W(x) (x - mid) dx over a cell, from the ends of int W and Gauss points inside.
fn first_moment(response: &SurfaceResponse, from: f64, to: f64, before: f64, after: f64) -> f64 {
    let memory = response.memory();
    let width = to - from;
    // Beyond the memory int W = t - relaxation, whose integral is elementary.
    let live = memory.clamp(from, to);
    let mut area = GAUSS_4
        .iter()
        .map(|&(x, weight)| weight * response.step_integral(from + x * (live - from)))
        .sum::<f64>()
        * (live - from);
    area += (to - live) * (0.5 * (to + live) - response.relaxation_time());
    0.5 * width * (before + after) - area
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfspace::{Deflection, Medium};

    fn response() -> SurfaceResponse {
        SurfaceResponse::new(&Medium::new(0.3).unwrap(), Deflection::Centre)
    }

    #[test]
    fn a_parabola_is_convolved_exactly() {
        // p = t^2: w/S = 2 int W(t - s) s ds = 2 int_0^t (int W)
        let response = response();
        for h in [0.03, 0.3, 3.0] {
            let weights = Weights::new(&response, h, 1.0);
            let n = 60_usize;
            let p = |i: f64| (i * h).powi(2);
            let mut sum = (n as f64 * h).powi(2);
            for (j, g) in weights.lag.iter().enumerate() {
                let i = n as f64 - j as f64;
                if i > 0.0 {
                    sum -= g * (p(i) - p(i - 1.0));
                }
            }
            let (t, m) = (n as f64 * h, response.memory());
            let mut exact = 0.0;
            let panels = 400;
            for panel in 0..panels {
                for (x, w) in GAUSS_4 {
                    let s = m.min(t) * (f64::from(panel) + x) / f64::from(panels);
                    exact += 2.0 * w * m.min(t) / f64::from(panels) * response.step_integral(s);
                }
            }
            if t > m {
                exact += (t - m) * (t + m - 2.0 * response.relaxation_time());
            }
            assert!(
                (sum / exact - 1.0).abs() < 1e-4 * h.min(1.0),
                "h = {h}: {sum} {exact}"
            );
        }
    }
}
