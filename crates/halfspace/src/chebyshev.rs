//! Chebyshev series of six fields at once.

use crate::field::Six;
use std::f64::consts::PI;

/// cos of the angle of node i of n.
pub(crate) fn node(i: usize, n: usize) -> f64 {
    angle(i, n).cos()
}

fn angle(i: usize, n: usize) -> f64 {
    PI * (i as f64 + 0.5) / n as f64
}

/// Coefficients of the series through the values at the nodes of [`node`].
pub(crate) fn fit<const N: usize>(values: &[Six; N]) -> [Six; N] {
    let mut coefficients = [Six::default(); N];
    for (k, coefficient) in coefficients.iter_mut().enumerate() {
        let scale = if k == 0 { 1.0 } else { 2.0 } / N as f64;
        for (i, value) in values.iter().enumerate() {
            let weight = scale * (k as f64 * angle(i, N)).cos();
            for (c, v) in coefficient.iter_mut().zip(value) {
                *c += weight * v;
            }
        }
    }
    coefficients
}

/// Clenshaw's sum at x in [-1, 1].
#[inline]
pub(crate) fn value(coefficients: &[Six], x: f64) -> Six {
    let (mut b1, mut b2) = (Six::default(), Six::default());
    for c in coefficients[1..].iter().rev() {
        let mut b0 = Six::default();
        for f in 0..6 {
            b0[f] = 2.0 * x * b1[f] - b2[f] + c[f];
        }
        (b1, b2) = (b0, b1);
    }
    std::array::from_fn(|f| x * b1[f] - b2[f] + coefficients[0][f])
}
