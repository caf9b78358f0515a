//! Mass and velocity of a ball from peak and duration of its blow.
//!
//! ```text
//! alpha = (P/K)^(2/3)      V = 2.943275 alpha/tc      m = 4 K alpha^2.5/(5 V^2)      K = (4/3) E* sqrt(R)
//! ```
//!
//! Hertz's law without waves (T38): both are powers of P and tc, and their errors follow from the covariance of the fit.
//! A radius of unknown ball follows if its density or mass is known.

use crate::error::{Estimate, InverseError, check, positive};
use crate::fit::PulseFit;
use contact::law::hertz::CONTACT_TIME;
use std::f64::consts::PI;

/// The known property of a ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Known {
    /// Radius in m.
    Radius(f64),
    /// Density in kg/m^3.
    Density(f64),
    /// Mass in kg.
    Mass(f64),
}

/// A ball and its velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// Radius in m.
    pub radius_m: Estimate,
    /// Mass in kg.
    pub mass_kg: Estimate,
    /// Velocity of approach in m/s.
    pub velocity_m_s: Estimate,
}

/// The ball behind a blow of which one property is known, for an elastic contact with this effective modulus in Pa.
///
/// Valid for Hertz's pulse: a contact that yields or radiates much has another peak and duration.
///
/// # Errors
/// [`InverseError`] for a modulus or property that is not positive.
pub fn ball(fit: &PulseFit, effective_modulus_pa: f64, known: Known) -> Result<Ball, InverseError> {
    positive("the effective modulus in Pa", effective_modulus_pa)?;
    match known {
        Known::Radius(radius_m) => positive("the radius in m", radius_m)?,
        Known::Density(density) => positive("the density in kg/m^3", density)?,
        Known::Mass(mass_kg) => positive("the mass in kg", mass_kg)?,
    }
    let (peak, duration) = (fit.peak_n.value, fit.duration_s.value);
    let k = 4.0 / 3.0 * effective_modulus_pa;
    // m over R^(1/3)
    let heavy = 0.8 * peak.cbrt() * (duration / CONTACT_TIME * k.cbrt()).powi(2);
    // radius, and its exponents of peak and duration
    let (radius, [a, b]) = match known {
        Known::Radius(radius_m) => (radius_m, [0.0, 0.0]),
        Known::Density(density) => {
            let radius = (heavy * 0.75 / (PI * density)).powf(0.375);
            (radius, [0.125, 0.75])
        }
        Known::Mass(mass_kg) => ((mass_kg / heavy).powi(3), [-1.0, -6.0]),
    };
    let alpha = (peak / (k * radius.sqrt())).powf(2.0 / 3.0);
    let estimate = |value: f64, exponents: [f64; 2]| {
        let [a, b] = [exponents[0] / peak, exponents[1] / duration];
        let c = fit.covariance;
        let relative = a * a * c[0][0] + 2.0 * a * b * c[0][1] + b * b * c[1][1];
        let sd = value * relative.max(0.0).sqrt();
        Estimate { value, sd }
    };
    Ok(Ball {
        radius_m: estimate(radius, [a, b]),
        mass_kg: estimate(heavy * radius.cbrt(), [(1.0 + a) / 3.0, 2.0 + b / 3.0]),
        velocity_m_s: estimate(
            CONTACT_TIME * alpha / duration,
            [(2.0 - a) / 3.0, -1.0 - b / 3.0],
        ),
    })
}

/// Momentum m V in N s before a blow of known restitution, from its impulse m V (1 + e); holds for every contact law.
///
/// # Errors
/// [`InverseError`] for a restitution outside [0, 1].
pub fn momentum(fit: &PulseFit, restitution: f64) -> Result<Estimate, InverseError> {
    let good = (0.0..=1.0).contains(&restitution);
    check(good, "restitution", restitution, "[0, 1]")?;
    let [value, sd] = [fit.impulse_n_s.value, fit.impulse_n_s.sd].map(|x| x / (1.0 + restitution));
    Ok(Estimate { value, sd })
}
