//! Polynomials on a piece.

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

    /// Values and slopes at some places together.
    pub(crate) fn jets<const N: usize>(&self, places: &[f64; N]) -> [[f64; N]; 2] {
        let x = places.map(|s| 2.0 * s - 1.0);
        let [mut value, mut slope] = [[0.0; N]; 2];
        for c in self.powers[..=self.degree].iter().rev() {
            for l in 0..N {
                slope[l] = slope[l] * x[l] + value[l];
                value[l] = value[l] * x[l] + c;
            }
        }
        [value, slope.map(|s| 2.0 * s)]
    }

    /// Value, slope and curvature.
    pub(crate) fn jet(&self, s: f64) -> [f64; 3] {
        let x = 2.0 * s - 1.0;
        let (mut value, mut slope, mut half) = (0.0, 0.0, 0.0);
        for c in self.powers[..=self.degree].iter().rev() {
            half = half * x + slope;
            slope = slope * x + value;
            value = value * x + c;
        }
        [value, 2.0 * slope, 8.0 * half]
    }
}

/// Largest degree of a piece.
pub(crate) const LARGEST: usize = 16;

/// Values at 0 and the nodes of such a piece.
pub(crate) const SIZE: usize = LARGEST + 1;

/// Scalar product.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_a_line() {
        let found = Polynomial::power(0.3, -0.2, 2).below(1.0);
        for s in [0.0, 0.2, 0.9, 1.0] {
            let [value, slope, bend] = found.jet(s);
            assert!((value - 1.0 + (0.3 - 0.2 * s) * (0.3 - 0.2 * s)).abs() < 1e-15);
            assert!((slope - 0.4 * (0.3 - 0.2 * s)).abs() < 1e-15);
            let [values, slopes] = found.jets(&[s, 0.5]);
            assert_eq!((values[0], slopes[0]), (value, slope));
            assert_eq!(found.value(s), value);
            assert!((bend + 0.08).abs() < 1e-15);
        }
    }
}
