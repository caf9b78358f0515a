//! Values with errors, and why traces do not determine a force.

use fault::{Class, Culprit, Fault, number, rounded};
use thiserror::Error;

/// A value with its standard deviation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Its standard deviation, in the same unit.
    pub sd: f64,
}

/// Why traces do not determine a force.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InverseError {
    /// A number outside its range.
    #[error("{key} = {} is outside {range}{remedy}", number(*value))]
    Range {
        /// What it is.
        key: String,
        /// Its value.
        value: f64,
        /// The allowed values.
        range: String,
        /// What to do, after a colon, where the range does not say it.
        remedy: &'static str,
    },
    /// A beginning that is not at rest.
    #[error(
        "trace {} begins under load: its first samples are {} times the noise; begin before the blow, or subtract the offset of the quiet part", index + 1, rounded(*ratio)
    )]
    UnderLoad {
        /// Index of the trace.
        index: usize,
        /// Mean of the beginning over the standard deviation of the noise.
        ratio: f64,
    },
    /// The wave of the start is not in a trace, or the response is another one.
    #[error(
        "the traces do not show the start of the blow: no pulse whose first wave is in them explains them; begin the traces earlier, pass a longer lead, or check the response and its sign"
    )]
    StartNotShown,
    /// Part of the force is not in a trace.
    #[error(
        "the force until {} s is not in the traces: they are valid until {} s, which shows forces until {} s; shorten the window, or move the sensor closer", rounded(*wanted_s), rounded(*valid_s), rounded(*shown_s)
    )]
    NotShown {
        /// End of the window or of the fitted pulse in s.
        wanted_s: f64,
        /// Time until which the traces are valid in s.
        valid_s: f64,
        /// End of the force that has a wave in them in s.
        shown_s: f64,
    },
    /// Waves in the quiet part.
    #[error(
        "the quiet part of trace {} ends at {} s, but the first wave of the blow arrives at {} s: end the quiet part before, or pass the standard deviation of the noise", index + 1, rounded(*quiet_s), rounded(*arrival_s)
    )]
    QuietMoves {
        /// Index of the trace.
        index: usize,
        /// End of the quiet part in s.
        quiet_s: f64,
        /// First arrival in s.
        arrival_s: f64,
    },
    /// No trace has a scale.
    #[error(
        "no gain is known, so only the shape of the force could be found: pass the gain of one trace or the impulse"
    )]
    NoScale,
    /// Rounding prevents a solution.
    #[error(
        "the force could not be computed: the responses are too similar for double precision; shorten the window or use a coarser force step"
    )]
    NotSolved,
}

impl Fault for InverseError {
    fn culprit(&self) -> Culprit<'_> {
        let culprit = Culprit::of(Class::Scene);
        match self {
            Self::Range {
                key, value, range, ..
            } => culprit.key(key).number(*value).range(range),
            Self::UnderLoad { ratio, .. } => culprit.key("trace").number(*ratio),
            Self::StartNotShown => culprit.key("trace"),
            Self::NotShown { wanted_s, .. } => culprit.key("window_s").number(*wanted_s),
            Self::QuietMoves { quiet_s, .. } => culprit.key("noise").number(*quiet_s),
            Self::NoScale => culprit.key("gain"),
            Self::NotSolved => Culprit::of(Class::Work),
        }
    }
}

/// The error of a number outside a range.
pub(crate) fn outside(
    key: impl Into<String>,
    value: f64,
    range: impl Into<String>,
    remedy: &'static str,
) -> InverseError {
    InverseError::Range {
        key: key.into(),
        value,
        range: range.into(),
        remedy,
    }
}

/// Rejects a number outside a range.
pub(crate) fn check(good: bool, key: &str, value: f64, range: &str) -> Result<(), InverseError> {
    if good {
        Ok(())
    } else {
        Err(outside(key, value, range, ""))
    }
}

/// Rejects a number that is not positive and finite.
pub(crate) fn positive(key: &str, value: f64) -> Result<(), InverseError> {
    check(value > 0.0 && value.is_finite(), key, value, "(0, inf)")
}

/// Rejects samples that are not finite.
pub(crate) fn finite(what: &str, samples: &[f64]) -> Result<(), InverseError> {
    let found = samples.iter().position(|x| !x.is_finite());
    found.map_or(Ok(()), |i| {
        let key = format!("sample {i} of {what}");
        Err(outside(
            key,
            samples[i],
            "(-inf, inf)",
            ": remove or interpolate such samples",
        ))
    })
}
