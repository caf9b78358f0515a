//! Functions of time as Chebyshev series on the panels of a zone.

use super::zone::{Zone, panel_ends, panel_of};
use std::f64::consts::{FRAC_PI_2, PI};

/// A function of the angle of a zone: one Chebyshev series a panel.
#[derive(Debug, Clone)]
pub(super) struct Curve {
    pub(super) series: Vec<Vec<f64>>,
}

impl Curve {
    pub(super) const TERMS: usize = 24;

    /// Fits f(panel, angle).
    pub(super) fn fit(zone: Zone, f: impl Fn(usize, f64) -> f64) -> Self {
        let n = Self::TERMS;
        let cosine = |i: usize, k: usize| (PI * k as f64 * (i as f64 + 0.5) / n as f64).cos();
        let series = panel_ends(zone)
            .windows(2)
            .enumerate()
            .map(|(panel, ends)| {
                let (mid, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
                let values: Vec<f64> = (0..n)
                    .map(|i| f(panel, mid + half * cosine(i, 1)))
                    .collect();
                let mut coefficients: Vec<f64> = (0..n)
                    .map(|k| {
                        let sum: f64 = values
                            .iter()
                            .enumerate()
                            .map(|(i, v)| v * cosine(i, k))
                            .sum();
                        sum * if k == 0 { 1.0 } else { 2.0 } / n as f64
                    })
                    .collect();
                let size = coefficients[0].abs();
                while coefficients.len() > 2
                    && coefficients.last().is_some_and(|c| c.abs() < 1e-17 * size)
                {
                    coefficients.pop();
                }
                coefficients
            })
            .collect();
        Self { series }
    }

    /// Clenshaw's sum on the panel that holds the angle.
    pub(super) fn value(&self, zone: Zone, angle: f64) -> f64 {
        let (panel, from, to) = panel_of(zone, angle / FRAC_PI_2);
        let u = (2.0 * angle / FRAC_PI_2 - from - to) / (to - from);
        let coefficients = &self.series[panel];
        let (mut b1, mut b2) = (0.0, 0.0);
        for &c in coefficients[1..].iter().rev() {
            (b1, b2) = (2.0 * u * b1 - b2 + c, b1);
        }
        u * b1 - b2 + coefficients[0]
    }
}
