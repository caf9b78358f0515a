//! Hankel quadrature of the transforms: from (k, s) to fields at (r, z) in the Laplace domain.
//!
//! Gauss-Legendre panels along the real k axis for Re s > 0.
//! The branch points and the Rayleigh pole lie at k = -i s times 1, 1/kappa and 1/c, below the path by Re s:
//! that distance and the oscillation of J(k r) Z_H(k) set the panels, and e^{-k z} sets the end.
//! For Re s <= 0, which only Talbot's contour needs, they have crossed the axis, and the path is raised above them.

use crate::transform::{Roots, Solid, load, path};
use halfspace::Medium;
use halfspace::gauss::Rule;
use num_complex::Complex64;
use std::cell::Cell;

/// Fields at one point as functions of the Laplace variable.
#[derive(Debug)]
pub(crate) struct Hankel {
    solid: Solid,
    r: f64,
    z: f64,
    digits: f64,
    evaluations: Cell<u64>,
}

/// Nodes along the real axis with everything that does not depend on s.
#[derive(Debug)]
pub(crate) struct Nodes {
    k: Vec<f64>,
    bessel: Vec<[f64; 3]>,
}

impl Hankel {
    /// For z > 0, to `digits` decimal digits.
    pub(crate) fn new(medium: &Medium, r: f64, z: f64, digits: f64) -> Self {
        Self {
            solid: Solid::new(medium),
            r,
            z,
            digits,
            evaluations: Cell::new(0),
        }
    }

    /// Integrand evaluations so far.
    pub(crate) fn evaluations(&self) -> u64 {
        self.evaluations.get()
    }

    /// Points of a panel for the digits asked for.
    fn points(&self) -> usize {
        (2.0 + 1.2 * self.digits).ceil() as usize
    }

    /// Nodes that serve every s with Re s >= `least` and |Im s| <= `widest`.
    pub(crate) fn nodes(&self, least: f64, widest: f64) -> Nodes {
        let slowest = self.solid.rayleigh_slowness;
        let end = widest * slowest + self.digits * std::f64::consts::LN_10 / self.z + 4.0 * least;
        let width = 3.5 / (1.0 + self.r);
        let rule = Rule::new(self.points());
        let mut nodes = Nodes {
            k: Vec::new(),
            bessel: Vec::new(),
        };
        let mut from = 0.0;
        while from < end {
            // beyond the last singularity their distance grows
            let clear = least.hypot((from - widest * slowest).max(0.0));
            let to = from + width.min(2.0 * clear);
            for (k, weight) in rule.on(from, to) {
                let scale = weight * load(k.into()).re;
                let x = k * self.r;
                let j1 = libm::j1(x);
                let ratio = if x < 1e-6 { 0.5 } else { j1 / x };
                nodes.k.push(k);
                nodes
                    .bessel
                    .push([scale * libm::j0(x), scale * j1, scale * ratio]);
            }
            from = to;
        }
        nodes
    }

    /// Step response of the six fields at s, Re s > 0.
    pub(crate) fn step(&self, nodes: &Nodes, s: Complex64) -> [Complex64; 6] {
        let reach = self.digits * std::f64::consts::LN_10 / self.z;
        let end = s.im.abs() * self.solid.rayleigh_slowness + reach + 4.0 * s.re;
        let count = nodes.k.partition_point(|&k| k <= end);
        let mut sum = [Complex64::default(); 6];
        for (&k, bessel) in nodes.k[..count].iter().zip(&nodes.bessel) {
            let k = k.into();
            let roots = Roots::new(&self.solid, k, s);
            let terms = roots.fields(&self.solid, k, s, self.z, bessel.map(Complex64::from));
            for (total, term) in sum.iter_mut().zip(terms) {
                *total += term;
            }
        }
        self.evaluations.set(self.evaluations.get() + count as u64);
        sum.map(|v| v / s)
    }

    /// Step response at any s with Im s >= 0, continued through the imaginary axis.
    ///
    /// The path rises along the imaginary axis above the three singularities and leaves to the right.
    pub(crate) fn continued(&self, s: Complex64) -> [Complex64; 6] {
        let slowest = self.solid.rayleigh_slowness;
        let clearance = 1.0 / (1.0 + self.r);
        let (height, widest) = path(s, slowest, clearance);
        let widest = widest.min(1.5 * clearance);
        let end = s.im.abs() * slowest + self.digits * std::f64::consts::LN_10 / self.z;
        let rule = Rule::new(self.points());
        let mut sum = [Complex64::default(); 6];
        let mut count = 0;
        let mut leg = |from: Complex64, to: Complex64| {
            // near k = 0 the singularities are as near as s
            let length = (to - from).norm();
            let (mut at, mut cuts) = (0.0, vec![0.0]);
            while at < length * (1.0 - 1e-12) {
                at = (at + widest.min((0.7 * s.norm()).max(0.5 * at))).min(length);
                cuts.push(at);
            }
            for pair in cuts.windows(2) {
                let share = |at: f64| at / length;
                for (x, weight) in rule.on(share(pair[0]), share(pair[1])) {
                    let k = from + (to - from) * x;
                    let scale = weight * (to - from) * load(k);
                    let [j0, j1] = bessel(k * self.r);
                    let ratio = if k.norm() * self.r < 1e-6 {
                        0.5.into()
                    } else {
                        j1 / (k * self.r)
                    };
                    let weights = [scale * j0, scale * j1, scale * ratio];
                    let roots = Roots::new(&self.solid, k, s);
                    let terms = roots.fields(&self.solid, k, s, self.z, weights);
                    for (total, term) in sum.iter_mut().zip(terms) {
                        *total += term;
                    }
                    count += 1;
                }
            }
        };
        let corner = Complex64::new(0.0, height);
        if height > 0.0 {
            leg(Complex64::default(), corner);
        }
        leg(corner, corner + end);
        self.evaluations.set(self.evaluations.get() + count);
        sum.map(|v| v / s)
    }
}

/// J0 and J1 of a complex argument.
fn bessel(x: Complex64) -> [Complex64; 2] {
    if x.norm() < 1e-8 {
        return [1.0.into(), 0.5 * x];
    }
    [0.0, 1.0].map(|order| {
        complex_bessel::besselj(order, x).unwrap_or(Complex64::new(f64::INFINITY, 0.0))
    })
}
