//! Complex numbers in registers.

use super::Lanes;
use crate::numeric::scalar::{Complex, Scalar};
use pulp::Simd;
use std::ops::{Add, Mul, Sub};

/// The complex numbers of two registers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair<S: Simd> {
    pub(crate) re: Lanes<S>,
    pub(crate) im: Lanes<S>,
}

impl<S: Simd> Complex for Pair<S> {
    type Part = Lanes<S>;

    #[inline(always)]
    fn new(re: Lanes<S>, im: Lanes<S>) -> Self {
        Self { re, im }
    }

    #[inline(always)]
    fn re(self) -> Lanes<S> {
        self.re
    }

    #[inline(always)]
    fn im(self) -> Lanes<S> {
        self.im
    }
}

impl<S: Simd> Scalar for Pair<S> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::new(self.re.constant(value), self.re.constant(0.0))
    }
}

operators! {
    Pair, Add<Self>, add: |a, b| Self::new(a.re + b.re, a.im + b.im);
    Pair, Sub<Self>, sub: |a, b| Self::new(a.re - b.re, a.im - b.im);
    Pair, Mul<Self>, mul: |a, b| Self::new(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re);
    Pair, Add<f64>, add: |a, b| Self::new(a.re + b, a.im);
    Pair, Sub<f64>, sub: |a, b| Self::new(a.re - b, a.im);
    Pair, Mul<f64>, mul: |a, b| a.times(a.re.constant(b));
}
