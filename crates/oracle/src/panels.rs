//! A step response as polynomials on panels between the fronts.
//!
//! A front may have a root, an inverse root or a logarithm. In the panels next to fronts a and b
//!
//! ```text
//! t = a + (b - a) sin^2(pi x/2)
//! ```
//!
//! absorbs the roots; panels are halved toward a logarithm until their series have converged. Nodes much nearer to a front than those
//! of a panel are avoided, since a time has a rounding error.

use crate::error::OracleError;
use crate::place::Place;
use halfspace::{Six, gauss};
use std::f64::consts::{FRAC_PI_2, PI};

/// Nodes of a panel: products of two polynomials of a lower degree are integrated exactly.
const NODES: usize = 16;

/// Truncation error that is allowed, relative to the peak of a field.
///
/// A hundredth of the error that is promised; `a_point_force_is_that_of_pekeris` fails at 1e-7.
const TOLERANCE: f64 = 1e-11;

/// Largest error that may be noise of the kernels, relative to the peak of a field, and the part of the last term of a series that halving
/// a panel leaves if it is noise; a logarithm leaves less.
///
/// `a_point_force_is_that_of_pekeris` takes ten times as long without it: next to the axis a kernel has a noise of 1e-9.
const MOST_NOISE: f64 = 1e-7;
const NOISE_FALL: f64 = 0.3;

/// Shortest part of a panel, next to a front. Where it is reached, the logarithm that is left is below the tolerance.
///
/// `a_point_force_is_that_of_pekeris` fails at 1e-6, where rounding errors of times next to a front dominate.
const SHORTEST: f64 = 1e-3;

/// Ratio below which two fronts are one.
const SAME_FRONT: f64 = 1e-13;

/// Largest number of panels of a place, about 300 MB; a long history of a high frequency needs more.
const MOST_PANELS: usize = 100_000;

/// A node of a panel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Node {
    pub(crate) time_s: f64,
    pub(crate) weight_s: f64,
    pub(crate) value: Six,
}

/// A part of the time between two fronts.
#[derive(Debug)]
struct Panel {
    span_s: [f64; 2],
    x: [f64; 2],
    end_s: f64,
    /// Legendre's coefficients of the response times dt/dy, y in [-1, 1] along the panel.
    series: [Six; NODES],
    /// Integral of the response from the first arrival to the panel.
    before: Six,
}

/// The step response of a place, from the first arrival on.
#[derive(Debug)]
pub(crate) struct Panels {
    panels: Vec<Panel>,
    /// All nodes, ascending in time.
    pub(crate) nodes: Vec<Node>,
}

/// Time and dt/dx at x.
fn stretched([from, to]: [f64; 2], x: f64) -> (f64, f64) {
    let sin = (FRAC_PI_2 * x.min(1.0 - x)).sin();
    let part = (to - from) * sin * sin;
    let time = if x < 0.5 { from + part } else { to - part };
    (time, FRAC_PI_2 * (to - from) * (PI * x).sin())
}

/// P_0 to P_N at y.
fn legendre(y: f64) -> [f64; NODES + 1] {
    let mut p = [1.0; NODES + 1];
    p[1] = y;
    for n in 1..NODES {
        let k = n as f64;
        p[n + 1] = ((2.0 * k + 1.0) * y * p[n] - k * p[n - 1]) / (k + 1.0);
    }
    p
}

impl Panel {
    fn fit(place: &Place, span_s: [f64; 2], x: [f64; 2]) -> Result<(Self, Vec<Node>), OracleError> {
        let (mut nodes, mut series) = (Vec::with_capacity(NODES), [Six::default(); NODES]);
        let rule = gauss::rule(NODES);
        for (y, (at, weight)) in rule.nodes().iter().zip(rule.on(x[0], x[1])) {
            let (time_s, slope) = stretched(span_s, at);
            let (value, weight_s) = (place.step(time_s)?, weight * slope);
            for (n, p) in legendre(*y)[..NODES].iter().enumerate() {
                for f in 0..6 {
                    series[n][f] += (n as f64 + 0.5) * p * weight_s * value[f];
                }
            }
            nodes.push(Node {
                time_s,
                weight_s,
                value,
            });
        }
        let panel = Self {
            span_s,
            x,
            end_s: stretched(span_s, x[1]).0,
            series,
            before: Six::default(),
        };
        Ok((panel, nodes))
    }

    /// Integral of the response from the first arrival to a time in the panel.
    fn integral(&self, time_s: f64) -> Six {
        let [from, to] = self.span_s;
        let roots = [time_s - from, to - time_s].map(|part| part.max(0.0).sqrt());
        let x = roots[0].atan2(roots[1]) / FRAC_PI_2;
        let part = ((x - self.x[0]) / (self.x[1] - self.x[0])).clamp(0.0, 1.0);
        let p = legendre(2.0 * part - 1.0);
        let mut found = self.before;
        for (n, series) in self.series.iter().enumerate() {
            let integral = match n {
                0 => 2.0 * part,
                n => (p[n + 1] - p[n - 1]) / (2 * n + 1) as f64,
            };
            for f in 0..6 {
                found[f] += series[f] * integral;
            }
        }
        found
    }
}

/// Panels between two fronts, not much longer than `longest_s`.
fn between(from: f64, to: f64, longest_s: f64) -> Vec<([f64; 2], [f64; 2])> {
    let count = ((to - from) / longest_s).ceil();
    if count <= 2.0 {
        return vec![([from, to], [0.0, 1.0])];
    }
    let length = (to - from) / count;
    let middle = |i: usize| {
        // sin^2 between a quarter and three quarters is nearly a line
        let (start, root) = (from + i as f64 * length, 0.5_f64.sqrt());
        let span = [
            start - 0.5 * (1.0 / root - 1.0) * length,
            start + 0.5 * (1.0 / root + 1.0) * length,
        ];
        (span, [0.25, 0.75])
    };
    let mut found = vec![([from, from + 2.0 * length], [0.0, 0.5])];
    found.extend((1..count as usize - 1).map(middle));
    found.push(([to - 2.0 * length, to], [0.5, 1.0]));
    found
}

impl Panels {
    /// Of a place until `end_s`, for forces that change by at most `rate` of their peak in a second; panels are not much longer than
    /// `longest_s`.
    pub(crate) fn of(
        place: &Place,
        end_s: f64,
        rate: f64,
        longest_s: f64,
    ) -> Result<Self, OracleError> {
        if end_s > MOST_PANELS as f64 * longest_s {
            let sentence = format!(
                "output.end_s is longer than {MOST_PANELS} intervals of quadrature, {} s: use a shorter history or a lower frequency",
                fault::rounded(MOST_PANELS as f64 * longest_s)
            );
            return Err(OracleError::new("output.end_s", sentence));
        }
        let (sizes, mut stack) = (place.sizes(), Vec::new());
        let mut from = place.first_s();
        for &to in place
            .fronts_s
            .iter()
            .filter(|&&t| t < end_s)
            .chain([&end_s])
        {
            if to - from > SAME_FRONT * to {
                let pieces = between(from, to, longest_s).into_iter();
                stack.extend(pieces.map(|(span, x)| (span, x, [f64::INFINITY; 6])));
                from = to;
            }
        }
        stack.reverse();
        let mut found = Self {
            panels: Vec::new(),
            nodes: Vec::new(),
        };
        while let Some((span, x, above)) = stack.pop() {
            let (mut panel, nodes) = Panel::fit(place, span, x)?;
            let tail: Six = std::array::from_fn(|f| {
                panel.series[NODES - 2][f]
                    .abs()
                    .max(panel.series[NODES - 1][f].abs())
            });
            let is_converged = |f: usize| {
                let error = tail[f] * rate / sizes[f];
                error <= TOLERANCE || error <= MOST_NOISE && tail[f] > NOISE_FALL * above[f]
            };
            if x[1] - x[0] > SHORTEST && !(0..6).all(|f| sizes[f] == 0.0 || is_converged(f)) {
                let middle = 0.5 * (x[0] + x[1]);
                stack.extend([[middle, x[1]], [x[0], middle]].map(|x| (span, x, tail)));
                continue;
            }
            if let Some(last) = found.panels.last() {
                panel.before = last.integral(last.end_s);
            }
            found.panels.push(panel);
            found.nodes.extend(nodes);
        }
        Ok(found)
    }

    /// Integral of the response from the first arrival to a time.
    pub(crate) fn integral(&self, time_s: f64) -> Six {
        let place = self.panels.partition_point(|panel| panel.end_s < time_s);
        let panel = self.panels.get(place).or(self.panels.last());
        panel.map_or(Six::default(), |panel| panel.integral(time_s))
    }
}
