//! One real pole or zero, or a pair of conjugate ones, in discrete time.
//!
//! ```text
//! 1/(s - a) over one step:  y_n = e^q y_{n-1} + dt sum_i w_i x_{n+i},   q = a dt
//! w_i = int_{-1}^0 e^{-q t} L_i(t) dt,                                   L_i of the nodes -2..2
//! ```
//!
//! The polynomial through five samples around n is integrated exactly, so that a pole far above the sampling rate is as
//! good as a slow one. A pair has the product of both polynomials in the shift, which is real.
//! A polynomial through an even number of samples would have a zero at half the sampling rate, one through samples of the
//! past alone zeros outside the unit circle, and neither could be inverted. This sum has as many zeros inside the circle
//! as shifts to the past (the test `the_sum_has_no_zero_on_the_circle`), so that it is a causal filter times one that
//! looks ahead, both with a bounded inverse. Past and future are two passes over the samples. The causal ones
//! come first, which makes the product exact for a record that begins at any time.
//!
//! After the last sample the filter that looks ahead continues its input by a polynomial of degree four.

use num_complex::Complex64;

/// Coefficients of L_i in powers of t.
const LAGRANGE: [[f64; 5]; 5] = [
    [0.0, 2.0 / 24.0, -1.0 / 24.0, -2.0 / 24.0, 1.0 / 24.0],
    [0.0, -4.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, -1.0 / 6.0],
    [1.0, 0.0, -5.0 / 4.0, 0.0, 1.0 / 4.0],
    [0.0, 4.0 / 6.0, 4.0 / 6.0, -1.0 / 6.0, -1.0 / 6.0],
    [0.0, -2.0 / 24.0, -1.0 / 24.0, 2.0 / 24.0, 1.0 / 24.0],
];

/// Largest number of rows of the elimination that finds both factors.
///
/// Each row gains half a digit or more, so that 40 are enough for every root below half the sampling rate; the rest is for
/// those beyond (the test `the_sum_has_no_zero_on_the_circle` fails at 15).
const MOST_ROWS: usize = 200;
/// Largest error of the product of both factors, relative to the sum: far above rounding, far below any factors of a sum
/// that has none (the same test).
const FACTORED: f64 = 1e-12;
/// Degree of the polynomial beyond the last sample: that of the sum, so that an end costs no order of accuracy (the test
/// `the_end_of_the_record_changes_nothing_before_it` fails at 2).
const DEGREE: usize = 4;

/// The integral of one root or of a pair over a step.
pub(super) struct Section {
    /// e^q - 1 of the root.
    growth: Complex64,
    /// Coefficients at x_n, x_{n-1}, .. of the causal factor of the sum.
    past: Vec<f64>,
    /// Coefficients at x_n, x_{n+1}, .. of the other; the first is one.
    ahead: Vec<f64>,
}

impl Section {
    /// Of a real root, or of a complex one and its conjugate, in rad/s; none if the steps are too coarse for it.
    pub(super) fn new(root: Complex64, step_s: f64) -> Option<Self> {
        let q = root * step_s;
        let weights = weights(q).map(|w| step_s * w);
        let sum = if root.im == 0.0 {
            weights.map(|w| w.re).to_vec()
        } else {
            let mut sum = vec![0.0; 9];
            for (i, a) in weights.iter().enumerate() {
                for (j, b) in weights.iter().enumerate() {
                    sum[i + j] += (a * b.conj()).re;
                }
            }
            sum
        };
        let (past, ahead) = factors(&sum)?;
        // without the digits that e^q loses next to one
        let half = (0.5 * q.im).sin();
        let real = q.re.exp_m1() * q.im.cos() - 2.0 * half * half;
        let growth = Complex64::new(real, q.re.exp() * q.im.sin());
        Some(Self {
            growth,
            past,
            ahead,
        })
    }

    /// The causal part of the integral, or of its inverse.
    pub(super) fn causal(&self, samples: &mut [f64], way: Way) {
        match way {
            Way::Integral => {
                filter(&self.past, &[1.0], samples);
                self.accumulate(samples);
            }
            Way::Inverse => {
                self.difference(samples);
                filter(&[1.0], &self.past, samples);
            }
        }
    }

    /// y_n = e^q y_{n-1} + x_n, and the same with the conjugate of q for a pair.
    ///
    /// One recursion of second order would lose the square of the digits that each of these loses for a slow root.
    fn accumulate(&self, samples: &mut [f64]) {
        let is_pair = self.growth.im != 0.0;
        let (mut first, mut second) = (Complex64::default(), Complex64::default());
        for sample in samples {
            first += self.growth * first + *sample;
            *sample = first.re;
            if is_pair {
                second += self.growth.conj() * second + first;
                *sample = second.re;
            }
        }
    }

    /// The inverse of [`Section::accumulate`].
    fn difference(&self, samples: &mut [f64]) {
        let is_pair = self.growth.im != 0.0;
        let (mut before, mut first_before) = (Complex64::default(), Complex64::default());
        for sample in samples {
            let own = Complex64::from(*sample);
            let first = (own - before) - self.growth * before;
            *sample = first.re;
            if is_pair {
                *sample = ((first - first_before) - self.growth.conj() * first_before).re;
            }
            (before, first_before) = (own, first);
        }
    }

    /// The part that looks ahead.
    pub(super) fn looking_ahead(&self, samples: &mut [f64], way: Way) {
        let count = samples.len();
        // the last samples depend on each other through the polynomial
        let last = count.min((DEGREE + 1).max(self.ahead.len() - 1));
        let end = count - last;
        let ahead = &self.ahead;
        let row = |n: usize, samples: &[f64]| -> f64 {
            ahead
                .iter()
                .zip(&samples[n..])
                .skip(1)
                .map(|(a, x)| a * x)
                .sum()
        };
        match way {
            Way::Integral => {
                let rows = self.end(last);
                for n in 0..end {
                    samples[n] += row(n, samples);
                }
                let input = samples[end..].to_vec();
                for (out, row) in samples[end..].iter_mut().zip(&rows) {
                    *out = row.iter().zip(&input).map(|(a, x)| a * x).sum();
                }
            }
            Way::Inverse => {
                solve(self.end(last), &mut samples[end..]);
                for n in (0..end).rev() {
                    samples[n] -= row(n, samples);
                }
            }
        }
    }

    /// The last rows of the filter that looks ahead, over so many samples.
    fn end(&self, last: usize) -> Vec<Vec<f64>> {
        let degree = DEGREE.min(last.saturating_sub(1));
        (0..last)
            .map(|n| {
                let mut row = vec![0.0; last];
                for (k, a) in self.ahead.iter().enumerate() {
                    match (n + k).checked_sub(last - 1) {
                        None | Some(0) => row[n + k] += a,
                        Some(beyond) => {
                            for (i, e) in continued(degree, beyond).enumerate() {
                                row[last - 1 - i] += a * e;
                            }
                        }
                    }
                }
                row
            })
            .collect()
    }
}

/// Whether a section integrates, as a pole does, or its inverse differentiates, as a zero does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    Integral,
    Inverse,
}

/// w_i of one root.
fn weights(q: Complex64) -> [Complex64; 5] {
    let moments = moments(q);
    LAGRANGE.map(|row| row.iter().zip(moments).map(|(c, m)| c * m).sum())
}

/// int_0^1 e^{q u} (-u)^j du for j = 0..4.
fn moments(q: Complex64) -> [Complex64; 5] {
    let mut found = [Complex64::default(); 5];
    if q.norm() < 2.0 {
        // 2^35/35! is below rounding
        let mut term = Complex64::new(1.0, 0.0);
        for k in 0..35_u32 {
            for (j, moment) in (1..).zip(&mut found) {
                *moment += term / f64::from(k + j);
            }
            term *= q / f64::from(k + 1);
        }
    } else {
        let end = q.exp();
        found[0] = (end - 1.0) / q;
        for j in 1..5 {
            found[j] = (end - j as f64 * found[j - 1]) / q;
        }
    }
    for j in [1, 3] {
        found[j] = -found[j];
    }
    found
}

/// The causal factor of a sum over -r..r and the one that looks ahead, by elimination from below in the matrix of the sum
/// with infinitely many rows; none if there is no such product.
fn factors(sum: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
    let reach = sum.len() / 2;
    let first: Vec<f64> = sum[..=reach].iter().rev().copied().collect();
    let mut below = vec![first; reach];
    let mut ahead = vec![1.0; reach + 1];
    for _ in 0..MOST_ROWS {
        let mut row = sum.to_vec();
        for k in (1..=reach).rev() {
            ahead[k] = row[reach + k] / below[k - 1][0];
            for (j, past) in below[k - 1].iter().enumerate() {
                row[reach + k - j] -= ahead[k] * past;
            }
        }
        below.rotate_right(1);
        below[0] = row[..=reach].iter().rev().copied().collect();
    }
    let past = below.swap_remove(0);
    let mut product = vec![0.0; sum.len()];
    for (k, a) in ahead.iter().enumerate() {
        for (j, p) in past.iter().enumerate() {
            product[reach + k - j] += a * p;
        }
    }
    let largest = sum.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let fits = |(a, b): (&f64, &f64)| (a - b).abs() <= FACTORED * largest;
    // a factor with zeros outside the circle would grow when it is inverted
    let is_bounded = |row: &[f64]| grows(row) < 1e3;
    let found = product.iter().zip(sum).all(fits) && is_bounded(&past) && is_bounded(&ahead);
    found.then_some((past, ahead))
}

/// Largest value of the inverse of a filter in a hundred steps.
fn grows(row: &[f64]) -> f64 {
    let mut impulse = vec![0.0; 100];
    impulse[0] = row[0];
    filter(&[1.0], row, &mut impulse);
    impulse.iter().fold(0.0, |a: f64, b| a.max(b.abs()))
}

/// y_n = (sum_j b_j x_{n-j} - sum_{j > 0} a_j y_{n-j})/a_0.
fn filter(numerator: &[f64], denominator: &[f64], samples: &mut [f64]) {
    let (mut inputs, mut outputs) = ([0.0; 5], [0.0; 5]);
    for sample in samples {
        inputs.rotate_right(1);
        inputs[0] = *sample;
        let mut sum: f64 = numerator.iter().zip(inputs).map(|(b, x)| b * x).sum();
        for (a, y) in denominator[1..].iter().zip(outputs) {
            sum -= a * y;
        }
        *sample = sum / denominator[0];
        outputs.rotate_right(1);
        outputs[0] = *sample;
    }
}

/// Weights of the last samples, from the last one back, in the polynomial through them, so many steps beyond the last.
fn continued(degree: usize, beyond: usize) -> impl Iterator<Item = f64> {
    let beyond = beyond as f64;
    (0..=degree).map(move |i| {
        let others = (0..=degree).filter(move |&k| k != i);
        others
            .map(|k| (beyond + k as f64) / (k as f64 - i as f64))
            .product()
    })
}

/// Solves a few equations by elimination with pivots.
fn solve(mut rows: Vec<Vec<f64>>, values: &mut [f64]) {
    for (row, value) in rows.iter_mut().zip(values.iter()) {
        row.push(*value);
    }
    let count = rows.len();
    for k in 0..count {
        let size = |&i: &usize| rows[i][k].abs();
        let pivot = (k..count).max_by(|i, j| size(i).total_cmp(&size(j)));
        rows.swap(k, pivot.unwrap_or(k));
        let (done, left) = rows.split_at_mut(k + 1);
        for row in left {
            let factor = row[k] / done[k][k];
            for (a, b) in row.iter_mut().zip(&done[k]).skip(k) {
                *a -= factor * b;
            }
        }
    }
    for k in (0..count).rev() {
        let known = rows[k].iter().zip(values.iter()).skip(k + 1);
        let known: f64 = known.map(|(a, x)| a * x).sum();
        values[k] = (rows[k][count] - known) / rows[k][k];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_has_no_zero_on_the_circle() {
        let turn = |q: Complex64| Section::new(q, 1.0);
        for damping in [0.0, 1e-6, 1e-3, 0.03, 0.5, 1.0] {
            for i in -60..=50 {
                let size = 10_f64.powf(f64::from(i) * 0.1).min(3.1 + 100.0 * damping);
                let q = Complex64::new(-damping, (1.0_f64 - damping * damping).sqrt()) * size;
                assert!(turn(q).is_some(), "{q}");
                let real = Complex64::new(-size, 0.0);
                assert!(turn(real).is_some(), "{real}");
            }
        }
        assert!(turn(Complex64::default()).is_some());
        // a resonance above the sampling rate, where the sum has as many zeros inside as shifts to the future
        assert!(turn(Complex64::new(-1e-3, 8.5)).is_none());
    }

    #[test]
    fn moments_of_both_formulas_agree() {
        for angle in [0.0, 1.0, 2.0, 3.1, -2.0] {
            let [a, b] = [1.999_999, 2.000_001].map(|r| moments(Complex64::from_polar(r, angle)));
            for (a, b) in a.iter().zip(b) {
                assert!((a - b).norm() < 1e-5 * a.norm(), "{a} {b}");
            }
        }
        // int_0^1 e^u u^4 du = 9 e - 24
        let exact = 9.0 * std::f64::consts::E - 24.0;
        assert!((moments(Complex64::new(1.0, 0.0))[4].re - exact).abs() < 1e-14);
    }
}
