//! Complex numbers side by side.

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

impl<S: Simd> Add for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl<S: Simd> Sub for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.im - other.im)
    }
}

impl<S: Simd> Mul for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self::new(
            self.re * other.re - self.im * other.im,
            self.re * other.im + self.im * other.re,
        )
    }
}

impl<S: Simd> Add<f64> for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self::new(self.re + other, self.im)
    }
}

impl<S: Simd> Sub<f64> for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: f64) -> Self {
        Self::new(self.re - other, self.im)
    }
}

impl<S: Simd> Mul<f64> for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self.times(self.re.constant(other))
    }
}
