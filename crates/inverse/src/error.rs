//! Values with errors, and why traces do not determine a force.

use fault::{Class, Culprit, Fault, rounded};
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
    #[error("{key} = {} is outside {range}", fault::number(*value))]
    Range {
        /// What it is.
        key: &'static str,
        /// Its value.
        value: f64,
        /// The allowed values.
        range: &'static str,
    },
    /// There is nothing to work on.
    #[error("{key} is empty: pass at least {least}")]
    Few {
        /// What is missing.
        key: &'static str,
        /// Fewest that are needed.
        least: usize,
    },
    /// A sample that is not a number.
    #[error(
        "sample {sample} of {what} {index} is {value}: remove or interpolate samples that are not finite"
    )]
    NotFinite {
        /// Trace, response or drop.
        what: &'static str,
        /// Index of the trace.
        index: usize,
        /// Index of the sample.
        sample: usize,
        /// Its value.
        value: f64,
    },
    /// Two lengths that do not fit.
    #[error(
        "{what} {index} has {found} samples, but {needed} are needed: resample both to the same step and length"
    )]
    Length {
        /// Response or drop.
        what: &'static str,
        /// Index of the trace.
        index: usize,
        /// Samples there.
        found: usize,
        /// Samples needed.
        needed: usize,
    },
    /// No noise.
    #[error(
        "trace {index} has {found} quiet samples before the first arrival, fewer than the {least} from which noise can be measured: record more before the trigger, or pass the standard deviation of the noise"
    )]
    NoQuiet {
        /// Index of the trace.
        index: usize,
        /// Quiet samples.
        found: usize,
        /// Fewest.
        least: usize,
    },
    /// A beginning that is not at rest.
    #[error(
        "trace {index} begins under load: its first samples are at {} of the noise; begin before the blow, or subtract the offset of the quiet part", rounded(*ratio)
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
        "the quiet part of trace {index} ends at {} s, but the first wave of the blow arrives at {} s: end the quiet part before, or pass the standard deviation of the noise", rounded(*quiet_s), rounded(*arrival_s)
    )]
    QuietMoves {
        /// Index of the trace.
        index: usize,
        /// End of the quiet part in s.
        quiet_s: f64,
        /// First arrival in s.
        arrival_s: f64,
    },
    /// Nothing but noise.
    #[error(
        "no blow stands out of the noise: the best pulse is {} times its own uncertainty, fewer than {}; average repeated drops, or move the sensor closer", rounded(*found), rounded(*least)
    )]
    Noisy {
        /// Peak of the best pulse over its standard deviation.
        found: f64,
        /// Least.
        least: f64,
    },
    /// No trace has a scale.
    #[error(
        "no gain is known, so only the shape of the force could be found: pass the gain of one trace or the impulse"
    )]
    NoScale,
    /// Repeated drops that differ.
    #[error(
        "drop {index} resembles the others by a correlation of {}, below {}: remove it, or average drops of the same ball, height and place only", rounded(*found), rounded(*least)
    )]
    Unlike {
        /// Index of the drop.
        index: usize,
        /// Correlation with the mean.
        found: f64,
        /// Least.
        least: f64,
    },
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
            Self::Range { key, value, range } => culprit.key(key).number(*value).range(range),
            Self::Few { key, .. } => culprit.key(key),
            Self::NotFinite { what, value, .. } => culprit.key(what).number(*value),
            Self::Length { what, found, .. } => culprit.key(what).number(*found as f64),
            Self::NoQuiet { found, .. } => culprit.key("noise").number(*found as f64),
            Self::UnderLoad { ratio, .. } => culprit.key("trace").number(*ratio),
            Self::StartNotShown => culprit.key("trace"),
            Self::NotShown { wanted_s, .. } => culprit.key("window_s").number(*wanted_s),
            Self::QuietMoves { quiet_s, .. } => culprit.key("noise").number(*quiet_s),
            Self::Noisy { found, .. } => culprit.key("trace").number(*found),
            Self::NoScale => culprit.key("gain"),
            Self::Unlike { found, .. } => culprit.key("trace").number(*found),
            Self::NotSolved => Culprit::of(Class::Work),
        }
    }
}

/// Rejects a number outside a range.
pub(crate) fn check(
    good: bool,
    key: &'static str,
    value: f64,
    range: &'static str,
) -> Result<(), InverseError> {
    if good {
        Ok(())
    } else {
        Err(InverseError::Range { key, value, range })
    }
}

/// Rejects samples that are not finite.
pub(crate) fn check_finite(
    what: &'static str,
    index: usize,
    samples: &[f64],
) -> Result<(), InverseError> {
    match samples.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(sample) => Err(InverseError::NotFinite {
            what,
            index,
            sample,
            value: samples[sample],
        }),
    }
}
