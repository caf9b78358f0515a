//! Points in the complex plane; functions are evaluated at several points at a time.

use super::{Lanes, Pair, WIDTH, dispatch};
use crate::numeric::scalar::{Complex, Real, Scalar};
use arrayvec::ArrayVec;
use num_complex::Complex64;
use pulp::{Simd, WithSimd};

/// Largest number of blocks of points: each of 16 fronts and 10 fixed points may be a cut too.
const BLOCKS: usize = 8;

/// A function of a complex number.
pub(crate) trait ComplexMap {
    fn at<C: Complex>(&self, v: C) -> C;
}

/// Points in the complex plane, with separate real and imaginary parts.
#[derive(Debug, Clone, Default)]
pub(crate) struct Points {
    /// The last block is filled with [`Self::NOWHERE`].
    blocks: ArrayVec<[[f64; WIDTH]; 2], BLOCKS>,
    count: usize,
}

impl Points {
    /// Real and imaginary part of points that are too far to matter, and of those that fill the last block.
    pub(crate) const NOWHERE: f64 = 1e12;

    #[inline]
    pub(crate) fn push(&mut self, point: Complex64) {
        let place = self.count % WIDTH;
        if place == 0 {
            self.blocks.push([[Self::NOWHERE; WIDTH]; 2]);
        }
        if let Some([re, im]) = self.blocks.last_mut() {
            (re[place], im[place]) = (point.re, point.im);
        }
        self.count += 1;
    }

    #[inline]
    pub(crate) fn iter(&self) -> impl Iterator<Item = Complex64> {
        let all = self.blocks.iter().flat_map(|[re, im]| re.iter().zip(im));
        all.take(self.count)
            .map(|(&re, &im)| Complex64::new(re, im))
    }

    /// Copies the points of another.
    #[inline]
    pub(crate) fn copy(&mut self, points: &Self) {
        self.blocks.clone_from(&points.blocks);
        self.count = points.count;
    }

    /// Replaces each point.
    #[inline]
    pub(crate) fn map(&mut self, map: &impl ComplexMap) {
        dispatch(Mapped { points: self, map });
    }

    /// Replaces each point, one by one.
    pub(crate) fn replace(&mut self, map: impl Fn(Complex64) -> Complex64) {
        let parts = self
            .blocks
            .iter_mut()
            .flat_map(|[re, im]| re.iter_mut().zip(im));
        for (re, im) in parts.take(self.count) {
            Complex64 { re: *re, im: *im } = map(Complex64::new(*re, *im));
        }
    }

    /// Smallest major axis of the ellipses with two foci through the points, focal distance 2.
    pub(crate) fn smallest_axis(&self, foci: [f64; 2]) -> f64 {
        dispatch(Axes { points: self, foci })
    }

    /// Sum of 1/rho^`power` over such ellipses of an axis up to `largest`, rho the sum of the half axes.
    pub(crate) fn sum_of_inverse_powers(&self, foci: [f64; 2], largest: f64, power: u32) -> f64 {
        dispatch(InversePowers {
            points: self,
            foci,
            largest,
            power,
        })
    }
}

/// Major axis of the ellipse with foci s0, s1 through a point, focal distance 2.
#[inline(always)]
pub(crate) fn major_axis<T: Real>(re: T, im: T, [s0, s1]: [f64; 2]) -> T {
    let (middle, inverse) = (0.5 * (s0 + s1), 2.0 / (s1 - s0));
    let (x, y) = ((re - middle) * inverse, im * inverse);
    let (square, twice) = (x * x + y * y + 1.0, x * 2.0);
    (square - twice).at_least(0.0).sqrt() + (square + twice).at_least(0.0).sqrt()
}

/// Sum of half axes of such an ellipse.
#[inline(always)]
pub(crate) fn half_axes<T: Real>(axis: T) -> T {
    let half = axis.at_least(2.0) * 0.5;
    half + (half * half - 1.0).sqrt().at_least(1e-9)
}

/// x to an integer power.
#[inline(always)]
pub(crate) fn power<T: Scalar>(mut x: T, mut exponent: u32) -> T {
    let mut product = x.constant(1.0);
    while exponent > 0 {
        if exponent & 1 == 1 {
            product = product * x;
        }
        x = x * x;
        exponent >>= 1;
    }
    product
}

struct Mapped<'a, M> {
    points: &'a mut Points,
    map: &'a M,
}

impl<M: ComplexMap> WithSimd for Mapped<'_, M> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for [re, im] in &mut self.points.blocks {
            let (re, im) = (S::as_mut_simd_f64s(re).0, S::as_mut_simd_f64s(im).0);
            for (re, im) in re.iter_mut().zip(im) {
                let point = Pair::new(Lanes::of(simd, *re), Lanes::of(simd, *im));
                let found = self.map.at(point);
                (*re, *im) = (found.re.register, found.im.register);
            }
        }
    }
}

struct Axes<'a> {
    points: &'a Points,
    foci: [f64; 2],
}

impl WithSimd for Axes<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let mut smallest = Lanes::all(simd, f64::INFINITY);
        for parts in &self.points.blocks {
            let [re, im] = parts.each_ref().map(|part| Lanes::registers(simd, part));
            for (re, im) in re.zip(im) {
                smallest = smallest.min(major_axis(re, im, self.foci));
            }
        }
        smallest.smallest()
    }
}

struct InversePowers<'a> {
    points: &'a Points,
    foci: [f64; 2],
    largest: f64,
    power: u32,
}

impl WithSimd for InversePowers<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let [zero, one, largest] = [0.0, 1.0, self.largest].map(|v| Lanes::all(simd, v));
        let mut sums = [0.0; WIDTH];
        let sums_of = S::as_mut_simd_f64s(&mut sums).0;
        for parts in &self.points.blocks {
            let [re, im] = parts.each_ref().map(|part| Lanes::registers(simd, part));
            for (sum, (re, im)) in sums_of.iter_mut().zip(re.zip(im)) {
                let axis = major_axis(re, im, self.foci);
                let left = one / power(half_axes(axis), self.power);
                *sum = (Lanes::of(simd, *sum) + largest.where_below(axis, zero, left)).register;
            }
        }
        super::total(&sums)
    }
}
