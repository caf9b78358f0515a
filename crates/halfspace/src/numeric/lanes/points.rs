//! Points of a complex plane, of which a function is taken four at a time.

use super::{Lanes, Pair, WIDTH, dispatch};
use crate::numeric::scalar::Real;
use num_complex::Complex64;
use pulp::{Simd, WithSimd};

/// Most points, a multiple of [`WIDTH`].
const CAPACITY: usize = 96;

/// A function of a complex number.
pub(crate) trait Map {
    fn at<S: Simd>(&self, v: Pair<S>) -> Pair<S>;
}

/// Points of a complex plane.
#[derive(Debug, Clone)]
pub(crate) struct Points {
    re: [f64; CAPACITY],
    im: [f64; CAPACITY],
    count: usize,
}

impl Points {
    pub(crate) fn new() -> Self {
        Self {
            re: [0.0; CAPACITY],
            im: [0.0; CAPACITY],
            count: 0,
        }
    }

    pub(crate) fn push(&mut self, point: Complex64) {
        debug_assert!(self.count < CAPACITY, "at most {CAPACITY} points");
        self.re[self.count] = point.re;
        self.im[self.count] = point.im;
        self.count += 1;
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = Complex64> {
        let parts = self.re.iter().zip(&self.im).take(self.count);
        parts.map(|(&re, &im)| Complex64::new(re, im))
    }

    /// Replaces each point.
    pub(crate) fn map(&mut self, map: &impl Map) {
        dispatch(Mapped { points: self, map });
    }

    /// Major axes of the ellipses with foci s0, s1 through the points, focal distance 2, and their number.
    pub(crate) fn axes(&self, s0: f64, s1: f64) -> Axes {
        dispatch(AxesOf {
            points: self,
            foci: [s0, s1],
        })
    }

    #[inline(always)]
    fn four<S: Simd>(&self, simd: S, first: usize) -> Pair<S> {
        Pair {
            re: Lanes::new(simd, std::array::from_fn(|i| self.re[first + i])),
            im: Lanes::new(simd, std::array::from_fn(|i| self.im[first + i])),
        }
    }
}

/// One number for each point.
pub(crate) struct Axes {
    all: [f64; CAPACITY],
    count: usize,
}

impl Axes {
    pub(crate) fn iter(&self) -> impl Iterator<Item = f64> {
        self.all[..self.count].iter().copied()
    }
}

struct Mapped<'a, M> {
    points: &'a mut Points,
    map: &'a M,
}

impl<M: Map> WithSimd for Mapped<'_, M> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { points, map } = self;
        for first in (0..points.count).step_by(WIDTH) {
            let found = map.at(points.four(simd, first));
            points.re[first..first + WIDTH].copy_from_slice(&found.re.into_array());
            points.im[first..first + WIDTH].copy_from_slice(&found.im.into_array());
        }
    }
}

struct AxesOf<'a> {
    points: &'a Points,
    foci: [f64; 2],
}

impl WithSimd for AxesOf<'_> {
    type Output = Axes;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Axes {
        let Self {
            points,
            foci: [s0, s1],
        } = self;
        let (middle, inverse) = (0.5 * (s0 + s1), 2.0 / (s1 - s0));
        let mut axes = Axes {
            all: [0.0; CAPACITY],
            count: points.count,
        };
        let zero = Lanes::all(simd, 0.0);
        for first in (0..points.count).step_by(WIDTH) {
            let point = points.four(simd, first);
            let (x, y) = ((point.re - middle) * inverse, point.im * inverse);
            let (square, twice) = (x * x + y * y + 1.0, x * 2.0);
            let axis = (square - twice).max(zero).sqrt() + (square + twice).max(zero).sqrt();
            axes.all[first..first + WIDTH].copy_from_slice(&axis.into_array());
        }
        axes
    }
}
