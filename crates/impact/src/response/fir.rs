//! The response of a digital filter.

use super::spectrum::ROUNDED;
use super::{ResponseError, counted, finite, positive};
use fault::rounded;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// A digital filter: output k is the sum of its coefficients times the inputs before.
#[derive(Debug, Clone, PartialEq)]
pub struct Fir {
    coefficients: Vec<f64>,
    rate_hz: f64,
}

/// Largest number of coefficients.
const MOST_COEFFICIENTS: usize = 1 << 16;
/// Largest length of a filter in steps of a history: the transform of so many needs 1 GB.
const MOST_STEPS: f64 = 16_777_216.0;
impl Fir {
    /// A filter of coefficients at times 0, 1, 2, .. over the rate in Hz.
    ///
    /// # Errors
    /// [`ResponseError`] without coefficients, or for numbers out of range.
    pub fn new(coefficients: Vec<f64>, rate_hz: f64) -> Result<Self, ResponseError> {
        let key = "response.coefficients";
        counted(key, coefficients.len(), 1..=MOST_COEFFICIENTS)?;
        finite(key, &coefficients)?;
        positive("response.rate_hz", rate_hz)?;
        Ok(Self {
            coefficients,
            rate_hz,
        })
    }

    /// The coefficients.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// The rate in Hz.
    pub fn rate_hz(&self) -> f64 {
        self.rate_hz
    }

    /// Its length in steps.
    pub(super) fn length(&self, step_s: f64) -> Result<usize, ResponseError> {
        let length_s = self.coefficients.len() as f64 / self.rate_hz;
        let least_s = length_s / MOST_STEPS;
        if step_s < least_s {
            let [step, length, least] = [step_s, length_s, least_s].map(rounded);
            let sentence = format!(
                "step_s = {step} is too small for a filter of {length} s: use at least {least} s, or resample the filter"
            );
            return Err(ResponseError::new("step_s", step_s, sentence));
        }
        Ok((length_s / step_s) as usize)
    }

    /// sum_k c_k e^{-2 pi i f k/rate} up to half the rate.
    pub(super) fn at(&self, frequency_hz: f64) -> Complex64 {
        if frequency_hz.abs() > 0.5 * self.rate_hz * (1.0 + ROUNDED) {
            return Complex64::default();
        }
        let turn = Complex64::from_polar(1.0, -TAU * frequency_hz / self.rate_hz);
        let coefficients = self.coefficients.iter().rev();
        coefficients.fold(Complex64::default(), |sum, c| sum * turn + c)
    }
}
