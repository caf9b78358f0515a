//! Crump (1976): Durbin's series, summed by Wynn's epsilon algorithm.

use super::Window;
use num_complex::Complex64;

/// f(t) from the samples of a transform.
#[must_use]
pub fn crump(window: &Window, samples: &[Complex64], t: f64) -> f64 {
    let turn = Complex64::from_polar(1.0, std::f64::consts::PI * t / window.half_period);
    let mut power = Complex64::new(1.0, 0.0);
    let mut sum = Complex64::default();
    let mut partial = Vec::with_capacity(samples.len());
    for (k, &sample) in samples.iter().enumerate() {
        sum += if k == 0 { 0.5 * sample } else { sample * power };
        power *= turn;
        partial.push(sum);
    }
    (window.damping * t).exp() / window.half_period * epsilon(&partial).re
}

/// Limit of a sequence: the last even column of Wynn's table, stopped where two entries coincide.
fn epsilon(partial: &[Complex64]) -> Complex64 {
    let mut before = vec![Complex64::default(); partial.len() + 1];
    let mut column = partial.to_vec();
    let mut best = partial.last().copied().unwrap_or_default();
    let mut order = 0;
    while column.len() > 1 {
        let mut next = Vec::with_capacity(column.len() - 1);
        for i in 0..column.len() - 1 {
            let difference = column[i + 1] - column[i];
            if difference.norm() <= 1e-15 * column[i].norm() {
                return best;
            }
            next.push(before[i + 1] + difference.inv());
        }
        order += 1;
        (before, column) = (column, next);
        if order % 2 == 0 {
            best = column.last().copied().unwrap_or(best);
        }
    }
    best
}
