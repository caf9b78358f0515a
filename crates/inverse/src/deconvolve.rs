//! A force history that is not negative and as smooth as the traces allow, with its band.
//!
//! ```text
//! minimise |A x - d|^2 + lambda |L x|^2,   x >= 0,   d and A = sum_k g_k h_k in units of the noise, L second differences
//! ```
//!
//! The force is linear between its samples and zero outside its window.
//! The default lambda has the largest likelihood of the traces, over all forces whose second differences are normal with
//! the variance 1/lambda; the discrepancy principle smooths more, and its bands are too narrow.
//!
//! Theory: `docs/theory.md` (T73).

use crate::error::{Estimate, InverseError};
use crate::fit::{PulseFit, variance};
use crate::nnls::{Factor, Solution, Symmetric, dot, nnls};
use crate::problem::{Gain, Problem, Rows};
use libm::erfc;
use std::f64::consts::FRAC_1_SQRT_2;

/// One point of the L-curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LCurvePoint {
    /// Weight of the squared second differences in 1/N^2.
    pub lambda: f64,
    /// Norm of the residual in units of the noise.
    pub residual: f64,
    /// Norm of the second differences of the force in N.
    pub roughness: f64,
}

/// A force history with its band.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceHistory {
    /// Time of the first force sample in s; the force is zero a step before it and a step after the last one.
    pub start_s: f64,
    /// Time between force samples in s.
    pub step_s: f64,
    /// Force in N.
    pub force_n: Vec<f64>,
    /// Lower end of the band in N.
    pub low_n: Vec<f64>,
    /// Upper end of the band in N.
    pub high_n: Vec<f64>,
    /// Largest force in N.
    pub peak_n: Estimate,
    /// Impulse in N s.
    pub impulse_n_s: Estimate,
    /// Gain of each trace; the standard deviation of a known one is 0.
    pub gains: Vec<Estimate>,
    /// Weight of the squared second differences in 1/N^2.
    pub lambda: f64,
    /// Other weights.
    pub l_curve: Vec<LCurvePoint>,
    /// Squared residual over the variance of the noise, of the rows that the window can change.
    pub chi_squared: f64,
    /// Those rows less the effective number of unknowns.
    pub degrees_of_freedom: f64,
    /// Factor by which the errors were enlarged because chi-squared is too large; 1 if it is not.
    pub error_factor: f64,
    /// Part of the squared whitened traces that the force explains.
    pub variance_reduction: f64,
}

/// Normal equations of a window of force samples.
#[derive(Clone)]
pub(crate) struct Equations {
    matrix: Symmetric,
    right: Vec<f64>,
    /// Squared rows that the window can change, their number, and all squared rows.
    data: [f64; 3],
}

impl Equations {
    /// Those of one trace for a gain of one.
    fn of(rows: &Rows, start: usize, size: usize) -> Self {
        let column = |j| rows.predict(start + j, &[1.0]);
        let columns: Vec<Vec<f64>> = (0..size).map(column).collect();
        let first = columns[0].iter().position(|x| *x != 0.0);
        let changed = &rows.data[first.unwrap_or(rows.data.len())..];
        let [square, all] = [changed, &rows.data].map(|data| dot(data, data));
        Self {
            matrix: Symmetric::from_fn(size, |i, j| dot(&columns[i], &columns[j])),
            right: columns
                .iter()
                .map(|column| dot(column, &rows.data))
                .collect(),
            data: [square, changed.len() as f64, all],
        }
    }

    /// Squared norm of the residual of a force.
    fn residual(&self, x: &[f64]) -> f64 {
        let explained = 2.0 * dot(&self.right, x) - dot(&self.matrix.times(x), x);
        (self.data[0] - explained).max(0.0)
    }
}

/// The normal equations of each trace for a gain of one.
pub(crate) struct Normal {
    /// First force sample.
    pub(crate) start: usize,
    traces: Vec<Equations>,
    penalty: Symmetric,
}

impl Normal {
    /// Over so many force samples from `start` on.
    pub(crate) fn new(rows: &[Rows], start: usize, size: usize) -> Self {
        let traces = rows.iter().map(|rows| Equations::of(rows, start, size));
        let penalty = Symmetric::from_fn(size, |i, j| {
            [6.0, -4.0, 1.0].get(i - j).copied().unwrap_or(0.0)
        });
        Self {
            start,
            traces: traces.collect(),
            penalty,
        }
    }

    /// Those of all traces but one with their gains.
    pub(crate) fn stacked(&self, gains: &[Estimate], but: Option<usize>) -> Equations {
        let size = self.penalty.size();
        let mut all = Equations {
            matrix: Symmetric::from_fn(size, |_, _| 0.0),
            right: vec![0.0; size],
            data: [0.0; 3],
        };
        for (k, (own, gain)) in self.traces.iter().zip(gains).enumerate() {
            if Some(k) != but {
                all.matrix.add(gain.value * gain.value, &own.matrix);
                let pairs = all.right.iter_mut().zip(&own.right);
                pairs.for_each(|(b, p)| *b += gain.value * p);
                (0..3).for_each(|i| all.data[i] += own.data[i]);
            }
        }
        all
    }

    /// The force of a weight, from a start.
    pub(crate) fn solve(
        &self,
        all: &Equations,
        lambda: f64,
        start: &[f64],
    ) -> Result<Solution, InverseError> {
        let found = nnls(&self.weighted(all, lambda), &all.right, start);
        found.ok_or_else(InverseError::not_solved)
    }

    fn weighted(&self, all: &Equations, lambda: f64) -> Symmetric {
        let mut matrix = all.matrix.clone();
        matrix.add(lambda, &self.penalty);
        matrix
    }

    /// Logarithm of the likelihood of the traces with rows of the variance `noise`.
    fn likelihood(&self, all: &Equations, lambda: f64, noise: f64) -> f64 {
        Factor::of(&self.weighted(all, lambda)).map_or(f64::NEG_INFINITY, |factor| {
            let y = factor.forward(&all.right);
            let count = all.right.len() as f64;
            0.5 * (dot(&y, &y) / noise - factor.log_determinant() + count * lambda.ln())
        })
    }

    /// The gains of a force, in the scale of the known ones or of the impulse, and the relative variance of that scale where
    /// gains are unknown.
    fn gains(
        &self,
        problem: &Problem,
        rows: &[Rows],
        x: &[f64],
        noise: f64,
    ) -> (Vec<Estimate>, f64) {
        let sums = self.traces.iter();
        let sums = sums.map(|own| [dot(&own.right, x), dot(&own.matrix.times(x), x)]);
        let sums: Vec<[f64; 2]> = sums.collect();
        let impulse = x.iter().sum::<f64>() * problem.force_step_s();
        let [scale, error] = problem.scale(rows, &sums, impulse, noise);
        let gain = |(rows, [product, square]): (&Rows, &[f64; 2])| match rows.gain {
            Gain::Known(value) => Estimate { value, sd: 0.0 },
            Gain::Unknown => {
                let value = product / square / scale;
                let sd = (noise / square + value * value * error).sqrt();
                Estimate { value, sd }
            }
        };
        let any = rows.iter().any(|rows| rows.gain == Gain::Unknown);
        let gains = rows.iter().zip(&sums).map(gain).collect();
        (gains, if any { error } else { 0.0 })
    }
}

/// Steps of the search in the logarithm of lambda: the first, the one at which it ends, which changes the force by a tenth of
/// its error, and how far it goes.
const FIRST_STEP: f64 = 2.0;
const LAST_STEP: f64 = 0.2;
const FARTHEST: f64 = 30.0;

/// Points of the L-curve on either side, and points in a decade.
const L_CURVE_SIDE: i32 = 6;
const L_CURVE_DENSITY: f64 = 2.0;

/// Changes of gain and force, at most, and the change at which they end.
const GAIN_CHANGES: usize = 50;
const GAIN_CHANGE: f64 = 1e-5;

/// The force history over a window of force samples.
pub(crate) fn deconvolve(
    problem: &Problem,
    rows: &[Rows],
    fit: &PulseFit,
    normal: &Normal,
) -> Result<ForceHistory, InverseError> {
    let start = vec![1.0; normal.penalty.size()];
    let (mut gains, mut lambda, mut noise) = (fit.gains.clone(), guess(problem, fit), 1.0);
    loop {
        let mut all = normal.stacked(&gains, None);
        lambda = problem.lambda.unwrap_or_else(|| {
            let likelihood = |log: f64| normal.likelihood(&all, log.exp(), noise);
            largest(likelihood, (lambda * noise).ln()).exp()
        });
        let mut solution = normal.solve(&all, lambda, &start)?;
        let mut scale = 0.0;
        for _ in 0..GAIN_CHANGES {
            let before = gains;
            (gains, scale) = normal.gains(problem, rows, &solution.x, noise);
            let pairs = gains.iter().zip(&before);
            let changes = pairs.map(|(a, b)| (a.value / b.value - 1.0).abs());
            if changes.fold(0.0, f64::max) <= GAIN_CHANGE {
                break;
            }
            all = normal.stacked(&gains, None);
            solution = normal.solve(&all, lambda, &solution.x)?;
        }
        let band = Band::new(normal, &all, lambda, &solution, [noise, scale])?;
        let chi_squared = all.residual(&solution.x);
        let degrees_of_freedom = (all.data[1] - band.unknowns).max(1.0);
        let found = variance(chi_squared, degrees_of_freedom);
        if found > 1.0 && noise == 1.0 {
            noise = found;
            continue;
        }
        let x = &solution.x;
        let width = quantile(0.5 * (1.0 - problem.confidence));
        let half = band.variance.iter().zip(&band.bias);
        let half = half.map(|(variance, bias)| width * variance.sqrt() + bias.abs());
        let (low_n, high_n) = x
            .iter()
            .zip(half)
            .map(|(x, half)| ((x - half).max(0.0), x + half))
            .unzip();
        let top = (0..x.len())
            .max_by(|&i, &j| x[i].total_cmp(&x[j]))
            .unwrap_or(0);
        let step_s = problem.force_step_s();
        let sd_of_sum = band.variance_of_sum.sqrt().hypot(band.bias.iter().sum());
        let [square, _, all_squares] = all.data;
        return Ok(ForceHistory {
            start_s: problem.force_time_s(normal.start as f64),
            step_s,
            low_n,
            high_n,
            peak_n: Estimate {
                value: x[top],
                sd: band.variance[top].sqrt().hypot(band.bias[top]),
            },
            impulse_n_s: Estimate {
                value: step_s * x.iter().sum::<f64>(),
                sd: step_s * sd_of_sum,
            },
            gains,
            lambda,
            l_curve: l_curve(normal, &all, lambda),
            chi_squared,
            degrees_of_freedom,
            error_factor: noise.sqrt(),
            variance_reduction: (square - chi_squared) / all_squares,
            force_n: solution.x,
        });
    }
}

/// The weight that suits the fitted pulse: the inverse mean square of its second differences.
fn guess(problem: &Problem, fit: &PulseFit) -> f64 {
    let count = fit.duration_s.value / problem.force_step_s();
    let at = |j: f64| problem.pulse.at(j / count)[0];
    let bends = (0..count as usize + 2).map(|j| j as f64);
    let bends = bends.map(|j| (at(j - 1.0) - 2.0 * at(j) + at(j + 1.0)).powi(2));
    count / (fit.peak_n.value * fit.peak_n.value * bends.sum::<f64>())
}

/// The largest value of a function with one maximum, found by steps that are halved where neither leads up.
fn largest(of: impl Fn(f64) -> f64, guess: f64) -> f64 {
    let (mut place, mut best, mut step) = (guess, of(guess), FIRST_STEP);
    while step > LAST_STEP && (place - guess).abs() < FARTHEST {
        let tried = [place + step, place - step].map(|x| (of(x), x));
        let higher = tried.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        match higher.filter(|higher| higher.0 > best) {
            Some(higher) => (best, place) = higher,
            None => step *= 0.4,
        }
    }
    place
}

/// Residual and roughness for weights around one, ascending; without those that rounding prevents.
fn l_curve(normal: &Normal, all: &Equations, lambda: f64) -> Vec<LCurvePoint> {
    let (mut x, mut points) = (Vec::new(), Vec::new());
    for i in (-L_CURVE_SIDE..=L_CURVE_SIDE).rev() {
        let lambda = lambda * 10_f64.powf(f64::from(i) / L_CURVE_DENSITY);
        if let Ok(found) = normal.solve(all, lambda, &x) {
            x = found.x;
            points.push(LCurvePoint {
                lambda,
                residual: all.residual(&x).sqrt(),
                roughness: dot(&normal.penalty.times(&x), &x).sqrt(),
            });
        }
    }
    points.reverse();
    points
}

/// What the traces do not determine of a force.
struct Band {
    /// Variance of each sample. Of a free one between that of the posterior, which has all of the prior in it and is too
    /// wide where the traces determine the force, and that of the noise alone, which has none and is too narrow: the geometric
    /// mean of the first and twice the second. `tests/back.rs` fails with either. Of a pinned one that of the posterior.
    variance: Vec<f64>,
    /// Variance of the sum of all samples.
    variance_of_sum: f64,
    /// Effective number of unknowns.
    unknowns: f64,
    /// Mean change of the force when the weight is doubled or halved.
    bias: Vec<f64>,
}

impl Band {
    /// Of rows of the variance `noise` and a relative variance `scale` of the whole force.
    fn new(
        normal: &Normal,
        all: &Equations,
        lambda: f64,
        solution: &Solution,
        [noise, scale]: [f64; 2],
    ) -> Result<Self, InverseError> {
        let Solution {
            x, free, factor, ..
        } = solution;
        let matrix = normal.weighted(all, lambda);
        let mut variance = vec![0.0; x.len()];
        let mut unknowns = free.len() as f64;
        for (inverse, &j) in factor.inverse().iter().zip(free) {
            let mut column = vec![0.0; x.len()];
            free.iter()
                .zip(inverse)
                .for_each(|(&i, value)| column[i] = *value);
            let rough = normal.penalty.times(&column);
            unknowns -= lambda * rough[j];
            let sampling = (column[j] - lambda * dot(&column, &rough)).max(0.0);
            variance[j] = noise * (column[j] * sampling * sampling).cbrt() + scale * x[j].powi(2);
        }
        for j in (0..x.len()).filter(|&j| x[j] == 0.0) {
            let entries: Vec<f64> = free.iter().map(|&i| matrix.row(j)[i]).collect();
            let known = factor.forward(&entries);
            variance[j] = noise / (matrix.row(j)[j] - dot(&known, &known));
        }
        let ones = factor.forward(&vec![1.0; free.len()]);
        let rough = normal.solve(all, 0.5 * lambda, x)?.x;
        let smooth = normal.solve(all, 2.0 * lambda, x)?.x;
        Ok(Self {
            variance,
            variance_of_sum: noise * dot(&ones, &ones) + scale * x.iter().sum::<f64>().powi(2),
            unknowns,
            bias: rough
                .iter()
                .zip(&smooth)
                .map(|(a, b)| 0.5 * (a - b))
                .collect(),
        })
    }
}

/// Where the probability of a normal variable above it is `tail`, at most 1/2.
fn quantile(tail: f64) -> f64 {
    let (mut low, mut high) = (0.0, 40.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        match 0.5 * erfc(middle * FRAC_1_SQRT_2) > tail {
            true => low = middle,
            false => high = middle,
        }
    }
    0.5 * (low + high)
}
