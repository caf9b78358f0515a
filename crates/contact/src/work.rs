//! The work of a sampled force on a sampled deflection.

/// int p dw over the kinetic energy before.
///
/// The trapezoid of Stieltjes with its next correction, (p' w'' - p'' w') h^3/12 a cell, where the
/// force is smooth; of second order because of the cells in which contact begins and ends.
#[must_use]
pub fn work(force: &[f64], deflection: &[f64]) -> f64 {
    let (p, w) = (force, deflection);
    let mut sum = 0.0;
    for i in 1..p.len().min(w.len()) {
        let (rise, moved) = (p[i] - p[i - 1], w[i] - w[i - 1]);
        let total = p[i] + p[i - 1];
        if total == 0.0 {
            continue;
        }
        sum += 0.5 * total * moved;
        if i >= 2 && i + 1 < p.len() && p[i] != 0.0 {
            // twice the mean of the second differences at both ends of the cell
            let bend = |x: &[f64]| x[i + 1] - x[i] - x[i - 1] + x[i - 2];
            sum += (rise * bend(w) - bend(p) * moved) / 24.0;
        }
    }
    // force times length is 5/2 of the kinetic energy
    2.5 * sum
}

/// int P dw in J of forces in N and deflections in m.
#[must_use]
pub fn work_j(force_n: &[f64], deflection_m: &[f64]) -> f64 {
    work(force_n, deflection_m) / 2.5
}
