//! The recurrence that the implicit scheme's newest samples follow at a frozen contact stiffness.

use contact::{ExactDisc, StaticShare, memory_weights};

/// Growth per step of the implicit scheme's newest samples at a frozen contact stiffness k.
///
/// The largest root, in modulus, of p_n/k + coupling [p_n - sum_j g_j (p_{n-j} - p_{n-j-1})] = 0, for the dynamic
/// share without the first p_n in brackets, from a long run of the recurrence; below one the samples settle.
#[must_use]
pub fn linear_growth(disc: &ExactDisc<'_>, stiffness: f64, step: f64) -> f64 {
    const STEPS: usize = 400;
    let lag = memory_weights(disc, step);
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
