//! A response that is tabulated over frequency.

use super::{ResponseError, counted, within};
use fault::number;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Largest number of rows: the phase of a minimum-phase response needs a time that grows with its square, 2 s for so many.
pub const MOST_ROWS: usize = 10_000;

/// Amplitudes and phases at frequencies, with straight lines between them; zero outside.
#[derive(Debug, Clone, PartialEq)]
pub struct Tabulated {
    frequencies_hz: Vec<f64>,
    amplitudes: Vec<f64>,
    /// Without jumps of 2 pi.
    phases_rad: Vec<f64>,
    is_minimum_phase: bool,
}

impl Tabulated {
    /// A table of frequencies in Hz, ascending from 0 or later, amplitudes, and phases in rad if they are known.
    ///
    /// Jumps of more than half a turn between neighbouring phases count as whole turns.
    /// Without phases the response is minimum phase: with a = ln |H|, on straight lines between the rows and constant outside,
    ///
    /// ```text
    /// phase(f) = (1/pi) int_0^inf a'(g) ln|(g + f)/(g - f)| dg
    /// ```
    ///
    /// which is exact for these lines. A table that ends where the amplitude still falls steeply has the phase of one that
    /// stays constant from there on.
    ///
    /// # Errors
    /// [`ResponseError`].
    pub fn new(
        frequencies_hz: Vec<f64>,
        amplitudes: Vec<f64>,
        phases_rad: Option<Vec<f64>>,
    ) -> Result<Self, ResponseError> {
        let count = frequencies_hz.len();
        let fits = (2..=MOST_ROWS).contains(&count);
        counted(
            "response.frequency_hz",
            count,
            fits,
            &format!("2 to {MOST_ROWS}"),
        )?;
        let phases = phases_rad.as_deref().unwrap_or(&amplitudes);
        for (key, list) in [
            ("response.amplitude", &*amplitudes),
            ("response.phase", phases),
        ] {
            counted(key, list.len(), list.len() == count, &count.to_string())?;
        }
        let positive = |x: f64| x >= 0.0 && x.is_finite();
        within(
            "response.frequency_hz",
            frequencies_hz.iter().copied(),
            positive,
            "[0, inf)",
        )?;
        within(
            "response.amplitude",
            amplitudes.iter().copied(),
            positive,
            "[0, inf)",
        )?;
        let given = phases_rad.iter().flatten().copied();
        within("response.phase", given, f64::is_finite, "(-inf, inf)")?;
        if let Some(pair) = frequencies_hz.windows(2).find(|pair| pair[1] <= pair[0]) {
            let (before, value) = (pair[0], pair[1]);
            let sentence = format!(
                "response.frequency_hz = {} does not follow {}: frequencies must ascend",
                number(value),
                number(before)
            );
            return Err(ResponseError::new("response.frequency_hz", value, sentence));
        }
        let is_minimum_phase = phases_rad.is_none();
        let phases_rad = match phases_rad {
            Some(phases_rad) => without_turns(phases_rad),
            None => minimum_phase(&frequencies_hz, &amplitudes)?,
        };
        Ok(Self {
            frequencies_hz,
            amplitudes,
            phases_rad,
            is_minimum_phase,
        })
    }

    /// Frequencies in Hz.
    pub fn frequencies_hz(&self) -> &[f64] {
        &self.frequencies_hz
    }

    /// Amplitudes.
    pub fn amplitudes(&self) -> &[f64] {
        &self.amplitudes
    }

    /// Phases in rad, given or computed, without jumps of whole turns.
    pub fn phases_rad(&self) -> &[f64] {
        &self.phases_rad
    }

    /// Whether the phases were computed from the amplitudes.
    pub fn is_minimum_phase(&self) -> bool {
        self.is_minimum_phase
    }

    pub(super) fn limits_hz(&self) -> [f64; 2] {
        [
            self.frequencies_hz[0],
            self.frequencies_hz[self.frequencies_hz.len() - 1],
        ]
    }

    pub(super) fn at(&self, frequency_hz: f64) -> Complex64 {
        let f = &self.frequencies_hz;
        let [first, last] = self.limits_hz();
        if !(first..=last).contains(&frequency_hz) {
            return Complex64::default();
        }
        let i = f
            .partition_point(|&f| f <= frequency_hz)
            .clamp(1, f.len() - 1);
        let part = (frequency_hz - f[i - 1]) / (f[i] - f[i - 1]);
        let between = |of: &[f64]| of[i - 1] + part * (of[i] - of[i - 1]);
        Complex64::from_polar(between(&self.amplitudes), between(&self.phases_rad))
    }
}

/// Phases without jumps of more than half a turn.
fn without_turns(mut phases_rad: Vec<f64>) -> Vec<f64> {
    for i in 1..phases_rad.len() {
        let turns = ((phases_rad[i] - phases_rad[i - 1]) / TAU).round();
        phases_rad[i] -= TAU * turns;
    }
    phases_rad
}

/// Phases of a minimum-phase response at the rows of its amplitudes.
///
/// On a straight line the integral is that of a' times P(g) = (g + f) ln(g + f) - (g - f) ln|g - f| at its ends.
fn minimum_phase(frequencies_hz: &[f64], amplitudes: &[f64]) -> Result<Vec<f64>, ResponseError> {
    let mut rows = frequencies_hz.iter().zip(amplitudes);
    if let Some((&frequency_hz, _)) = rows.find(|(_, amplitude)| **amplitude == 0.0) {
        let sentence = format!(
            "response.amplitude = 0 at {} Hz is outside (0, inf): without a column of phases the response is minimum phase, which requires positive amplitudes; remove the row or add the phases",
            number(frequency_hz)
        );
        return Err(ResponseError::new("response.amplitude", 0.0, sentence));
    }
    let slope = |(f, a): (&[f64], &[f64])| (a[1] / a[0]).ln() / (f[1] - f[0]);
    let slopes = frequencies_hz
        .windows(2)
        .zip(amplitudes.windows(2))
        .map(slope);
    let mut bends: Vec<f64> = vec![0.0; frequencies_hz.len()];
    for (i, slope) in slopes.enumerate() {
        bends[i] -= slope;
        bends[i + 1] += slope;
    }
    let entropy = |x: f64| if x == 0.0 { 0.0 } else { x * x.abs().ln() };
    let phase = |&f: &f64| {
        let each = frequencies_hz.iter().zip(&bends);
        let sum: f64 = each
            .map(|(&g, bend)| bend * (entropy(g + f) - entropy(g - f)))
            .sum();
        sum / PI
    };
    Ok(frequencies_hz.iter().map(phase).collect())
}
