//! Real or complex numbers, one or several side by side: the closed forms hold for all of them.

use num_complex::Complex64;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real or complex number.
pub(crate) trait Scalar:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// A constant of the same kind.
    fn constant(self, value: f64) -> Self;
}

/// A real number.
pub(crate) trait Real: Scalar + Div<Output = Self> + Neg<Output = Self> {
    fn sqrt(self) -> Self;
    fn exp(self) -> Self;
    fn abs(self) -> Self;
    fn at_least(self, least: f64) -> Self;

    /// `yes` where this is below `limit`, else `no`.
    fn where_below(self, limit: Self, yes: Self, no: Self) -> Self;
}

impl Scalar for f64 {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value
    }
}

impl Real for f64 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn exp(self) -> Self {
        f64::exp(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }

    #[inline(always)]
    fn at_least(self, least: f64) -> Self {
        self.max(least)
    }

    #[inline(always)]
    fn where_below(self, limit: Self, yes: Self, no: Self) -> Self {
        if self < limit { yes } else { no }
    }
}

impl Scalar for Complex64 {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value.into()
    }
}
