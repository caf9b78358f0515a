//! Points of a complex plane, of which a function is taken for several at a time.

use super::{Lanes, Pair, WIDTH, dispatch};
use crate::numeric::scalar::{Complex, Real, Scalar};
use arrayvec::ArrayVec;
use num_complex::Complex64;
use pulp::{Simd, WithSimd};

/// Most points, in whole blocks: each of 16 fronts and 10 fixed points may be a cut too.
const CAPACITY: usize = 8 * WIDTH;

/// A function of a complex number.
pub(crate) trait Map {
    fn at<C: Complex>(&self, v: C) -> C;
}

/// Points of a complex plane, real and imaginary parts side by side.
#[derive(Debug, Clone)]
pub(crate) struct Points {
    /// In whole blocks, the last filled with what is nowhere.
    re: ArrayVec<f64, CAPACITY>,
    im: ArrayVec<f64, CAPACITY>,
    count: usize,
}

impl Points {
    /// Real and imaginary part of what is too far to matter, and of what fills the last register.
    pub(crate) const NOWHERE: f64 = 1e12;

    #[inline]
    pub(crate) fn new() -> Self {
        Self {
            re: ArrayVec::new(),
            im: ArrayVec::new(),
            count: 0,
        }
    }

    #[inline]
    pub(crate) fn push(&mut self, point: Complex64) {
        if self.count == self.re.len() {
            extend(&mut self.re, &[Self::NOWHERE; WIDTH]);
            extend(&mut self.im, &[Self::NOWHERE; WIDTH]);
        }
        (self.re[self.count], self.im[self.count]) = (point.re, point.im);
        self.count += 1;
    }

    #[inline]
    pub(crate) fn iter(&self) -> impl Iterator<Item = Complex64> {
        let all = self.re.iter().zip(&self.im).take(self.count);
        all.map(|(&re, &im)| Complex64::new(re, im))
    }

    /// Becomes the points of another.
    #[inline]
    pub(crate) fn copy(&mut self, points: &Self) {
        self.re.clear();
        self.im.clear();
        extend(&mut self.re, &points.re);
        extend(&mut self.im, &points.im);
        self.count = points.count;
    }

    /// Replaces each point.
    #[inline]
    pub(crate) fn map(&mut self, map: &impl Map) {
        dispatch(Mapped { points: self, map });
    }

    /// The same, one by one.
    pub(crate) fn replace(&mut self, map: impl Fn(Complex64) -> Complex64) {
        for (re, im) in self.re.iter_mut().zip(&mut self.im).take(self.count) {
            Complex64 { re: *re, im: *im } = map(Complex64::new(*re, *im));
        }
    }

    /// The smallest major axis of the ellipses with two foci through the points, focal distance 2.
    pub(crate) fn smallest_axis(&self, foci: [f64; 2]) -> f64 {
        dispatch(SmallestAxis { points: self, foci })
    }

    /// Sum of 1/rho^`power` over those ellipses of an axis up to `largest`, rho the sum of the half axes.
    pub(crate) fn sum_of_inverse_powers(&self, foci: [f64; 2], largest: f64, power: u32) -> f64 {
        let axes = SmallestAxis { points: self, foci };
        dispatch(InversePowers {
            axes,
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

/// x to a whole power.
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

/// Adds numbers for which there is room.
#[inline(always)]
fn extend<const N: usize>(numbers: &mut ArrayVec<f64, N>, more: &[f64]) {
    let added = numbers.try_extend_from_slice(more);
    debug_assert!(added.is_ok());
}

struct Mapped<'a, M> {
    points: &'a mut Points,
    map: &'a M,
}

impl<M: Map> WithSimd for Mapped<'_, M> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Points { re, im, count } = self.points;
        let used = count.next_multiple_of(S::F64_LANES);
        let (re, _) = S::as_mut_simd_f64s(&mut re[..used]);
        let (im, _) = S::as_mut_simd_f64s(&mut im[..used]);
        for (re, im) in re.iter_mut().zip(im) {
            let found = self
                .map
                .at(Pair::new(Lanes::of(simd, *re), Lanes::of(simd, *im)));
            (*re, *im) = (found.re.register, found.im.register);
        }
    }
}

struct SmallestAxis<'a> {
    points: &'a Points,
    foci: [f64; 2],
}

impl SmallestAxis<'_> {
    /// Calls `f` with the axis of each point.
    #[inline(always)]
    fn for_each<S: Simd>(&self, simd: S, mut f: impl FnMut(Lanes<S>)) {
        let Points { re, im, count } = self.points;
        let used = count.next_multiple_of(S::F64_LANES);
        let parts = [re, im].map(|part| Lanes::registers(simd, &part[..used]));
        let [re, im] = parts;
        re.zip(im)
            .for_each(|(re, im)| f(major_axis(re, im, self.foci)));
    }
}

impl WithSimd for SmallestAxis<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let mut smallest = Lanes::all(simd, f64::INFINITY);
        self.for_each(simd, |axis| smallest = smallest.min(axis));
        smallest.smallest()
    }
}

struct InversePowers<'a> {
    axes: SmallestAxis<'a>,
    largest: f64,
    power: u32,
}

impl WithSimd for InversePowers<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let [zero, one, largest] = [0.0, 1.0, self.largest].map(|v| Lanes::all(simd, v));
        let mut sums = [0.0; WIDTH];
        let (sums_of, mut next) = (S::as_mut_simd_f64s(&mut sums).0, 0);
        self.axes.for_each(simd, |axis| {
            let left = one / power(half_axes(axis), self.power);
            let sum = &mut sums_of[next % (WIDTH / S::F64_LANES)];
            *sum = (Lanes::of(simd, *sum) + largest.where_below(axis, zero, left)).register;
            next += 1;
        });
        super::total(&sums)
    }
}
