//! The footer of a Parquet file of rows: one JSON text with a checksum of the footer.
//!
//! It is found and checked without a Parquet reader, which would trust its input.

use crate::scene::section::parse;
use crate::sweep::fields::{Precision, WrittenResults, stored_columns};
use crate::sweep::shard::{Part, Selection};
use ledger::sha256_hex;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::Path;

/// Version of the format. The first number changes when older readers would fail.
pub const FORMAT_VERSION: &str = "1.3";

/// First and last bytes of the file.
pub(crate) const MAGIC: &[u8; 4] = b"PAR1";
/// First bytes of the text: the file type, followed by the checksum.
const BEGIN: &[u8] = b"{\"file_type\":\"hertzlamb sweep";
const SEAL: &[u8] = b",\"seal\":\"";
/// Hexadecimal digits of the checksum.
pub(super) const DIGITS: usize = 64;
/// Bytes after the footer: its length and the magic number.
pub(super) const TAIL: u64 = 8;

/// The JSON text.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Footer {
    /// `hertzlamb sweep` or `hertzlamb sweep part`.
    pub(crate) file_type: String,
    /// Checksum; blank until the file is written.
    pub(super) seal: String,
    pub(crate) format_version: String,
    pub(super) software_version: String,
    /// The sweep with its base scene, as TOML.
    pub(crate) sweep: String,
    pub(super) sweep_sha256: String,
    pub(super) shard: String,
    pub(super) sweep_rows: usize,
    pub(super) first_row: usize,
    pub(super) rows: usize,
    pub(super) failed: usize,
    /// Unit and meaning of each column.
    pub(super) columns: Map<String, Value>,
    pub(super) bits: usize,
    /// SHA-256 of the bytes of each group.
    pub(crate) row_groups: Vec<String>,
    /// Bytes before the footer.
    pub(super) data_bytes: u64,
}

impl Footer {
    /// Reads the text of a file that begins like Parquet, and the description of its rows; none if the program did not
    /// write it.
    ///
    /// # Errors
    /// The defect, in a few words.
    pub(crate) fn read(path: &Path) -> Result<Option<(Self, Part)>, String> {
        let found = File::open(path).and_then(|file| footer_in(&file));
        let (bytes, length) = found.map_err(|error| error.to_string())?;
        let Some(bytes) = bytes else {
            return Err("it has no end: it was truncated".to_owned());
        };
        let Some(begin) = find(&bytes, BEGIN) else {
            return Ok(None);
        };
        let digits = seal_in(&bytes).ok_or("its footer has no checksum")?;
        if bytes[digits.clone()] != *sum_without(&bytes, &digits).as_bytes() {
            return Err("its footer was changed".to_owned());
        }
        let mut texts = serde_json::Deserializer::from_slice(&bytes[begin..]).into_iter();
        let found: Option<Self> = texts.next().and_then(Result::ok);
        let found = found.and_then(|found| Some((found.part(path)?, found)));
        let (part, found) = found.ok_or("its footer does not describe its rows")?;
        if part.selection.rows.end > part.sweep_rows {
            return Err("it has more rows than its sweep".to_owned());
        }
        if found.data_bytes.checked_add(bytes.len() as u64 + TAIL) != Some(length) {
            return Err("its length differs from the one in its footer".to_owned());
        }
        Ok(Some((found, part)))
    }

    /// All entries of the footer, as Parquet stores them.
    #[cfg(feature = "parquet")]
    pub(crate) fn bytes(path: &Path) -> io::Result<Vec<u8>> {
        Ok(footer_in(&File::open(path)?)?.0.unwrap_or_default())
    }

    fn part(&self, path: &Path) -> Option<Part> {
        let shard = match self.shard.as_str() {
            "" => None,
            shard => Some(shard.parse().ok()?),
        };
        let mut fields = WrittenResults::all(stored_columns(&parse(&self.sweep).ok()?).ok()?);
        fields.retain(|name| self.columns.contains_key(name));
        let mut precisions = [Precision::Double, Precision::Single].into_iter();
        fields.precision = precisions.find(|precision| self.bits == *precision as usize)?;
        Some(Part {
            path: path.to_owned(),
            sha256: self.sweep_sha256.clone(),
            sweep_rows: self.sweep_rows,
            selection: Selection {
                rows: self.first_row..self.first_row.checked_add(self.rows)?,
                shard,
            },
            failed: self.failed,
            fields,
            sealed: true,
        })
    }
}

/// The footer without its length and magic number, if it exists, and the length of the file.
pub(super) fn footer_in(mut file: &File) -> io::Result<(Option<Vec<u8>>, u64)> {
    let length = file.metadata()?.len();
    file.rewind()?;
    let (mut head, mut tail) = ([0; 4], [0; TAIL as usize]);
    if length < 4 + TAIL {
        return Ok((None, length));
    }
    file.read_exact(&mut head)?;
    file.seek(SeekFrom::End(-(TAIL as i64)))?;
    file.read_exact(&mut tail)?;
    let [a, b, c, d, magic @ ..] = tail;
    let size = u64::from(u32::from_le_bytes([a, b, c, d]));
    if head != *MAGIC || magic != *MAGIC || size > length - 4 - TAIL {
        return Ok((None, length));
    }
    file.seek(SeekFrom::Start(length - TAIL - size))?;
    let mut bytes = Vec::new();
    file.take(size).read_to_end(&mut bytes)?;
    Ok((Some(bytes), length))
}

/// Position of the digits of the checksum.
pub(super) fn seal_in(footer: &[u8]) -> Option<Range<usize>> {
    let begin = find(footer, BEGIN)?;
    let start = begin + find(&footer[begin..], SEAL)? + SEAL.len();
    let digits = start..start + DIGITS;
    footer.get(digits.clone()).map(|_| digits)
}

/// SHA-256 of a footer whose checksum is blank.
pub(super) fn sum_without(footer: &[u8], digits: &Range<usize>) -> String {
    sha256_hex([
        &footer[..digits.start],
        &[b'0'; DIGITS],
        &footer[digits.end..],
    ])
}

fn find(bytes: &[u8], wanted: &[u8]) -> Option<usize> {
    bytes.windows(wanted.len()).position(|part| part == wanted)
}
