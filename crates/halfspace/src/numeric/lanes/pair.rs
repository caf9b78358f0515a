//! Complex numbers side by side.

use super::Lanes;
use crate::numeric::scalar::{Real, Scalar};
use pulp::Simd;
use std::ops::{Add, Mul, Sub};

/// The complex numbers of two registers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair<S: Simd> {
    pub(crate) re: Lanes<S>,
    pub(crate) im: Lanes<S>,
}

impl<S: Simd> Pair<S> {
    #[inline(always)]
    pub(crate) fn new(re: Lanes<S>, im: Lanes<S>) -> Self {
        Self { re, im }
    }

    /// Principal logarithm; of zero it is finite.
    #[inline(always)]
    pub(crate) fn logarithm(self) -> Self {
        let square = self.norm_sqr().at_least(f64::MIN_POSITIVE);
        Self::new(square.ln() * 0.5, self.im.angle_over(self.re))
    }

    #[inline(always)]
    pub(crate) fn norm_sqr(self) -> Lanes<S> {
        self.re * self.re + self.im * self.im
    }

    #[inline(always)]
    pub(crate) fn conj(self) -> Self {
        Self::new(self.re, -self.im)
    }

    /// i times this.
    #[inline(always)]
    pub(crate) fn times_i(self) -> Self {
        Self::new(-self.im, self.re)
    }

    /// -i times this.
    #[inline(always)]
    pub(crate) fn times_minus_i(self) -> Self {
        Self::new(self.im, -self.re)
    }

    #[inline(always)]
    pub(crate) fn reciprocal(self) -> Self {
        let scale = self.re.constant(1.0) / self.norm_sqr();
        Self::new(self.re * scale, -self.im * scale)
    }

    /// Principal square root.
    #[inline(always)]
    pub(crate) fn root(self) -> Self {
        let modulus = self.norm_sqr().sqrt();
        let large = ((modulus + self.re.abs()) * 0.5).sqrt();
        let small = self.im.abs() * 0.5 / large.at_least(f64::MIN_POSITIVE);
        let zero = self.re.constant(0.0);
        Self::new(
            self.re.where_below(zero, small, large),
            self.re.where_below(zero, large, small).copysign(self.im),
        )
    }

    /// `yes` where `value` is below `limit`, else `no`.
    #[inline(always)]
    pub(crate) fn where_below(value: Lanes<S>, limit: Lanes<S>, yes: Self, no: Self) -> Self {
        Self::new(
            value.where_below(limit, yes.re, no.re),
            value.where_below(limit, yes.im, no.im),
        )
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

impl<S: Simd> Mul<Lanes<S>> for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, real: Lanes<S>) -> Self {
        Self::new(self.re * real, self.im * real)
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
        self * self.re.constant(other)
    }
}

impl<S: Simd> Scalar for Pair<S> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::new(self.re.constant(value), self.re.constant(0.0))
    }
}
