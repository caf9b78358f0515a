//! Points of a complex plane, of which a function is taken four at a time.

use super::{Lanes, Pair, WIDTH, dispatch};
use crate::numeric::scalar::Real;
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
    /// What the last has no points for is one.
    fours: ArrayVec<Four, CAPACITY>,
    count: usize,
}

impl Points {
    pub(crate) fn new() -> Self {
        Self {
            fours: ArrayVec::new(),
            count: 0,
        }
    }

    pub(crate) fn push(&mut self, point: Complex64) {
        let place = self.count % WIDTH;
        if place == 0 {
            self.fours.push([[1.0; WIDTH]; 2]);
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

    /// Major axes of the ellipses with foci s0, s1 through the points, focal distance 2.
    pub(crate) fn axes(&self, s0: f64, s1: f64) -> Axes {
        dispatch(AxesOf {
            points: self,
            foci: [s0, s1],
        })
    }
}

#[inline(always)]
fn pair<S: Simd>(simd: S, four: &Four) -> Pair<S> {
    let [re, im] = four.map(|part| Lanes::new(simd, part));
    Pair { re, im }
}

/// One number for each point.
pub(crate) struct Axes {
    fours: ArrayVec<[f64; WIDTH], CAPACITY>,
    count: usize,
}

impl Axes {
    pub(crate) fn iter(&self) -> impl Iterator<Item = f64> {
        self.fours.iter().flatten().take(self.count).copied()
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
        for four in &mut self.points.fours {
            let found = self.map.at(pair(simd, four));
            *four = [found.re.into_array(), found.im.into_array()];
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
            fours: ArrayVec::new(),
            count: points.count,
        };
        let zero = Lanes::all(simd, 0.0);
        for four in &points.fours {
            let point = pair(simd, four);
            let (x, y) = ((point.re - middle) * inverse, point.im * inverse);
            let (square, twice) = (x * x + y * y + 1.0, x * 2.0);
            let axis = (square - twice).max(zero).sqrt() + (square + twice).max(zero).sqrt();
            axes.fours.push(axis.into_array());
        }
        axes
    }
}
