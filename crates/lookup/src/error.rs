//! What can be wrong with the content of a table, and what can be wrong with a question to it.

use fault::{Class, Culprit, Fault};
use halfspace::DomainError;
use thiserror::Error;

/// Numbers that are no table; a file's error ([`TableError`](crate::TableError)) adds the path.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ContentError {
    /// A list has another length than the axes demand, or a value may not be there: where and what is allowed.
    #[error("{0}")]
    Wrong(String),
    /// Poisson's ratio of a slice is outside the physics.
    #[error(transparent)]
    Domain(#[from] DomainError),
}

/// The error of a list that has another length than the axes demand.
pub(crate) fn shape(item: &str, needed: usize, found: usize) -> ContentError {
    ContentError::Wrong(format!("{item} has {found} values, needed {needed}"))
}

/// The error of a value of a dataset or an attribute that may not be there.
pub(crate) fn value(item: &str, value: f64, range: &str) -> ContentError {
    ContentError::Wrong(format!("{item} = {value}, allowed: {range}"))
}

/// A question that a table cannot answer.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LookupError {
    /// The point lies outside the table.
    #[error("{axis} = {value} is outside the table's range [{}, {}]", .limits[0], .limits[1])]
    Outside {
        /// `r/r0`, `z/r0` or `poisson_ratio`.
        axis: &'static str,
        /// The value asked for.
        value: f64,
        /// Smallest and largest value that the table serves.
        limits: [f64; 2],
    },
    /// Time cells beyond anything that a table can hold.
    #[error("coarsening = {value} is outside [0, {max}]")]
    Coarsening {
        /// The value asked for.
        value: u32,
        /// Largest value allowed.
        max: u32,
    },
    /// The slices for the results of a batch do not fit the points.
    #[error(
        "{points} points with memory for {infos} results and {cells} cells: needed as many results as points and a multiple of cells"
    )]
    Lengths {
        /// Points asked for.
        points: usize,
        /// Places for their results.
        infos: usize,
        /// Places for all their cells.
        cells: usize,
    },
    /// The pulse of an error estimate has no length.
    #[error("pulse_length = {value} is outside (0, inf)")]
    PulseLength {
        /// The value asked for.
        value: f64,
    },
    /// The static field cannot be computed there.
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
