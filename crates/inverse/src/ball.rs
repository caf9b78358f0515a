//! Mass and velocity of a ball from peak and duration of its blow.
//!
//! ```text
//! alpha = (P/K)^(2/3)      V = 2.943275 alpha/tc      m = 4 K alpha^2.5/(5 V^2)      K = (4/3) E* sqrt(R)
//! ```
//!
//! Hertz's law without waves (T38): both are powers of P and tc, and their errors follow from the covariance of the fit.
//! A radius of unknown ball follows if its density or mass is known.

use crate::error::{Estimate, InverseError, check};
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
    let positive =
        |key, value: f64| check(value > 0.0 && value.is_finite(), key, value, "(0, inf)");
    positive("the effective modulus in Pa", effective_modulus_pa)?;
    // K = k sqrt(R), and m = c K^(2/3) P^(1/3) tc^2
    let k = 4.0 / 3.0 * effective_modulus_pa;
    let c = 0.8 / (CONTACT_TIME * CONTACT_TIME);
    let heavy = Power {
        factor: c * k.powf(2.0 / 3.0),
        powers: [1.0 / 3.0, 2.0],
    };
    let radius = match known {
        Known::Radius(radius_m) => {
            positive("the radius in m", radius_m)?;
            Power {
                factor: radius_m,
                powers: [0.0; 2],
            }
        }
        Known::Density(density) => {
            positive("the density in kg/m^3", density)?;
            // (4/3) pi rho R^3 = heavy R^(1/3)
            heavy.times(3.0 / (4.0 * PI * density), 1.0).to(3.0 / 8.0)
        }
        Known::Mass(mass_kg) => {
            positive("the mass in kg", mass_kg)?;
            heavy.times(1.0 / mass_kg, 1.0).to(-3.0)
        }
    };
    let mass = heavy.and(radius, 1.0 / 3.0);
    // V = 2.943275 (P/K)^(2/3)/tc
    let rate = Power {
        factor: CONTACT_TIME * k.powf(-2.0 / 3.0),
        powers: [2.0 / 3.0, -1.0],
    };
    let velocity = rate.and(radius, -1.0 / 3.0);
    Ok(Ball {
        radius_m: radius.of(fit),
        mass_kg: mass.of(fit),
        velocity_m_s: velocity.of(fit),
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

/// A factor times powers of peak and duration.
#[derive(Clone, Copy)]
struct Power {
    factor: f64,
    powers: [f64; 2],
}

impl Power {
    fn times(self, factor: f64, power: f64) -> Self {
        Self {
            factor: self.factor * factor,
            ..self.to(power)
        }
    }

    fn to(self, power: f64) -> Self {
        Self {
            factor: self.factor.powf(power),
            powers: self.powers.map(|p| p * power),
        }
    }

    fn and(self, other: Self, power: f64) -> Self {
        let other = other.to(power);
        Self {
            factor: self.factor * other.factor,
            powers: [0, 1].map(|i| self.powers[i] + other.powers[i]),
        }
    }

    fn of(self, fit: &PulseFit) -> Estimate {
        let values = [fit.peak_n.value, fit.duration_s.value];
        let [p, t] = self.powers;
        let value = self.factor * values[0].powf(p) * values[1].powf(t);
        let slopes = [p / values[0], t / values[1]];
        let pairs = [(0, 0), (0, 1), (1, 0), (1, 1)];
        let relative: f64 = pairs
            .iter()
            .map(|&(i, j)| slopes[i] * slopes[j] * fit.covariance[i][j])
            .sum();
        Estimate {
            value,
            sd: value * relative.max(0.0).sqrt(),
        }
    }
}
