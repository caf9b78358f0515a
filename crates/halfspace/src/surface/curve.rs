//! Functions of time as Chebyshev series on the panels of a zone.

use super::measure::{Zone, panel_ends, panel_of};
use crate::numeric::polynomial::chebyshev;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::OnceLock;

pub(super) const CURVE_TERMS: usize = 24;

/// Functions of the angle of a zone: Chebyshev series for each panel, fitted at the first use of the panel.
#[derive(Debug, Clone)]
pub(super) struct Curve {
    /// Ends of the panels, as fractions of pi/2.
    ends: Vec<f64>,
    series: Vec<OnceLock<[Vec<f64>; 3]>>,
}

impl Curve {
    pub(super) fn new(zone: Zone) -> Self {
        let ends = panel_ends(zone);
        Self {
            series: vec![OnceLock::new(); ends.len() - 1],
            ends,
        }
    }

    /// Value of one of the functions f(panel, angles); the angles descend.
    pub(super) fn value(
        &self,
        which: usize,
        angle: f64,
        f: impl Fn(usize, &[f64; CURVE_TERMS]) -> [[f64; 3]; CURVE_TERMS],
    ) -> f64 {
        let panel = panel_of(&self.ends, angle / FRAC_PI_2);
        let [from, to] = [self.ends[panel], self.ends[panel + 1]];
        let u = (2.0 * angle / FRAC_PI_2 - from - to) / (to - from);
        let ends = [from, to].map(|fraction| fraction * FRAC_PI_2);
        let series = self.series[panel].get_or_init(|| fit(ends, |angles| f(panel, angles)));
        chebyshev(&series[which], u)
    }
}

/// The series of functions between two angles.
fn fit(
    [from, to]: [f64; 2],
    f: impl Fn(&[f64; CURVE_TERMS]) -> [[f64; 3]; CURVE_TERMS],
) -> [Vec<f64>; 3] {
    static COSINES: OnceLock<[[f64; CURVE_TERMS]; CURVE_TERMS]> = OnceLock::new();
    let n = CURVE_TERMS as f64;
    let cosine = |k: usize, i: usize| (PI * k as f64 * (i as f64 + 0.5) / n).cos();
    let cosines =
        COSINES.get_or_init(|| std::array::from_fn(|k| std::array::from_fn(|i| cosine(k, i))));
    let (mid, half) = (0.5 * (from + to), 0.5 * (to - from));
    let values = f(&cosines[1].map(|x| mid + half * x));
    std::array::from_fn(|which| {
        let mut coefficients: Vec<f64> = cosines
            .iter()
            .enumerate()
            .map(|(k, row)| {
                let sum: f64 = values.iter().zip(row).map(|(v, x)| v[which] * x).sum();
                sum * if k == 0 { 1.0 } else { 2.0 } / n
            })
            .collect();
        let size = coefficients[0].abs();
        while coefficients.len() > 2 && coefficients.last().is_some_and(|c| c.abs() < 1e-17 * size)
        {
            coefficients.pop();
        }
        coefficients
    })
}
