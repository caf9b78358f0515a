//! Types of values.

use crate::bytes::Cursor;
use crate::error::{HdfError, damaged};
use std::fmt;

/// A type of values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// IEEE 754, of 4 or 8 bytes.
    Float {
        /// Bytes.
        bytes: usize,
        /// Most significant byte first.
        big_endian: bool,
    },
    /// A whole number of 1, 2, 4 or 8 bytes.
    Integer {
        /// Bytes.
        bytes: usize,
        /// Two's complement.
        signed: bool,
        /// Most significant byte first.
        big_endian: bool,
    },
    /// A text of any length.
    Text,
    /// A text of a fixed length.
    FixedText {
        /// Bytes.
        bytes: usize,
    },
    /// Something else.
    Other {
        /// Its class in HDF5.
        class: u8,
        /// Bytes.
        bytes: usize,
    },
}

impl Kind {
    pub(crate) fn parse(at: &mut Cursor<'_>) -> Result<Self, HdfError> {
        let first = at.u8()?;
        let (class, version) = (first & 0x0f, first >> 4);
        if !(1..=4).contains(&version) {
            return Err(damaged(format!("a type of version {version}")));
        }
        let bits = at.number(3)?;
        let bytes = at.u32()? as usize;
        let other = Self::Other { class, bytes };
        Ok(match class {
            0 => {
                let (offset, precision) = (at.u16()?, at.u16()?);
                let whole = offset == 0 && usize::from(precision) == 8 * bytes;
                if !whole || !matches!(bytes, 1 | 2 | 4 | 8) {
                    return Ok(other);
                }
                Self::Integer {
                    bytes,
                    signed: bits & 0x08 != 0,
                    big_endian: bits & 1 != 0,
                }
            }
            1 => float(at, bits, bytes)?.unwrap_or(other),
            3 => Self::FixedText { bytes },
            9 if bits & 0x0f == 1 && bytes == 16 => Self::Text,
            _ => other,
        })
    }

    /// Bytes of one value in the file.
    #[must_use]
    pub fn bytes(self) -> usize {
        match self {
            Self::Text => 16,
            Self::Float { bytes, .. }
            | Self::Integer { bytes, .. }
            | Self::FixedText { bytes }
            | Self::Other { bytes, .. } => bytes,
        }
    }

    /// Whether values are numbers, and read as 64-bit floats.
    #[must_use]
    pub fn is_number(self) -> bool {
        matches!(self, Self::Float { .. } | Self::Integer { .. })
    }
}

/// IEEE 754 and nothing else.
fn float(at: &mut Cursor<'_>, bits: u64, bytes: usize) -> Result<Option<Kind>, HdfError> {
    let (offset, precision) = (at.u16()?, at.u16()?);
    let fields = [at.u8()?, at.u8()?, at.u8()?, at.u8()?];
    let bias = at.u32()?;
    let (wanted, sign, expected_bias) = match bytes {
        4 => ([23, 8, 0, 23], 31, 127),
        8 => ([52, 11, 0, 52], 63, 1023),
        _ => return Ok(None),
    };
    let ieee = offset == 0
        && usize::from(precision) == 8 * bytes
        && fields == wanted
        && bias == expected_bias
        && bits >> 8 & 0xff == sign
        && bits >> 4 & 3 == 2;
    let order = bits & 0x41;
    Ok((ieee && order < 2).then_some(Kind::Float {
        bytes,
        big_endian: order == 1,
    }))
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let order = |big: &bool| if *big { ", big-endian" } else { "" };
        match self {
            Self::Float { bytes, big_endian } => {
                write!(f, "{}-bit float{}", 8 * bytes, order(big_endian))
            }
            Self::Integer {
                bytes,
                signed,
                big_endian,
            } => {
                let sign = if *signed { "" } else { "unsigned " };
                write!(f, "{}-bit {sign}integer{}", 8 * bytes, order(big_endian))
            }
            Self::Text => write!(f, "text"),
            Self::FixedText { bytes } => write!(f, "text of {bytes} bytes"),
            Self::Other { class, bytes } => write!(f, "HDF5's class {class} of {bytes} bytes"),
        }
    }
}

/// Numbers that are read as they are.
pub trait Number: Copy {
    /// Their type.
    const KIND: Kind;

    /// From its bytes, as many as the type has.
    fn read(bytes: &[u8]) -> Self;
}

macro_rules! number {
    ($type:ty, $kind:expr) => {
        impl Number for $type {
            const KIND: Kind = $kind;

            #[inline]
            fn read(bytes: &[u8]) -> Self {
                let mut word = [0; size_of::<Self>()];
                word.copy_from_slice(bytes);
                Self::from_le_bytes(word)
            }
        }
    };
}

number!(
    f32,
    Kind::Float {
        bytes: 4,
        big_endian: false
    }
);
number!(
    f64,
    Kind::Float {
        bytes: 8,
        big_endian: false
    }
);
number!(
    u64,
    Kind::Integer {
        bytes: 8,
        signed: false,
        big_endian: false
    }
);

number!(
    u32,
    Kind::Integer {
        bytes: 4,
        signed: false,
        big_endian: false
    }
);
number!(
    u8,
    Kind::Integer {
        bytes: 1,
        signed: false,
        big_endian: false
    }
);
number!(
    i32,
    Kind::Integer {
        bytes: 4,
        signed: true,
        big_endian: false
    }
);

/// Any number as a 64-bit float.
pub(crate) fn as_f64(kind: Kind, bytes: &[u8]) -> Option<f64> {
    let mut word = [0_u8; 8];
    let width = kind.bytes();
    let (big, signed) = match kind {
        Kind::Float { big_endian, .. } => (big_endian, false),
        Kind::Integer {
            big_endian, signed, ..
        } => (big_endian, signed),
        Kind::Text | Kind::FixedText { .. } | Kind::Other { .. } => return None,
    };
    word.get_mut(..width)?.copy_from_slice(bytes.get(..width)?);
    if big {
        word[..width].reverse();
    }
    let value = u64::from_le_bytes(word);
    Some(match kind {
        Kind::Float { bytes: 4, .. } => f64::from(f32::from_bits(value as u32)),
        Kind::Float { .. } => f64::from_bits(value),
        _ if signed => {
            let shift = 64 - 8 * width;
            ((value << shift) as i64 >> shift) as f64
        }
        _ => value as f64,
    })
}
