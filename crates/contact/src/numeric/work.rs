//! Work of a sampled force on a sampled deflection, int p dw.
//!
//! Theory: `docs/theory.md` (T56).

/// int p dw over each cell.
///
/// The trapezoid of Stieltjes with its next correction, (p' w'' - p'' w') h^3/12 a cell, where the
/// force is smooth; of second order because of the cells in which contact begins and ends.
fn cells<'a>(force: &'a [f64], deflection: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
    let (p, w) = (force, deflection);
    (1..p.len().min(w.len())).map(move |i| {
        let (rise, moved) = (p[i] - p[i - 1], w[i] - w[i - 1]);
        let total = p[i] + p[i - 1];
        if total == 0.0 {
            return 0.0;
        }
        let mut sum = 0.5 * total * moved;
        if i >= 2 && i + 1 < p.len() && p[i] != 0.0 {
            // twice the mean of the second differences at both ends of the cell
            let bend = |x: &[f64]| x[i + 1] - x[i] - x[i - 1] + x[i - 2];
            sum += (rise * bend(w) - bend(p) * moved) / 24.0;
        }
        sum
    })
}

/// int p dw over the kinetic energy before, of a contact in collision units.
pub(crate) fn work(force: &[f64], deflection: &[f64]) -> f64 {
    // force times length is 5/2 of the kinetic energy
    2.5 * cells(force, deflection).sum::<f64>()
}

/// int P dw in J from the first sample to each, of forces in N and deflections in m.
pub fn work_until_j(force_n: &[f64], deflection_m: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let first = force_n.first().map(|_| 0.0);
    let all = first.into_iter().chain(cells(force_n, deflection_m));
    let until = all.map(|cell| {
        sum += cell;
        sum
    });
    until.collect()
}
