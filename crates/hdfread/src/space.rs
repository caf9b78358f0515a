//! Dimensions.

use crate::bytes::Cursor;
use crate::error::{HdfError, damaged, unsupported};

/// Dimensions at most, as in HDF5.
pub(crate) const MOST_DIMENSIONS: usize = 32;

/// Dimensions of a dataset or an attribute.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Space {
    /// One value.
    Scalar,
    /// A block of values.
    Simple(Vec<usize>),
}

impl Space {
    pub(crate) fn parse(at: &mut Cursor<'_>) -> Result<Self, HdfError> {
        let version = at.u8()?;
        let (rank, _flags) = (usize::from(at.u8()?), at.u8()?);
        let class = match version {
            1 => {
                at.skip(5)?;
                u8::from(rank > 0)
            }
            2 => at.u8()?,
            _ => return Err(damaged(format!("dimensions of version {version}"))),
        };
        if rank > MOST_DIMENSIONS {
            return Err(damaged(format!("{rank} dimensions")));
        }
        match (class, rank) {
            (0, 0) => Ok(Self::Scalar),
            (1, _) => Ok(Self::Simple(
                (0..rank).map(|_| at.size()).collect::<Result<_, _>>()?,
            )),
            (2, _) => Err(unsupported("data without dimensions")),
            _ => Err(damaged(format!("dimensions of class {class}"))),
        }
    }

    /// Dimensions; none of a single value.
    pub(crate) fn shape(&self) -> &[usize] {
        match self {
            Self::Scalar => &[],
            Self::Simple(shape) => shape,
        }
    }
}

/// The product, or more than any list has where it is more than a number holds.
pub(crate) fn product(factors: &[usize]) -> usize {
    factors.iter().fold(1, |all, &x| all.saturating_mul(x))
}
