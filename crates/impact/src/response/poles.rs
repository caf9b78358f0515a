//! A rational response of poles and zeros.

use super::section::{FilterSection, Way};
use super::{ResponseError, finite, within};
use fault::rounded;
use num_complex::Complex64;
use std::f64::consts::TAU;
use std::iter::repeat;

/// H(s) = gain prod(s - z)/prod(s - p), s = i w in rad/s.
#[derive(Debug, Clone, PartialEq)]
pub struct PolesZeros {
    poles: Vec<Complex64>,
    zeros: Vec<Complex64>,
    gain: f64,
}

/// Difference between two roots that count as conjugate, relative to their size: files have six digits or more.
const CONJUGATE: f64 = 1e-5;
/// Samples before an impulse and before the end whose gains are summed one by one: filters that look ahead have decayed to
/// 1e-8 there (the test `the_largest_gain_bounds_the_output` fails at 1).
const NEAR: usize = 16;
/// Weights of the last samples, from the last one back, in the value of the polynomial through them one step later. One of a
/// lower degree would cost an order of accuracy (the test `the_end_of_the_record_changes_nothing_before_it` fails at degree 2).
const CONTINUED: [&[f64]; 5] = [
    &[1.0],
    &[2.0, -1.0],
    &[3.0, -3.0, 1.0],
    &[4.0, -6.0, 4.0, -1.0],
    &[5.0, -10.0, 10.0, -5.0, 1.0],
];
/// Samples after which the inverse of a filter that looks ahead has decayed below rounding, by a factor of 4 each (the test
/// `removing_a_response_returns_the_input_in_its_band` fails at 5).
const FORGOTTEN: usize = 40;

impl PolesZeros {
    /// A response of poles and zeros in rad/s and a real factor; the order of the roots is free.
    ///
    /// # Errors
    /// [`ResponseError`] for poles whose real part is not negative, more zeros than poles, complex roots without their
    /// conjugates, and numbers that are not finite.
    pub fn new(
        poles: Vec<Complex64>,
        zeros: Vec<Complex64>,
        gain: f64,
    ) -> Result<Self, ResponseError> {
        let fits = |x: f64| x.is_finite() && x != 0.0;
        within("response.gain", &[gain], fits, "(-inf, inf) without 0")?;
        for (key, roots) in [("response.poles", &poles), ("response.zeros", &zeros)] {
            let parts = roots.iter().flat_map(|root| [root.re, root.im]);
            finite(key, &parts.collect::<Vec<_>>())?;
        }
        if let Some(&pole) = poles.iter().find(|pole| pole.re >= 0.0) {
            let sentence = format!(
                "response.poles contains {pole}, whose real part is outside (-inf, 0): the response would grow without end; poles are in rad/s, not in Hz, and their real parts are negative"
            );
            return Err(ResponseError::new("response.poles", pole.re, sentence));
        }
        if zeros.len() > poles.len() {
            let (zeros, poles) = (zeros.len(), poles.len());
            let sentence = format!(
                "response.zeros has {zeros} zeros, more than the {poles} poles: the response would differentiate its input; use the sensor's velocity or acceleration as quantity instead, with one zero at 0 less for each derivative"
            );
            return Err(ResponseError::new("response.zeros", zeros as f64, sentence));
        }
        paired("response.poles", &poles)?;
        paired("response.zeros", &zeros)?;
        Ok(Self { poles, zeros, gain })
    }

    /// Poles in rad/s.
    pub fn poles(&self) -> &[Complex64] {
        &self.poles
    }

    /// Zeros in rad/s.
    pub fn zeros(&self) -> &[Complex64] {
        &self.zeros
    }

    /// The real factor.
    pub fn gain(&self) -> f64 {
        self.gain
    }

    /// H at a frequency.
    pub(super) fn at(&self, frequency_hz: f64) -> Complex64 {
        let s = Complex64::new(0.0, TAU * frequency_hz);
        // one factor after the other, so that large numbers of both signs of the exponent do not meet
        let zeros = self.zeros.iter().map(|zero| s - zero);
        let zeros = zeros.chain(repeat(1.0.into()));
        let each = self.poles.iter().zip(zeros);
        each.fold(self.gain.into(), |product, (pole, zero)| {
            product * (zero / (s - pole))
        })
    }

    /// The output at the samples of an input, and the largest gain of an error.
    pub(super) fn output(
        &self,
        step_s: f64,
        samples: &[f64],
    ) -> Result<(Vec<f64>, f64), ResponseError> {
        let chain = Chain::new(self, step_s)?;
        Ok((chain.forward(samples), chain.largest_gain(samples.len())))
    }

    /// The input at the samples of an output: the inverse of [`PolesZeros::output`] to rounding.
    pub(super) fn input(&self, step_s: f64, samples: &[f64]) -> Result<Vec<f64>, ResponseError> {
        if let Some(&zero) = self.zeros.iter().find(|zero| zero.re > 0.0) {
            let sentence = format!(
                "response.zeros contains {zero}, whose real part is positive: the inverse of the response would grow without end; fit the input to the output instead"
            );
            return Err(ResponseError::new("response.zeros", zero.re, sentence));
        }
        Ok(Chain::new(self, step_s)?.back(samples))
    }
}

/// The sections of all poles and zeros: a zero differentiates, a pole integrates.
///
/// The samples between two sections are complex; after both of a conjugate pair they are real up to rounding.
struct Chain {
    sections: Vec<FilterSection>,
    gain: f64,
}

impl Chain {
    fn new(response: &PolesZeros, step_s: f64) -> Result<Self, ResponseError> {
        let of = |root: Complex64, is_pole: bool| {
            FilterSection::new(root, is_pole, step_s).ok_or_else(|| {
                let frequency_hz = root.norm() / TAU;
                let [step, at, least] = [step_s, frequency_hz, 0.1 / frequency_hz].map(rounded);
                let sentence = format!("step_s = {step} is too large for the resonance of the response at {at} Hz: use a step of at most {least} s");
                ResponseError::new("step_s", step_s, sentence)
            })
        };
        let mut zeros = paired("response.zeros", &response.zeros)?.into_iter();
        let mut sections = Vec::new();
        // A zero comes before the pole that makes up for it: differences of smooth samples keep their digits, but those of
        // an integral lose the square of its length in steps. Not all zeros come first, for those of rough samples.
        for pole in paired("response.poles", &response.poles)? {
            if let Some(zero) = zeros.next() {
                sections.push(of(zero, false)?);
            }
            sections.push(of(pole, true)?);
        }
        let gain = response.gain;
        Ok(Self { sections, gain })
    }

    fn forward(&self, samples: &[f64]) -> Vec<f64> {
        let mut values: Vec<Complex64> = samples.iter().map(|&x| x.into()).collect();
        for section in &self.sections {
            section.causal(&mut values, Way::Forward);
        }
        self.continued(&mut values);
        for section in &self.sections {
            section.looking_ahead(&mut values, Way::Forward);
        }
        let output = values.iter().take(samples.len());
        output.map(|y| self.gain * y.re).collect()
    }

    fn back(&self, samples: &[f64]) -> Vec<f64> {
        let mut values: Vec<Complex64> = samples.iter().map(|y| (y / self.gain).into()).collect();
        self.continued(&mut values);
        for section in self.sections.iter().rev() {
            section.looking_ahead(&mut values, Way::Back);
        }
        for section in self.sections.iter().rev() {
            section.causal(&mut values, Way::Back);
        }
        let input = values.iter().take(samples.len());
        input.map(|x| x.re).collect()
    }

    /// Continues samples by the polynomial of degree four through the last five.
    ///
    /// A filter that looks ahead turns a polynomial into another one of its degree, so that an inverse continues the
    /// samples in the same way.
    fn continued(&self, values: &mut Vec<Complex64>) {
        let known = CONTINUED.len().min(values.len());
        let weights = known.checked_sub(1).map_or(&[][..], |i| CONTINUED[i]);
        for _ in 0..FORGOTTEN + 2 * self.sections.len() {
            let last = values.iter().rev().zip(weights);
            values.push(last.map(|(x, weight)| x * weight).sum());
        }
    }

    /// Largest sum of magnitudes of a row of the matrix that makes outputs of inputs.
    ///
    /// All rows are those of the impulse response but the last, where the polynomial beyond the end counts.
    fn largest_gain(&self, count: usize) -> f64 {
        let impulse = |length: usize, at: usize| {
            let mut samples = vec![0.0; length];
            samples[at] = 1.0;
            self.forward(&samples)
        };
        let sum = |samples: &[f64]| samples.iter().map(|x| x.abs()).sum::<f64>();
        let response = impulse(NEAR + count, NEAR.min(count));
        let ends: Vec<Vec<f64>> = (NEAR..2 * NEAR).map(|at| impulse(2 * NEAR, at)).collect();
        let row = |n: usize| ends.iter().map(|end| end[NEAR + n].abs()).sum::<f64>();
        let of_end = (0..NEAR).map(row).fold(0.0, f64::max);
        sum(&response).max(of_end + sum(&response[(2 * NEAR).min(response.len())..]))
    }
}

/// The roots in conjugate pairs and real ones.
fn paired(key: &'static str, roots: &[Complex64]) -> Result<Vec<Complex64>, ResponseError> {
    let mut left = roots.to_vec();
    let mut found = Vec::new();
    while let Some(root) = left.pop() {
        found.push(root);
        if root.im != 0.0 {
            let fits = |other: &Complex64| (other - root.conj()).norm() <= CONJUGATE * root.norm();
            let partner = left.iter().position(fits);
            left.remove(partner.ok_or_else(|| {
                let sentence = format!("{key} contains {root} without its conjugate {}: the output would not be real; list both", root.conj());
                ResponseError::new(key, root.im, sentence)
            })?);
            found.push(root.conj());
        }
    }
    Ok(found)
}
