//! Polynomials through places and in Chebyshev's form.

/// A Chebyshev series at x in [-1, 1], by Clenshaw's recurrence.
#[inline]
pub fn chebyshev(series: &[f64], x: f64) -> f64 {
    let (mut b1, mut b2) = (0.0, 0.0);
    for &c in series[1..].iter().rev() {
        (b1, b2) = (2.0 * x * b1 - b2 + c, b1);
    }
    x * b1 - b2 + series[0]
}

/// The polynomial that is one at the k-th of `count` places and zero at the others, at x.
#[inline]
pub fn lagrange(place: impl Fn(usize) -> f64, count: usize, k: usize, x: f64) -> f64 {
    let (own, others) = (place(k), (0..count).filter(|&j| j != k));
    let factors = others.map(|j| (x - place(j)) / (own - place(j)));
    factors.product()
}
