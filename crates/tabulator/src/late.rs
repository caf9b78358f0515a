//! The decay after the last arrival: one Chebyshev series in 1/t for the integral of R.

use crate::error::BuildError;
use halfspace::{Kernel, Six};
use lookup::chebyshev;
use std::f64::consts::PI;

/// S(t) = int R dt for t >= `from`, as a Chebyshev series in 1/t on [0, 1/from].
///
/// R vanishes like 1/t^2, so that S is smooth in 1/t down to 0, where it is the constant that all of R
/// adds up to. The nearest singularity is the last arrival.
#[derive(Debug, Clone)]
pub(crate) struct Late {
    from: f64,
    /// Field by field.
    coefficients: [[f64; Self::TERMS]; 6],
}

impl Late {
    const TERMS: usize = 22;
    /// The series starts at this multiple of the last arrival: its terms fall by 2.4 each.
    pub(crate) const START: f64 = 1.2;

    /// The series at (r, z) from `from` on.
    pub(crate) fn new(kernel: &Kernel, r: f64, z: f64, from: f64) -> Result<Self, BuildError> {
        let mut samples = [[0.0; Self::TERMS]; 6];
        for i in 0..Self::TERMS {
            let value = kernel
                .step_integral(r, z, from / node(i, Self::TERMS))?
                .value;
            for (list, x) in samples.iter_mut().zip(value) {
                list[i] = x;
            }
        }
        let coefficients = samples.map(|list| {
            let mut coefficients = [0.0; Self::TERMS];
            transform(&list, &mut coefficients);
            coefficients
        });
        Ok(Self { from, coefficients })
    }

    /// S(t).
    pub(crate) fn integral(&self, t: f64) -> Six {
        let u = self.from / t;
        std::array::from_fn(|f| chebyshev(&self.coefficients[f], u))
    }

    /// Coefficients c_k of the tail R = u^2 sum_k c_k T_k(2u - 1), u = `end`/t, for `end` >= `from`.
    pub(crate) fn tail(&self, end: f64, terms: usize) -> Vec<Six> {
        let mut tail = vec![[0.0; 6]; terms];
        // R = -x^2 dS/dx with x = 1/t.
        let scale = -2.0 * self.from / (end * end);
        for (f, coefficients) in self.coefficients.iter().enumerate() {
            let slope = derivative(coefficients);
            let samples: Vec<f64> = (0..terms)
                .map(|i| scale * chebyshev(&slope, self.from / end * node(i, terms)))
                .collect();
            let mut column = vec![0.0; terms];
            transform(&samples, &mut column);
            for (six, c) in tail.iter_mut().zip(column) {
                six[f] = c;
            }
        }
        tail
    }
}

/// Chebyshev point `i` of `count` on [0, 1].
fn node(i: usize, count: usize) -> f64 {
    0.5 * (1.0 + (PI * (i as f64 + 0.5) / count as f64).cos())
}

/// Coefficients of the interpolant through `samples` at the points of [`node`].
fn transform(samples: &[f64], coefficients: &mut [f64]) {
    let count = samples.len() as f64;
    for (k, c) in coefficients.iter_mut().enumerate() {
        let factor = if k == 0 { 1.0 } else { 2.0 } / count;
        *c = factor
            * samples
                .iter()
                .enumerate()
                .map(|(i, v)| v * (PI * k as f64 * (i as f64 + 0.5) / count).cos())
                .sum::<f64>();
    }
}

/// d/dy of sum_k c_k T_k(y).
fn derivative(coefficients: &[f64]) -> Vec<f64> {
    let mut slope = vec![0.0; coefficients.len() + 1];
    for k in (1..coefficients.len()).rev() {
        slope[k - 1] = slope[k + 1] + 2.0 * k as f64 * coefficients[k];
    }
    slope[0] *= 0.5;
    slope.truncate(coefficients.len().saturating_sub(1));
    slope
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfspace::{Arrivals, Medium, Profile};

    #[test]
    fn the_derivative_of_a_series_is_that_of_the_polynomial() {
        // T_0 + 2 T_1 + 3 T_2 + 4 T_3 = -2 - 10 y + 6 y^2 + 16 y^3
        let slope = derivative(&[1.0, 2.0, 3.0, 4.0]);
        for y in [-0.9_f64, 0.0, 0.35, 1.0] {
            let exact = -10.0 + 12.0 * y + 48.0 * y * y;
            assert!((chebyshev(&slope, 0.5 * (y + 1.0)) - exact).abs() < 1e-13);
        }
    }

    #[test]
    fn integral_and_tail_agree_with_the_kernels() {
        for nu in [0.0, 0.3, 0.45] {
            let medium = Medium::new(nu).unwrap();
            let kernel = Kernel::new(&medium, Profile::Hertz, 1e-12).unwrap();
            for (r, z) in [(0.0, 0.5), (0.9, 0.0), (1.1, 0.2), (3.0, 4.0), (6.0, 0.1)] {
                let last = Arrivals::new(&medium, Profile::Hertz, r, z).unwrap().last();
                let rest = kernel.static_field(r, z).unwrap();
                let size = rest.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
                let from = Late::START * last;
                let late = Late::new(&kernel, r, z, from).unwrap();
                for t in [from, 1.3 * from, 5.0 * from, 100.0 * from] {
                    let exact = kernel.step_integral(r, z, t).unwrap().value;
                    for (a, b) in late.integral(t).iter().zip(exact) {
                        let error = (a - b).abs() / (size * last);
                        assert!(error < 1e-10, "nu {nu} r {r} z {z} t {t}: {error:.1e}");
                    }
                }
                let end = 1.5 * last;
                let tail = late.tail(end, 12);
                for t in [end, 1.1 * end, 3.0 * end, 50.0 * end] {
                    let exact = kernel.remainder(r, z, t).unwrap().value;
                    let u = end / t;
                    for f in 0..6 {
                        let column: Vec<f64> = tail.iter().map(|six| six[f]).collect();
                        let error = (u * u * chebyshev(&column, u) - exact[f]).abs() / size;
                        assert!(
                            error < 5e-8,
                            "nu {nu} r {r} z {z} t {t} field {f}: {error:.1e}"
                        );
                    }
                }
            }
        }
    }
}
