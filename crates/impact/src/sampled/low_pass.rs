//! A low pass of zero phase, exact for a force or another history that is linear between uneven rows.
//!
//! It is Butterworth's filter of fourth order run forwards and backwards, in closed form: a gain of
//!
//! ```text
//! G(f) = 1/(1 + (f/fc)^8)        h(t) = -(1/4) Re sum_k s_k e^(s_k |t|),   s_k = 2 pi fc e^(5 pi i/8), 2 pi fc e^(7 pi i/8)
//! ```
//!
//! with no delay: 1 to 1e-3 up to 0.42 fc, 1/2 at fc, 1e-3 at 2.4 fc. h has the integral one, so that the impulse stays.
//! The convolution of h with straight lines is one recursion in each direction, without any error of sampling.

use super::projection::largest;
use num_complex::Complex64;
use std::f64::consts::PI;
use std::ops::Range;

/// Cutoff periods after which h has fallen by 1e-13: 13 ln 10/(2 pi sin(pi/8)).
const REACH: f64 = 12.45;

/// Rows in a cutoff period where the force of the record has fewer: a sine at the cutoff is joined to 1.2e-3 of itself.
const ROWS: f64 = 64.0;

/// Rows that a filtered record may have, unless the record itself has more than half as many.
const MOST_ROWS: f64 = 4e6;

/// A difference below this fraction of the largest force is rounding: the force is left as it is.
const ROUNDING: f64 = 1e-12;

/// A force by rows, zero outside.
#[derive(Default)]
pub(crate) struct Rows {
    /// Times in s.
    pub(crate) time_s: Vec<f64>,
    /// Forces in N.
    pub(crate) force_n: Vec<f64>,
    /// Impulse in N s that the filter has put before the time zero, where it is lost.
    pub(crate) before_zero_n_s: f64,
    /// The rows of the record; those before and after are added.
    of_record: Range<usize>,
}

/// Frequencies in Hz that can be cut for rows at these times.
///
/// One period is at most the whole record; the number of rows that the filter adds is bounded.
pub(crate) fn allowed_hz(time_s: &[f64]) -> [f64; 2] {
    let span_s = time_s[time_s.len() - 1] - time_s[0];
    let most = MOST_ROWS.max(2.0 * time_s.len() as f64);
    let rows = |cutoff_hz: f64| {
        let reach = 2.0 * REACH * ROWS;
        let added = |t: &[f64]| (ROWS * cutoff_hz * (t[1] - t[0])).min(reach).floor();
        time_s.len() as f64 + reach + time_s.windows(2).map(added).sum::<f64>()
    };
    let (mut low, mut high) = (1.0 / span_s, (1e4 * MOST_ROWS / span_s).min(f64::MAX));
    if rows(high) <= most {
        return [low, high];
    }
    let least = low;
    while high > 1.001 * low {
        // each root for itself: the product of times that nobody has is zero or infinite
        let middle = low.sqrt() * high.sqrt();
        match rows(middle) <= most {
            true => low = middle,
            false => high = middle,
        }
    }
    [least, low]
}

/// The poles above the real axis in rad/s.
fn poles(cutoff_hz: f64) -> [Complex64; 2] {
    [0.625, 0.875].map(|angle| Complex64::from_polar(2.0 * PI * cutoff_hz, angle * PI))
}

/// The force through the filter; `cutoff_hz` is one of [`allowed_hz`].
pub(crate) fn low_pass(time_s: &[f64], force_n: &[f64], cutoff_hz: f64) -> Rows {
    let mut rows = Rows::new(time_s, force_n, cutoff_hz);
    let poles = poles(cutoff_hz);
    let count = rows.time_s.len();
    let mut sum = vec![0.0; count];
    let mut state = [Complex64::default(); 2];
    for i in 0..count - 1 {
        sum[i + 1] = rows.step(&poles, i, &mut state, false);
    }
    state = [Complex64::default(); 2];
    for i in (0..count - 1).rev() {
        sum[i] += rows.step(&poles, i, &mut state, true);
    }
    // before the first row the force dies as exp(s |t|), whose integral is -1/s
    if rows.time_s[0] == 0.0 {
        rows.before_zero_n_s = 0.25 * (state[0] + state[1]).re;
    }
    let rounding_n = ROUNDING * largest(force_n);
    for (filtered, &given) in sum.iter_mut().zip(&rows.force_n) {
        if (*filtered - given).abs() <= rounding_n {
            *filtered = given;
        }
    }
    rows.force_n = sum;
    rows.join();
    rows
}

/// A history through the filter at its own times, or a rate of it of an order up to two: zero before, and as at the end after.
///
/// Exact for straight lines between the values. F and B are the states of a pole forwards and backwards, with F' = x + s F and
/// B' = -x - s B, so that the rates follow from them:
///
/// ```text
/// y = -(1/4) Re sum s (F + B),     y' = -(1/4) Re sum s^2 (F - B),     y'' = -(1/4) Re sum s^3 (F + B)
/// ```
pub(crate) fn filtered(time_s: &[f64], values: &[f64], cutoff_hz: f64, order: i32) -> Vec<f64> {
    let count = values.len();
    let mut found = vec![0.0; count];
    let last = values.last().copied().unwrap_or(0.0);
    for pole in poles(cutoff_hz) {
        let steps = time_s.windows(2).map(|t| functions(pole * (t[1] - t[0])));
        let steps: Vec<_> = steps.collect();
        let (mut state, factor) = (Complex64::default(), -0.25 * pole.powi(order + 1));
        let sign = if order == 1 { -1.0 } else { 1.0 };
        for i in 1..count {
            let (decay, first, second) = steps[i - 1];
            let (a, b, width) = (values[i - 1], values[i], time_s[i] - time_s[i - 1]);
            state = decay * state + width * (a * first + (b - a) * second);
            found[i] += (factor * state).re;
        }
        state = -last / pole;
        for i in (0..count).rev() {
            if i + 1 < count {
                let (decay, first, second) = steps[i];
                let (a, b, width) = (values[i], values[i + 1], time_s[i + 1] - time_s[i]);
                state = decay * state + width * (a * first + (b - a) * (first - second));
            }
            found[i] += sign * (factor * state).re;
        }
    }
    found
}

/// Integral of the magnitude of the filter's response to an impulse, and of its rates, over the cutoff to their order: that much an
/// error of a history grows.
pub(crate) const GROWTH: [f64; 3] = [1.381, 5.631, 28.71];

impl Rows {
    fn new(time_s: &[f64], force_n: &[f64], cutoff_hz: f64) -> Self {
        let (reach_s, step_s) = (REACH / cutoff_hz, 1.0 / (ROWS * cutoff_hz));
        let (start_s, end_s) = (time_s[0], time_s[time_s.len() - 1]);
        let mut rows = Self::default();
        rows.between([(start_s - reach_s).max(0.0), start_s], [0.0; 2], step_s);
        rows.of_record.start = rows.time_s.len();
        for (t, p) in time_s.windows(2).zip(force_n.windows(2)) {
            let line = |time_s: f64| p[0] + (p[1] - p[0]) * (time_s - t[0]) / (t[1] - t[0]);
            if t[1] - t[0] > 2.0 * reach_s {
                let inner = [t[0] + reach_s, t[1] - reach_s];
                rows.between([t[0], inner[0]], [p[0], line(inner[0])], step_s);
                rows.between(inner, inner.map(line), f64::INFINITY);
                rows.between([inner[1], t[1]], [line(inner[1]), p[1]], step_s);
            } else {
                rows.between([t[0], t[1]], [p[0], p[1]], step_s);
            }
            // a jump is two rows of one time until it is filtered
            if t[0] == t[1] {
                rows.add(t[0], p[0]);
                rows.add(t[1], p[1]);
            }
        }
        rows.push(end_s, force_n[force_n.len() - 1]);
        rows.of_record.end = rows.time_s.len() - 1;
        rows.between([end_s, end_s + reach_s], [0.0; 2], step_s);
        // the row at the record's end is there already
        rows.push(end_s + reach_s, 0.0);
        rows
    }

    fn push(&mut self, time_s: f64, force_n: f64) {
        if self.time_s.last().is_none_or(|&last| time_s > last) {
            self.add(time_s, force_n);
        }
    }

    fn add(&mut self, time_s: f64, force_n: f64) {
        self.time_s.push(time_s);
        self.force_n.push(force_n);
    }

    /// Makes one row of two that have one time and, filtered, one force.
    fn join(&mut self) {
        let mut kept = 0;
        for i in 0..self.time_s.len() {
            if kept > 0 && self.time_s[kept - 1] == self.time_s[i] {
                kept -= 1;
            }
            (self.time_s[kept], self.force_n[kept]) = (self.time_s[i], self.force_n[i]);
            kept += 1;
        }
        self.time_s.truncate(kept);
        self.force_n.truncate(kept);
    }

    /// The rows of an interval from its beginning, its end left out.
    fn between(&mut self, [from_s, to_s]: [f64; 2], [from_n, to_n]: [f64; 2], step_s: f64) {
        let count = ((to_s - from_s) / step_s).ceil().max(1.0);
        for i in 0..count as usize {
            let x = i as f64 / count;
            if from_s + x * (to_s - from_s) < to_s {
                self.push(from_s + x * (to_s - from_s), from_n + x * (to_n - from_n));
            }
        }
    }

    /// Takes the states of both poles over the interval after row `i`, forwards or backwards, and gives the filtered force of
    /// that direction there.
    ///
    /// ```text
    /// int_0^d e^(s (d - u)) (a + (b - a) u/d) du = d [a p1 + (b - a) p2]       p1 = (e^q - 1)/q,  q = s d
    /// int_0^d e^(s u)       (a + (b - a) u/d) du = d [a p1 + (b - a) (p1 - p2)]  p2 = (e^q - 1 - q)/q^2
    /// ```
    fn step(
        &self,
        poles: &[Complex64; 2],
        i: usize,
        state: &mut [Complex64; 2],
        backwards: bool,
    ) -> f64 {
        let width = self.time_s[i + 1] - self.time_s[i];
        let [a, b] = match self.of_record.contains(&i) {
            true => [self.force_n[i], self.force_n[i + 1]],
            false => [0.0; 2],
        };
        for (state, pole) in state.iter_mut().zip(poles) {
            let (decay, first, second) = functions(pole * width);
            let second = if backwards { first - second } else { second };
            *state = decay * *state + width * (a * first + (b - a) * second);
        }
        -0.25 * (poles[0] * state[0] + poles[1] * state[1]).re
    }
}

/// e^q, (e^q - 1)/q and (e^q - 1 - q)/q^2, to rounding.
fn functions(q: Complex64) -> (Complex64, Complex64, Complex64) {
    if q.norm_sqr() > 0.25 {
        let decay = q.exp();
        let first = (decay - 1.0) / q;
        return (decay, first, (first - 1.0) / q);
    }
    // sum q^n/(n + 2)!, 0.5^13/15! is below rounding
    let mut second = Complex64::new(1.0, 0.0);
    for n in (3..=15).rev() {
        second = 1.0 + second * q / f64::from(n);
    }
    second *= 0.5;
    let first = 1.0 + q * second;
    (1.0 + q * first, first, second)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(found: &Rows, time_s: f64) -> f64 {
        let i = found.time_s.partition_point(|&t| t < time_s);
        assert!((found.time_s[i] - time_s).abs() < 1e-9 * time_s);
        found.force_n[i]
    }

    /// Of a cosine squared that ends on a plateau: gains of a constant and a cosine, and the rates of these.
    #[test]
    fn a_sampled_history_has_the_gain_and_its_rates() {
        let (f, step, cutoff): (f64, f64, f64) = (1.0, 1e-3, 1.3);
        let time_s: Vec<f64> = (0..60_000).map(|i| f64::from(i) * step).collect();
        let values: Vec<f64> = time_s
            .iter()
            .map(|&t| 2.0 + (2.0 * PI * f * t).cos())
            .collect();
        let sinc = (PI * f * step).sin() / (PI * f * step);
        let gain = sinc * sinc / (1.0 + (f / cutoff).powi(8));
        let w = 2.0 * PI * f;
        for order in 0..3 {
            let found = filtered(&time_s, &values, cutoff, order);
            for i in (25_000..35_000).step_by(97) {
                let (sine, cosine) = (w * time_s[i]).sin_cos();
                let exact = [
                    2.0 + gain * cosine,
                    -gain * w * sine,
                    -gain * w * w * cosine,
                ];
                let off = (found[i] - exact[order as usize]).abs() / w.powi(order);
                // of the second rate what the straight lines bend at their ends is seen
                let within = [1e-12, 1e-10, 1e-4][order as usize];
                assert!(off < within, "{order}: {off:e}");
            }
            let last = found[found.len() - 1];
            assert!(last.is_finite());
        }
        let held = filtered(&[0.0, 1e-9, 50.0, 100.0], &[0.0, 1.0, 1.0, 1.0], cutoff, 0);
        assert!((held[2] - 1.0).abs() < 1e-12 && (held[3] - 1.0).abs() < 1e-12);
        assert!((held[0] - 0.5).abs() < 1e-6, "{}", held[0]);
    }

    #[test]
    fn a_sine_has_the_gain_of_the_filter_and_no_delay() {
        // linear between samples, a sine has sinc^2 of its amplitude; its images lie far above the cutoff
        for ratio in [0.1_f64, 0.3, 0.42, 1.0, 2.0, 2.4] {
            let (f, step) = (1.0, 1e-3);
            let time_s: Vec<f64> = (0..80_000).map(|i| f64::from(i) * step).collect();
            let sine = |t: f64| (2.0 * PI * f * t + 0.3).sin();
            let force_n: Vec<f64> = time_s.iter().map(|&t| sine(t)).collect();
            let found = low_pass(&time_s, &force_n, f / ratio);
            let sinc = (PI * f * step).sin() / (PI * f * step);
            let gain = sinc * sinc / (1.0 + ratio.powi(8));
            for i in (38_000..42_000).step_by(97) {
                let error = (at(&found, time_s[i]) - gain * sine(time_s[i])).abs();
                assert!(error < 1e-12, "{ratio}: {error:e}");
            }
        }
    }

    #[test]
    fn rows_on_the_lines_change_nothing_and_the_impulse_stays() {
        let (time_s, force_n) = (vec![1.0, 1.3, 2.0], vec![0.5, 2.0, 0.0]);
        let uneven = |i: i32| 1.0 + (f64::from(i) / 999.0).powi(2);
        let mut many: Vec<f64> = (0..1000).map(uneven).collect();
        many.push(1.3);
        many.sort_by(f64::total_cmp);
        let line = |t: f64| {
            if t < 1.3 {
                0.5 + (t - 1.0) * 5.0
            } else {
                2.0 - (t - 1.3) / 0.7 * 2.0
            }
        };
        let values: Vec<f64> = many.iter().map(|&t| line(t)).collect();
        // a low pass far above the rows adds rows between them
        let found = [20.0, 200.0].map(|cutoff| {
            let (few, many) = (
                low_pass(&time_s, &force_n, cutoff),
                low_pass(&many, &values, cutoff),
            );
            for t in [1.0, 1.3, 2.0] {
                assert!((at(&few, t) - at(&many, t)).abs() < 1e-13, "{cutoff} {t}");
            }
            few
        });
        for filtered in found {
            let rows = filtered.time_s.windows(2).zip(filtered.force_n.windows(2));
            let impulse: f64 = rows.map(|(t, p)| 0.5 * (t[1] - t[0]) * (p[0] + p[1])).sum();
            assert!((impulse / 1.075 - 1.0).abs() < 1e-6, "{impulse}");
            assert_eq!(filtered.before_zero_n_s, 0.0);
        }
    }

    #[test]
    fn a_step_is_the_integral_of_the_impulse_response() {
        // half of the step's height is reached at the step, and h integrates to one
        let found = low_pass(&[0.0, 50.0, 100.0], &[1.0, 1.0, 1.0], 1.0);
        assert!((at(&found, 100.0) - 0.5).abs() < 1e-13);
        assert!((at(&found, 50.0) - 1.0).abs() < 1e-12);
        // h is even: the part before zero is int_0^inf t h(t) dt = (1/4) Re sum 1/s
        let poles = [0.625, 0.875].map(|a| Complex64::from_polar(2.0 * PI, a * PI));
        let expected = -0.25 * (1.0 / poles[0] + 1.0 / poles[1]).re;
        assert!(
            (found.before_zero_n_s - expected).abs() < 1e-13,
            "{} {expected}",
            found.before_zero_n_s
        );
    }

    /// Beside the same record with rises over a part of the cutoff's period that does not matter.
    #[test]
    fn a_jump_is_filtered_as_the_steepest_of_rises() {
        let jumps = low_pass(
            &[1.0, 1.0, 2.0, 2.0, 3.0, 3.0],
            &[0.0, 2.0, 3.0, 1.0, 1.0, 0.0],
            4.0,
        );
        let rises = low_pass(
            &[1.0 - 1e-9, 1.0, 2.0, 2.0 + 1e-9, 3.0, 3.0 + 1e-9],
            &[0.0, 2.0, 3.0, 1.0, 1.0, 0.0],
            4.0,
        );
        let [ends, falls] = [&jumps, &rises].map(|rows| (rows.time_s.len(), at(rows, 2.0)));
        assert!(ends.0 <= falls.0 && (ends.1 - 2.0).abs() < 0.1, "{ends:?}");
        for t in [1.0, 2.0, 3.0] {
            assert!((at(&jumps, t) - at(&rises, t)).abs() < 1e-7, "{t}");
        }
        assert!(jumps.time_s.windows(2).all(|t| t[0] < t[1]));
    }

    /// Products of times that no instrument has are zero or infinite.
    #[test]
    fn the_cutoffs_of_absurd_times_are_found() {
        for span_s in [1e-300, 1e-160, 1e205, 1e307] {
            let many: Vec<f64> = (0..5000)
                .map(|i| span_s * (f64::from(i) / 4999.0))
                .collect();
            let [low, high] = allowed_hz(&many);
            assert!(low > 0.0 && high > low, "{span_s}: {low} {high}");
        }
    }

    #[test]
    fn what_is_quiet_stays_quiet() {
        let found = low_pass(
            &[0.0, 100.0, 101.0, 102.0, 500.0, 501.0],
            &[0.0, 0.0, 3.0, 1.0, 1.0, 0.0],
            5.0,
        );
        let still = |from: f64, to: f64, value: f64| {
            let rows = found.time_s.iter().zip(&found.force_n);
            let mut inside = rows.filter(|(t, _)| **t >= from && **t <= to);
            inside.all(|(_, p)| *p == value)
        };
        assert!(still(0.0, 97.0, 0.0) && still(105.0, 497.0, 1.0) && still(504.0, 1e9, 0.0));
        assert!(found.time_s.len() < 10_000, "{}", found.time_s.len());
    }

    #[test]
    fn the_cutoffs_allowed_bound_the_rows() {
        let [low, high] = allowed_hz(&[0.0, 0.5, 2.0]);
        assert_eq!(low, 0.5);
        assert!(
            low_pass(&[0.0, 0.5, 2.0], &[0.0, 1.0, 0.0], high)
                .time_s
                .len()
                <= 4_000_000
        );
        let many: Vec<f64> = (0..10_000).map(f64::from).collect();
        let [_, high] = allowed_hz(&many);
        let rows = low_pass(&many, &vec![1.0; 10_000], high).time_s.len() as f64;
        assert!((3.9e6..=4.0e6).contains(&rows), "{rows}");
    }
}
