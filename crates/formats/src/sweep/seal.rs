//! The text in the footer of a Parquet file as it is written, and its seal.

use super::fields::Precision;
use super::footer::{DIGITS, Footer, TAIL, footer_of, seal_in, sum_without, version};
use super::schema::{self, part};
use super::shard::Selection;
use super::spec::Spec;
use serde_json::{Map, json};
use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

/// Key of the text in the footer.
pub(super) const KEY: &str = "hertzlamb";

impl Footer {
    /// The text, whose seal is still blank; `columns` are name, unit and meaning.
    pub(super) fn json(&self, columns: &[(String, &str, String)]) -> String {
        let described = columns.iter().map(|(name, unit, meaning)| {
            let labels = json!({ "units": unit, "long_name": meaning });
            (name.clone(), labels)
        });
        let precision = match self.fields.precision {
            Precision::Double => 64,
            Precision::Single => 32,
        };
        let shard = self.selection.shard.map(|shard| shard.to_string());
        json!({
            "file_type": self.file_type,
            "seal": "0".repeat(DIGITS),
            "format_version": self.version,
            "software_version": env!("CARGO_PKG_VERSION"),
            "sweep": self.sweep,
            schema::SHA256: self.sha256,
            part::SHARD: shard.unwrap_or_default(),
            part::SWEEP_ROWS: self.sweep_rows,
            part::FIRST_ROW: self.selection.rows.start,
            schema::ROWS: self.selection.rows.len(),
            schema::FAILED: self.failed,
            "columns": described.collect::<Map<_, _>>(),
            "bits": precision,
            "row_groups": self.groups,
            "data_bytes": self.data_bytes,
        })
        .to_string()
    }

    /// Of all rows of a sweep or of some, before any is written.
    pub(super) fn of(spec: &Spec, selection: Option<&Selection>) -> Self {
        let whole = || Selection {
            rows: 0..spec.rows(),
            shard: None,
        };
        let file_type = match selection {
            Some(_) => part::FILE_TYPE,
            None => schema::FILE_TYPE,
        };
        Self {
            file_type: file_type.to_owned(),
            version: version(&spec.fields).to_owned(),
            sweep: spec.resolved.clone(),
            sha256: spec.sha256(),
            sweep_rows: spec.rows(),
            selection: selection.cloned().unwrap_or_else(whole),
            failed: 0,
            fields: spec.fields.clone(),
            groups: Vec::new(),
            data_bytes: 0,
        }
    }
}

/// Seals the footer of a file that is written.
pub(super) fn seal(path: &Path) -> io::Result<()> {
    let (bytes, length) = footer_of(path)?;
    let placed = bytes.and_then(|bytes| Some((seal_in(&bytes)?, bytes)));
    let (digits, bytes) = placed.ok_or_else(|| io::Error::other("its footer has no seal"))?;
    let place = length - TAIL - bytes.len() as u64 + digits.start as u64;
    let mut file = File::options().write(true).open(path)?;
    file.seek(SeekFrom::Start(place))?;
    file.write_all(sum_without(&bytes, &digits).as_bytes())
}
