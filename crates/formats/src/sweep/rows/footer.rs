//! What a Parquet file of rows says of itself: one JSON text in its footer, with a seal over the footer.
//!
//! It is found and checked without a reader of Parquet: that trusts what it reads.

use crate::scene::section::parse;
use crate::sweep::fields::{Fields, Precision, stored_columns};
use crate::sweep::schema::{self, part};
use crate::sweep::shard::{Part, Selection};
#[cfg(feature = "parquet")]
use crate::{quantities::Described, sweep::spec::Spec};
use serde_json::Value;
#[cfg(feature = "parquet")]
use serde_json::{Map, json};
use sha2::{Digest, Sha256};
use std::fs::File;
#[cfg(feature = "parquet")]
use std::io::Write;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::Path;

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

/// What is in the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Footer {
    /// `hertzlamb sweep` or `hertzlamb sweep part`.
    pub(crate) file_type: String,
    pub(crate) version: String,
    /// The sweep with its base scene, as TOML.
    pub(crate) sweep: String,
    pub(crate) part: Part,
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
        let found = text.as_ref().and_then(|text| Self::parsed(text, path));
        let found = found.ok_or("its footer does not say what it has")?;
        if found.part.selection.rows.end > found.part.sweep_rows {
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

    fn parsed(text: &Value, path: &Path) -> Option<Self> {
        let string = |name: &str| Some(text.get(name)?.as_str()?.to_owned());
        let count = |name: &str| usize::try_from(text.get(name)?.as_u64()?).ok();
        let start = count(part::FIRST_ROW)?;
        let shard = match string(part::SHARD)?.as_str() {
            "" => None,
            shard => Some(shard.parse().ok()?),
        };
        let columns = text.get("columns")?.as_object()?;
        let sweep = string("sweep")?;
        let mut fields = Fields::all(stored_columns(&parse(&sweep).ok()?).ok()?);
        fields.retain(|name| columns.contains_key(name));
        fields.precision = match count("bits")? {
            64 => Precision::Double,
            32 => Precision::Single,
            _ => return None,
        };
        let groups = text.get("row_groups")?.as_array()?.iter();
        Some(Self {
            file_type: string("file_type")?,
            version: string("format_version")?,
            sweep,
            part: Part {
                path: path.to_owned(),
                sha256: string(schema::SHA256)?,
                sweep_rows: count(part::SWEEP_ROWS)?,
                selection: Selection {
                    rows: start..start.checked_add(count(schema::ROWS)?)?,
                    shard,
                },
                failed: count(schema::FAILED)?,
                fields,
                sealed: true,
            },
            groups: groups
                .map(|group| Some(group.as_str()?.to_owned()))
                .collect::<Option<_>>()?,
            data_bytes: text.get("data_bytes")?.as_u64()?,
        })
    }
}

#[cfg(feature = "parquet")]
impl Footer {
    /// Of all rows of a sweep or of some, before any is written.
    pub(super) fn of(spec: &Spec, selection: Option<&Selection>) -> Self {
        let whole = || Selection {
            rows: 0..spec.rows(),
            shard: None,
        };
        let file_type = selection.map_or(schema::FILE_TYPE, |_| part::FILE_TYPE);
        Self {
            file_type: file_type.to_owned(),
            version: FORMAT_VERSION.to_owned(),
            sweep: spec.resolved.clone(),
            part: Part {
                path: std::path::PathBuf::new(),
                sha256: spec.sha256(),
                sweep_rows: spec.rows(),
                selection: selection.cloned().unwrap_or_else(whole),
                failed: 0,
                fields: spec.fields.clone(),
                sealed: true,
            },
            groups: Vec::new(),
            data_bytes: 0,
        }
    }

    /// The text, whose seal is still blank.
    pub(super) fn json<'c>(&self, columns: impl Iterator<Item = &'c Described>) -> String {
        let described = columns.map(|column| {
            let labels = json!({ "units": column.unit, "long_name": column.meaning });
            (column.name.clone(), labels)
        });
        let Part {
            selection, fields, ..
        } = &self.part;
        let shard = selection.shard.map(|shard| shard.to_string());
        json!({
            "file_type": self.file_type,
            "seal": "0".repeat(DIGITS),
            "format_version": self.version,
            "software_version": env!("CARGO_PKG_VERSION"),
            "sweep": self.sweep,
            schema::SHA256: self.part.sha256,
            part::SHARD: shard.unwrap_or_default(),
            part::SWEEP_ROWS: self.part.sweep_rows,
            part::FIRST_ROW: selection.rows.start,
            schema::ROWS: selection.rows.len(),
            schema::FAILED: self.part.failed,
            "columns": described.collect::<Map<_, _>>(),
            "bits": 8 * fields.precision.bytes(),
            "row_groups": self.groups,
            "data_bytes": self.data_bytes,
        })
        .to_string()
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
