//! A wave field to draw: wavelets that spread from the surface at the speeds of P, S and Rayleigh waves.

use std::f64::consts::PI;

/// Wave speeds in m/s.
pub(crate) const SPEEDS: [f64; 3] = [5950.0, 3240.0, 3000.0];

/// Ricker's wavelet of a frequency in Hz.
fn ricker(t: f64, frequency: f64) -> f64 {
    let x = (PI * frequency * t).powi(2);
    (1.0 - 2.0 * x) * (-x).exp()
}

/// Vertical velocity in m/s at (r, z) in m and a time in s.
pub(crate) fn velocity(r: f64, z: f64, t: f64) -> f64 {
    const FREQUENCY: f64 = 400e3;
    let distance = r.hypot(z).max(2e-3);
    let cosine = z / distance;
    let [p, s, rayleigh] = SPEEDS.map(|c| ricker(t - 2.5e-6 - distance / c, FREQUENCY));
    let depth = (-z / 5e-3).exp();
    let body = 0.02 * (cosine * p + 0.8 * (1.0 - cosine * cosine) * s) / distance * 2e-3;
    body + 0.012 * rayleigh * depth * (2e-3 / distance).sqrt()
}

/// A half-sine to the power 3/2, as the force of a contact.
pub(crate) fn pulse(t: f64, length: f64) -> f64 {
    if (0.0..=length).contains(&t) {
        (PI * t / length).sin().max(0.0).powf(1.5)
    } else {
        0.0
    }
}

/// `count` even numbers from `low` to `high`.
pub(crate) fn even(low: f64, high: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|i| low + (high - low) * i as f64 / (count - 1) as f64)
        .collect()
}
