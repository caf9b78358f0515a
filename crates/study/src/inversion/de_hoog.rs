//! De Hoog, Knight and Stokes (1982): Durbin's series as a continued fraction by the quotient-difference scheme.

use super::Window;
use num_complex::Complex64;

/// The continued fraction of the samples of a transform, which serves every time of the window.
#[derive(Debug, Clone)]
pub struct DeHoog {
    window: Window,
    coefficients: Vec<Complex64>,
}

impl DeHoog {
    /// From an odd number of samples.
    #[must_use]
    pub fn new(window: &Window, samples: &[Complex64]) -> Self {
        Self {
            window: *window,
            coefficients: fraction(samples),
        }
    }

    /// f(t), with the remainder estimate of the authors.
    #[must_use]
    pub fn at(&self, t: f64) -> f64 {
        let (window, coefficients) = (&self.window, &self.coefficients);
        let z = Complex64::from_polar(1.0, std::f64::consts::PI * t / window.half_period);
        let last = coefficients.len() - 1;
        let one = Complex64::new(1.0, 0.0);
        let (mut a0, mut a1) = (Complex64::default(), coefficients[0]);
        let (mut b0, mut b1) = (one, one);
        for &d in &coefficients[1..last] {
            (a0, a1) = (a1, a1 + d * z * a0);
            (b0, b1) = (b1, b1 + d * z * b0);
        }
        let half = 0.5 * (one + (coefficients[last - 1] - coefficients[last]) * z);
        let rest = -half * (one - (one + coefficients[last] * z / (half * half)).sqrt());
        let (a, b) = (a1 + rest * a0, b1 + rest * b0);
        (window.damping * t).exp() / window.half_period * (a / b).re
    }
}

/// Coefficients d_0 .. d_2M of the fraction d_0/(1 + d_1 z/(1 + d_2 z/ ...)).
fn fraction(samples: &[Complex64]) -> Vec<Complex64> {
    let count = samples.len() - (1 - samples.len() % 2);
    let order = count / 2;
    let term = |k: usize| if k == 0 { 0.5 * samples[0] } else { samples[k] };
    let mut q: Vec<Complex64> = (0..2 * order).map(|k| term(k + 1) / term(k)).collect();
    let mut e = vec![Complex64::default(); count];
    let mut d = vec![term(0), -q[0]];
    for column in 1..=order {
        for i in 0..2 * (order - column) + 1 {
            e[i] = q[i + 1] - q[i] + e[i + 1];
        }
        d.push(-e[0]);
        if column < order {
            for i in 0..2 * (order - column) {
                q[i] = q[i + 1] * e[i + 1] / e[i];
            }
            d.push(-q[0]);
        }
    }
    d
}
