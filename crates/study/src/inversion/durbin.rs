//! Durbin's Fourier series: Dubner and Abate (1968), Durbin (1974).

use super::Window;
use num_complex::Complex64;

/// f(t) from the samples of a transform; the tail of the series is cut off.
#[must_use]
pub fn durbin(window: &Window, samples: &[Complex64], t: f64) -> f64 {
    let turn = Complex64::from_polar(1.0, std::f64::consts::PI * t / window.half_period);
    // Horner from the last term
    let sum = samples
        .iter()
        .skip(1)
        .rev()
        .fold(Complex64::default(), |sum, &sample| (sum + sample) * turn);
    let first = samples.first().map_or(0.0, |f| 0.5 * f.re);
    (window.damping * t).exp() / window.half_period * (first + sum.re)
}
