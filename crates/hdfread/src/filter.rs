//! What a chunk went through before it was written: shuffling, compression, a checksum.

use crate::bytes::Cursor;
use crate::error::{HdfError, damaged, unsupported};
use miniz_oxide::inflate::TINFLStatus;
use miniz_oxide::inflate::core::inflate_flags::{
    TINFL_FLAG_COMPUTE_ADLER32, TINFL_FLAG_PARSE_ZLIB_HEADER,
    TINFL_FLAG_USING_NON_WRAPPING_OUTPUT_BUF,
};
use miniz_oxide::inflate::core::{DecompressorOxide, decompress};

/// One step, in the order of writing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Filter {
    /// zlib.
    Deflate,
    /// Bytes of the same significance together, for values of so many bytes.
    Shuffle(usize),
    /// Four bytes of Fletcher's sum at the end.
    Fletcher32,
}

/// Filters of a dataset at most.
const MOST: u8 = 8;

/// What deflate can make of a byte at most, with some to spare for short chunks.
const MOST_GROWTH: usize = 1032;
const SPARE: usize = 1024;

/// The filters of a dataset's message.
pub(crate) fn parse(message: &[u8]) -> Result<Vec<Filter>, HdfError> {
    let mut at = Cursor::new(message, "a dataset's filters");
    let (version, count) = (at.u8()?, at.u8()?);
    if !(1..=2).contains(&version) || count > MOST {
        return Err(damaged(format!("{count} filters of version {version}")));
    }
    at.skip(if version == 1 { 6 } else { 0 })?;
    (0..count).map(|_| filter(&mut at, version)).collect()
}

fn filter(at: &mut Cursor<'_>, version: u8) -> Result<Filter, HdfError> {
    let id = at.u16()?;
    let named = version == 1 || id >= 256;
    let name = if named { usize::from(at.u16()?) } else { 0 };
    at.skip(2)?;
    let values = usize::from(at.u16()?);
    at.skip(if version == 1 {
        name.next_multiple_of(8)
    } else {
        name
    })?;
    let mut data = Cursor::new(at.take(4 * values)?, "a filter");
    at.skip(if version == 1 && values % 2 == 1 {
        4
    } else {
        0
    })?;
    match id {
        1 => Ok(Filter::Deflate),
        2 => Ok(Filter::Shuffle(data.u32()? as usize)),
        3 => Ok(Filter::Fletcher32),
        _ => Err(unsupported(format!("data that went through filter {id}"))),
    }
}

/// The `wanted` bytes of a chunk from what is stored of it; `skipped` has a bit for each filter that was not applied.
pub(crate) fn undo(
    filters: &[Filter],
    skipped: u32,
    stored: Vec<u8>,
    wanted: usize,
) -> Result<Vec<u8>, HdfError> {
    let mut bytes = stored;
    for (index, filter) in filters.iter().enumerate().rev() {
        if skipped >> index & 1 == 1 {
            continue;
        }
        bytes = match filter {
            Filter::Fletcher32 => checked(bytes)?,
            Filter::Deflate => {
                let sums = filters[..index]
                    .iter()
                    .filter(|f| **f == Filter::Fletcher32);
                inflated(&bytes, wanted + 4 * sums.count())?
            }
            Filter::Shuffle(width) => unshuffled(&bytes, *width),
        };
    }
    if bytes.len() == wanted {
        Ok(bytes)
    } else {
        let found = bytes.len();
        Err(damaged(format!(
            "a chunk has {found} bytes, needed {wanted}"
        )))
    }
}

/// Exactly `wanted` bytes of a zlib stream: more are never taken room for.
fn inflated(stream: &[u8], wanted: usize) -> Result<Vec<u8>, HdfError> {
    let explained = stream
        .len()
        .saturating_mul(MOST_GROWTH)
        .saturating_add(SPARE);
    if wanted > explained {
        let found = stream.len();
        return Err(damaged(format!(
            "{found} bytes cannot be a chunk of {wanted}"
        )));
    }
    let mut bytes = vec![0; wanted];
    let flags = TINFL_FLAG_PARSE_ZLIB_HEADER
        | TINFL_FLAG_USING_NON_WRAPPING_OUTPUT_BUF
        | TINFL_FLAG_COMPUTE_ADLER32;
    let mut state = Box::<DecompressorOxide>::default();
    let (status, _, written) = decompress(&mut state, stream, &mut bytes, 0, flags);
    if status == TINFLStatus::Done && written == wanted {
        Ok(bytes)
    } else {
        Err(damaged("a chunk cannot be decompressed"))
    }
}

/// The bytes without their sum, if it is right.
fn checked(mut bytes: Vec<u8>) -> Result<Vec<u8>, HdfError> {
    let Some(length) = bytes.len().checked_sub(4) else {
        return Err(damaged("a chunk is shorter than its checksum"));
    };
    let mut word = [0; 4];
    word.copy_from_slice(&bytes[length..]);
    bytes.truncate(length);
    if fletcher32(&bytes) == u32::from_le_bytes(word) {
        Ok(bytes)
    } else {
        Err(damaged("the checksum of a chunk is not that of its bytes"))
    }
}

/// Fletcher's sum as the HDF5 library takes it: over words of two bytes, the first the more significant.
fn fletcher32(bytes: &[u8]) -> u32 {
    let fold = |sum: u32| (sum & 0xffff) + (sum >> 16);
    let (mut low, mut high) = (0_u32, 0_u32);
    for part in bytes.chunks(2 * 360) {
        for word in part.chunks_exact(2) {
            low += u32::from(word[0]) << 8 | u32::from(word[1]);
            high += low;
        }
        if let [last] = part.chunks_exact(2).remainder() {
            // the library folds before the odd byte, which is in the last part
            (low, high) = (fold(low), fold(high));
            low += u32::from(*last) << 8;
            high += low;
        }
        (low, high) = (fold(low), fold(high));
    }
    fold(high) << 16 | fold(low)
}

/// Bytes of a value together again.
fn unshuffled(bytes: &[u8], width: usize) -> Vec<u8> {
    let count = bytes.len().checked_div(width).unwrap_or(0);
    if width < 2 || count < 2 {
        return bytes.to_vec();
    }
    let mut values = vec![0; bytes.len()];
    for (place, plane) in bytes.chunks_exact(count).take(width).enumerate() {
        for (value, &byte) in values.chunks_exact_mut(width).zip(plane) {
            value[place] = byte;
        }
    }
    let whole = count * width;
    values[whole..].copy_from_slice(&bytes[whole..]);
    values
}
