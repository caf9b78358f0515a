//! Decay of the remainder after the last time cell.
//!
//! Theory: `docs/theory.md` (T21).

use halfspace::{Six, chebyshev_each};

/// Number of times at which a series is summed in parallel.
const LANES: usize = 8;

/// Series of all fields of the remainder after the last cell, R(t) = u^2 g(u) with u = `t_end`/t in (0, 1].
///
/// ```text
/// g(u) = sum_k c_k T_k(2u - 1),    int_{t1}^{t2} R dt = t_end (G(u1) - G(u2)),    G' = g
/// ```
///
/// After the last arrival R is smooth in u and vanishes at least like u^2, so g is smooth on the
/// closed interval and the integral of a cell of any width is the difference of two polynomials.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tail {
    time_end: f64,
    /// Coefficients of G by term.
    terms: Vec<Six>,
}

impl Tail {
    /// The tail after `time_end`, in r0/c1, with the coefficients c_k.
    pub(super) fn new(time_end: f64, coefficients: &[Six]) -> Self {
        // int T_k(x) dx with x = 2u - 1, du = dx/2: G = sum_k C_k T_k, the constant is irrelevant.
        let c = |k: usize| *coefficients.get(k).unwrap_or(&Six::default());
        let term = |k: usize| -> Six {
            let (before, after, part) = match k {
                0 => return Six::default(),
                1 => (c(0).map(|c| 2.0 * c), c(2), 0.25),
                _ => (c(k - 1), c(k + 1), 0.25 / k as f64),
            };
            std::array::from_fn(|f| part * (before[f] - after[f]))
        };
        Self {
            time_end,
            terms: (0..=coefficients.len()).map(term).collect(),
        }
    }

    /// G at the given times, computed eight at a time.
    pub(super) fn integrals(&self, times: &[f64]) -> Vec<Six> {
        let mut found = vec![Six::default(); times.len()];
        for (found, times) in found.chunks_mut(LANES).zip(times.chunks(LANES)) {
            let time = |i| times.get(i).unwrap_or(&self.time_end);
            let x: [f64; LANES] = std::array::from_fn(|i| 2.0 * (self.time_end / time(i)) - 1.0);
            let sums = chebyshev_each(&self.terms, x);
            for (i, found) in found.iter_mut().enumerate() {
                *found = sums.map(|sum| sum[i]);
            }
        }
        found
    }

    /// Factor from the difference of G between two times, `duration` apart, to the average of R between them.
    #[inline(always)]
    pub(super) fn scale(&self, duration: f64) -> f64 {
        self.time_end / duration
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn average(tail: &Tail, from: f64, to: f64) -> Six {
        let ends = tail.integrals(&[from, to]);
        let (near, far) = (ends[0], ends[1]);
        std::array::from_fn(|f| tail.scale(to - from) * (near[f] - far[f]))
    }

    #[test]
    fn a_power_law_is_integrated_exactly() {
        // R = u^2 (1 + 3 u), times the number of the field: g = 2.5 T_0 + 1.5 T_1,
        // int R dt = t_end [u + 1.5 u^2] between the ends.
        let each = [2.5, 1.5].map(|c| std::array::from_fn(|f| c * f as f64));
        let tail = Tail::new(20.0, &each);
        for (from, to) in [(20.0, 20.1), (25.0, 31.0), (400.0, 400.1), (1e4, 2e4)] {
            let (a, b) = (20.0 / from, 20.0 / to);
            let exact = 20.0 * ((a - b) + 1.5 * (a * a - b * b)) / (to - from);
            for (f, found) in average(&tail, from, to).into_iter().enumerate() {
                assert!((found - f as f64 * exact).abs() < 1e-12 * (1.0 + f as f64));
            }
        }
    }

    #[test]
    fn averages_of_parts_make_the_average_of_the_whole() {
        let tail = Tail::new(30.0, &[0.3, -0.2, 0.1, 0.05, -0.01].map(|c| [c; 6]));
        let part = |i: u32| average(&tail, 30.0 + f64::from(i), 31.0 + f64::from(i))[3];
        let parts: f64 = (0..8).map(part).sum();
        assert!((parts / 8.0 - average(&tail, 30.0, 38.0)[3]).abs() < 1e-13);
    }
}
