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

/// The normal equations of each trace for a gain of one, over a window of force samples.
pub(crate) struct Normal {
    /// First force sample.
    pub(crate) start: usize,
    parts: Vec<Part>,
    penalty: Symmetric,
}

struct Part {
    matrix: Symmetric,
    right: Vec<f64>,
    /// Squared rows that the window can change, their number, and all squared rows.
    data: [f64; 3],
}

/// The normal equations of all traces with their gains.
pub(crate) struct Stacked {
    matrix: Symmetric,
    right: Vec<f64>,
    square: f64,
    count: f64,
}

impl Normal {
    /// Over the force samples from `start` to `end`.
    pub(crate) fn new(problem: &Problem, rows: &[Rows], [start, end]: [usize; 2]) -> Self {
        let size = end + 1 - start;
        let parts = rows
            .iter()
            .map(|rows| Part::new(problem, rows, start, size))
            .collect();
        let penalty = Symmetric::from_fn(size, |i, j| {
            [6.0, -4.0, 1.0].get(i - j).copied().unwrap_or(0.0)
        });
        Self {
            start,
            parts,
            penalty,
        }
    }

    /// Those of all traces but one, with the variance of the noise.
    pub(crate) fn stacked(&self, gains: &[Estimate], but: Option<usize>, variance: f64) -> Stacked {
        let size = self.penalty.size();
        let matrix = Symmetric::from_fn(size, |_, _| 0.0);
        let mut all = Stacked {
            matrix,
            right: vec![0.0; size],
            square: 0.0,
            count: 0.0,
        };
        for (k, (part, &Estimate { value: gain, .. })) in self.parts.iter().zip(gains).enumerate() {
            if Some(k) == but {
                continue;
            }
            all.matrix.add(gain * gain / variance, &part.matrix);
            all.right
                .iter_mut()
                .zip(&part.right)
                .for_each(|(b, p)| *b += gain * p / variance);
            all.square += part.data[0] / variance;
            all.count += part.data[1];
        }
        all
    }

    /// The force of a weight, from a start.
    pub(crate) fn solve(
        &self,
        all: &Stacked,
        lambda: f64,
        start: &[f64],
    ) -> Result<Solution, InverseError> {
        nnls(&self.weighted(all, lambda), &all.right, start).ok_or(InverseError::NotSolved)
    }

    fn weighted(&self, all: &Stacked, lambda: f64) -> Symmetric {
        let mut matrix = all.matrix.clone();
        matrix.add(lambda, &self.penalty);
        matrix
    }

    /// Logarithm of the likelihood of the traces.
    fn likelihood(&self, all: &Stacked, lambda: f64) -> f64 {
        Factor::of(&self.weighted(all, lambda)).map_or(f64::NEG_INFINITY, |factor| {
            let y = factor.forward(&all.right);
            0.5 * (dot(&y, &y) - factor.log_determinant() + all.right.len() as f64 * lambda.ln())
        })
    }

    /// Squared norms of residual and second differences.
    fn norms(&self, all: &Stacked, x: &[f64]) -> [f64; 2] {
        let residual = dot(&all.matrix.times(x), x) - 2.0 * dot(&all.right, x) + all.square;
        [residual.max(0.0), dot(&self.penalty.times(x), x)]
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
        let sums = self
            .parts
            .iter()
            .map(|part| [dot(&part.right, x), dot(&part.matrix.times(x), x)]);
        let sums: Vec<[f64; 2]> = sums.collect();
        let mut known = [0.0; 2];
        for (rows, [product, square]) in rows.iter().zip(&sums) {
            if let Gain::Known(gain) = rows.gain {
                known = [known[0] + gain * product, known[1] + gain * gain * square];
            }
        }
        let (scale, error) = match problem.impulse_n_s {
            Some(impulse) if known[1] == 0.0 => {
                let sum = x.iter().sum::<f64>() * problem.force_step_s();
                (impulse.value / sum, (impulse.sd / impulse.value).powi(2))
            }
            Some(_) | None => (known[0] / known[1], noise / known[1]),
        };
        let gain = |(rows, [product, square]): (&Rows, &[f64; 2])| match rows.gain {
            Gain::Known(value) => Estimate { value, sd: 0.0 },
            Gain::Unknown => {
                let value = product / square / scale;
                Estimate {
                    value,
                    sd: (noise / square + value * value * error).sqrt(),
                }
            }
        };
        let any = rows.iter().any(|rows| rows.gain == Gain::Unknown);
        let gains = rows.iter().zip(&sums).map(gain).collect();
        (gains, if any { error } else { 0.0 })
    }
}

impl Part {
    fn new(problem: &Problem, rows: &Rows, start: usize, size: usize) -> Self {
        let column = |j| rows.predict(problem, start + j, &[1.0]);
        let columns: Vec<Vec<f64>> = (0..size).map(column).collect();
        let first = columns[0].iter().position(|x| *x != 0.0);
        let changed = &rows.data[first.unwrap_or(rows.data.len())..];
        let squares = [changed, &rows.data].map(|data| dot(data, data));
        Self {
            matrix: Symmetric::from_fn(size, |i, j| dot(&columns[i], &columns[j])),
            right: columns
                .iter()
                .map(|column| dot(column, &rows.data))
                .collect(),
            data: [squares[0], changed.len() as f64, squares[1]],
        }
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
    let pulse = pulse_samples(problem, fit, normal);
    let mut lambda = guess(problem, fit);
    let chosen = |all: &Stacked, guess: f64| match problem.lambda {
        Some(lambda) => lambda,
        None => largest(|log| normal.likelihood(all, log.exp()), guess.ln()).exp(),
    };
    let (mut gains, mut noise) = (fit.gains.clone(), 1.0);
    loop {
        let mut all = normal.stacked(&gains, None, noise);
        lambda = chosen(&all, lambda);
        let mut solution = normal.solve(&all, lambda, &pulse)?;
        let mut scale = 0.0;
        for _ in 0..GAIN_CHANGES {
            let before = gains;
            (gains, scale) = normal.gains(problem, rows, &solution.x, noise);
            let pairs = gains.iter().zip(&before);
            let change = pairs
                .map(|(a, b)| (a.value / b.value - 1.0).abs())
                .fold(0.0, f64::max);
            if change <= GAIN_CHANGE {
                break;
            }
            all = normal.stacked(&gains, None, noise);
            solution = normal.solve(&all, lambda, &solution.x)?;
        }
        let posterior = Posterior::new(normal, &all, lambda, solution, scale);
        let [residual, _] = normal.norms(&all, &posterior.solution.x);
        let found = variance(residual, (all.count - posterior.unknowns).max(1.0));
        if found > 1.0 && noise == 1.0 {
            noise = found;
            continue;
        }
        return Ok(posterior.history(problem, &all, gains, noise, residual * noise));
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

/// Samples of the fitted pulse in the window.
fn pulse_samples(problem: &Problem, fit: &PulseFit, normal: &Normal) -> Vec<f64> {
    let sample = |j| {
        let time_s = problem.force_time_s((normal.start + j) as f64) - fit.start_s.value;
        fit.peak_n.value * problem.pulse.at(time_s / fit.duration_s.value)[0]
    };
    (0..normal.penalty.size()).map(sample).collect()
}

/// The largest value of a function with one maximum, found by steps that are halved where neither leads up.
fn largest(of: impl Fn(f64) -> f64, guess: f64) -> f64 {
    let (mut place, mut best, mut step) = (guess, of(guess), FIRST_STEP);
    while step > LAST_STEP && (place - guess).abs() < FARTHEST {
        let tried = [place + step, place - step].map(|x| (of(x), x));
        let higher = if tried[0].0 > tried[1].0 {
            tried[0]
        } else {
            tried[1]
        };
        if higher.0 > best {
            (best, place) = higher;
        } else {
            step *= 0.4;
        }
    }
    place
}

/// Residual and roughness for weights around one, ascending, for noise of the variance one; without those that rounding
/// prevents.
fn l_curve(normal: &Normal, all: &Stacked, lambda: f64, noise: f64) -> Vec<LCurvePoint> {
    let (mut x, mut points) = (Vec::new(), Vec::new());
    for i in (-L_CURVE_SIDE..=L_CURVE_SIDE).rev() {
        let lambda = lambda * 10_f64.powf(f64::from(i) / L_CURVE_DENSITY);
        if let Ok(found) = normal.solve(all, lambda, &x) {
            x = found.x;
            let [residual, roughness] = normal.norms(all, &x);
            points.push(LCurvePoint {
                lambda: lambda * noise,
                residual: (residual * noise).sqrt(),
                roughness: roughness.sqrt(),
            });
        }
    }
    points.reverse();
    points
}

/// The force of a weight with what it does not determine.
struct Posterior<'a> {
    normal: &'a Normal,
    lambda: f64,
    solution: Solution,
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

impl<'a> Posterior<'a> {
    fn new(normal: &'a Normal, all: &Stacked, lambda: f64, solution: Solution, scale: f64) -> Self {
        let (free, factor) = (&solution.free, &solution.factor);
        let size = solution.x.len();
        let matrix = normal.weighted(all, lambda);
        let mut variance = vec![0.0; size];
        let mut unknowns = free.len() as f64;
        for (at, &j) in free.iter().enumerate() {
            let mut column = vec![0.0; size];
            let unit: Vec<f64> = (0..free.len())
                .map(|i| f64::from(u8::from(i == at)))
                .collect();
            factor
                .solve(&unit)
                .iter()
                .zip(free)
                .for_each(|(value, &i)| column[i] = *value);
            // rows of the penalty have five entries
            let near = |i: usize| i.saturating_sub(2)..(i + 3).min(size);
            let rough = |i: usize| dot(&normal.penalty.row(i)[near(i)], &column[near(i)]);
            let prior: f64 = free.iter().map(|&i| column[i] * rough(i)).sum();
            unknowns -= lambda * rough(j);
            let sampling = (column[j] - lambda * prior).max(0.0);
            variance[j] = (column[j] * sampling * sampling).cbrt() + scale * solution.x[j].powi(2);
        }
        for j in (0..size).filter(|&j| solution.x[j] == 0.0) {
            let entries: Vec<f64> = free.iter().map(|&i| matrix.row(j)[i]).collect();
            let known = factor.forward(&entries);
            variance[j] = 1.0 / (matrix.row(j)[j] - dot(&known, &known));
        }
        let sum = factor.forward(&vec![1.0; free.len()]);
        let variance_of_sum = dot(&sum, &sum) + scale * solution.x.iter().sum::<f64>().powi(2);
        let changed = [0.5, 2.0].map(|factor| normal.solve(all, factor * lambda, &solution.x));
        let bias = match changed {
            [Ok(rough), Ok(smooth)] => rough
                .x
                .iter()
                .zip(&smooth.x)
                .map(|(a, b)| 0.5 * (a - b))
                .collect(),
            _ => vec![0.0; size],
        };
        Self {
            normal,
            lambda,
            solution,
            variance,
            variance_of_sum,
            unknowns,
            bias,
        }
    }

    fn history(
        &self,
        problem: &Problem,
        all: &Stacked,
        gains: Vec<Estimate>,
        noise: f64,
        chi_squared: f64,
    ) -> ForceHistory {
        let x = &self.solution.x;
        let tail = 0.5 * (1.0 - problem.confidence);
        let width = quantile(tail);
        let half = |j: usize| width * self.variance[j].sqrt() + self.bias[j].abs();
        let high = (0..x.len()).map(|j| match x[j] > 0.0 {
            true => x[j] + half(j),
            false => self.pinned(j, 2.0 * tail) + self.bias[j].abs(),
        });
        let low = (0..x.len()).map(|j| (x[j] - half(j)).max(0.0));
        let top = (0..x.len())
            .max_by(|&i, &j| x[i].total_cmp(&x[j]))
            .unwrap_or(0);
        let step = problem.force_step_s();
        let bias_of_sum: f64 = self.bias.iter().sum();
        let squares: f64 = self.normal.parts.iter().map(|part| part.data[2]).sum();
        let changed: f64 = self.normal.parts.iter().map(|part| part.data[0]).sum();
        ForceHistory {
            start_s: problem.force_time_s(self.normal.start as f64),
            step_s: step,
            low_n: low.collect(),
            high_n: high.collect(),
            peak_n: Estimate {
                value: x[top],
                sd: self.variance[top].sqrt().hypot(self.bias[top]),
            },
            impulse_n_s: Estimate {
                value: step * x.iter().sum::<f64>(),
                sd: step * self.variance_of_sum.sqrt().hypot(bias_of_sum),
            },
            gains,
            lambda: self.lambda * noise,
            l_curve: l_curve(self.normal, all, self.lambda, noise),
            chi_squared,
            degrees_of_freedom: (all.count - self.unknowns).max(1.0),
            error_factor: noise.sqrt(),
            variance_reduction: 1.0 - (chi_squared + squares - changed) / squares,
            force_n: x.clone(),
        }
    }

    /// The upper end of a pinned sample: its posterior is the tail of a normal law whose mean is negative.
    fn pinned(&self, j: usize, tail: f64) -> f64 {
        let sd = self.variance[j].sqrt();
        // beyond 30 standard deviations the tail is below 1e-197
        let mean = (self.solution.gradient[j] * sd).clamp(-30.0, 0.0);
        (sd * (mean + quantile(tail * upper_tail(-mean)))).max(0.0)
    }
}

/// Probability of a normal variable above z.
fn upper_tail(z: f64) -> f64 {
    0.5 * erfc(z * std::f64::consts::FRAC_1_SQRT_2)
}

/// Where the probability of a normal variable above it is `tail`, at most 1/2.
fn quantile(tail: f64) -> f64 {
    let (mut low, mut high) = (0.0, 40.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        match upper_tail(middle) > tail {
            true => low = middle,
            false => high = middle,
        }
    }
    0.5 * (low + high)
}
