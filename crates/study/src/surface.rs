//! The transform of the paper's kernel, the deflection w(0, 0, t), by Hankel quadrature.
//!
//! At z = 0 nothing decays along k. Beyond the singularities the load's e^{ik} and e^{-ik} are separated and
//! each is followed into the half-plane where it decays, after the static deflection is taken out.

use crate::transform::{Roots, Solid, load, path};
use halfspace::Medium;
use halfspace::gauss::Rule;
use num_complex::Complex64;
use std::cell::Cell;
use std::f64::consts::PI;

/// Step response of the deflection of the centre over its static value, as a function of s.
#[derive(Debug)]
pub(crate) struct SurfaceTransform {
    solid: Solid,
    digits: f64,
    evaluations: Cell<u64>,
}

impl SurfaceTransform {
    pub(crate) fn new(medium: &Medium, digits: f64) -> Self {
        Self {
            solid: Solid::new(medium),
            digits,
            evaluations: Cell::new(0),
        }
    }

    /// Integrand evaluations so far.
    pub(crate) fn evaluations(&self) -> u64 {
        self.evaluations.get()
    }

    /// At any s with Im s >= 0, continued through the imaginary axis.
    pub(crate) fn step(&self, s: Complex64) -> Complex64 {
        let rest = 1.0 - self.solid.poisson_ratio;
        let slowest = self.solid.rayleigh_slowness;
        let rule = Rule::new((3.0 + 1.3 * self.digits).ceil() as usize);
        let near = |k: Complex64| Roots::new(&self.solid, k, s).surface(&self.solid, s) - rest / k;
        let far = |k: Complex64| Roots::far(&self.solid, k, s).surface(&self.solid, s) - rest / k;
        let mut sum = Complex64::default();
        let mut count = 0;
        let (height, widest) = path(s, slowest, 1.0);
        let widest = widest.min(2.0);
        // near k = 0 the singularities are as near as s
        let least = (0.7 * s.norm()).min(1.0);
        let mut leg = |from: Complex64, to: Complex64, f: &dyn Fn(Complex64) -> Complex64| {
            let length = (to - from).norm();
            let mut at = 0.0;
            while at < length * (1.0 - 1e-12) {
                let next = (at + least.max(0.5 * at).min(widest)).min(length);
                for (x, weight) in rule.on(at, next) {
                    let direction = (to - from) / length;
                    sum += weight * direction * f(from + direction * x);
                    count += 1;
                }
                at = next;
            }
        };
        let corner = Complex64::new(0.0, height);
        let start = corner + s.norm() * slowest + 4.0;
        let whole = |k: Complex64| load(k) * near(k);
        if height > 0.0 {
            leg(Complex64::default(), corner, &whole);
        }
        leg(corner, start, &whole);
        // 3 (sin k - k cos k)/(2 pi k^2) = sum over both signs of e^{+-ik} (-+ i - k)/2 times 3/(2 pi k^2)
        let depth = self.digits * std::f64::consts::LN_10 + 2.0;
        for sign in [1.0, -1.0] {
            let i = Complex64::new(0.0, sign);
            let half = |k: Complex64| 0.75 / PI * (i * k).exp() * (-i - k) / (k * k) * far(k);
            leg(start, start + i * depth, &half);
        }
        self.evaluations.set(self.evaluations.get() + count);
        (1.0 + sum / (0.375 * rest)) / s
    }
}
