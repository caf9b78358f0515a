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
/// [`InverseError::Range`] for a modulus or property that is not positive.
pub fn ball(fit: &PulseFit, effective_modulus_pa: f64, known: Known) -> Result<Ball, InverseError> {
    positive("the effective modulus in Pa", effective_modulus_pa)?;
    let k = 4.0 / 3.0 * effective_modulus_pa;
    // m over R^(1/3)
    let heavy =
        |peak: f64, duration: f64| 0.8 * peak.cbrt() * (duration / CONTACT_TIME * k.cbrt()).powi(2);
    match known {
        Known::Radius(radius_m) => positive("the radius in m", radius_m)?,
        Known::Density(density) => positive("the density in kg/m^3", density)?,
        Known::Mass(mass_kg) => positive("the mass in kg", mass_kg)?,
    }
    let of = |peak: f64, duration: f64| {
        let radius = match known {
            Known::Radius(radius_m) => radius_m,
            Known::Density(density) => (heavy(peak, duration) * 0.75 / (PI * density)).powf(0.375),
            Known::Mass(mass_kg) => (mass_kg / heavy(peak, duration)).powi(3),
        };
        let alpha = (peak / (k * radius.sqrt())).powf(2.0 / 3.0);
        [
            radius,
            heavy(peak, duration) * radius.cbrt(),
            CONTACT_TIME * alpha / duration,
        ]
    };
    let (peak, duration) = (fit.peak_n.value, fit.duration_s.value);
    // powers of both: the slopes are exact up to the square of the step
    let step = 1e-4;
    let [up, down] = [step, -step].map(|h| {
        [
            of(peak * (1.0 + h), duration),
            of(peak, duration * (1.0 + h)),
        ]
    });
    let found = of(peak, duration);
    let [radius_m, mass_kg, velocity_m_s] = [0, 1, 2].map(|c| {
        let slope = |i: usize, x: f64| (up[i][c] - down[i][c]) / (2.0 * step * x);
        let slopes = [slope(0, peak), slope(1, duration)];
        let terms = [(0, 0), (0, 1), (1, 0), (1, 1)]
            .map(|(i, j)| slopes[i] * slopes[j] * fit.covariance[i][j]);
        Estimate {
            value: found[c],
            sd: terms.iter().sum::<f64>().max(0.0).sqrt(),
        }
    });
    Ok(Ball {
        radius_m,
        mass_kg,
        velocity_m_s,
    })
}

/// Momentum m V in N s before a blow of known restitution, from its impulse m V (1 + e); holds for every contact law.
///
/// # Errors
/// [`InverseError::Range`] for a restitution outside [0, 1].
pub fn momentum(fit: &PulseFit, restitution: f64) -> Result<Estimate, InverseError> {
    check(
        (0.0..=1.0).contains(&restitution),
        "restitution",
        restitution,
        "[0, 1]",
    )?;
    let Estimate { value, sd } = fit.impulse_n_s;
    let scaled = |x: f64| x / (1.0 + restitution);
    Ok(Estimate {
        value: scaled(value),
        sd: scaled(sd),
    })
}
