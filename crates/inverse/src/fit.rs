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

use crate::error::{Estimate, InverseError, outside};
use crate::nnls::{Factor, Symmetric, dot};
use crate::problem::{Gain, Noise, Problem, Rows};

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
    let refined = starts
        .into_iter()
        .take(REFINED)
        .map(|(_, start)| fitting.refine(start));
    let best = refined
        .flatten()
        .min_by(|a, b| a.chi_squared.total_cmp(&b.chi_squared));
    let noise: f64 = rows.iter().map(|rows| dot(&rows.data, &rows.data)).sum();
    let found = best
        .as_ref()
        .map_or(0.0, |best| (noise - best.chi_squared).max(0.0).sqrt());
    let count: usize = rows.iter().map(|rows| rows.data.len()).sum();
    match best.filter(|_| found >= LEAST_DETECTION) {
        Some(best) => fitting.checked(&best, found),
        None if noise > MOVING * count as f64 => Err(InverseError::StartNotShown),
        None => Err(outside(
            "the peak of the best pulse over its uncertainty",
            found,
            format!("[{LEAST_DETECTION}, inf)"),
            ": no blow stands out of the noise; average repeated drops, or move the sensor closer",
        )),
    }
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
        let mut next = 2;
        self.rows.iter().map(move |rows| match rows.gain {
            Gain::Known(gain) => (gain, None),
            Gain::Unknown => {
                next += 1;
                (values[next], Some(next))
            }
        })
    }

    /// For each duration of the net the best parameters, with the part of chi-squared that they explain.
    fn net(&self) -> Vec<(f64, Vec<f64>)> {
        let rho = self.problem.oversampling;
        let longest = self
            .rows
            .iter()
            .map(|rows| rows.data.len() * rho)
            .max()
            .unwrap_or(0) as f64;
        let ends = self
            .rows
            .iter()
            .filter_map(|rows| rows.last_shown(self.problem))
            .max();
        let mut duration = SHORTEST.max(rho as f64);
        let mut found = Vec::new();
        while duration < longest {
            let stride = rho * (duration / (STARTS_EACH * rho as f64)).ceil() as usize;
            let pulse =
                (0..=duration as usize + 1).map(|j| self.problem.pulse.at(j as f64 / duration)[0]);
            let pulse: Vec<f64> = pulse.collect();
            let template =
                |rows: &Rows| rows.respond((0..rows.kernel.len()).step_by(rho).map(Some), &pulse);
            let templates: Vec<Vec<f64>> = self.rows.iter().map(template).collect();
            let places = (0..=ends.unwrap_or(0)).step_by(stride);
            let tried = places.map(|start| self.explained(duration, start, &templates));
            found.extend(tried.max_by(|a, b| a.0.total_cmp(&b.0)));
            duration *= DURATION_RATIO;
        }
        found
    }

    /// The best peak and gains of pulses that start at a force sample, and the part of chi-squared that they explain.
    fn explained(&self, duration: f64, start: usize, templates: &[Vec<f64>]) -> (f64, Vec<f64>) {
        let rho = self.problem.oversampling;
        let (mut known, mut explained, mut gains, mut shown) = ([0.0; 2], 0.0, Vec::new(), false);
        for (rows, template) in self.rows.iter().zip(templates) {
            // row i shows the template at i + offset
            let offset =
                (rows.force_index(self.problem, 0) / rho) as isize - (start / rho) as isize;
            let data = rows
                .data
                .get((-offset).max(0) as usize..)
                .unwrap_or_default();
            let model = template.get(offset.max(0) as usize..).unwrap_or_default();
            let count = data.len().min(model.len());
            let (data, model) = (&data[..count], &model[..count]);
            let (product, square) = (dot(data, model), dot(model, model));
            shown |= square > SHOWN * dot(template, template);
            match rows.gain {
                Gain::Known(gain) => {
                    known = [known[0] + gain * product, known[1] + gain * gain * square];
                }
                Gain::Unknown if square > 0.0 => {
                    gains.push(product / square);
                    explained += product * product / square;
                }
                Gain::Unknown => gains.push(0.0),
            }
        }
        let peak = match self.problem.impulse_n_s {
            Some(impulse) if known[1] == 0.0 => impulse.value / self.per_peak(duration),
            Some(_) | None => known[0] / known[1],
        };
        if !(shown && peak > 0.0 && peak.is_finite()) {
            return (0.0, Vec::new());
        }
        let values = [peak, duration, start as f64]
            .into_iter()
            .chain(gains.iter().map(|gain| gain / peak));
        (explained + peak * known[0], values.collect())
    }

    /// Steps of Gauss and Newton, damped by Marquardt, from the parameters of the net.
    fn refine(&self, start: Vec<f64>) -> Option<Point> {
        let mut here = Some(start)
            .filter(|start| !start.is_empty())
            .map(|start| self.point(start))?;
        let mut damping = 1e-3;
        for _ in 0..MOST_STEPS {
            let mut damped = here.matrix.clone();
            (0..damped.size())
                .for_each(|i| damped.set(i, i, here.matrix.row(i)[i] * (1.0 + damping)));
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

    fn point(&self, values: Vec<f64>) -> Point {
        let size = values.len();
        let (peak, duration, start) = (values[0], values[1], values[2]);
        let first = start.max(0.0).floor() as usize;
        let last = (start + duration).max(first as f64).ceil() as usize;
        // a line between samples lies inside a curve: the samples are moved out by a twelfth of the second difference
        let sample = |j: usize| {
            let parts = [(-1.0, -1.0), (0.0, 14.0), (1.0, -1.0)].map(|(offset, weight)| {
                let fraction = (j as f64 + offset - start) / duration;
                let [value, slope] = self.problem.pulse.at(fraction);
                [value, fraction * slope, slope].map(|x| weight / 12.0 * x)
            });
            [0, 1, 2].map(|c| parts[0][c] + parts[1][c] + parts[2][c])
        };
        let samples: Vec<[f64; 3]> = (first..=last).map(sample).collect();
        let scale = [1.0, -peak / duration, -peak / duration];
        let forces = [0, 1, 2].map(|c| {
            samples
                .iter()
                .map(|s| scale[c] * s[c])
                .collect::<Vec<f64>>()
        });
        let mut point = Point {
            values,
            chi_squared: 0.0,
            matrix: Symmetric::from_fn(size, |_, _| 0.0),
            right: vec![0.0; size],
        };
        let gains: Vec<_> = self.gains(&point.values).collect();
        for (rows, (gain, at)) in self.rows.iter().zip(gains) {
            let columns = forces
                .each_ref()
                .map(|force| rows.predict(self.problem, first, force));
            let residual: Vec<f64> = rows
                .data
                .iter()
                .zip(&columns[0])
                .map(|(d, q)| d - gain * peak * q)
                .collect();
            let scaled = [gain, gain, gain, peak];
            let places = [Some(0), Some(1), Some(2), at];
            for (a, place_a) in places.iter().enumerate() {
                let Some(i) = *place_a else { continue };
                point.right[i] += scaled[a] * dot(&columns[a % 3], &residual);
                for (b, place_b) in places.iter().enumerate().take(a + 1) {
                    let Some(j) = *place_b else { continue };
                    let product = scaled[a] * scaled[b] * dot(&columns[a % 3], &columns[b % 3]);
                    point.matrix.set(i, j, point.matrix.row(i)[j] + product);
                }
            }
            point.chi_squared += dot(&residual, &residual);
        }
        if let Some(impulse) = self.problem.impulse_n_s {
            let per_peak = self.per_peak(duration) / impulse.sd;
            let missing = impulse.value / impulse.sd - peak * per_peak;
            let slopes = [per_peak, peak * per_peak / duration];
            for i in 0..2 {
                point.right[i] += slopes[i] * missing;
                for j in 0..=i {
                    let product = slopes[i] * slopes[j];
                    point.matrix.set(i, j, point.matrix.row(i)[j] + product);
                }
            }
            point.chi_squared += missing * missing;
        }
        point
    }

    /// The fit in SI units, if the traces show its start and its end.
    fn checked(&self, best: &Point, detection: f64) -> Result<PulseFit, InverseError> {
        let count: usize = self.rows.iter().map(|rows| rows.data.len()).sum();
        let degrees_of_freedom = count.saturating_sub(best.values.len()).max(1);
        let factor = Factor::of(&best.matrix).ok_or(InverseError::NotSolved)?;
        let scale = variance(best.chi_squared, degrees_of_freedom as f64);
        let count = best.values.len();
        let unit = |i| (0..count).map(move |j| f64::from(u8::from(i == j)));
        let column = |i| factor.solve(&unit(i).collect::<Vec<_>>());
        let inverse: Vec<Vec<f64>> = (0..count).map(column).collect();
        let step = self.problem.force_step_s();
        let units = [1.0, step, step];
        let covariance: [[f64; 3]; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| inverse[i][j] * units[i] * units[j] * scale)
        });
        let of = |value, i: usize| Estimate {
            value,
            sd: covariance[i][i].sqrt(),
        };
        let (peak, duration) = (best.values[0], best.values[1] * step);
        let start_s = self.problem.force_time_s(best.values[2]);
        let impulse_n_s = self.per_peak(best.values[1]) * peak;
        let relative = covariance[0][0] / (peak * peak)
            + covariance[1][1] / (duration * duration)
            + 2.0 * covariance[0][1] / (peak * duration);
        let gains = self.gains(&best.values).map(|(value, at)| {
            let sd = at.map_or(0.0, |i| (inverse[i][i] * scale).sqrt());
            Estimate { value, sd }
        });
        let fit = PulseFit {
            peak_n: of(peak, 0),
            duration_s: of(duration, 1),
            start_s: of(start_s, 2),
            covariance,
            impulse_n_s: Estimate {
                value: impulse_n_s,
                sd: impulse_n_s * relative.max(0.0).sqrt(),
            },
            gains: gains.collect(),
            chi_squared: best.chi_squared,
            degrees_of_freedom,
            detection,
        };
        self.shown(&fit, best).map(|()| fit)
    }

    fn shown(&self, fit: &PulseFit, best: &Point) -> Result<(), InverseError> {
        let start_s = fit.start_s.value;
        // first arrival against the first row, in force samples
        let seen = |rows: &Rows| {
            best.values[2] + rows.arrival as f64 >= rows.force_index(self.problem, 0) as f64
        };
        if best.values[2] < 0.0 || !self.rows.iter().any(seen) {
            return Err(InverseError::StartNotShown);
        }
        self.problem
            .shown(self.rows, best.values[2] + best.values[1])?;
        for (index, (rows, trace)) in self.rows.iter().zip(&self.problem.traces).enumerate() {
            if let Noise::Quiet(range) = &trace.noise {
                let quiet_s = range.end as f64 * self.problem.step_s;
                let arrival_s = start_s + rows.arrival as f64 * self.problem.force_step_s();
                // the foot of a pulse is below the noise
                if arrival_s + 0.1 * fit.duration_s.value < quiet_s {
                    return Err(InverseError::QuietMoves {
                        index,
                        quiet_s,
                        arrival_s,
                    });
                }
            }
        }
        Ok(())
    }
}
