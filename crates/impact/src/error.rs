//! Errors of an impact and of its fields.

use crate::response::ResponseError;
use contact::ContactError;
use fault::{AnyError, Class, Culprit, Fault};
use halfspace::DomainError;
use lookup::LookupError;
use thiserror::Error;

/// Errors of a scene.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImpactError {
    /// The contact failed.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The contact failed, and the numbers of the bodies look implausible.
    #[error("{error}; {}", doubts.join("; "))]
    Doubtful {
        /// Error of the contact.
        error: ContactError,
        /// Implausible numbers.
        doubts: Vec<String>,
    },
    /// The table could not be loaded.
    #[error("{0}")]
    Table(AnyError),
    /// A point is outside the table.
    #[error(
        "probe r = {} m, z = {} m with disc radius {} m: {source}",
        fault::rounded(*r_m), fault::rounded(*z_m), fault::rounded(*disc_radius_m)
    )]
    OutsideTable {
        /// Distance from the axis in m.
        r_m: f64,
        /// Depth in m.
        z_m: f64,
        /// Unit of length in m.
        disc_radius_m: f64,
        /// Error of the table.
        source: LookupError,
    },
    /// A point is outside the half-space.
    #[error(
        "probe r = {} m, z = {} m: {source}",
        fault::rounded(*r_m), fault::rounded(*z_m)
    )]
    OutsideBlock {
        /// Distance from the axis in m.
        r_m: f64,
        /// Depth in m.
        z_m: f64,
        /// Error of the kernel.
        source: DomainError,
    },
    /// The scene has no section with rows.
    #[error("the scene has no [striker] or no [map]: its section has no rows")]
    NoRows,
    /// Too many samples.
    #[error(
        "the output needs {samples:.3e} samples of {step_s:.3e} s, more than {limit}: use a larger step_s or a smaller duration_s"
    )]
    TooManySamples {
        /// Samples needed.
        samples: f64,
        /// Their step in s.
        step_s: f64,
        /// Samples allowed.
        limit: usize,
    },
    /// Too little memory.
    #[error(
        "the scene needs about {needed_gb:.3} GB of memory, more than the {limit_gb:.3} GB allowed ({points} points, {} samples, {frames} frames): use {change}",
        fault::number(*samples)
    )]
    TooMuchMemory {
        /// Needed in GB.
        needed_gb: f64,
        /// Allowed in GB.
        limit_gb: f64,
        /// Points with fields.
        points: usize,
        /// Samples of the output in time.
        samples: f64,
        /// Frames of the section.
        frames: usize,
        /// Advice on the settings to change.
        change: &'static str,
    },
    /// A frame of the section later than the output.
    #[error(
        "map.times_s = {} is outside [0, {}], the times of the output: set output.duration_s",
        fault::number(*wanted_s),
        fault::number(*end_s)
    )]
    LateFrame {
        /// Its time in s.
        wanted_s: f64,
        /// Last time of the output in s.
        end_s: f64,
    },
    /// Kernels of a table for a block with attenuation.
    #[error(
        "target.quality_factor = {}: a kernel table is of an elastic block; remove the key or compute the kernels",
        fault::rounded(*quality_factor)
    )]
    DampedTable {
        /// The quality factor.
        quality_factor: f64,
    },
    /// An output in which the echoes of a plate cannot be computed to the end.
    #[error(
        "output.duration_s = {} is outside (0, {}]: after 16 transits of the plate no digit of its echoes is left; use a smaller duration_s, and the modes of the plate (Rayleigh-Lamb) for later times",
        fault::number(*duration_s),
        fault::rounded(*latest_s)
    )]
    LateEchoes {
        /// Requested duration in s.
        duration_s: f64,
        /// The longest in s.
        latest_s: f64,
    },
    /// A low pass that the output does not resolve.
    #[error(
        "output.low_pass_hz = {} is outside ({}, {}), from one over the duration of the output to half of its sampling rate: use a smaller contact.step_s for a higher cutoff, a larger output.duration_s for a lower one",
        fault::number(*cutoff_hz),
        fault::rounded(limits[0]),
        fault::rounded(limits[1])
    )]
    LowPass {
        /// Cutoff in Hz.
        cutoff_hz: f64,
        /// The lowest and the highest in Hz.
        limits: [f64; 2],
    },
    /// The caller has cancelled the scene after its forecast.
    #[error("the scene was cancelled before it began: it would take about {seconds:.1e} s")]
    GivenUp {
        /// Time in s.
        seconds: f64,
    },
    /// The response of a sensor does not fit its history.
    #[error(transparent)]
    Response(ResponseError),
    /// A result that is not finite.
    #[error(
        "{quantity} is {value}: the numbers of the scene exceed the range of floating-point numbers; check their units"
    )]
    NotFinite {
        /// Name of the result.
        quantity: String,
        /// Its value.
        value: f64,
    },
    /// A number outside its physical range.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// A record without the disc that it loads.
    #[error("a force record requires the radius of the loaded disc: set disc_radius_m")]
    NoDisc,
    /// A disc so large for the record that rounding errors would dominate.
    #[error(
        "disc_radius_m = {} is outside (0, {largest_m:.3e}]: in a larger disc waves would cross only a tiny part during the record",
        fault::number(*radius_m)
    )]
    TooWide {
        /// Radius of the disc in m.
        radius_m: f64,
        /// The largest for this record in m.
        largest_m: f64,
    },
}

/// Rejects numbers that are not finite.
pub(crate) fn finite(
    quantity: impl Fn() -> String,
    numbers: impl IntoIterator<Item = f64>,
) -> Result<(), ImpactError> {
    match numbers.into_iter().find(|x| !x.is_finite()) {
        None => Ok(()),
        Some(value) => Err(ImpactError::NotFinite {
            quantity: quantity(),
            value,
        }),
    }
}

impl Fault for ImpactError {
    fn culprit(&self) -> Culprit<'_> {
        let culprit = Culprit::of(Class::Impact);
        match self {
            Self::Contact(error) | Self::Doubtful { error, .. } => of_contact(error),
            Self::Table(fault) => of_table(fault),
            Self::OutsideTable { source, .. } => source.culprit(),
            Self::Response(source) => source.culprit(),
            Self::OutsideBlock { source, .. } | Self::Domain(source) => source.culprit(),
            Self::TooMuchMemory { .. } => Culprit::of(Class::Memory),
            Self::TooManySamples { .. } | Self::GivenUp { .. } | Self::NotFinite { .. } => culprit,
            Self::NoDisc => culprit.key("disc_radius_m"),
            Self::NoRows => culprit.key("map"),
            Self::LateFrame { wanted_s, end_s } => Culprit {
                limits: Some([0.0, *end_s]),
                ..culprit.key("map.times_s").number(*wanted_s)
            },
            Self::LateEchoes {
                duration_s,
                latest_s,
            } => Culprit {
                limits: Some([0.0, *latest_s]),
                ..culprit.key("output.duration_s").number(*duration_s)
            },
            Self::DampedTable { quality_factor } => {
                culprit.key("target.quality_factor").number(*quality_factor)
            }
            Self::LowPass { cutoff_hz, limits } => Culprit {
                limits: Some(*limits),
                ..culprit.key("output.low_pass_hz").number(*cutoff_hz)
            },
            Self::TooWide {
                radius_m,
                largest_m,
            } => Culprit {
                limits: Some([0.0, *largest_m]),
                ..culprit.key("disc_radius_m").number(*radius_m)
            },
        }
    }
}

fn of_contact(error: &ContactError) -> Culprit<'_> {
    use contact::MarchError as M;
    let culprit = Culprit::of(Class::Impact);
    match error {
        ContactError::March(
            M::NoSolution { .. } | M::TooLong { .. } | M::NotConverged { .. } | M::Unstable { .. },
        ) => culprit.unmendable(),
        ContactError::TooFast { velocity_m_s, .. }
        | ContactError::NoRebound { velocity_m_s, .. } => {
            culprit.key("velocity_m_s").number(*velocity_m_s)
        }
        ContactError::OutOfRange { quantity, value } => {
            // combinations of several keys are described in words
            let is_key = !quantity.contains(' ');
            let culprit = culprit.number(*value).range("[1e-30, 1e30]");
            if is_key {
                culprit.key(quantity)
            } else {
                culprit
            }
        }
        _ => culprit,
    }
}

/// A table that could not be loaded is always an input that can be changed.
#[cfg_attr(not(feature = "hdf5"), allow(unused_variables))]
fn of_table(fault: &AnyError) -> Culprit<'_> {
    let culprit = Culprit::of(Class::Table);
    #[cfg(feature = "hdf5")]
    if let Some(lookup::TableError { path, .. }) = fault.downcast_ref() {
        return culprit.file(path);
    }
    culprit
}
