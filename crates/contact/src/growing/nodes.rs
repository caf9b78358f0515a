//! Polynomials on a piece and collocation at Radau's nodes: the matrices of a degree n, made once for each n.

use crate::numeric::gauss::radau;
use crate::numeric::linear::dot;
use halfspace::{gauss, lagrange};
use std::sync::OnceLock;

/// A polynomial in s on [0, 1], in powers of 2 s - 1.
///
/// The coefficients of a function that a piece resolves fall faster than these powers lose digits.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Polynomial {
    /// Degree.
    pub(crate) degree: usize,
    /// Coefficients of the powers.
    pub(crate) powers: [f64; SIZE],
}

impl Polynomial {
    /// The constant.
    pub(crate) fn constant(value: f64) -> Self {
        let mut powers = [0.0; SIZE];
        powers[0] = value;
        Self { degree: 0, powers }
    }

    /// (from + rise s)^power
    pub(crate) fn power(from: f64, rise: f64, power: usize) -> Self {
        let (middle, half) = (from + 0.5 * rise, 0.5 * rise);
        let mut found = Self::constant(1.0);
        for degree in 1..=power {
            for k in (0..=degree).rev() {
                let below = if k > 0 { found.powers[k - 1] } else { 0.0 };
                found.powers[k] = middle * found.powers[k] + half * below;
            }
            found.degree = degree;
        }
        found
    }

    /// constant - self
    pub(crate) fn below(mut self, constant: f64) -> Self {
        for power in &mut self.powers {
            *power = -*power;
        }
        self.powers[0] += constant;
        self
    }

    /// Value at s.
    pub(crate) fn value(&self, s: f64) -> f64 {
        self.jet(s)[0]
    }

    /// Value, slope and curvature.
    pub(crate) fn jet(&self, s: f64) -> [f64; 3] {
        self.jets(&[s]).map(|[one]| one)
    }

    /// The same at several places together; inlined, so that unused slopes cost nothing.
    #[inline]
    pub(crate) fn jets<const N: usize>(&self, places: &[f64; N]) -> [[f64; N]; 3] {
        let x = places.map(|s| 2.0 * s - 1.0);
        let [mut value, mut slope, mut half] = [[0.0; N]; 3];
        for c in self.powers[..=self.degree].iter().rev() {
            for l in 0..N {
                half[l] = half[l] * x[l] + slope[l];
                slope[l] = slope[l] * x[l] + value[l];
                value[l] = value[l] * x[l] + c;
            }
        }
        [value, slope.map(|s| 2.0 * s), half.map(|h| 8.0 * h)]
    }
}

/// Largest degree of a piece.
pub(crate) const LARGEST_DEGREE: usize = 16;

/// Values at 0 and the nodes of such a piece.
pub(crate) const SIZE: usize = LARGEST_DEGREE + 1;

/// Matrices of the polynomials of degree n through 0 and the n nodes of Radau's rule on (0, 1], or of those of a degree more
/// that have no slope at 0.
#[derive(Debug)]
pub(crate) struct RadauNodes {
    /// Number of nodes n; the degree is [`Self::order`].
    pub(crate) degree: usize,
    /// Whether they have no slope at 0.
    flat: bool,
    /// 0 and the nodes.
    pub(crate) places: Vec<f64>,
    /// Row i: slope with respect to s at the place i from the values at 0 and the nodes.
    pub(crate) slope: Vec<Vec<f64>>,
    /// Row i: weights of the nodes in the integral from 0 to the place i; to the last one, exact to degree 2 n - 2.
    pub(crate) integral: Vec<Vec<f64>>,
    /// Legendre coefficients from the values at 0 and the nodes.
    modes: Vec<Vec<f64>>,
    /// Coefficients of the powers of 2 s - 1 from those of Legendre's polynomials.
    powers: Vec<Vec<f64>>,
    /// Barycentric weights of 0 and the nodes.
    barycentric: Vec<f64>,
}

impl RadauNodes {
    /// The nodes of a degree in [2, `LARGEST_DEGREE`], of polynomials that have no slope at 0 or may have one.
    pub(crate) fn of(degree: usize, flat: bool) -> &'static Self {
        static ALL: [[OnceLock<RadauNodes>; SIZE]; 2] =
            [const { [const { OnceLock::new() }; SIZE] }; 2];
        let degree = degree.clamp(2, LARGEST_DEGREE - usize::from(flat));
        ALL[usize::from(flat)][degree].get_or_init(|| Self::new(degree, flat))
    }

    /// Degree of the polynomials.
    pub(crate) fn order(&self) -> usize {
        self.degree + usize::from(self.flat)
    }

    fn new(n: usize, flat: bool) -> Self {
        let order = n + usize::from(flat);
        let places: Vec<f64> = [0.0].into_iter().chain(radau(n)).collect();
        let others = |i: usize| (0..=n).filter(move |&j| j != i);
        let weight = |i: usize| {
            let distances = others(i).map(|j| 2.0 * (places[i] - places[j]));
            1.0 / distances.product::<f64>()
        };
        let barycentric: Vec<f64> = (0..=n).map(weight).collect();
        let slope = |i: usize| {
            let mut row = vec![0.0; n + 1];
            for j in others(i) {
                row[j] = barycentric[j] / barycentric[i] / (places[i] - places[j]);
            }
            row[i] = -row.iter().sum::<f64>();
            if flat && i > 0 {
                // of s/s_j times the polynomial of a node
                for j in 1..=n {
                    row[j] *= places[i] / places[j];
                }
                row[i] += 1.0 / places[i];
                row[0] = -row[1..].iter().sum::<f64>();
            }
            row
        };
        // the rule is exact for the polynomials through the nodes times those of the same degree
        let rule = gauss::rule(order + 1);
        let integral = |i: usize, j: usize| {
            let parts = rule.on(0.0, places[i]);
            parts
                .map(|(x, weight)| weight * lagrange(|k| places[k + 1], n, j, x))
                .sum()
        };
        let basis = |j: usize, s: f64| {
            let plain = |j| lagrange(|k| places[k], n + 1, j, s);
            let risen = |j: usize| plain(j) * s / places[j];
            match (flat, j) {
                (false, _) => plain(j),
                (true, 0) => 1.0 - (1..=n).map(risen).sum::<f64>(),
                (true, _) => risen(j),
            }
        };
        let mode = |k: usize, j: usize| {
            let part = |(s, weight): (f64, f64)| {
                let (value, _) = gauss::legendre(k, 2.0 * s - 1.0);
                (2 * k + 1) as f64 * weight * value * basis(j, s)
            };
            rule.on(0.0, 1.0).map(part).sum()
        };
        Self {
            degree: n,
            flat,
            slope: (0..=n).map(slope).collect(),
            integral: matrix([n + 1, n], integral),
            modes: matrix([order + 1, n + 1], mode),
            powers: powers(order),
            barycentric,
            places,
        }
    }

    /// Legendre coefficients of values at 0 and the nodes.
    pub(crate) fn modes(&self, values: &[f64]) -> [f64; SIZE] {
        let mut modes = [0.0; SIZE];
        for (mode, row) in modes.iter_mut().zip(&self.modes) {
            *mode = dot(row, values);
        }
        modes
    }

    /// The polynomial of values at 0 and the nodes.
    pub(crate) fn polynomial(&self, values: &[f64]) -> Polynomial {
        let modes = self.modes(values);
        let mut found = Polynomial::constant(0.0);
        found.degree = self.order();
        for (k, row) in self.powers.iter().enumerate() {
            found.powers[k] = dot(&row[k..], &modes[k..]);
        }
        found
    }

    /// Values of Lagrange's polynomials at s; not at a node.
    pub(crate) fn lagrange(&self, s: f64, values: &mut [f64]) {
        let values = &mut values[..=self.degree];
        let parts = self.barycentric.iter().zip(&self.places);
        for (value, (weight, place)) in values.iter_mut().zip(parts) {
            let distance = s - place;
            *value = if distance == 0.0 {
                1e300
            } else {
                weight / distance
            };
        }
        let sum: f64 = values.iter().sum();
        values.iter_mut().for_each(|value| *value /= sum);
        if self.flat {
            for (value, place) in values.iter_mut().zip(&self.places).skip(1) {
                *value *= s / place;
            }
            values[0] = 1.0 - values[1..].iter().sum::<f64>();
        }
    }
}

/// A matrix by rows.
fn matrix([rows, columns]: [usize; 2], entry: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
    let row = |i| (0..columns).map(|j| entry(i, j)).collect();
    (0..rows).map(row).collect()
}

/// Row k: coefficients of x^k in the Legendre polynomials of degree 0 to n > 0.
fn powers(n: usize) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; n + 1]; n + 1];
    (rows[0][0], rows[1][1]) = (1.0, 1.0);
    for degree in 2..=n {
        let d = degree as f64;
        for k in 0..=degree {
            let up = if k > 0 { rows[k - 1][degree - 1] } else { 0.0 };
            rows[k][degree] = ((2.0 * d - 1.0) * up - (d - 1.0) * rows[k][degree - 2]) / d;
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_is_met_with_its_slope_and_integral() {
        for n in 2..=LARGEST_DEGREE {
            let nodes = RadauNodes::of(n, false);
            let f = |s: f64| 1.0 / (2.0 + s);
            let values: Vec<f64> = nodes.places.iter().map(|&s| f(s)).collect();
            let found = nodes.polynomial(&values);
            let error = 4.0 * 9.9_f64.powi(-(n as i32)) + 1e-13;
            for s in [0.0, 0.013, 0.2, 0.77, 1.0] {
                let [value, slope, _] = found.jet(s);
                assert!((value - f(s)).abs() < error, "{n}");
                assert_eq!(value, found.value(s));
                assert!((slope + f(s).powi(2)).abs() < 100.0 * error, "{n}");
                let mut basis = [0.0; SIZE];
                nodes.lagrange(s, &mut basis);
                assert!((dot(&basis, &values) - value).abs() < 1e-13);
            }
            let rows = (1..=n).map(|i| (i, &nodes.slope[i], &nodes.integral[i]));
            for (i, slope, integral) in rows {
                let s = nodes.places[i];
                let found = found.jet(s)[1];
                assert!((dot(slope, &values) - found).abs() < 1e-11, "{n} {i}");
                let exact = ((2.0 + s) / 2.0).ln();
                assert!(
                    (dot(integral, &values[1..]) - exact).abs() < error,
                    "{n} {i}"
                );
            }
        }
    }

    #[test]
    fn a_polynomial_without_a_slope_at_its_start_is_met() {
        for n in 3..LARGEST_DEGREE {
            let nodes = RadauNodes::of(n, true);
            let f = |s: f64| 1.0 / (2.0 + s * s);
            let values: Vec<f64> = nodes.places.iter().map(|&s| f(s)).collect();
            let found = nodes.polynomial(&values);
            let error = 4.0 * 2.5_f64.powi(-(n as i32)) + 1e-12;
            for s in [0.0, 0.013, 0.2, 0.77, 1.0] {
                let [value, slope, _] = found.jet(s);
                assert!((value - f(s)).abs() < error, "{n} {s}");
                assert!((slope + 2.0 * s * f(s).powi(2)).abs() < 100.0 * error);
                let mut basis = [0.0; SIZE];
                nodes.lagrange(s, &mut basis);
                assert!((dot(&basis, &values) - value).abs() < 1e-12, "{n} {s}");
            }
            assert!(found.jet(0.0)[1].abs() < 1e-10);
            for i in 1..=n {
                let found = found.jet(nodes.places[i])[1];
                assert!(
                    (dot(&nodes.slope[i], &values) - found).abs() < 1e-10,
                    "{n} {i}"
                );
            }
        }
    }

    #[test]
    fn powers_of_a_line() {
        let found = Polynomial::power(0.3, -0.2, 2).below(1.0);
        for s in [0.0, 0.2, 0.9, 1.0] {
            let [value, slope, bend] = found.jet(s);
            assert!((value - 1.0 + (0.3 - 0.2 * s) * (0.3 - 0.2 * s)).abs() < 1e-15);
            assert!((slope - 0.4 * (0.3 - 0.2 * s)).abs() < 1e-15);
            let [values, slopes, _] = found.jets(&[s, 0.5]);
            assert_eq!((values[0], slopes[0]), (value, slope));
            assert_eq!(found.value(s), value);
            assert!((bend + 0.08).abs() < 1e-15);
        }
    }
}
