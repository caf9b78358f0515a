//! The elastic half-space in reduced units: its wave speeds and Rayleigh function, from Poisson's ratio.
//!
//! Theory: `docs/theory.md` (T1, T11).

use crate::domain::{DomainError, check};
use crate::numeric::double::Double;
use num_complex::Complex64;

/// An isotropic elastic half-space, reduced by its longitudinal wave speed c1 and shear modulus mu.
///
/// Slownesses are multiples of 1/c1 and speeds multiples of c1.
///
/// ```
/// let steel = halfspace::Medium::new(0.3)?;
/// // c2/c_R = 1.07826859556 (Kausel 2012, largest root of the Rayleigh cubic)
/// assert!((steel.kappa() / steel.rayleigh_speed() - 1.07826859556).abs() < 1e-11);
/// # Ok::<(), halfspace::DomainError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Medium {
    poisson_ratio: f64,
    kappa: f64,
    rayleigh_speed: f64,
    /// Rayleigh wave speed to twice the digits of a double.
    pub(crate) exact_rayleigh_speed: Double,
    /// The roots (c2/c)^2 of the rationalised Rayleigh equation
    /// -16 (1 - a2) x^3 + 8 (3 - 2 a2) x^2 - 8 x + 1 = 0, a2 = kappa^2 (Kausel 2012).
    ///
    /// The last one is real and belongs to the Rayleigh wave; the other two lie on other sheets.
    /// They are real below nu = 0.26308206, equal there, and a conjugate pair above.
    pub(crate) rayleigh_cubic_roots: [Complex64; 3],
}

impl Medium {
    /// The half-space of Poisson's ratio `poisson_ratio`, valid in (-1, 1/2).
    ///
    /// As the ratio approaches 1/2, the longitudinal speed becomes infinite relative to the shear speed, and every
    /// reduced time becomes long. The stated accuracies hold for ratios in [-0.5, 0.4999].
    ///
    /// # Errors
    /// [`DomainError`] if the ratio is not in the open interval; also for NaN.
    pub fn new(poisson_ratio: f64) -> Result<Self, DomainError> {
        check(
            poisson_ratio > -1.0 && poisson_ratio < 0.5,
            "poisson_ratio",
            poisson_ratio,
            "(-1, 0.5)",
        )?;
        let a2 = (1.0 - 2.0 * poisson_ratio) / (2.0 - 2.0 * poisson_ratio);
        let roots = rayleigh_cubic_roots(a2);
        let rayleigh_speed = (a2 / roots[2].re).sqrt();
        let rest = rayleigh_rest(poisson_ratio, roots[2].re, rayleigh_speed);
        Ok(Self {
            poisson_ratio,
            kappa: a2.sqrt(),
            rayleigh_speed,
            exact_rayleigh_speed: Double::sum(rayleigh_speed, rest),
            rayleigh_cubic_roots: roots,
        })
    }

    /// Poisson's ratio nu.
    pub fn poisson_ratio(&self) -> f64 {
        self.poisson_ratio
    }

    /// kappa = c2/c1, the shear wave speed: sqrt((1 - 2 nu)/(2 - 2 nu)).
    pub fn kappa(&self) -> f64 {
        self.kappa
    }

    /// lambda/mu = 2 nu/(1 - 2 nu), the ratio of the Lame constants.
    pub fn lambda_over_mu(&self) -> f64 {
        2.0 * self.poisson_ratio / (1.0 - 2.0 * self.poisson_ratio)
    }

    /// c = c_R/c1, the Rayleigh wave speed.
    pub fn rayleigh_speed(&self) -> f64 {
        self.rayleigh_speed
    }

    /// (c1/c2)^2 = 1/kappa^2, the square of the shear slowness.
    pub(crate) fn shear_slowness_squared(&self) -> f64 {
        (2.0 - 2.0 * self.poisson_ratio) / (1.0 - 2.0 * self.poisson_ratio)
    }

    /// D'(c) in the pole term: the derivative of Rayleigh's function D(c) = (2 - v)^2 - 4 sqrt((1 - c^2)(1 - v)), v = (c/kappa)^2,
    /// at the Rayleigh speed.
    pub fn rayleigh_slope(&self) -> f64 {
        let (c, k) = (self.rayleigh_speed, self.shear_slowness_squared());
        let a = (1.0 - c * c).sqrt();
        let b = (1.0 - c * c * k).sqrt();
        4.0 * c * (b / a + k * a / b - k * (2.0 - c * c * k))
    }
}

/// The Rayleigh speed minus `speed`, from one step of Newton's method with twice the digits.
fn rayleigh_rest(poisson_ratio: f64, root: f64, speed: f64) -> f64 {
    let double = Double::from;
    let a2 =
        Double::sum(1.0, -2.0 * poisson_ratio) / (double(2.0) * Double::sum(1.0, -poisson_ratio));
    let x = double(root);
    let c3 = double(-16.0) * (double(1.0) - a2);
    let c2 = double(8.0) * (double(3.0) - double(2.0) * a2);
    let value = ((c3 * x + c2) * x - double(8.0)) * x + double(1.0);
    let slope = (3.0 * c3.high * root + 2.0 * c2.high) * root - 8.0;
    let square = a2 / (x - double(value.value() / slope));
    (square - Double::product(speed, speed)).value() / (2.0 * speed)
}

fn rayleigh_cubic_roots(a2: f64) -> [Complex64; 3] {
    let (c3, c2) = (-16.0 * (1.0 - a2), 8.0 * (3.0 - 2.0 * a2));
    // beyond the largest root the cubic falls and is concave, so that Newton's method descends monotonically
    let mut x = 2.5;
    for _ in 0..60 {
        let value = ((c3 * x + c2) * x - 8.0) * x + 1.0;
        let slope = (3.0 * c3 * x + 2.0 * c2) * x - 8.0;
        let step = value / slope;
        x -= step;
        if step.abs() < 1e-16 * x {
            break;
        }
    }
    let sum = -c2 / c3 - x;
    let product = -1.0 / (c3 * x);
    let split = Complex64::new(0.25 * sum * sum - product, 0.0).sqrt();
    [0.5 * sum - split, 0.5 * sum + split, Complex64::new(x, 0.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_satisfy_the_cubic_and_rayleighs_function() {
        for nu in [
            -0.9,
            -0.5,
            0.0,
            0.25,
            0.263_082_06,
            0.3,
            0.45,
            0.4999,
            0.499_999,
        ] {
            let medium = Medium::new(nu).unwrap();
            let a2 = medium.kappa().powi(2);
            for x in medium.rayleigh_cubic_roots {
                let value =
                    -16.0 * (1.0 - a2) * x.powi(3) + 8.0 * (3.0 - 2.0 * a2) * x * x - 8.0 * x + 1.0;
                assert!(value.norm() < 1e-13, "nu = {nu}: {value}");
            }
            let c = medium.rayleigh_speed();
            let function = |speed: f64| {
                let v = speed * speed / a2;
                (2.0 - v).powi(2) - 4.0 * ((1.0 - speed * speed) * (1.0 - v)).sqrt()
            };
            assert!(function(c).abs() < 1e-13, "nu = {nu}");
            let h = 1e-6 * c;
            let slope = (function(c + h) - function(c - h)) / (2.0 * h);
            assert!((slope / medium.rayleigh_slope() - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn ratio_outside_the_domain_is_named() {
        for nu in [-1.0, 0.5, f64::NAN, f64::INFINITY, -2.0] {
            let message = Medium::new(nu).unwrap_err().to_string();
            assert_eq!(
                message,
                format!("poisson_ratio = {nu} is outside (-1, 0.5)")
            );
        }
    }
}
