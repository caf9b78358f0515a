//! Discs of fixed radii whose Hertz pressures stand for one whose radius follows the load.
//!
//! A pressure of unit force and radius a has the transform 3 j1(ka)/(ka), which is even in a. A polynomial in a^2 through
//! its values at some radii a_k is therefore as good as waves are long compared with the spacing of the radii:
//!
//! ```text
//! p(r, t) = P(t) H_a(t)(r) = sum_j P(t) n_j(a(t)^2) D_j(r),    n_j(A) = prod_{i<j} (A - A_i),   D_j = H[A_0, .., A_j]
//! ```
//!
//! in Newton's form: D_j is the divided difference of order j of the pressures, and small where waves are long. The waves
//! under a growing contact are those of a few discs, each loaded by a history of its own. The static field needs none of
//! this: it is that of the radius of the instant.
//!
//! The first term that is left out has the load P n_N(A), and for its kernel the leading term of D_N for long waves, of which
//! Rayleigh's are the shortest: a multiple of (a/c_R)^2 d^2/dt^2 D_{N-1}. It is the truncation error that is reported.
//!
//! Theory: `docs/theory.md` (T60).

use halfspace::lagrange;
use std::f64::consts::PI;

/// Squares of some radii over that of the largest, with their polynomials.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Discs {
    /// Squares of the radii, the largest first, then those farthest from the ones before.
    squares: Vec<f64>,
    /// Their roots.
    pub(crate) radii: Vec<f64>,
}

impl Discs {
    /// One disc of a radius alone.
    pub(crate) fn one(radius: f64) -> Self {
        Self::of(vec![radius * radius])
    }

    /// So many discs, two at least, with radii from `smallest` of the largest up: Chebyshev's points of the second kind in the
    /// squares of the radii, both ends among them. A disc that is nearly a point stands for the first and last instants of a
    /// contact, which have the shortest waves.
    pub(crate) fn between(smallest: f64, count: usize) -> Self {
        let least = smallest * smallest;
        let gaps = (count.max(2) - 1) as f64;
        let node = |k: usize| 0.5 * (1.0 + least + (1.0 - least) * (PI * k as f64 / gaps).cos());
        let mut rest: Vec<f64> = (0..count.max(2)).map(node).collect();
        let mut squares = vec![rest.remove(0)];
        // Leja's order, in which Newton's form keeps its digits
        while !rest.is_empty() {
            let apart = |x: &f64| squares.iter().map(|y| (x - y).abs()).product::<f64>();
            let next = (0..rest.len()).max_by(|&i, &j| apart(&rest[i]).total_cmp(&apart(&rest[j])));
            squares.push(rest.remove(next.unwrap_or(0)));
        }
        Self::of(squares)
    }

    fn of(squares: Vec<f64>) -> Self {
        let radii = squares.iter().map(|square| square.sqrt()).collect();
        Self { squares, radii }
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.radii.len()
    }

    /// The smallest radius over the largest.
    pub(crate) fn smallest(&self) -> f64 {
        self.radii.iter().copied().fold(1.0, f64::min)
    }

    /// Newton's polynomial of degree `j` at a square; of degree [`Self::count`] it is that of the term left out.
    pub(crate) fn newton(&self, j: usize, square: f64) -> f64 {
        self.squares[..j].iter().map(|own| square - own).product()
    }

    /// The same with its slope.
    pub(crate) fn newton_with_slope(&self, j: usize, square: f64) -> [f64; 2] {
        let times = |[value, slope]: [f64; 2], own: &f64| {
            [value * (square - own), slope * (square - own) + value]
        };
        self.squares[..j].iter().fold([1.0, 0.0], times)
    }

    /// Weight of disc `k` in the divided difference of order `j`.
    pub(crate) fn weight(&self, j: usize, k: usize) -> f64 {
        if k > j {
            return 0.0;
        }
        let others = self.squares[..=j].iter().enumerate();
        let others = others.filter(|(i, _)| *i != k);
        let product: f64 = others.map(|(_, other)| self.squares[k] - other).product();
        product.recip()
    }

    /// Force on disc `k` over the load, for a load whose radius has this square.
    pub(crate) fn share(&self, k: usize, square: f64) -> f64 {
        lagrange(|i| self.squares[i], self.count(), k, square)
    }

    /// Total variation of the force on disc `k` over that of the load, while this rises to its largest by Hertz's law.
    pub(crate) fn variation(&self, k: usize) -> f64 {
        /// Steps in which it is summed; every share is a polynomial of low degree.
        const STEPS: usize = 64;
        let at = |i: usize| {
            let square = i as f64 / STEPS as f64;
            square.powf(1.5) * self.share(k, square)
        };
        (0..STEPS).map(|i| (at(i + 1) - at(i)).abs()).sum()
    }

    /// Ratio of the kernel of the term left out to (a/c_R)^2 d^2/dt^2 of that of the last one, for long waves: that of the
    /// coefficients of the series of 3 j1(x)/x in x^2.
    pub(crate) fn next(&self) -> f64 {
        let count = self.count() as f64;
        1.0 / (2.0 * count * (2.0 * count + 3.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_reproduce_powers_of_the_squared_radius() {
        let sets = [(0.04, 2), (0.04, 3), (0.5, 2), (0.2, 4), (0.04, 9)];
        let sets = sets.map(|(smallest, count)| Discs::between(smallest, count));
        for discs in sets.into_iter().chain([Discs::one(1.0)]) {
            assert_eq!(discs.radii[0], 1.0);
            for square in [0.0, 0.1, 0.63, 1.0, 1.01] {
                for power in 0..discs.count() as i32 {
                    let each = (0..discs.count())
                        .map(|k| discs.share(k, square) * discs.radii[k].powi(2 * power));
                    let sum: f64 = each.sum();
                    assert!(
                        (sum - f64::powi(square, power)).abs() < 1e-9,
                        "{square} {power}"
                    );
                }
            }
        }
    }

    #[test]
    fn newtons_form_has_the_shares_of_lagranges() {
        for discs in [(0.04, 2), (0.3, 5), (0.04, 9)].map(|(s, count)| Discs::between(s, count)) {
            for square in [0.0, 0.04, 0.3, 1.0] {
                for k in 0..discs.count() {
                    let terms =
                        (0..discs.count()).map(|j| discs.newton(j, square) * discs.weight(j, k));
                    let sum: f64 = terms.sum();
                    assert!((sum - discs.share(k, square)).abs() < 1e-9, "{k} {square}");
                }
            }
        }
    }

    /// 3 j1(x)/x = 1 - x^2/10 + x^4/280 - ..
    #[test]
    fn ratios_of_terms_are_those_of_the_series() {
        let ratios = [Discs::one(1.0), Discs::between(0.1, 2)].map(|d| d.next());
        assert!((ratios[0] - 0.1).abs() < 1e-15 && (ratios[1] - 1.0 / 28.0).abs() < 1e-15);
    }
}
