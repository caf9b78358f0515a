//! Real numbers, one or several side by side: the closed forms hold for all of them.

use crate::numeric::complex::Complex;
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
    /// Complex numbers of such parts.
    type Complex: Complex<Part = Self>;

    fn sqrt(self) -> Self;
    fn exp(self) -> Self;
    fn ln(self) -> Self;
    fn abs(self) -> Self;
    fn copysign(self, sign: Self) -> Self;
    fn at_least(self, least: f64) -> Self;

    /// The angle of the vector (`x`, self), in [-pi, pi]; of nothing it is zero.
    fn angle_over(self, x: Self) -> Self;

    /// `yes` where this is below `limit`, else `no`.
    fn where_below(self, limit: Self, yes: Self, no: Self) -> Self;

    /// The largest of those side by side.
    fn largest(self) -> f64;

    /// The smallest of those side by side.
    fn smallest(self) -> f64;
}

impl Scalar for f64 {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value
    }
}

impl Real for f64 {
    type Complex = Complex64;

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn exp(self) -> Self {
        f64::exp(self)
    }

    #[inline(always)]
    fn ln(self) -> Self {
        f64::ln(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        f64::copysign(self, sign)
    }

    #[inline(always)]
    fn at_least(self, least: f64) -> Self {
        self.max(least)
    }

    #[inline(always)]
    fn angle_over(self, x: Self) -> Self {
        self.atan2(x)
    }

    #[inline(always)]
    fn where_below(self, limit: Self, yes: Self, no: Self) -> Self {
        if self < limit { yes } else { no }
    }

    #[inline(always)]
    fn largest(self) -> f64 {
        self
    }

    #[inline(always)]
    fn smallest(self) -> f64 {
        self
    }
}
