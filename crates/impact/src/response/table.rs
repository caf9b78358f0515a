//! A response that is tabulated over frequency.

use super::{ResponseError, counted, finite, within};
use fault::number;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Largest number of rows: the phase of a minimum-phase response needs a time that grows with its square, 2 s for so many.
const MOST_ROWS: usize = 10_000;

/// Amplitudes and phases at frequencies, with straight lines between them; zero outside.
#[derive(Debug, Clone, PartialEq)]
pub struct Tabulated {
    /// Frequency in Hz, amplitude, and phase in rad without jumps of 2 pi.
    rows: Vec<[f64; 3]>,
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
        let fits = |x: f64| x >= 0.0 && x.is_finite();
        counted("response.frequency_hz", count, 2..=MOST_ROWS)?;
        counted("response.amplitude", amplitudes.len(), count..=count)?;
        within("response.frequency_hz", &frequencies_hz, fits, "[0, inf)")?;
        within("response.amplitude", &amplitudes, fits, "[0, inf)")?;
        if let Some(phases_rad) = &phases_rad {
            counted("response.phase", phases_rad.len(), count..=count)?;
            finite("response.phase", phases_rad)?;
        }
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
        let rows = frequencies_hz.into_iter().zip(amplitudes).zip(phases_rad);
        let rows = rows.map(|((frequency, amplitude), phase)| [frequency, amplitude, phase]);
        Ok(Self {
            rows: rows.collect(),
            is_minimum_phase,
        })
    }

    /// Whether the phases were computed from the amplitudes.
    pub fn is_minimum_phase(&self) -> bool {
        self.is_minimum_phase
    }

    pub(super) fn limits_hz(&self) -> [f64; 2] {
        [self.rows[0][0], self.rows[self.rows.len() - 1][0]]
    }

    pub(super) fn at(&self, frequency_hz: f64) -> Complex64 {
        let [first, last] = self.limits_hz();
        if !(first..=last).contains(&frequency_hz) {
            return Complex64::default();
        }
        let next = self.rows.partition_point(|row| row[0] <= frequency_hz);
        let next = next.min(self.rows.len() - 1);
        let (a, b) = (self.rows[next - 1], self.rows[next]);
        let part = (frequency_hz - a[0]) / (b[0] - a[0]);
        let [amplitude, phase] = [1, 2].map(|i| a[i] + part * (b[i] - a[i]));
        Complex64::from_polar(amplitude, phase)
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
    if let Some(row) = amplitudes.iter().position(|&amplitude| amplitude == 0.0) {
        let sentence = format!(
            "response.amplitude = 0 at {} Hz is outside (0, inf): without a column of phases the response is minimum phase, which requires positive amplitudes; remove the row or add the phases",
            number(frequencies_hz[row])
        );
        return Err(ResponseError::new("response.amplitude", 0.0, sentence));
    }
    let lines = frequencies_hz.windows(2).zip(amplitudes.windows(2));
    let slopes = lines.map(|(f, a)| (a[1] / a[0]).ln() / (f[1] - f[0]));
    let mut bends = vec![0.0; frequencies_hz.len()];
    for (i, slope) in slopes.enumerate() {
        bends[i] -= slope;
        bends[i + 1] += slope;
    }
    let entropy = |x: f64| if x == 0.0 { 0.0 } else { x * x.abs().ln() };
    let phase = |f: &f64| {
        let each = frequencies_hz.iter().zip(&bends);
        let each = each.map(|(g, bend)| bend * (entropy(g + f) - entropy(g - f)));
        each.sum::<f64>() / PI
    };
    Ok(frequencies_hz.iter().map(phase).collect())
}
