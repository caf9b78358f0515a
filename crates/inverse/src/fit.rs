//! Peak, duration and start of a contact law's pulse from traces.
//!
//! ```text
//! d_k = g_k P h_k * p((t - t0)/tc) + noise
//! ```
//!
//! h_k is the response of sensor k and g_k its gain, which is fitted where it is unknown.
//! Every start and duration is tried on a coarse net with the best peak and gains, which are linear; Gauss and Newton's
//! steps refine the best ones. Three numbers from hundreds of samples are two to thirty times as accurate as a force history.
//!
//! Theory: `docs/theory.md` (T73).

use crate::error::{Estimate, InverseError};
use crate::nnls::{Factor, Symmetric, dot};
use crate::problem::{Gain, Noise, Problem, Rows, last_shown};
use fault::rounded;

/// Peak, duration and start of a pulse with their errors.
#[derive(Debug, Clone, PartialEq)]
pub struct PulseFit {
    /// Largest force in N.
    pub peak_n: Estimate,
    /// Duration in s.
    pub duration_s: Estimate,
    /// Start in s, from the first sample.
    pub start_s: Estimate,
    /// Covariance of peak, duration and start, in their units.
    pub covariance: [[f64; 3]; 3],
    /// Impulse in N s.
    pub impulse_n_s: Estimate,
    /// Gain of each trace; the standard deviation of a known one is 0.
    pub gains: Vec<Estimate>,
    /// Squared residual over the variance of the noise.
    pub chi_squared: f64,
    /// Rows less parameters; chi-squared far above it means that the response or the pulse is not that of the blow.
    pub degrees_of_freedom: usize,
    /// Peak of the best pulse over its standard deviation, if its place were known.
    pub detection: f64,
}

/// Detection below which a pulse is noise: the best of a few hundred places in pure noise reaches 4 to 5. It is that of a
/// signal-to-noise ratio of about 2 to 3 with 25 samples a duration. `tests/rejected.rs` has pure noise.
pub(crate) const LEAST_DETECTION: f64 = 8.0;

/// Mean square of whitened traces from which they certainly move.
const MOVING: f64 = 2.0;

/// Ratio of durations of the net and starts for each duration, coarse enough to be cheap and fine enough that the steps that
/// follow converge.
const DURATION_RATIO: f64 = 1.3;
const STARTS_EACH: f64 = 10.0;

/// Durations of the net that are refined.
const REFINED: usize = 4;

/// Part of the largest squared response that a place must show: where the traces end before the main waves of a late blow,
/// any force explains a little.
const SHOWN: f64 = 0.1;

/// Steps at most, and the gain in chi-squared at which they end: a standard deviation is a gain of one.
const MOST_STEPS: usize = 60;
const CONVERGED: f64 = 1e-7;

/// Step of the slopes by each parameter, relative to it: central differences are exact to its square.
const SLOPE_STEP: f64 = 1e-4;

/// Shortest duration in force steps.
const SHORTEST: f64 = 3.0;

/// Standard deviations of chi-squared from which an excess is not chance, and errors grow with it.
const EXCESS: f64 = 3.0;

/// Variance of the noise that explains a squared residual: 1 unless it is far too large.
pub(crate) fn variance(chi_squared: f64, degrees: f64) -> f64 {
    let ratio = chi_squared / degrees;
    if ratio > 1.0 + EXCESS * (2.0 / degrees).sqrt() {
        ratio
    } else {
        1.0
    }
}

/// Fits peak, duration and start, and the unknown gains.
pub(crate) fn fit(problem: &Problem, rows: &[Rows]) -> Result<PulseFit, InverseError> {
    let fitting = Fitting { problem, rows };
    let mut starts = fitting.net();
    starts.sort_by(|a, b| b.0.total_cmp(&a.0));
    let starts = starts.into_iter().take(REFINED);
    let refined = starts.filter_map(|(_, start)| fitting.refine(start));
    let best = refined.min_by(|a, b| a.chi_squared.total_cmp(&b.chi_squared));
    let noise: f64 = rows.iter().map(|rows| dot(&rows.data, &rows.data)).sum();
    let count: usize = rows.iter().map(|rows| rows.data.len()).sum();
    let explained = |best: &Point| (noise - best.chi_squared).max(0.0);
    let detection = best.as_ref().map_or(0.0, explained).sqrt();
    match best.filter(|_| detection >= LEAST_DETECTION) {
        Some(best) => fitting.checked(&best, detection),
        None if noise > MOVING * count as f64 => Err(start_not_shown()),
        None => Err(InverseError::outside(
            "the peak of the best pulse over its uncertainty",
            detection,
            &format!("[{LEAST_DETECTION}, inf)"),
            ": no blow stands out of the noise; average repeated drops, or move the sensor closer",
        )),
    }
}

/// The wave of the start is not in a trace, or the response is another one.
fn start_not_shown() -> InverseError {
    let sentence = "the traces do not show the start of the blow: no pulse whose first wave is in them explains them; begin the traces earlier, pass a longer lead, or check the response and its sign";
    InverseError::new("trace", None, sentence.to_owned())
}

struct Fitting<'a> {
    problem: &'a Problem<'a>,
    rows: &'a [Rows],
}

/// Parameters (peak, duration and start in force steps, unknown gains) with their normal equations.
struct Point {
    values: Vec<f64>,
    chi_squared: f64,
    matrix: Symmetric,
    right: Vec<f64>,
}

impl Fitting<'_> {
    /// The gain of each trace with its place among the parameters, where it has one.
    fn gains<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = (f64, Option<usize>)> + 'a {
        let mut unknown = (3..).zip(&values[3..]);
        self.rows.iter().map(move |rows| match rows.gain {
            Gain::Known(gain) => (gain, None),
            Gain::Unknown => unknown
                .next()
                .map_or((0.0, None), |(i, gain)| (*gain, Some(i))),
        })
    }

    /// For each duration of the net the best parameters, with the part of chi-squared that they explain.
    fn net(&self) -> Vec<(f64, Vec<f64>)> {
        let rho = self.problem.oversampling;
        let longest = self.rows.iter().map(|rows| rows.data.len() * rho).max();
        let mut duration = SHORTEST.max(rho as f64);
        let mut found = Vec::new();
        while duration < longest.unwrap_or(0) as f64 {
            let stride = rho * (duration / (STARTS_EACH * rho as f64)).ceil() as usize;
            let samples = (0..=duration as usize + 1).map(|j| j as f64 / duration);
            let pulse: Vec<f64> = samples.map(|x| self.problem.pulse.at(x)[0]).collect();
            let template = |rows: &Rows| rows.respond((1..=rows.kernel.len()).step_by(rho), &pulse);
            let templates: Vec<Vec<f64>> = self.rows.iter().map(template).collect();
            let starts = (0..=last_shown(self.rows)).step_by(stride);
            let tried = starts.filter_map(|start| self.explained(duration, start, &templates));
            found.extend(tried.max_by(|a, b| a.0.total_cmp(&b.0)));
            duration *= DURATION_RATIO;
        }
        found
    }

    /// The best peak and gains of pulses that start at a force sample, and the part of chi-squared that they explain.
    fn explained(
        &self,
        duration: f64,
        start: usize,
        templates: &[Vec<f64>],
    ) -> Option<(f64, Vec<f64>)> {
        let (mut sums, mut shown) = (Vec::new(), false);
        for (rows, template) in self.rows.iter().zip(templates) {
            // the row and the place of the template at which the later of both begins
            let [first, start] = [rows.first, start].map(|time| time / rows.stride);
            let data = rows
                .data
                .get(start.saturating_sub(first)..)
                .unwrap_or_default();
            let model = template
                .get(first.saturating_sub(start)..)
                .unwrap_or_default();
            let count = data.len().min(model.len());
            let (data, model) = (&data[..count], &model[..count]);
            let square = dot(model, model);
            shown |= square > SHOWN * dot(template, template);
            sums.push([dot(data, model), square]);
        }
        let impulse = self.per_peak(duration);
        let [peak, _] = self.problem.scale(self.rows, &sums, impulse, 1.0);
        let mut values = vec![peak, duration, start as f64];
        let mut explained = 0.0;
        for (rows, [product, square]) in self.rows.iter().zip(sums) {
            let factor = match rows.gain {
                Gain::Known(gain) => peak * gain,
                Gain::Unknown if square > 0.0 => product / square,
                Gain::Unknown => 0.0,
            };
            explained += factor * (2.0 * product - factor * square);
            if rows.gain == Gain::Unknown {
                values.push(factor / peak);
            }
        }
        (shown && peak > 0.0 && peak.is_finite()).then_some((explained, values))
    }

    /// Steps of Gauss and Newton, damped by Marquardt, from the parameters of the net.
    fn refine(&self, start: Vec<f64>) -> Option<Point> {
        let mut here = self.point(start);
        let mut damping = 1e-3;
        for _ in 0..MOST_STEPS {
            let damped = Symmetric::from_fn(here.values.len(), |i, j| {
                here.matrix.row(i)[j] * if i == j { 1.0 + damping } else { 1.0 }
            });
            let step = Factor::of(&damped)?.solve(&here.right);
            let moved: Vec<f64> = here
                .values
                .iter()
                .zip(&step)
                .map(|(x, dx)| x + dx)
                .collect();
            let possible =
                moved[0] > 0.0 && moved[1] >= SHORTEST && moved[1] < 4.0 * here.values[1];
            let there = possible.then(|| self.point(moved));
            match there.filter(|there| there.chi_squared <= here.chi_squared) {
                Some(there) => {
                    let gained = here.chi_squared - there.chi_squared;
                    here = there;
                    damping = (0.2 * damping).max(1e-9);
                    if gained < CONVERGED {
                        break;
                    }
                }
                None if damping > 1e6 => break,
                None => damping *= 8.0,
            }
        }
        Some(here)
    }

    /// Impulse over peak in s of a duration in force steps.
    fn per_peak(&self, duration: f64) -> f64 {
        duration * self.problem.force_step_s() * self.problem.pulse.mean()
    }

    /// The residual of all rows, and that of the impulse.
    fn residual(&self, values: &[f64]) -> Vec<f64> {
        let (peak, duration, start) = (values[0], values[1], values[2]);
        let first = start.max(0.0) as usize;
        let last = (start + duration).max(first as f64).ceil() as usize;
        let pulse = |j: f64| peak * self.problem.pulse.at((j - start) / duration)[0];
        // a line between samples lies inside a curve: the samples are moved out by a twelfth of the second difference
        let sample = |j: usize| {
            let parts = [(-1.0, -1.0), (0.0, 14.0), (1.0, -1.0)];
            let parts = parts.map(|(offset, weight)| weight / 12.0 * pulse(j as f64 + offset));
            parts.iter().sum::<f64>()
        };
        let force: Vec<f64> = (first..=last).map(sample).collect();
        let mut residual = Vec::new();
        for (rows, (gain, _)) in self.rows.iter().zip(self.gains(values)) {
            let model = rows.predict(first, &force);
            residual.extend(rows.data.iter().zip(model).map(|(d, x)| d - gain * x));
        }
        let impulse = self.problem.impulse_n_s.iter();
        residual.extend(impulse.map(|own| (own.value - peak * self.per_peak(duration)) / own.sd));
        residual
    }

    fn point(&self, values: Vec<f64>) -> Point {
        let residual = self.residual(&values);
        let slope = |i: usize| {
            // the start has no scale of its own, nor has a gain of zero
            let scale = if i == 2 { values[1] } else { values[i].abs() };
            let step = SLOPE_STEP * if scale > 0.0 { scale } else { 1.0 };
            let [low, high] = [-step, step].map(|step| {
                let mut moved = values.clone();
                moved[i] += step;
                self.residual(&moved)
            });
            let pairs = low.iter().zip(&high);
            pairs
                .map(|(low, high)| (low - high) / (2.0 * step))
                .collect()
        };
        let slopes: Vec<Vec<f64>> = (0..values.len()).map(slope).collect();
        Point {
            chi_squared: dot(&residual, &residual),
            matrix: Symmetric::from_fn(values.len(), |i, j| dot(&slopes[i], &slopes[j])),
            right: slopes.iter().map(|slope| dot(slope, &residual)).collect(),
            values,
        }
    }

    /// The fit in SI units, if the traces show its start and its end.
    fn checked(&self, best: &Point, detection: f64) -> Result<PulseFit, InverseError> {
        let rows: usize = self.rows.iter().map(|rows| rows.data.len()).sum();
        let count = best.values.len();
        let degrees_of_freedom = rows.saturating_sub(count).max(1);
        let factor = Factor::of(&best.matrix).ok_or_else(InverseError::not_solved)?;
        let scale = variance(best.chi_squared, degrees_of_freedom as f64);
        let inverse = factor.inverse();
        let step = self.problem.force_step_s();
        let units = [1.0, step, step];
        let covariance: [[f64; 3]; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| inverse[i][j] * units[i] * units[j] * scale)
        });
        let of = |value, variance: f64| Estimate {
            value,
            sd: variance.max(0.0).sqrt(),
        };
        let (peak, duration) = (best.values[0], best.values[1] * step);
        let impulse_n_s = self.per_peak(best.values[1]) * peak;
        let relative = covariance[0][0] / (peak * peak)
            + covariance[1][1] / (duration * duration)
            + 2.0 * covariance[0][1] / (peak * duration);
        let gains = self.gains(&best.values);
        let gains = gains.map(|(gain, i)| of(gain, i.map_or(0.0, |i| inverse[i][i] * scale)));
        let fit = PulseFit {
            peak_n: of(peak, covariance[0][0]),
            duration_s: of(duration, covariance[1][1]),
            start_s: of(self.problem.force_time_s(best.values[2]), covariance[2][2]),
            covariance,
            impulse_n_s: of(impulse_n_s, impulse_n_s * impulse_n_s * relative),
            gains: gains.collect(),
            chi_squared: best.chi_squared,
            degrees_of_freedom,
            detection,
        };
        self.shown(&fit).map(|()| fit)
    }

    /// Rejects a pulse whose start or end is not in the traces, or whose wave is in a quiet part.
    fn shown(&self, fit: &PulseFit) -> Result<(), InverseError> {
        let (start_s, duration_s) = (fit.start_s.value, fit.duration_s.value);
        let start = self.problem.force_place(start_s);
        let seen = |rows: &Rows| start + rows.arrival as f64 >= rows.first as f64;
        if start < 0.0 || !self.rows.iter().any(seen) {
            return Err(start_not_shown());
        }
        self.problem.shown(self.rows, start_s + duration_s)?;
        for (index, (rows, trace)) in self.rows.iter().zip(&self.problem.traces).enumerate() {
            let Noise::Quiet(range) = &trace.noise else {
                continue;
            };
            let quiet_s = range.end as f64 * self.problem.step_s;
            let arrival_s = start_s + rows.arrival as f64 * self.problem.force_step_s();
            // the foot of a pulse is below the noise
            if arrival_s + 0.1 * duration_s < quiet_s {
                let sentence = format!(
                    "the quiet part of trace {} ends at {} s, but the first wave of the blow arrives at {} s: end the quiet part before, or pass the standard deviation of the noise",
                    index + 1,
                    rounded(quiet_s),
                    rounded(arrival_s)
                );
                return Err(InverseError::new("noise", quiet_s, sentence));
            }
        }
        Ok(())
    }
}
