//! The Laplace-Hankel transforms (22) to (29) of the paper, with the coefficient of (24) corrected to 4.
//!
//! ```text
//! alpha = sqrt(k^2 + s^2)   beta = sqrt(k^2 + s^2/kappa^2)   gamma = 2 k^2 + s^2/kappa^2   D = gamma^2 - 4 alpha beta k^2
//! w   = alpha (gamma e^{-alpha z} - 2 k^2 e^{-beta z})/D                                   times J0
//! u   = k (gamma e^{-alpha z} - 2 alpha beta e^{-beta z})/D                                times J1
//! szz = -(gamma^2 e^{-alpha z} - 4 alpha beta k^2 e^{-beta z})/D                           times J0
//! srz = 2 alpha gamma k (e^{-beta z} - e^{-alpha z})/D                                     times J1
//! srr = [gamma (2 k^2 - (lambda/mu) s^2) e^{-alpha z} - 4 alpha beta k^2 e^{-beta z}]/D    times J0,   - 2 u J1/(k r)
//! stt = -(lambda/mu) s^2 gamma e^{-alpha z}/D                                              times J0,   + 2 u J1/(k r)
//! ```
//!
//! Impulse responses under a unit force; a step response is one over s times them.
//! Units: mu = c1 = r0 = 1.

use halfspace::Medium;
use num_complex::Complex64;
use std::f64::consts::PI;

/// The two roots and what follows from them at one (k, s).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Roots {
    alpha: Complex64,
    beta: Complex64,
    gamma: Complex64,
    /// 1/D.
    inverse: Complex64,
    /// 1/kappa^2.
    shear: f64,
}

impl Roots {
    /// Right branch for every k on a path that passes above the branch points -i s, -i s/kappa.
    pub(crate) fn new(medium: &Medium, k: Complex64, s: Complex64) -> Self {
        // by factors: the cut from -i s runs to the right below the path, that from i s to the left
        let root = |s: Complex64| {
            let i = Complex64::i();
            i * (-(k + i * s)).sqrt() * (k - i * s).sqrt()
        };
        Self::from(medium, k, s, root)
    }

    /// The same for |k| beyond the last singularity, in any direction of a half-plane Re k > 0.
    pub(crate) fn far(medium: &Medium, k: Complex64, s: Complex64) -> Self {
        let root = |s: Complex64| k * (1.0 + (s / k) * (s / k)).sqrt();
        Self::from(medium, k, s, root)
    }

    fn from(
        medium: &Medium,
        k: Complex64,
        s: Complex64,
        root: impl Fn(Complex64) -> Complex64,
    ) -> Self {
        let shear = 1.0 / (medium.kappa() * medium.kappa());
        let (alpha, beta) = (root(s), root(s * shear.sqrt()));
        let (k2, s2) = (k * k, s * s);
        let slow = s2 * shear;
        let gamma = 2.0 * k2 + slow;
        // gamma^2 - 4 k^4 and alpha beta - k^2 apart: no difference of large numbers for k >> s
        let product = alpha * beta;
        let excess = (k2 * (s2 + slow) + s2 * slow) / (product + k2);
        let d = slow * (4.0 * k2 + slow) - 4.0 * k2 * excess;
        Self {
            alpha,
            beta,
            gamma,
            inverse: d.inv(),
            shear,
        }
    }

    /// The deflection of the surface, w at z = 0.
    pub(crate) fn surface(&self, s: Complex64) -> Complex64 {
        self.alpha * s * s * self.shear * self.inverse
    }

    /// The fields in the order of [`halfspace::FIELDS`] from J0 and J1 times a weight, and J1/(k r) times it.
    pub(crate) fn fields(
        &self,
        medium: &Medium,
        k: Complex64,
        s: Complex64,
        z: f64,
        [j0, j1, j1_over_kr]: [Complex64; 3],
    ) -> [Complex64; 6] {
        let k2 = k * k;
        let p = (-self.alpha * z).exp() * self.inverse;
        let q = (-self.beta * z).exp() * self.inverse;
        let cross = 4.0 * self.alpha * self.beta * k2 * q;
        let lame = medium.lambda_over_mu() * s * s;
        let u = k * (self.gamma * p - 2.0 * self.alpha * self.beta * q);
        let hoop = 2.0 * u * k * j1_over_kr;
        [
            u * j1,
            self.alpha * (self.gamma * p - 2.0 * k2 * q) * j0,
            (self.gamma * (2.0 * k2 - lame) * p - cross) * j0 - hoop,
            -lame * self.gamma * p * j0 + hoop,
            (cross - self.gamma * self.gamma * p) * j0,
            2.0 * self.alpha * self.gamma * k * (q - p) * j1,
        ]
    }
}

/// k Z_H(k) of Hertz's pressure, (30): 3 (sin k - k cos k)/(2 pi k^2).
pub(crate) fn load(k: Complex64) -> Complex64 {
    let scale = 1.5 / PI;
    if k.norm() < 0.1 {
        let k2 = k * k;
        return scale * k / 3.0 * (1.0 - k2 / 10.0 * (1.0 - k2 / 28.0 * (1.0 - k2 / 54.0)));
    }
    scale * (k.sin() - k * k.cos()) / (k * k)
}

/// A path in the k plane from 0 that passes above the singularities -i s x, x = 1 .. `slowest`, and to the
/// right of i s x: its height, and the widest panel that keeps away from them.
pub(crate) fn path(s: Complex64, slowest: f64, clearance: f64) -> (f64, f64) {
    if s.im == 0.0 && s.re > 0.0 {
        (0.0, f64::INFINITY)
    } else if s.re > 0.25 * s.im {
        (0.0, 1.4 * s.re)
    } else {
        ((-s.re).max(0.0) * slowest + clearance, 1.5 * clearance)
    }
}
