//! The recurrence that the implicit scheme's newest samples follow at a frozen contact stiffness.

use crate::gauss::Rule;
use halfspace::SurfaceResponse;
use impact::march::{FixedDisc, StaticShare};

/// The implicit scheme's weights g_j of a step in r0/c1: cell means of 1 - W, corrected for the curvature of
/// the force with the first moments of W, that of the newest cell continued from the two before it.
pub(super) fn weights(response: &SurfaceResponse, step: f64) -> Vec<f64> {
    let cells = (response.memory() / step).ceil() as usize;
    let rule = Rule::new(8);
    let integral = |t: f64| response.step_integral(t);
    let mut lag = vec![0.0; cells + 2];
    for j in 0..cells {
        let (from, to) = (j as f64 * step, (j + 1) as f64 * step);
        lag[j] += 1.0 - (integral(to) - integral(from)) / step;
        // the response has a corner where its memory ends
        let live = response.memory().clamp(from, to);
        let area: f64 = [(from, live), (live, to)]
            .iter()
            .flat_map(|&(a, b)| rule.on(a, b))
            .map(|(t, weight)| weight * integral(t))
            .sum();
        let curvature = (0.5 * step * (integral(from) + integral(to)) - area) / (step * step);
        if j == 0 {
            lag[0] += 1.5 * curvature;
            lag[1] -= 2.0 * curvature;
            lag[2] += 0.5 * curvature;
        } else {
            lag[j - 1] += 0.5 * curvature;
            lag[j + 1] -= 0.5 * curvature;
        }
    }
    lag
}

/// Growth per step of the implicit scheme's newest samples at a frozen contact stiffness k.
///
/// The largest root, in modulus, of p_n/k + coupling [p_n - sum_j g_j (p_{n-j} - p_{n-j-1})] = 0, for the dynamic
/// share without the first p_n in brackets, from a long run of the recurrence; below one the samples settle.
#[must_use]
pub fn linear_growth(disc: &FixedDisc<'_>, stiffness: f64, step: f64) -> f64 {
    const STEPS: usize = 400;
    let lag = weights(disc.response, step / disc.wave_time);
    let still = match disc.share {
        StaticShare::Full => 1.0,
        StaticShare::Dynamic => 0.0,
    };
    let own = 1.0 / stiffness + disc.coupling * (still - lag[0]);
    let mut p = vec![0.0; lag.len() + 1];
    p.push(1.0);
    // rescaled so that nothing overflows; the logarithm of the scale is kept
    let mut growth = 0.0;
    for n in 0..STEPS {
        let m = p.len();
        let past: f64 = lag[1..]
            .iter()
            .enumerate()
            .map(|(j, g)| g * (p[m - 1 - j] - p[m - 2 - j]))
            .sum();
        p.push(disc.coupling * (past - lag[0] * p[m - 1]) / own);
        p.remove(0);
        let size = p.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
        if size == 0.0 {
            return 0.0;
        }
        for v in &mut p {
            *v /= size;
        }
        if n >= STEPS / 2 {
            growth += size.ln();
        }
    }
    (growth / (STEPS / 2) as f64).exp()
}
