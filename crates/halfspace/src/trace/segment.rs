//! A segment of a trace: R as a polynomial in the root of the distance in time from a front.
//!
//! ```text
//! t = anchor + scale s^2      scale > 0 after a front, scale < 0 before one
//! ```
//!
//! The nodes are a Leja sequence, taken in pairs: each set holds the one before, so that a segment has as many as it needs,
//! and none lies on a front.

use crate::error::DomainError;
use crate::field::{Estimate, Six};
use crate::numeric::gauss;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Nodes of a segment at most, and at first.
const MOST: usize = 15;
const FEWEST: usize = 3;

/// What is left of a series over its last terms: beside a front they fall as a power, and many of the same size follow.
const CAUTION: f64 = 3.0;

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

    /// Start and end in time.
    pub(crate) fn times(&self) -> [f64; 2] {
        let [a, b] = self.s.map(|s| self.time(s));
        [a.min(b), a.max(b)]
    }
}

/// Nodes in [-1, 1], and what makes coefficients of Chebyshev's polynomials of values at the first of them, for each set.
struct Rule {
    nodes: [f64; MOST],
    inverses: Vec<Vec<[f64; MOST]>>,
}

static RULE: LazyLock<Rule> = LazyLock::new(|| {
    // after the middle and two near the ends, each pair where the product of distances to those before is largest
    let mut nodes = vec![0.0, -0.97, 0.97];
    while nodes.len() < MOST {
        let product = |x: f64| -> f64 {
            let own = (1.0 - x * x).sqrt();
            own * nodes.iter().map(|node| (x - node).abs()).product::<f64>()
        };
        let tried = (1..1000).map(|i| (0.5 * PI * f64::from(i) / 1000.0).sin());
        let best = tried.fold(
            0.5,
            |best, x| if product(x) > product(best) { x } else { best },
        );
        nodes.extend([-best, best]);
    }
    let inverse = |terms: usize| {
        let row = |i: usize| -> Vec<f64> {
            let unit = (0..terms).map(|j| f64::from(u8::from(i == j)));
            let angle = nodes[i].acos();
            (0..terms)
                .map(|j| (j as f64 * angle).cos())
                .chain(unit)
                .collect()
        };
        let mut rows: Vec<Vec<f64>> = (0..terms).map(row).collect();
        // Gauss and Jordan
        for column in 0..terms {
            let size = |i: &usize| rows[*i][column].abs();
            let pivot = (column..terms).max_by(|a, b| size(a).total_cmp(&size(b)));
            rows.swap(column, pivot.unwrap_or(column));
            let scale = rows[column][column].recip();
            let own: Vec<f64> = rows[column].iter().map(|x| scale * x).collect();
            for (i, row) in rows.iter_mut().enumerate() {
                let times = row[column];
                for (x, o) in row.iter_mut().zip(&own) {
                    *x = if i == column { *o } else { *x - times * o };
                }
            }
        }
        let kept = rows.iter().map(|row| {
            let mut kept = [0.0; MOST];
            kept[..terms].copy_from_slice(&row[terms..]);
            kept
        });
        kept.collect()
    };
    Rule {
        inverses: (0..=MOST)
            .map(|n| if n % 2 == 1 { inverse(n) } else { Vec::new() })
            .collect(),
        nodes: std::array::from_fn(|i| nodes[i]),
    }
});

/// A piece with its polynomial.
#[derive(Debug, Clone)]
pub(crate) struct Segment {
    /// Start and end in time.
    pub(crate) times: [f64; 2],
    pub(crate) piece: Piece,
    /// Coefficients of Chebyshev's polynomials.
    series: [Six; MOST],
    terms: usize,
    /// Likely error of the mean of R over a part of the segment, but for the truncation of the series.
    pub(crate) error: Six,
    /// Truncation error of the polynomial, from its last terms.
    pub(crate) truncation: Six,
    /// At the nodes so far: values, and the sum of their errors.
    values: [Six; MOST],
    noise: Six,
}

impl Segment {
    /// Of the fewest nodes.
    pub(crate) fn fit(
        piece: Piece,
        remainder: impl FnMut(f64) -> Result<Estimate, DomainError>,
    ) -> Result<Self, DomainError> {
        let mut segment = Self {
            times: piece.times(),
            piece,
            series: [Six::default(); MOST],
            terms: 0,
            error: Six::default(),
            truncation: Six::default(),
            values: [Six::default(); MOST],
            noise: Six::default(),
        };
        segment.refine(remainder)?;
        Ok(segment)
    }

    /// Takes the next larger set of nodes; whether there is one.
    pub(crate) fn refine(
        &mut self,
        mut remainder: impl FnMut(f64) -> Result<Estimate, DomainError>,
    ) -> Result<bool, DomainError> {
        if self.terms == MOST {
            return Ok(false);
        }
        let terms = if self.terms == 0 {
            FEWEST
        } else {
            self.terms + 2
        };
        let (middle, half) = self.piece.middle();
        for i in self.terms..terms {
            let found = remainder(self.piece.time(middle + half * RULE.nodes[i]))?;
            self.values[i] = found.value;
            for (sum, e) in self.noise.iter_mut().zip(found.error) {
                *sum += NOISE * e;
            }
        }
        self.terms = terms;
        for (term, weights) in self.series.iter_mut().zip(&RULE.inverses[terms]) {
            let mut sum = Six::default();
            for (weight, value) in weights[..terms].iter().zip(&self.values) {
                for (s, v) in sum.iter_mut().zip(value) {
                    *s += weight * v;
                }
            }
            *term = sum;
        }
        // a time is known to its rounding error
        let blur = 4.0 * f64::EPSILON * self.times[1] / (self.times[1] - self.times[0]);
        for f in 0..6 {
            let size = |part: &[Six]| part.iter().map(|c| c[f].abs()).sum::<f64>();
            self.error[f] = self.noise[f] / terms as f64 + blur * size(&self.series[1..terms]);
            self.truncation[f] = CAUTION * size(&self.series[terms - 2..terms]);
        }
        Ok(true)
    }

    /// R in the middle.
    pub(crate) fn middle(&self) -> &Six {
        &self.values[0]
    }

    fn value(&self, x: f64) -> Six {
        let (mut b1, mut b2) = (Six::default(), Six::default());
        for c in self.series[1..self.terms].iter().rev() {
            let mut b0 = Six::default();
            for f in 0..6 {
                b0[f] = 2.0 * x * b1[f] - b2[f] + c[f];
            }
            (b1, b2) = (b0, b1);
        }
        std::array::from_fn(|f| x * b1[f] - b2[f] + self.series[0][f])
    }

    /// R at a time of the segment.
    pub(crate) fn at(&self, t: f64) -> Six {
        let (middle, half) = self.piece.middle();
        self.value((self.piece.place(t) - middle) / half)
    }

    /// Adds int R dt, int (t - centre) R dt and int (t - centre)^2 R dt over a part of the segment.
    pub(crate) fn add(&self, from: f64, to: f64, centre: f64, sums: &mut [Six; 3]) {
        /// On a part this short, as a fraction of the segment, the series is nearly a cubic.
        const SHORT: f64 = 0.05;
        let Piece { anchor, scale, .. } = self.piece;
        let [mut low, mut high] = [from, to].map(|t| self.piece.place(t));
        if low > high {
            (low, high) = (high, low);
        }
        let (middle, half) = self.piece.middle();
        // exact for the series times dt/ds times t^2
        let nodes = if high - low < SHORT * 2.0 * half {
            4
        } else {
            self.terms / 2 + 3
        };
        let [area, moment, second] = sums;
        for (s, weight) in gauss::rule(nodes).on(low, high) {
            let value = self.value((s - middle) / half);
            let weight = weight * 2.0 * scale.abs() * s;
            let arm = (anchor - centre) + scale * s * s;
            for (f, value) in value.into_iter().enumerate() {
                let value = weight * value;
                area[f] += value;
                moment[f] += arm * value;
                second[f] += arm * arm * value;
            }
        }
    }
}
