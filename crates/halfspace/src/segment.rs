//! A piece of a trace: R as a Chebyshev series in the root of the distance in time from a front.
//!
//! ```text
//! t = anchor + scale s^2      scale > 0 after a front, scale < 0 before one
//! ```

use crate::chebyshev;
use crate::error::DomainError;
use crate::field::{Estimate, Six};
use crate::gauss;

/// Terms of a series.
const TERMS: usize = 16;

/// Error of an integral over a cell over the mean estimate of the values at the nodes: errors of values are well below
/// their estimates and of any sign.
const NOISE: f64 = 0.12;

/// An interval of time as one of s.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    pub(crate) anchor: f64,
    pub(crate) scale: f64,
    pub(crate) s: [f64; 2],
}

impl Piece {
    fn time(&self, s: f64) -> f64 {
        self.anchor + self.scale * s * s
    }

    /// s of a time, held on the piece.
    fn place(&self, t: f64) -> f64 {
        let s = ((t - self.anchor) / self.scale).max(0.0).sqrt();
        s.clamp(self.s[0], self.s[1])
    }

    /// Middle and half width of the interval of s.
    fn middle(&self) -> (f64, f64) {
        let [low, high] = self.s;
        (0.5 * (low + high), 0.5 * (high - low))
    }

    /// Its halves in s, the earlier first.
    pub(crate) fn halves(self) -> (Self, Self) {
        let (middle, _) = self.middle();
        let part = |s| Self { s, ..self };
        let (low, high) = (part([self.s[0], middle]), part([middle, self.s[1]]));
        if self.scale > 0.0 {
            (low, high)
        } else {
            (high, low)
        }
    }
}

/// A piece with its series.
#[derive(Debug, Clone)]
pub(crate) struct Segment {
    /// Start and end in time.
    pub(crate) times: [f64; 2],
    pub(crate) piece: Piece,
    series: [Six; TERMS],
    /// Likely error of the mean of R over a part of the segment, but for the truncation of the series.
    pub(crate) error: Six,
}

impl Segment {
    /// Fits a series to R at the nodes of a piece.
    pub(crate) fn fit(
        piece: Piece,
        mut remainder: impl FnMut(f64) -> Result<Estimate, DomainError>,
    ) -> Result<Self, DomainError> {
        let (middle, half) = piece.middle();
        let mut values = [Six::default(); TERMS];
        let mut error = Six::default();
        for (i, value) in values.iter_mut().enumerate() {
            let found = remainder(piece.time(middle + half * chebyshev::node(i, TERMS)))?;
            *value = found.value;
            for (sum, e) in error.iter_mut().zip(found.error) {
                *sum += NOISE * e / TERMS as f64;
            }
        }
        let series = chebyshev::fit(&values);
        let times = piece.s.map(|s| piece.time(s));
        let times = [times[0].min(times[1]), times[0].max(times[1])];
        // a time is known to its rounding error
        let blur = 4.0 * f64::EPSILON * times[1] / (times[1] - times[0]);
        for (f, error) in error.iter_mut().enumerate() {
            let variation: f64 = series[1..].iter().map(|c| c[f].abs()).sum();
            *error += blur * variation;
        }
        Ok(Self {
            times,
            piece,
            series,
            error,
        })
    }

    /// Truncation error of the series, from its last terms.
    pub(crate) fn truncation(&self) -> Six {
        /// Beside a front the terms fall as a power, and many of the same size follow the last.
        const CAUTION: f64 = 3.0;
        std::array::from_fn(|f| {
            let last = self.series[TERMS - 3..].iter().map(|c| c[f].abs());
            CAUTION * last.sum::<f64>()
        })
    }

    /// R at a time of the segment.
    pub(crate) fn at(&self, t: f64) -> Estimate {
        let (middle, half) = self.piece.middle();
        let truncation = self.truncation();
        Estimate {
            value: chebyshev::value(&self.series, (self.piece.place(t) - middle) / half),
            error: std::array::from_fn(|f| self.error[f] + truncation[f]),
        }
    }

    /// Adds int R dt, int (t - centre) R dt and the error of the first over a part of the segment.
    pub(crate) fn add(&self, from: f64, to: f64, centre: f64, sums: &mut [Six; 3]) {
        /// On a part this short, as a fraction of the segment, the series is nearly a cubic.
        const SHORT: f64 = 0.05;
        /// What is left of a series is of either sign over a segment, and so is the force's rate times it.
        const OSCILLATES: f64 = 0.5;
        let Piece { anchor, scale, .. } = self.piece;
        let [mut low, mut high] = [from, to].map(|t| self.piece.place(t));
        if low > high {
            (low, high) = (high, low);
        }
        let (middle, half) = self.piece.middle();
        // exact for the series times dt/ds times t
        let nodes = if high - low < SHORT * 2.0 * half {
            4
        } else {
            TERMS / 2 + 2
        };
        let [area, moment, error] = sums;
        for (s, weight) in gauss::rule(nodes).on(low, high) {
            let value = chebyshev::value(&self.series, (s - middle) / half);
            let weight = weight * 2.0 * scale.abs() * s;
            let arm = (anchor - centre) + scale * s * s;
            for (f, value) in value.into_iter().enumerate() {
                area[f] += weight * value;
                moment[f] += weight * arm * value;
            }
        }
        let truncation = self.truncation();
        for (f, error) in error.iter_mut().enumerate() {
            *error += (to - from) * (self.error[f] + OSCILLATES * truncation[f]);
        }
    }
}
