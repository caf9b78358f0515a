//! Four real or complex numbers side by side in vector registers, with the functions of the closed forms.
//!
//! No operation is fused and the width is fixed, so that a machine without vector registers finds the same bits.

mod elementary;
mod pair;
mod points;

pub(crate) use pair::Pair;
pub(crate) use points::{Axes, Map, Points, half_axes, major_axis, power};

use crate::numeric::scalar::{Real, Scalar};
use pulp::{Simd, WithSimd, cast};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// How many numbers go side by side.
pub(crate) const WIDTH: usize = 4;

/// Runs `work` with the machine's vector registers, or without any.
#[inline]
pub(crate) fn dispatch<W: WithSimd>(work: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    if let Some(simd) = pulp::x86::V3::try_new() {
        return Simd::vectorize(simd, work);
    }
    Simd::vectorize(pulp::Scalar256b, work)
}

/// Four real numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lanes<S: Simd> {
    simd: S,
    four: S::f64s,
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, four: [f64; WIDTH]) -> Self {
        Self {
            simd,
            four: cast(four),
        }
    }

    #[inline(always)]
    pub(crate) fn all(simd: S, value: f64) -> Self {
        Self {
            simd,
            four: simd.splat_f64s(value),
        }
    }

    #[inline(always)]
    pub(crate) fn into_array(self) -> [f64; WIDTH] {
        cast(self.four)
    }

    #[inline(always)]
    fn with(self, four: S::f64s) -> Self {
        Self { four, ..self }
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        self.with(self.simd.abs_f64s(self.four))
    }

    #[inline(always)]
    pub(crate) fn max(self, other: Self) -> Self {
        self.with(self.simd.max_f64s(self.four, other.four))
    }

    #[inline(always)]
    pub(crate) fn min(self, other: Self) -> Self {
        self.with(self.simd.min_f64s(self.four, other.four))
    }

    #[inline(always)]
    pub(crate) fn copysign(self, other: Self) -> Self {
        let Self { simd, .. } = self;
        let sign = simd.and_f64s(other.four, simd.splat_f64s(-0.0));
        self.with(simd.or_f64s(self.abs().four, sign))
    }

    /// The largest of the four.
    #[inline(always)]
    pub(crate) fn largest(self) -> f64 {
        self.simd.reduce_max_f64s(self.four)
    }

    /// `yes` where this is below `limit`, else `no`.
    #[inline(always)]
    pub(crate) fn where_below(self, limit: Self, yes: Self, no: Self) -> Self {
        let mask = self.simd.less_than_f64s(self.four, limit.four);
        self.with(self.simd.select_f64s(mask, yes.four, no.four))
    }

    /// Horner's rule, the highest coefficient first.
    #[inline(always)]
    fn polynomial<const N: usize>(self, coefficients: [f64; N]) -> Self {
        let mut sum = self.constant(coefficients[0]);
        for c in &coefficients[1..] {
            sum = sum * self + *c;
        }
        sum
    }
}

macro_rules! operators {
    ($($operation:ident, $method:ident, $vector:ident;)*) => {$(
        impl<S: Simd> $operation for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.with(self.simd.$vector(self.four, other.four))
            }
        }

        impl<S: Simd> $operation<f64> for Lanes<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                self.$method(self.constant(other))
            }
        }
    )*};
}

operators! {
    Add, add, add_f64s;
    Sub, sub, sub_f64s;
    Mul, mul, mul_f64s;
    Div, div, div_f64s;
}

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.with(self.simd.neg_f64s(self.four))
    }
}

impl<S: Simd> Scalar for Lanes<S> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::all(self.simd, value)
    }
}

impl<S: Simd> Real for Lanes<S> {
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.with(self.simd.sqrt_f64s(self.four))
    }

    #[inline(always)]
    fn exp(self) -> Self {
        self.exponential()
    }

    #[inline(always)]
    fn at_least(self, least: f64) -> Self {
        self.max(self.constant(least))
    }
}
