//! Errors of the content of a table, and of lookups in it.

use fault::{Class, Culprit, Fault};
use halfspace::DomainError;
use thiserror::Error;

/// Invalid content of a table; the error of a file, [`TableError`](crate::TableError), adds the path.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ContentError {
    /// A list whose length does not fit the axes, or a value that is not allowed; the message contains the place and
    /// the allowed range.
    #[error("{0}")]
    Wrong(String),
    /// Poisson's ratio of a slice is outside the physics.
    #[error(transparent)]
    Domain(#[from] DomainError),
}

/// Error of a list whose length does not fit the axes.
pub(crate) fn shape(item: &str, needed: usize, found: usize) -> ContentError {
    ContentError::Wrong(format!("{item} has {found} values, needed {needed}"))
}

/// Error of a value of a dataset or attribute that is not allowed.
pub(crate) fn value(item: &str, value: f64, range: &str) -> ContentError {
    ContentError::Wrong(format!("{item} = {value}, allowed: {range}"))
}

/// A lookup outside the range of a table.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LookupError {
    /// The point lies outside the table.
    #[error("{axis} = {value} is outside the table's range [{}, {}]", .limits[0], .limits[1])]
    Outside {
        /// `r/r0`, `z/r0` or `poisson_ratio`.
        axis: &'static str,
        /// Requested value.
        value: f64,
        /// Smallest and largest value in the table.
        limits: [f64; 2],
    },
    /// Time cells wider than any table can have.
    #[error("coarsening = {value} is outside [0, {max}]")]
    Coarsening {
        /// Requested value.
        value: u32,
        /// Largest value allowed.
        max: u32,
    },
    /// The output slices of a batch do not fit the points.
    #[error(
        "{points} points with room for {infos} results and {cells} cells: needed are {points} results and a multiple of {points} cells"
    )]
    Lengths {
        /// Number of points.
        points: usize,
        /// Length of `infos`.
        infos: usize,
        /// Length of `cells`.
        cells: usize,
    },
    /// The pulse of an error estimate has no positive length.
    #[error("pulse_length = {value} is outside (0, inf)")]
    PulseLength {
        /// Requested value.
        value: f64,
    },
    /// The static field is not defined at the point.
    #[error(transparent)]
    Domain(#[from] DomainError),
}

impl LookupError {
    pub(crate) fn outside(axis: &'static str, value: f64, limits: [f64; 2]) -> Self {
        Self::Outside {
            axis,
            value,
            limits,
        }
    }
}

impl Fault for LookupError {
    fn culprit(&self) -> Culprit<'_> {
        let outside = |axis, number, limits| Culprit {
            limits: Some(limits),
            ..Culprit::of(Class::OutsideTable).key(axis).number(number)
        };
        match self {
            Self::Outside {
                axis,
                value,
                limits,
            } => outside(*axis, *value, *limits),
            Self::Coarsening { value, max } => {
                outside("coarsening", f64::from(*value), [0.0, f64::from(*max)])
            }
            Self::PulseLength { value } => outside("pulse_length", *value, [0.0, f64::INFINITY]),
            Self::Domain(error) => error.culprit(),
            Self::Lengths { .. } => Culprit::of(Class::Work),
        }
    }
}
