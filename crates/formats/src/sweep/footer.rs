//! What a Parquet file of rows says of itself: one JSON text in its footer, with a seal over the footer.
//!
//! It is found and checked without a reader of Parquet: that trusts what it reads.

use super::fields::{Fields, Precision};
use super::probed::stored_columns;
use super::schema::{self, part};
use super::shard::Selection;
use crate::section::parse;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::Path;

/// Version of the format: the first number changes when a reader of the old one would fail.
pub const FORMAT_VERSION: &str = "1.0";
/// Version of a file with probes.
const PROBED_VERSION: &str = "1.1";

/// Version of a file with these results.
#[cfg(feature = "parquet")]
pub(super) fn version(fields: &Fields) -> &'static str {
    if fields.probed.is_empty() {
        FORMAT_VERSION
    } else {
        PROBED_VERSION
    }
}

/// How the file begins and ends.
pub(crate) const MAGIC: &[u8; 4] = b"PAR1";
/// How the text begins: with the type of the file, whichever it is, and the seal behind it.
const BEGIN: &[u8] = b"{\"file_type\":\"hertzlamb sweep";
const SEAL: &[u8] = b",\"seal\":\"";
/// Digits of a seal.
pub(super) const DIGITS: usize = 64;
/// Bytes behind the footer: its length and the magic number.
pub(super) const TAIL: u64 = 8;

/// What is in the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Footer {
    /// `hertzlamb sweep` or `hertzlamb sweep part`.
    pub(crate) file_type: String,
    /// Version of the format.
    pub(crate) version: String,
    /// The sweep with its base scene, as TOML.
    pub(crate) sweep: String,
    /// Which sweep.
    pub(crate) sha256: String,
    /// Rows of the whole sweep.
    pub(crate) sweep_rows: usize,
    /// Which of them are here.
    pub(crate) selection: Selection,
    /// Failed rows.
    pub(crate) failed: usize,
    /// Which results, and how exactly.
    pub(crate) fields: Fields,
    /// SHA-256 of the bytes of each row group.
    pub(crate) groups: Vec<String>,
    /// Bytes before the footer.
    pub(crate) data_bytes: u64,
}

impl Footer {
    /// Reads the text of a file that begins like Parquet; nothing where it is none of the program's.
    ///
    /// # Errors
    /// What is wrong with it, in a few words.
    pub(crate) fn read(path: &Path) -> Result<Option<Self>, String> {
        let (bytes, length) = footer_of(path).map_err(|error| error.to_string())?;
        let Some(bytes) = bytes else {
            return Err("it has no end: it was cut short".to_owned());
        };
        let Some(begin) = find(&bytes, BEGIN) else {
            return Ok(None);
        };
        let digits = seal_in(&bytes).ok_or("its footer has no seal")?;
        if bytes[digits.clone()] != *sum_without(&bytes, &digits).as_bytes() {
            return Err("its footer was changed".to_owned());
        }
        let mut texts = serde_json::Deserializer::from_slice(&bytes[begin..]).into_iter();
        let text: Option<Value> = texts.next().and_then(Result::ok);
        let found = text.as_ref().and_then(Self::parsed);
        let found = found.ok_or("its footer does not say what it has")?;
        if found.selection.rows.end > found.sweep_rows {
            return Err("it has rows beyond those of its sweep".to_owned());
        }
        if found.data_bytes.checked_add(bytes.len() as u64 + TAIL) != Some(length) {
            return Err("its length is not what its footer says".to_owned());
        }
        Ok(Some(found))
    }

    /// All of the footer, as Parquet has it.
    #[cfg(feature = "parquet")]
    pub(crate) fn bytes(path: &Path) -> io::Result<Vec<u8>> {
        Ok(footer_of(path)?.0.unwrap_or_default())
    }

    fn parsed(text: &Value) -> Option<Self> {
        let string = |name: &str| Some(text.get(name)?.as_str()?.to_owned());
        let count = |name: &str| usize::try_from(text.get(name)?.as_u64()?).ok();
        let start = count(part::FIRST_ROW)?;
        let shard = match string(part::SHARD)?.as_str() {
            "" => None,
            shard => Some(shard.parse().ok()?),
        };
        let columns = text.get("columns")?.as_object()?;
        let sweep = string("sweep")?;
        let version = string("format_version")?;
        let probed = if version == PROBED_VERSION {
            stored_columns(&parse(&sweep).ok()?).ok()?
        } else {
            Vec::new()
        };
        let mut fields = Fields::all(probed);
        fields.retain(|name| columns.contains_key(name));
        fields.precision = match count("bits")? {
            64 => Precision::Double,
            32 => Precision::Single,
            _ => return None,
        };
        let groups = text.get("row_groups")?.as_array()?.iter();
        Some(Self {
            file_type: string("file_type")?,
            version,
            sweep,
            sha256: string(schema::SHA256)?,
            sweep_rows: count(part::SWEEP_ROWS)?,
            selection: Selection {
                rows: start..start.checked_add(count(schema::ROWS)?)?,
                shard,
            },
            failed: count(schema::FAILED)?,
            fields,
            groups: groups
                .map(|group| Some(group.as_str()?.to_owned()))
                .collect::<Option<_>>()?,
            data_bytes: text.get("data_bytes")?.as_u64()?,
        })
    }
}

/// The footer without its length and magic number, if there is one, and the length of the file.
pub(super) fn footer_of(path: &Path) -> io::Result<(Option<Vec<u8>>, u64)> {
    let mut file = File::open(path)?;
    let length = file.metadata()?.len();
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

/// Where the digits of the seal are.
pub(super) fn seal_in(footer: &[u8]) -> Option<Range<usize>> {
    let begin = find(footer, BEGIN)?;
    let start = begin + find(&footer[begin..], SEAL)? + SEAL.len();
    footer
        .get(start..start + DIGITS)
        .map(|_| start..start + DIGITS)
}

/// SHA-256 of a footer whose seal is blank.
pub(super) fn sum_without(footer: &[u8], digits: &Range<usize>) -> String {
    let mut hash = Sha256::new();
    hash.update(&footer[..digits.start]);
    hash.update([b'0'; DIGITS]);
    hash.update(&footer[digits.end..]);
    format!("{:x}", hash.finalize())
}

fn find(bytes: &[u8], wanted: &[u8]) -> Option<usize> {
    bytes.windows(wanted.len()).position(|part| part == wanted)
}
