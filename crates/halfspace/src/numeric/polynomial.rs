//! Polynomials through places and in Chebyshev's form.

use crate::numeric::lanes::{Lanes, dispatch};
use crate::numeric::scalar::Scalar;
use pulp::{Simd, WithSimd};

/// A Chebyshev series at x in [-1, 1], by Clenshaw's recurrence.
#[inline]
pub fn chebyshev(series: &[f64], x: f64) -> f64 {
    let (mut b1, mut b2) = (0.0, 0.0);
    for &c in series[1..].iter().rev() {
        (b1, b2) = (2.0 * x * b1 - b2 + c, b1);
    }
    x * b1 - b2 + series[0]
}

/// Several series, with their coefficients term by term, at several x in vector registers; the same bits on every machine.
pub fn chebyshev_each<const F: usize, const N: usize>(
    series: &[[f64; F]],
    x: [f64; N],
) -> [[f64; N]; F] {
    dispatch(Series(series, x))
}

struct Series<'a, const F: usize, const N: usize>(&'a [[f64; F]], [f64; N]);

impl<const F: usize, const N: usize> WithSimd for Series<'_, F, N> {
    type Output = [[f64; N]; F];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self(series, x) = self;
        let mut values = [[0.0; N]; F];
        for from in (0..N).step_by(S::F64_LANES) {
            let own = from..N.min(from + S::F64_LANES);
            let x = Lanes::of(simd, simd.partial_load_f64s(&x[own.clone()]));
            let (mut term, mut next) = (x.constant(1.0), x);
            let mut sums = [x.constant(0.0); F];
            for coefficients in series {
                for (sum, coefficient) in sums.iter_mut().zip(coefficients) {
                    *sum = *sum + term * *coefficient;
                }
                (term, next) = (next, (x + x) * next - term);
            }
            for (values, sum) in values.iter_mut().zip(sums) {
                simd.partial_store_f64s(&mut values[own.clone()], sum.register);
            }
        }
        values
    }
}

/// The polynomial that is one at the k-th of `count` places and zero at the others, at x.
#[inline]
pub fn lagrange(place: impl Fn(usize) -> f64, count: usize, k: usize, x: f64) -> f64 {
    let (own, others) = (place(k), (0..count).filter(|&j| j != k));
    let factors = others.map(|j| (x - place(j)) / (own - place(j)));
    factors.product()
}
