//! What a Parquet file of rows says of itself: one JSON text in its footer, with a seal over the footer.
//!
//! It is found and checked without a reader of Parquet: that trusts what it reads.

use crate::scene::section::parse;
use crate::sweep::fields::{Fields, Precision, stored_columns};
use crate::sweep::shard::{Part, Selection};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::Path;
#[cfg(feature = "parquet")]
use {
    super::columns::{Column, rows_of},
    crate::sweep::schema::{self, part},
    crate::sweep::spec::Spec,
    serde_json::json,
    std::io::Write,
};

/// Version of the format: the first number changes when a reader of the old one would fail.
pub const FORMAT_VERSION: &str = "1.2";

/// How the file begins and ends.
pub(crate) const MAGIC: &[u8; 4] = b"PAR1";
/// How the text begins: with the type of the file, whichever it is, and the seal behind it.
const BEGIN: &[u8] = b"{\"file_type\":\"hertzlamb sweep";
const SEAL: &[u8] = b",\"seal\":\"";
/// Digits of a seal.
const DIGITS: usize = 64;
/// Bytes behind the footer: its length and the magic number.
const TAIL: u64 = 8;

/// Key of the text in the footer.
#[cfg(feature = "parquet")]
pub(super) const KEY: &str = "hertzlamb";

/// The text, key by key.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Footer {
    /// `hertzlamb sweep` or `hertzlamb sweep part`.
    pub(crate) file_type: String,
    /// Blank until the file is written.
    seal: String,
    pub(crate) format_version: String,
    software_version: String,
    /// The sweep with its base scene, as TOML.
    pub(crate) sweep: String,
    sweep_sha256: String,
    shard: String,
    sweep_rows: usize,
    first_row: usize,
    rows: usize,
    failed: usize,
    /// Unit and meaning of each.
    columns: Map<String, Value>,
    bits: usize,
    /// SHA-256 of the bytes of each.
    pub(crate) row_groups: Vec<String>,
    /// Bytes before the footer.
    pub(super) data_bytes: u64,
}

impl Footer {
    /// Reads the text of a file that begins like Parquet, with what it says of the rows; nothing where it is none of the
    /// program's.
    ///
    /// # Errors
    /// What is wrong with it, in a few words.
    pub(crate) fn read(path: &Path) -> Result<Option<(Self, Part)>, String> {
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
        let found: Option<Self> = texts.next().and_then(Result::ok);
        let found = found.and_then(|found| Some((found.part(path)?, found)));
        let (part, found) = found.ok_or("its footer does not say what it has")?;
        if part.selection.rows.end > part.sweep_rows {
            return Err("it has rows beyond those of its sweep".to_owned());
        }
        if found.data_bytes.checked_add(bytes.len() as u64 + TAIL) != Some(length) {
            return Err("its length is not what its footer says".to_owned());
        }
        Ok(Some((found, part)))
    }

    /// All of the footer, as Parquet has it.
    #[cfg(feature = "parquet")]
    pub(crate) fn bytes(path: &Path) -> io::Result<Vec<u8>> {
        Ok(footer_of(path)?.0.unwrap_or_default())
    }

    fn part(&self, path: &Path) -> Option<Part> {
        let shard = match self.shard.as_str() {
            "" => None,
            shard => Some(shard.parse().ok()?),
        };
        let mut fields = Fields::all(stored_columns(&parse(&self.sweep).ok()?).ok()?);
        fields.retain(|name| self.columns.contains_key(name));
        let mut precisions = [Precision::Double, Precision::Single].into_iter();
        fields.precision = precisions.find(|precision| self.bits == 8 * precision.bytes())?;
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

    /// Of all rows of a sweep or of some, before their groups are known.
    #[cfg(feature = "parquet")]
    pub(super) fn of(
        spec: &Spec,
        selection: Option<&Selection>,
        columns: &[Column<'_>],
        failed: usize,
    ) -> Self {
        let described = columns.iter().map(|Column { described, .. }| {
            let labels = json!({ "units": described.unit, "long_name": described.meaning });
            (described.name.clone(), labels)
        });
        let rows = rows_of(spec, selection);
        let shard = selection.and_then(|selection| selection.shard);
        Self {
            file_type: selection
                .map_or(schema::FILE_TYPE, |_| part::FILE_TYPE)
                .to_owned(),
            seal: "0".repeat(DIGITS),
            format_version: FORMAT_VERSION.to_owned(),
            software_version: env!("CARGO_PKG_VERSION").to_owned(),
            sweep: spec.resolved.clone(),
            sweep_sha256: spec.sha256.clone(),
            shard: shard.map_or_else(String::new, |shard| shard.to_string()),
            sweep_rows: spec.rows(),
            first_row: rows.start,
            rows: rows.len(),
            failed,
            columns: described.collect(),
            bits: 8 * spec.fields.precision.bytes(),
            row_groups: Vec::new(),
            data_bytes: 0,
        }
    }
}

/// Seals the footer of a file that is written.
#[cfg(feature = "parquet")]
pub(super) fn seal(path: &Path) -> io::Result<()> {
    let (bytes, length) = footer_of(path)?;
    let placed = bytes.and_then(|bytes| Some((seal_in(&bytes)?, bytes)));
    let (digits, bytes) = placed.ok_or_else(|| io::Error::other("its footer has no seal"))?;
    let place = length - TAIL - bytes.len() as u64 + digits.start as u64;
    let mut file = File::options().write(true).open(path)?;
    file.seek(SeekFrom::Start(place))?;
    file.write_all(sum_without(&bytes, &digits).as_bytes())
}

/// The footer without its length and magic number, if there is one, and the length of the file.
fn footer_of(path: &Path) -> io::Result<(Option<Vec<u8>>, u64)> {
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
fn seal_in(footer: &[u8]) -> Option<Range<usize>> {
    let begin = find(footer, BEGIN)?;
    let start = begin + find(&footer[begin..], SEAL)? + SEAL.len();
    footer
        .get(start..start + DIGITS)
        .map(|_| start..start + DIGITS)
}

/// SHA-256 of a footer whose seal is blank.
fn sum_without(footer: &[u8], digits: &Range<usize>) -> String {
    let mut hash = Sha256::new();
    hash.update(&footer[..digits.start]);
    hash.update([b'0'; DIGITS]);
    hash.update(&footer[digits.end..]);
    format!("{:x}", hash.finalize())
}

fn find(bytes: &[u8], wanted: &[u8]) -> Option<usize> {
    bytes.windows(wanted.len()).position(|part| part == wanted)
}
