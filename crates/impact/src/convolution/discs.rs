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

use crate::face::Share;
use halfspace::lagrange;
use std::f64::consts::PI;

/// Squares of some radii over that of the largest, with their polynomials.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Discs {
    /// Squares of the radii, the largest first, then those farthest from the ones before.
    squares: Vec<f64>,
    /// Their roots.
    pub(crate) radii: Vec<f64>,
    /// Shares of the force on each, where they are prescribed.
    prescribed: Option<Vec<Share>>,
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
        Self {
            squares,
            radii,
            prescribed: None,
        }
    }

    /// Discs of some radii over the largest of the load, each with a share of the force.
    pub(crate) fn with_shares(radii: &[f64], shares: &[Share]) -> Self {
        Self {
            prescribed: Some(shares.to_vec()),
            ..Self::of(radii.iter().map(|radius| radius * radius).collect())
        }
    }

    /// Whether their shares of the force are prescribed, and stand for all of the load.
    pub(crate) fn are_prescribed(&self) -> bool {
        self.prescribed.is_some()
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.radii.len()
    }

    /// How many functions of the squared radius the shares are made of: Newton's polynomials, or the powers of prescribed shares.
    pub(crate) fn orders(&self) -> usize {
        let Some(shares) = &self.prescribed else {
            return self.count();
        };
        let power = |share: &Share| share.iter().rposition(|own| *own != 0.0).unwrap_or(0);
        1 + shares.iter().map(power).max().unwrap_or(0)
    }

    /// The smallest radius over the largest.
    pub(crate) fn smallest(&self) -> f64 {
        self.radii.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Newton's polynomial of degree `j` at a square; of degree [`Self::count`] it is that of the term left out. The power `j` for
    /// prescribed shares.
    pub(crate) fn newton(&self, j: usize, square: f64) -> f64 {
        if self.are_prescribed() {
            return square.powi(j as i32);
        }
        self.squares[..j].iter().map(|own| square - own).product()
    }

    /// The same with its slope.
    pub(crate) fn newton_with_slope(&self, j: usize, square: f64) -> [f64; 2] {
        if self.are_prescribed() {
            let slope = j
                .checked_sub(1)
                .map_or(0.0, |below| j as f64 * square.powi(below as i32));
            return [square.powi(j as i32), slope];
        }
        let times = |[value, slope]: [f64; 2], own: &f64| {
            [value * (square - own), slope * (square - own) + value]
        };
        self.squares[..j].iter().fold([1.0, 0.0], times)
    }

    /// Weight of disc `k` in the divided difference of order `j`, or its coefficient in a prescribed share.
    pub(crate) fn weight(&self, j: usize, k: usize) -> f64 {
        if let Some(shares) = &self.prescribed {
            return shares[k][j];
        }
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
        if self.are_prescribed() {
            let terms = (0..self.orders()).map(|j| self.newton(j, square) * self.weight(j, k));
            return terms.sum();
        }
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
    fn prescribed_shares_are_kept() {
        let shares = [[-0.1, 0.2, 0.0], [0.3, -0.1, 0.05], [0.8, -0.1, -0.05]];
        let discs = Discs::with_shares(&[4.0, 7.5, 9.0], &shares);
        assert_eq!(discs.smallest(), 4.0);
        assert_eq!(discs.orders(), 3);
        for square in [0.0, 0.5, 1.0] {
            for (k, [a, b, c]) in shares.into_iter().enumerate() {
                let wanted = a + b * square + c * square * square;
                assert!((discs.share(k, square) - wanted).abs() < 1e-12);
            }
            for j in 0..3 {
                let [value, slope] = discs.newton_with_slope(j, square);
                assert_eq!(value, discs.newton(j, square));
                let beside = discs.newton(j, square + 1e-6);
                assert!((beside - value - 1e-6 * slope).abs() < 1e-11);
            }
        }
        let constant = shares.map(|[own, ..]| [own, 0.0, 0.0]);
        assert_eq!(Discs::with_shares(&[4.0, 7.5, 9.0], &constant).orders(), 1);
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
