//! The surface-centre step response in closed form.
//!
//! The surface point-load step response of Kausel (2012), superposed over the Hertz disc.
//! The program uses [`SurfaceResponse`](crate::SurfaceResponse). This independent formula checks it, since the two
//! share no quadrature.
//!
//! Theory: `docs/theory.md` (T29, T30).

use crate::medium::Medium;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI};

/// W(T) at the centre of a Hertz disc, T = c2 t/r0: step response over its static value.
///
/// ```text
/// W = (4/pi) { I0(X_R) + [I0 - A3 I3]_{X_R}^{X_S} + 1/2 [I0 - A3 I3 - Re sum_j A_j I_j]_{X_S}^{X_P} }
/// ```
///
/// with X_R = min(1, T/T_R), X_S = min(1, T), X_P = min(1, T/kappa), T_R = c2/c_R.
/// Exactly 0 for T <= 0 and 1 for T >= T_R; NaN for NaN.
/// The accuracy is 1e-14, except near nu = 0.26308206, where the two poles x_1, x_2 coincide: the error of their
/// divided difference is 1e-16 over their distance, up to 1e-8 at the nearest number.
///
/// ```
/// use halfspace::{kausel, Medium};
/// // W(0.5) = 0.4834211245802 at nu = 0.3, from an independent evaluation of Kausel's formula
/// assert!((kausel::centre_step(&Medium::new(0.3)?, 0.5) - 0.4834211245802).abs() < 1e-12);
/// # Ok::<(), halfspace::DomainError>(())
/// ```
pub fn centre_step(medium: &Medium, t: f64) -> f64 {
    let kappa = medium.kappa();
    let roots = medium.rayleigh_cubic_roots;
    let x3 = roots[2].re;
    if t.is_nan() {
        return t;
    }
    if t <= 0.0 {
        return 0.0;
    }
    if t >= x3.sqrt() {
        return 1.0;
    }
    let (mid, mut half) = (0.5 * (roots[0] + roots[1]), 0.5 * (roots[1] - roots[0]));
    if half.norm() < CLOSEST_POLES {
        half = CLOSEST_POLES.into();
    }
    let split = Split {
        a2: kappa * kappa,
        x1: mid - half,
        x2: mid + half,
        x3,
        t,
    };
    let (xs, xp) = (t.min(1.0), (t / kappa).min(1.0));
    // at X_R the square root q of I3 is zero, and so is I3: I0(X_R) cancels with the bracket
    let surface = |x: f64| i0(x) - split.rayleigh(x);
    4.0 / PI * (surface(xs) + 0.5 * (surface(xp) - surface(xs) - split.leaky(xs, xp)))
}

/// Smallest half distance of coalescing poles; closer poles are separated.
const CLOSEST_POLES: f64 = 1e-8;

struct Split {
    a2: f64,
    x1: Complex64,
    x2: Complex64,
    x3: f64,
    t: f64,
}

impl Split {
    /// A3 I3(x), the Rayleigh pole.
    fn rayleigh(&self, x: f64) -> f64 {
        let (x3, t2) = (self.x3, self.t * self.t);
        let a3 = Complex64::new((x3 - 0.5).powi(2) * (x3 - self.a2).sqrt(), 0.0)
            / ((x3 - self.x1) * (x3 - self.x2));
        let q = (x3 * x * x - t2).max(0.0).sqrt();
        let p = (1.0 - x * x).max(0.0).sqrt();
        let far = x3 - t2;
        let angle = if x >= 1.0 {
            FRAC_PI_2
        } else {
            (q / far.sqrt()).min(1.0).asin()
        };
        a3.re * (q * p / (2.0 * x3) + far / (2.0 * x3 * x3.sqrt()) * angle)
    }

    /// Re of A1 I1 + A2 I2 between two limits: a divided difference of one function over x1, x2.
    fn leaky(&self, from: f64, to: f64) -> f64 {
        let f = |root: Complex64| {
            let weight = (root - 0.5).powi(2) * (self.a2 - root).sqrt() / (root - self.x3);
            weight * (self.primitive(root, to) - self.primitive(root, from))
        };
        ((f(self.x1) - f(self.x2)) / (self.x1 - self.x2)).re
    }

    /// I_j(x) = -q p/(2 x_j) + (T^2 - x_j)/(2 x_j^{3/2}) ln(sqrt(x_j) p + q), q = sqrt(T^2 - x_j x^2).
    fn primitive(&self, root: Complex64, x: f64) -> Complex64 {
        let t2 = self.t * self.t;
        let p = (1.0 - x * x).max(0.0).sqrt();
        let q = (t2 - root * x * x).sqrt();
        let s = root.sqrt();
        -q * p / (2.0 * root) + (t2 - root) / (2.0 * root * s) * (s * p + q).ln()
    }
}

/// I0(x) = [x sqrt(1 - x^2) + asin x]/2.
fn i0(x: f64) -> f64 {
    0.5 * (x * (1.0 - x * x).max(0.0).sqrt() + x.asin())
}
