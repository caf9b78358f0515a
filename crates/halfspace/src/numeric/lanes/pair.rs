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
    pub(crate) fn norm_sqr(self) -> Lanes<S> {
        self.re * self.re + self.im * self.im
    }

    #[inline(always)]
    pub(crate) fn conj(self) -> Self {
        Self {
            im: -self.im,
            ..self
        }
    }

    /// i times this.
    #[inline(always)]
    pub(crate) fn times_i(self) -> Self {
        Self {
            re: -self.im,
            im: self.re,
        }
    }

    /// -i times this.
    #[inline(always)]
    pub(crate) fn times_minus_i(self) -> Self {
        Self {
            re: self.im,
            im: -self.re,
        }
    }

    #[inline(always)]
    pub(crate) fn reciprocal(self) -> Self {
        let scale = self.re.constant(1.0) / self.norm_sqr();
        Self {
            re: self.re * scale,
            im: -self.im * scale,
        }
    }

    /// Principal square root.
    #[inline(always)]
    pub(crate) fn root(self) -> Self {
        let modulus = self.norm_sqr().sqrt();
        let large = ((modulus + self.re.abs()) * 0.5).sqrt();
        let small = self.im.abs() * 0.5 / large.at_least(f64::MIN_POSITIVE);
        let zero = self.re.constant(0.0);
        Self {
            re: self.re.where_below(zero, small, large),
            im: self.re.where_below(zero, large, small).copysign(self.im),
        }
    }

    /// `yes` where `value` is below `limit`, else `no`.
    #[inline(always)]
    pub(crate) fn where_below(value: Lanes<S>, limit: Lanes<S>, yes: Self, no: Self) -> Self {
        Self {
            re: value.where_below(limit, yes.re, no.re),
            im: value.where_below(limit, yes.im, no.im),
        }
    }
}

impl<S: Simd> Add for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            re: self.re + other.re,
            im: self.im + other.im,
        }
    }
}

impl<S: Simd> Sub for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            re: self.re - other.re,
            im: self.im - other.im,
        }
    }
}

impl<S: Simd> Mul for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }
}

impl<S: Simd> Mul<Lanes<S>> for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, real: Lanes<S>) -> Self {
        Self {
            re: self.re * real,
            im: self.im * real,
        }
    }
}

impl<S: Simd> Add<f64> for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self {
            re: self.re + other,
            ..self
        }
    }
}

impl<S: Simd> Sub<f64> for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: f64) -> Self {
        Self {
            re: self.re - other,
            ..self
        }
    }
}

impl<S: Simd> Mul<f64> for Pair<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        Self {
            re: self.re * other,
            im: self.im * other,
        }
    }
}

impl<S: Simd> Scalar for Pair<S> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self {
            re: self.re.constant(value),
            im: self.re.constant(0.0),
        }
    }
}
