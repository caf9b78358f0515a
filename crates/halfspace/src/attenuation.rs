//! Attenuation with a constant quality factor, the same for longitudinal and shear waves.
//!
//! Theory: `docs/theory.md` (T78).

use crate::domain::{DomainError, check};
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI};

/// Kjartansson's constant quality factor Q (1979): all moduli are multiplied by
///
/// ```text
/// m(f) = (i f/f0)^(2 g),     g = atan(1/Q)/pi
/// ```
///
/// at a frequency f, with the moduli of the elastic body at the reference frequency f0 (up to the phase).
/// The law is causal: waves of higher frequencies are faster. It has no static limit: under a constant force the body
/// creeps as t^(2 g).
///
/// Because P and S waves are damped alike, the damped response is the elastic one at a complex frequency:
/// displacement G(f/sqrt m)/m, stress G(f/sqrt m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attenuation {
    quality_factor: f64,
    reference: f64,
}

impl Attenuation {
    /// A quality factor in [1, 1e15] and the reference frequency f0 in (0, inf), in c1/r0 where kernels are reduced.
    ///
    /// # Errors
    /// [`DomainError`] for values outside these ranges.
    pub fn new(quality_factor: f64, reference_frequency: f64) -> Result<Self, DomainError> {
        check(
            (1.0..=1e15).contains(&quality_factor),
            "quality_factor",
            quality_factor,
            "[1, 1e15]",
        )?;
        check(
            reference_frequency > 0.0 && reference_frequency.is_finite(),
            "reference_frequency",
            reference_frequency,
            "(0, inf)",
        )?;
        Ok(Self {
            quality_factor,
            reference: reference_frequency,
        })
    }

    /// Q.
    pub fn quality_factor(&self) -> f64 {
        self.quality_factor
    }

    /// f0.
    pub fn reference_frequency(&self) -> f64 {
        self.reference
    }

    /// The exponent g = atan(1/Q)/pi.
    pub(crate) fn exponent(&self) -> f64 {
        self.quality_factor.recip().atan() / PI
    }

    /// sqrt m(f), by which wave speeds are multiplied, for f > 0.
    pub fn speed_factor(&self, frequency: f64) -> Complex64 {
        let g = self.exponent();
        Complex64::from_polar((frequency / self.reference).powf(g), g * FRAC_PI_2)
    }
}
