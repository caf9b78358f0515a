//! A segment of a trace: R as a polynomial in s, where time is a function of s.
//!
//! ```text
//! t = a + (b - a) sin^2(pi s/2)             between fronts a and b
//! t = a + (w - 1)^2/(2 w), w = e^(Y s)      after a front a whose next is very far, or the last; before one likewise
//! t = c + b sinh(x + (y - x) s)             around a time c at which a wave of duration b passes
//! ```
//!
//! The first two make the roots at the fronts smooth functions of s; the last two do this also for 1/t, in which R is
//! finally smooth. The second is t - a + 1 = cosh(Y s): the front of the other edge, about one disc width away, where R
//! has another root, keeps its distance in s, however long the interval. The third does the same for roots at c + i b
//! and c - i b.
//!
//! The nodes are those of [`leja_nodes`], none of which lies on a front.

use crate::domain::DomainError;
use crate::field::{Estimate, Six};
use crate::numeric::gauss;
use crate::numeric::polynomial::{LEJA_NODES, chebyshev_each, leja_nodes, leja_rest, leja_series};
use std::f64::consts::{FRAC_PI_2, PI};

/// Initial number of nodes of a segment.
const FIRST_NODES: usize = 3;

/// Ratio of the error of an integral over a cell to the mean error estimate of the values at the nodes; the errors of
/// values are well below their estimates and have both signs.
const CELL_NOISE: f64 = 0.12;

/// Time as a function of s, which ascends within [0, 1].
#[derive(Debug, Clone, Copy)]
pub(crate) enum Course {
    /// Between two fronts.
    Between([f64; 2]),
    /// On one side of a front: its time, Y and the sign of the side.
    Beside([f64; 3]),
    /// Around a wave without a front: its time, its duration, and x and y.
    Around([f64; 2], [f64; 2]),
}

impl Course {
    /// Course from a front to a time before or after it.
    pub(crate) fn beside(front: f64, other: f64) -> Self {
        let distance = other - front;
        Self::Beside([front, turn(distance.abs()), distance.signum()])
    }

    /// Course around a wave, from one time to another.
    pub(crate) fn around([centre, duration]: [f64; 2], times: [f64; 2]) -> Self {
        let ends = times.map(|t| ((t - centre) / duration).asinh());
        Self::Around([centre, duration], ends)
    }

    /// Logarithm of the ratio of times along the course; zero between two fronts.
    pub(crate) fn length(&self) -> f64 {
        match self {
            Self::Between(_) => 0.0,
            Self::Beside([_, most, _]) => *most,
            Self::Around(_, [first, last]) => last - first,
        }
    }
}

/// s at a distance over Y, or the reverse; s ascends with time before and after a front.
fn directed(sign: f64, s: f64) -> f64 {
    if sign > 0.0 { s } else { 1.0 - s }
}

/// The y for which cosh y - 1 equals a distance.
fn turn(distance: f64) -> f64 {
    (distance + (distance * (distance + 2.0)).sqrt()).ln_1p()
}

/// An interval of time, mapped to an interval of s.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MappedInterval {
    course: Course,
    s: [f64; 2],
}

impl MappedInterval {
    /// From the start of a course to a time.
    pub(crate) fn new(course: Course, end: f64) -> Self {
        let mut piece = Self {
            course,
            s: [0.0, 1.0],
        };
        piece.s[1] = piece.place(end);
        piece
    }

    /// Time from `origin` at s, and dt/ds.
    fn time(&self, s: f64, origin: f64) -> (f64, f64) {
        match self.course {
            Course::Between([from, to]) => {
                let (length, (sin, cos)) = (to - from, (FRAC_PI_2 * s).sin_cos());
                let time = if s < 0.5 {
                    (from - origin) + length * sin * sin
                } else {
                    (to - origin) - length * cos * cos
                };
                (time, PI * length * sin * cos)
            }
            Course::Beside([front, most, sign]) => {
                // w - 1, and 1/2 of 1/w
                let more = (most * directed(sign, s)).exp_m1();
                let half = 0.5 / (1.0 + more);
                let time = (front - origin) + sign * more * more * half;
                (time, most * more * (more + 2.0) * half)
            }
            Course::Around([centre, duration], [first, last]) => {
                let y = first + (last - first) * s;
                let time = (centre - origin) + duration * y.sinh();
                (time, (last - first) * duration * y.cosh())
            }
        }
    }

    /// s of a time, limited to the interval.
    fn place(&self, t: f64) -> f64 {
        let s = match self.course {
            Course::Between([from, to]) => {
                let [x, y] = [t - from, to - t].map(|x| x.max(0.0).sqrt());
                x.atan2(y) / FRAC_PI_2
            }
            Course::Beside([front, most, sign]) => {
                directed(sign, turn((sign * (t - front)).max(0.0)) / most)
            }
            Course::Around([centre, duration], [first, last]) => {
                (((t - centre) / duration).asinh() - first) / (last - first)
            }
        };
        s.clamp(self.s[0], self.s[1])
    }

    /// Middle and half width of the interval of s.
    fn middle(&self) -> (f64, f64) {
        let [low, high] = self.s;
        (0.5 * (low + high), 0.5 * (high - low))
    }

    /// Division into parts of equal length in s.
    pub(crate) fn parts(self, count: u32) -> impl DoubleEndedIterator<Item = Self> {
        let at = move |i: u32| {
            let part = f64::from(i) / f64::from(count);
            self.s[0] + (self.s[1] - self.s[0]) * part
        };
        (0..count).map(move |i| Self {
            s: [at(i), at(i + 1)],
            ..self
        })
    }

    /// Start and end in time.
    pub(crate) fn times(&self) -> [f64; 2] {
        self.s.map(|s| self.time(s, 0.0).0)
    }
}

/// A segment with its polynomial.
#[derive(Debug, Clone)]
pub(crate) struct Segment {
    /// Start and end in time.
    pub(crate) times: [f64; 2],
    pub(crate) piece: MappedInterval,
    /// Coefficients of Chebyshev's polynomials.
    series: Vec<Six>,
    /// Likely error of the mean of R over a part of the segment, without the truncation error of the series.
    pub(crate) error: Six,
    /// Truncation error of the polynomial, estimated from its last terms.
    pub(crate) truncation: Six,
    /// Values at the nodes, and the sum of their errors.
    values: Vec<Six>,
    noise: Six,
}

impl Segment {
    /// A segment with the smallest number of nodes.
    pub(crate) fn fit(
        piece: MappedInterval,
        remainder: impl FnMut(f64) -> Result<Estimate, DomainError>,
    ) -> Result<Self, DomainError> {
        let mut segment = Self {
            times: piece.times(),
            piece,
            series: Vec::new(),
            error: Six::default(),
            truncation: Six::default(),
            values: Vec::new(),
            noise: Six::default(),
        };
        segment.refine(remainder)?;
        Ok(segment)
    }

    /// Uses the next larger set of nodes; returns false if there is none.
    pub(crate) fn refine(
        &mut self,
        mut remainder: impl FnMut(f64) -> Result<Estimate, DomainError>,
    ) -> Result<bool, DomainError> {
        let terms = match self.values.len() {
            0 => FIRST_NODES,
            LEJA_NODES => return Ok(false),
            some => some + 2,
        };
        let (middle, half) = self.piece.middle();
        for node in &leja_nodes()[self.values.len()..terms] {
            let (t, _) = self.piece.time(middle + half * node, 0.0);
            let found = remainder(t)?;
            self.values.push(found.value);
            for (sum, e) in self.noise.iter_mut().zip(found.error) {
                *sum += CELL_NOISE * e;
            }
        }
        self.series = leja_series(&self.values);
        self.truncation = leja_rest(&self.series);
        // a time has its rounding error
        let rounding = 4.0 * f64::EPSILON * self.times[1] / (self.times[1] - self.times[0]);
        for f in 0..6 {
            let size = |part: &[Six]| part.iter().map(|c| c[f].abs()).sum::<f64>();
            self.error[f] = self.noise[f] / terms as f64 + rounding * size(&self.series[1..]);
        }
        Ok(true)
    }

    /// The start of the segment, and times in it between which few terms would be enough.
    pub(crate) fn breaks(&self) -> impl Iterator<Item = f64> {
        const FEW_TERMS: usize = 12;
        let parts = self.series.len().div_ceil(FEW_TERMS) as u32;
        self.piece.parts(parts).map(|part| part.times()[0])
    }

    /// R in the middle.
    pub(crate) fn middle(&self) -> &Six {
        &self.values[0]
    }

    /// R at some s.
    fn values<const N: usize>(&self, s: [f64; N]) -> [[f64; N]; 6] {
        let (middle, half) = self.piece.middle();
        chebyshev_each(&self.series, s.map(|s| (s - middle) / half))
    }

    /// R at times of the segment.
    pub(crate) fn at<const N: usize>(&self, times: [f64; N]) -> [[f64; N]; 6] {
        self.values(times.map(|t| self.piece.place(t)))
    }

    /// Adds int R dt, int (t - centre) R dt and int (t - centre)^2 R dt over a part of the segment.
    pub(crate) fn add(&self, from: f64, to: f64, centre: f64, sums: &mut [Six; 3]) {
        /// Length of a part, as a fraction of the segment over the number of terms, below which the polynomial is
        /// nearly a cubic.
        const SHORT_PART: f64 = 0.75;
        /// Nodes for dt/ds times t^2: exact if time is a square; otherwise the minimum for a wave.
        const SQUARE: usize = 3;
        const WAVE: f64 = 11.0;
        const LEAST_NODES: f64 = 5.0;
        /// Number of nodes computed in parallel.
        const GROUP_NODES: usize = 4;
        let [low, high] = [from, to].map(|t| self.piece.place(t));
        let (_, half) = self.piece.middle();
        let part = (high - low) / (2.0 * half);
        let terms = self.series.len();
        let nodes = match self.piece.course {
            _ if part * (terms as f64) < SHORT_PART => GROUP_NODES,
            Course::Between(_) => {
                // toward an end of the segment the terms vary on the scale of its root
                let whole = 0.5 * terms as f64 + WAVE;
                (LEAST_NODES + part.sqrt() * (whole - LEAST_NODES)).ceil() as usize
            }
            course @ (Course::Beside(_) | Course::Around(..)) => {
                terms / 2 + SQUARE + (course.length() * (high - low)).ceil() as usize
            }
        };
        let mut rule = gauss::rule(nodes).on(low, high);
        for _ in 0..nodes.div_ceil(GROUP_NODES) {
            // an incomplete group is filled with nodes of zero weight
            let group: [_; GROUP_NODES] =
                std::array::from_fn(|_| rule.next().unwrap_or((high, 0.0)));
            let values = self.values(group.map(|(s, _)| s));
            for (i, (s, weight)) in group.into_iter().enumerate() {
                let (arm, slope) = self.piece.time(s, centre);
                for (f, values) in values.iter().enumerate() {
                    let value = weight * slope * values[i];
                    sums[0][f] += value;
                    sums[1][f] += arm * value;
                    sums[2][f] += arm * arm * value;
                }
            }
        }
    }
}
