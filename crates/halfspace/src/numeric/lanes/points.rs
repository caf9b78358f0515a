//! Points of a complex plane, of which a function is taken four at a time.

use super::{Lanes, Pair, WIDTH, dispatch};
use crate::numeric::scalar::{Real, Scalar};
use arrayvec::ArrayVec;
use num_complex::Complex64;
use pulp::{Simd, WithSimd};

/// Most points, in fours.
const CAPACITY: usize = 24;

/// A function of a complex number.
pub(crate) trait Map {
    fn at<S: Simd>(&self, v: Pair<S>) -> Pair<S>;
}

/// Real and imaginary parts of four points.
type Four = [[f64; WIDTH]; 2];

/// Points of a complex plane.
#[derive(Debug, Clone)]
pub(crate) struct Points {
    fours: ArrayVec<Four, CAPACITY>,
    count: usize,
}

impl Points {
    /// Real and imaginary part of what is too far to matter, and of what the last four has no points for.
    pub(crate) const NOWHERE: f64 = 1e12;

    pub(crate) fn new() -> Self {
        Self {
            fours: ArrayVec::new(),
            count: 0,
        }
    }

    pub(crate) fn push(&mut self, point: Complex64) {
        let place = self.count % WIDTH;
        if place == 0 {
            self.fours.push([[Self::NOWHERE; WIDTH]; 2]);
        }
        if let Some([re, im]) = self.fours.last_mut() {
            (re[place], im[place]) = (point.re, point.im);
        }
        self.count += 1;
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = Complex64> {
        let all = self.fours.iter().flat_map(|[re, im]| re.iter().zip(im));
        all.take(self.count)
            .map(|(&re, &im)| Complex64::new(re, im))
    }

    /// Replaces each point.
    pub(crate) fn map(&mut self, map: &impl Map) {
        dispatch(Mapped { points: self, map });
    }

    /// Puts the major axes of the ellipses with foci s0, s1 through the points, focal distance 2, into `axes`; the smallest.
    pub(crate) fn axes(&self, s0: f64, s1: f64, axes: &mut Axes) -> f64 {
        dispatch(AxesOf {
            points: self,
            foci: [s0, s1],
            axes,
        })
    }
}

#[inline(always)]
fn pair<S: Simd>(simd: S, four: &Four) -> Pair<S> {
    let [re, im] = four.map(|part| Lanes::new(simd, part));
    Pair { re, im }
}

/// One number for each point, and some that are larger.
pub(crate) struct Axes(ArrayVec<[f64; WIDTH], CAPACITY>);

impl Axes {
    pub(crate) fn new() -> Self {
        Self(ArrayVec::new())
    }

    /// Sum of 1/rho^`power` over the axes up to a largest, rho the sum of the half axes.
    pub(crate) fn sum_of_inverse_powers(&self, largest: f64, power: u32) -> f64 {
        dispatch(Powers {
            axes: self,
            largest,
            power,
        })
    }
}

/// Major axis of the ellipse with foci s0, s1 through a point, focal distance 2.
#[inline(always)]
pub(crate) fn major_axis<T: Real>(re: T, im: T, s0: f64, s1: f64) -> T {
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

struct Mapped<'a, M> {
    points: &'a mut Points,
    map: &'a M,
}

impl<M: Map> WithSimd for Mapped<'_, M> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for four in &mut self.points.fours {
            let found = self.map.at(pair(simd, four));
            *four = [found.re.into_array(), found.im.into_array()];
        }
    }
}

struct AxesOf<'a> {
    points: &'a Points,
    foci: [f64; 2],
    axes: &'a mut Axes,
}

impl WithSimd for AxesOf<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let Self {
            points,
            foci: [s0, s1],
            axes: Axes(axes),
        } = self;
        let mut smallest = Lanes::all(simd, f64::INFINITY);
        axes.clear();
        for four in &points.fours {
            let point = pair(simd, four);
            let axis = major_axis(point.re, point.im, s0, s1);
            smallest = smallest.min(axis);
            axes.push(axis.into_array());
        }
        smallest
            .into_array()
            .into_iter()
            .fold(f64::INFINITY, f64::min)
    }
}

struct Powers<'a> {
    axes: &'a Axes,
    largest: f64,
    power: u32,
}

impl WithSimd for Powers<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let [zero, one, largest] = [0.0, 1.0, self.largest].map(|v| Lanes::all(simd, v));
        let Axes(axes) = self.axes;
        let mut sum = 0.0;
        for axis in axes {
            let axis = Lanes::new(simd, *axis);
            let left = one / power(half_axes(axis), self.power);
            for left in largest.where_below(axis, zero, left).into_array() {
                sum += left;
            }
        }
        sum
    }
}
