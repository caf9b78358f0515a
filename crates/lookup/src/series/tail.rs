//! The decay of the remainder after the last time cell.
//!
//! Theory: `docs/theory.md` (T21).

use halfspace::Six;

/// Series of the remainder after the end of the cells, R(t) = u^2 g(u) with u = `t_end`/t in (0, 1].
///
/// ```text
/// g(u) = sum_k c_k T_k(2u - 1),    int_{t1}^{t2} R dt = t_end (G(u1) - G(u2)),    G' = g
/// ```
///
/// After the last arrival R is smooth in u and vanishes at least like u^2, so g is smooth on the
/// closed interval and the integral of a cell of any width is the difference of two polynomials.
#[derive(Debug, Clone, PartialEq)]
pub struct Tail {
    time_end: f64,
    integral: Vec<f64>,
}

impl Tail {
    /// The tail after `time_end` with the coefficients c_k.
    #[must_use]
    pub fn new(time_end: f64, coefficients: &[f64]) -> Self {
        // int T_k(x) dx with x = 2u - 1, du = dx/2: G = sum_k C_k T_k, the constant is irrelevant.
        let n = coefficients.len();
        let c = |k: usize| coefficients.get(k).copied().unwrap_or(0.0);
        let mut integral = vec![0.0; n + 1];
        for (k, value) in integral.iter_mut().enumerate().skip(1) {
            let below = if k == 1 { 2.0 * c(0) } else { c(k - 1) };
            *value = 0.5 * (below - c(k + 1)) / (2.0 * k as f64);
        }
        Self { time_end, integral }
    }

    /// Average of R over [from, to], `time_end` <= from < to.
    #[must_use]
    pub fn average(&self, from: f64, to: f64) -> f64 {
        let (near, far) = (self.time_end / from, self.time_end / to);
        self.time_end * (chebyshev(&self.integral, near) - chebyshev(&self.integral, far))
            / (to - from)
    }
}

/// The integrals of the tails of all fields, evaluated together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Integrals {
    time_end: f64,
    /// Term by term.
    terms: Vec<Six>,
}

impl Integrals {
    /// Those of `tails`, one for each field, with the same end and the same number of terms.
    pub(crate) fn new(tails: &[Tail]) -> Self {
        let count = tails.first().map_or(0, |tail| tail.integral.len());
        let term = |k: usize| std::array::from_fn(|f| tails[f].integral[k]);
        Self {
            time_end: tails.first().map_or(0.0, |tail| tail.time_end),
            terms: (0..count).map(term).collect(),
        }
    }

    /// G at time `t`, the same to the last bit as field by field.
    pub(crate) fn at(&self, t: f64) -> Six {
        let x = 2.0 * (self.time_end / t) - 1.0;
        let (mut b1, mut b2): (Six, Six) = ([0.0; 6], [0.0; 6]);
        for c in self.terms.iter().skip(1).rev() {
            let next = std::array::from_fn(|f| 2.0 * x * b1[f] - b2[f] + c[f]);
            (b1, b2) = (next, b1);
        }
        let first = self.terms.first().copied().unwrap_or([0.0; 6]);
        std::array::from_fn(|f| x * b1[f] - b2[f] + first[f])
    }

    /// The average of R over a time that long, between whose ends G differs by `difference`.
    pub(crate) fn average(&self, difference: f64, duration: f64) -> f64 {
        self.time_end * difference / duration
    }
}

/// Sum of c_k T_k(2u - 1) by Clenshaw's recurrence.
#[must_use]
pub fn chebyshev(coefficients: &[f64], u: f64) -> f64 {
    let x = 2.0 * u - 1.0;
    let (mut b1, mut b2) = (0.0, 0.0);
    for &c in coefficients.iter().skip(1).rev() {
        (b1, b2) = (2.0 * x * b1 - b2 + c, b1);
    }
    x * b1 - b2 + coefficients.first().copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_integrated_exactly() {
        // R = u^2 (1 + 3 u): g = 2.5 T_0 + 1.5 T_1, int R dt = t_end [u + 1.5 u^2] between the ends.
        let tail = Tail::new(20.0, &[2.5, 1.5]);
        for (from, to) in [(20.0, 20.1), (25.0, 31.0), (400.0, 400.1), (1e4, 2e4)] {
            let (a, b) = (20.0 / from, 20.0 / to);
            let exact = 20.0 * ((a - b) + 1.5 * (a * a - b * b)) / (to - from);
            assert!((tail.average(from, to) - exact).abs() < 1e-12);
        }
    }

    #[test]
    fn all_fields_together_are_as_each_alone() {
        let tails: Vec<Tail> = (0..6)
            .map(|f| Tail::new(30.0, &[0.3 + f64::from(f), -0.2, 0.1 * f64::from(f), 0.05]))
            .collect();
        let integrals = Integrals::new(&tails);
        let (before, after) = (integrals.at(41.0), integrals.at(43.5));
        for (f, tail) in tails.iter().enumerate() {
            let together = integrals.average(before[f] - after[f], 2.5);
            assert_eq!(together, tail.average(41.0, 43.5));
        }
    }

    #[test]
    fn averages_of_parts_make_the_average_of_the_whole() {
        let tail = Tail::new(30.0, &[0.3, -0.2, 0.1, 0.05, -0.01]);
        let parts: f64 = (0..8)
            .map(|i| tail.average(30.0 + f64::from(i), 31.0 + f64::from(i)))
            .sum();
        assert!((parts / 8.0 - tail.average(30.0, 38.0)).abs() < 1e-13);
    }
}
