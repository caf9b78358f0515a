//! Discs of fixed radii whose Hertz pressures stand for one with a radius that follows the load.
//!
//! A pressure of unit force and radius a has the transform 3 j1(ka)/(ka), even in a: a polynomial in a^2 through its values
//! at some radii a_k is as good as waves are long beside their spacing,
//!
//! ```text
//! p(r, t) = P(t) H_a(t)(r) = sum_k P(t) phi_k(a(t)^2) H_k(r),        phi_k the Lagrange polynomials of the nodes a_k^2
//! ```
//!
//! so that the waves under a growing contact are those of a few discs, each with a force of its own. The static field needs
//! none of it: it is that of the radius of the instant.
//!
//! Beside the load the nodes are Chebyshev's. Some radii away from it waves are long beside the contact but in its first and
//! last instants, when it is small: there a disc that is nearly a point stands for these, and one to three for the rest.
//!
//! Theory: `docs/theory.md` (T60).

use crate::excitation::PressureRadius;
use halfspace::lagrange;
use std::f64::consts::PI;

/// Radii over the largest, with the polynomials that share the load out.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Discs {
    /// Radii over the largest, the largest of them first.
    pub(crate) radii: Vec<f64>,
    /// Smallest square of a radius that the nodes cover.
    least: f64,
    /// Where discs stand for the load away from it, what each counts in what they leave: in the next term of the series in
    /// the square of the radius over the length of waves, of which Rayleigh's are the shortest. That is the divided difference
    /// of the discs' kernels, times (a_max/c_R)^2 d^2/dt^2 of the load times the product of a^2 less the square of each
    /// radius. Empty where their highest power tells.
    pub(crate) omitted: Vec<f64>,
}

/// Squares of the radii some radii away from the load, and how many of them the choices have: most are small, since where
/// the contact is large waves are long.
const APART: [f64; 4] = [0.4, 0.0015, 0.9, 0.15];
const COUNTS_APART: [usize; 3] = [2, 3, 4];

/// Digits up to which these serve.
const DIGITS_APART: f64 = 5.0;

/// Terms of 3 j1(ka)/(ka) over those before, some radii away as many times as in the first instants, when waves are short, a
/// front may bring.
const OMITTED: [f64; 4] = [1.0 / 10.0, 1.0 / 28.0, 1.0 / 54.0, 1.0 / 88.0];
const CAUTION: f64 = 6.0;

/// Tolerance of the kernels of discs over that of the fields: small where the discs' differences tell what is left, large
/// some radii away, where what kernels leave is mostly in short times. Series of the fewest terms say little of what they
/// leave: none is coarser than some part of the peak.
const OF_DIFFERENCES: f64 = 0.03;
const OF_APART: f64 = 4.0;
pub(crate) const COARSEST: f64 = 3e-3;

/// Discs for each digit of the tolerance where kernels are computed: more of them near the load.
const A_DIGIT: [f64; 4] = [0.75, 2.0, 4.0, 8.0];

/// Discs where kernels are looked up, and the smallest radius that they cover over the largest: the farther a point, the
/// fewer small discs the table has for it.
const LOOKED_UP: usize = 4;
const COVERED: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

impl Discs {
    /// Those for kernels that are computed, the fewest first: some radii away from the load, and beside it or far away.
    pub(crate) fn computed(radius: PressureRadius, tolerance: f64) -> Vec<Self> {
        if let PressureRadius::Fixed(_) = radius {
            return vec![Self::following(1, 1.0)];
        }
        let digits = (-tolerance.log10()).clamp(2.0, 8.0);
        let apart = COUNTS_APART.into_iter().filter(|_| digits <= DIGITS_APART);
        let beside = A_DIGIT.map(|a_digit| (a_digit * digits).round() as usize);
        let beside = beside.map(|count| Self::following(count, 0.0));
        apart.map(Self::apart).chain(beside).collect()
    }

    /// Those for kernels that are looked up, the smallest radii first.
    pub(crate) fn looked_up(radius: PressureRadius) -> Vec<Self> {
        let mut choices = vec![Self::following(1, 1.0)];
        if let PressureRadius::Following { .. } = radius {
            let smaller = COVERED.map(|smallest| Self::following(LOOKED_UP, smallest));
            choices.splice(0..0, smaller);
        }
        choices
    }

    /// The smallest radius over the largest.
    pub(crate) fn smallest(&self) -> f64 {
        self.radii.iter().copied().fold(1.0, f64::min)
    }

    /// Those that stand for the load some radii away from it.
    fn apart(count: usize) -> Self {
        let squares = &APART[..count];
        let of = |own: &f64| {
            let others = squares.iter().filter(|other| *other != own);
            let difference: f64 = others.map(|other| own - other).product();
            CAUTION * OMITTED[count - 1] / difference
        };
        Self {
            radii: squares.iter().map(|square| square.sqrt()).collect(),
            least: 0.0,
            omitted: squares.iter().map(of).collect(),
        }
    }

    /// Tolerance of the kernels of the discs for one on the fields.
    pub(crate) fn tolerance(&self, fields: f64) -> f64 {
        let part = match self.omitted.len() {
            0 => OF_DIFFERENCES,
            1 => 1.0,
            _ => OF_APART,
        };
        (part * fields).min(COARSEST)
    }

    /// Whether they stand for the load some radii away from it.
    pub(crate) fn is_apart(&self) -> bool {
        self.omitted.len() > 1
    }

    /// The product of a^2 less the square of each radius.
    pub(crate) fn product(&self, square: f64) -> f64 {
        self.radii.iter().map(|b| square - b * b).product()
    }

    /// Chebyshev's nodes for the squares of radii from `smallest` of the largest up; one from the largest takes all.
    pub(crate) fn following(count: usize, smallest: f64) -> Self {
        let least = smallest * smallest;
        let radii = (0..count).map(|k| {
            let x = (PI * (2 * k + 1) as f64 / (2 * count) as f64).cos();
            (0.5 * ((1.0 + least) + (1.0 - least) * x)).sqrt()
        });
        Self {
            radii: radii.collect(),
            least,
            omitted: if count == 1 {
                vec![OMITTED[0]]
            } else {
                Vec::new()
            },
        }
    }

    /// Chebyshev's polynomials of the squared radius at `square` of the largest, one for each disc: the load that each of
    /// them multiplies acts on the kernels of [`Self::kernel`].
    pub(crate) fn polynomial(&self, j: usize, square: f64) -> f64 {
        match self.radii.len() {
            1 => 1.0,
            _ => chebyshev(j, (2.0 * square - 1.0 - self.least) / (1.0 - self.least)),
        }
    }

    /// What disc `k` counts in the kernel on which polynomial `j` of the load acts,
    ///
    /// ```text
    /// sum_k share_k R_k = sum_j T_j D_j,     D_0 = sum_k R_k / N,     D_j = 2 sum_k T_j(node_k) R_k / N
    /// ```
    ///
    /// D_j is a difference of order j of the kernels and small where waves are long beside the radii, while shares of
    /// loads that are smaller than the smallest disc are large and cancel.
    pub(crate) fn kernel(&self, j: usize, k: usize) -> f64 {
        let count = self.radii.len();
        let node = (PI * (2 * k + 1) as f64 / (2 * count) as f64).cos();
        let twice = if j == 0 { 1.0 } else { 2.0 };
        twice * chebyshev(j, node) / count as f64
    }

    /// The share of disc `k` of a load that has `square` of the largest radius squared, and the part of it that the
    /// highest power brings.
    pub(crate) fn share(&self, k: usize, square: f64) -> [f64; 2] {
        let count = self.radii.len();
        if count == 1 {
            return [1.0, 0.0];
        }
        if self.is_apart() {
            let own = |j: usize| self.radii[j] * self.radii[j];
            return [lagrange(own, count, k, square), 0.0];
        }
        let x = (2.0 * square - 1.0 - self.least) / (1.0 - self.least);
        let node = (PI * (2 * k + 1) as f64 / (2 * count) as f64).cos();
        let ([mut a, mut b], [mut c, mut d]) = ([1.0, x], [1.0, node]);
        let (mut all, mut last) = (1.0, 0.0);
        for j in 1..count {
            let term = 2.0 * b * d;
            all += term;
            if j + 1 == count {
                last = term;
            }
            (a, b) = (b, 2.0 * x * b - a);
            (c, d) = (d, 2.0 * node * d - c);
        }
        [all, last].map(|sum| sum / count as f64)
    }
}

/// Chebyshev's polynomial of degree j at any x.
fn chebyshev(j: usize, x: f64) -> f64 {
    let (mut before, mut own) = (1.0, x);
    for _ in 0..j {
        (before, own) = (own, 2.0 * x * own - before);
    }
    before
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_on_differences_of_kernels_are_shares_of_kernels() {
        for (count, smallest) in [(1, 1.0), (3, 0.0), (4, 0.5)] {
            let discs = Discs::following(count, smallest);
            // extrapolated to small loads, too
            for square in [0.0, 0.04, 0.3, 1.0] {
                for k in 0..count {
                    let terms =
                        (0..count).map(|j| discs.polynomial(j, square) * discs.kernel(j, k));
                    let sum: f64 = terms.sum();
                    assert!(
                        (sum - discs.share(k, square)[0]).abs() < 1e-11,
                        "{count} {square}"
                    );
                }
            }
        }
    }

    #[test]
    fn shares_reproduce_powers_of_the_squared_radius() {
        for count in COUNTS_APART {
            let discs = Discs::apart(count);
            for square in [0.0, 0.1, 0.63, 1.0] {
                let sum: f64 = (0..count)
                    .map(|k| discs.share(k, square)[0] * discs.radii[k].powi(2))
                    .sum();
                assert!((sum - square).abs() < 1e-12, "{count} {square}");
            }
        }
        for (count, smallest) in [(1, 1.0), (2, 0.5), (6, 0.0), (9, 0.2)] {
            let discs = if count == 1 {
                Discs::following(1, 1.0)
            } else {
                Discs::following(count, smallest)
            };
            for square in [0.0, 0.1, 0.63, 1.0, 1.01] {
                for power in 0..count as i32 {
                    let sum: f64 = (0..count)
                        .map(|k| discs.share(k, square)[0] * discs.radii[k].powi(2 * power))
                        .sum();
                    assert!(
                        (sum - f64::powi(square, power)).abs() < 1e-9,
                        "{count} {square} {power}"
                    );
                }
            }
        }
    }
}
