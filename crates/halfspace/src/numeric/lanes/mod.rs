//! Real or complex numbers in vector registers, with the functions of the closed forms.
//!
//! A register contains two, four or eight numbers. No operation is fused, and sums are those of blocks of eight, so that
//! results are bit-identical on every machine.

/// Operators between registers, each by its formula.
macro_rules! operators {
    ($($numbers:ident, $operation:ident<$other:ty>, $method:ident: |$a:ident, $b:ident| $formula:expr;)*) => {$(
        impl<S: Simd> $operation<$other> for $numbers<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, $b: $other) -> Self {
                let $a = self;
                $formula
            }
        }
    )*};
}

mod elementary;
mod pair;
mod points;

pub(crate) use pair::Pair;
pub(crate) use points::{ComplexMap, Points, half_axes, major_axis, power};

use crate::numeric::scalar::Scalar;
use pulp::{Simd, WithSimd};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Number of numbers in a block, which fills one register or several.
pub(crate) const WIDTH: usize = 8;

/// Runs `work` with the machine's vector registers, or without any.
#[inline]
pub(crate) fn dispatch<W: WithSimd>(work: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    {
        if let Some(simd) = pulp::x86::V4::try_new() {
            return Simd::vectorize(simd, work);
        }
        if let Some(simd) = pulp::x86::V3::try_new() {
            return Simd::vectorize(simd, work);
        }
    }
    #[cfg(target_arch = "wasm32")]
    if let Some(simd) = pulp::wasm::Simd128::try_new() {
        return Simd::vectorize(simd, work);
    }
    Simd::vectorize(pulp::Scalar256b, work)
}

/// The sum of a block.
#[inline(always)]
pub(crate) fn total([a, b, c, d, e, f, g, h]: &[f64; WIDTH]) -> f64 {
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}

/// The real numbers of one register.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lanes<S: Simd> {
    simd: S,
    pub(crate) register: S::f64s,
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub(crate) fn of(simd: S, register: S::f64s) -> Self {
        Self { simd, register }
    }

    #[inline(always)]
    pub(crate) fn all(simd: S, value: f64) -> Self {
        Self::of(simd, simd.splat_f64s(value))
    }

    /// The first of two numbers in the first place, and the second in all others.
    #[inline(always)]
    pub(crate) fn two(simd: S, [first, second]: [f64; 2]) -> Self {
        let mut block = [second; WIDTH];
        block[0] = first;
        Self::of(simd, S::as_simd_f64s(&block).0[0])
    }

    #[inline(always)]
    pub(crate) fn get(self, i: usize) -> f64 {
        let mut block = [0.0; WIDTH];
        S::as_mut_simd_f64s(&mut block).0[0] = self.register;
        block[i]
    }

    /// The numbers of whole blocks.
    #[inline(always)]
    pub(crate) fn registers(simd: S, blocks: &[f64]) -> impl Iterator<Item = Self> {
        let registers = S::as_simd_f64s(blocks).0.iter();
        registers.map(move |&register| Self::of(simd, register))
    }

    #[inline(always)]
    fn with(self, register: S::f64s) -> Self {
        Self { register, ..self }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.with(self.simd.max_f64s(self.register, other.register))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.with(self.simd.min_f64s(self.register, other.register))
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

operators! {
    Lanes, Add<Self>, add: |a, b| a.with(a.simd.add_f64s(a.register, b.register));
    Lanes, Sub<Self>, sub: |a, b| a.with(a.simd.sub_f64s(a.register, b.register));
    Lanes, Mul<Self>, mul: |a, b| a.with(a.simd.mul_f64s(a.register, b.register));
    Lanes, Div<Self>, div: |a, b| a.with(a.simd.div_f64s(a.register, b.register));
    Lanes, Add<f64>, add: |a, b| a + a.constant(b);
    Lanes, Sub<f64>, sub: |a, b| a - a.constant(b);
    Lanes, Mul<f64>, mul: |a, b| a * a.constant(b);
}

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.with(self.simd.neg_f64s(self.register))
    }
}

impl<S: Simd> Scalar for Lanes<S> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::all(self.simd, value)
    }
}
