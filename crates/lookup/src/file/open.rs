//! Opening of a table: the checks before anything else is read.

use super::error::{BadTable, TableError};
use super::source::TableSource;
use crate::schema;
use ledger::{HdfError, HdfFile};
use std::path::Path;

/// Opens the table at `path` for reading.
///
/// Checks in this order: the file is a regular file, its seal is intact, it is HDF5, and its kind and version are
/// known. Data that is read later is compared with the seal then.
///
/// # Errors
/// [`TableError`].
pub(super) fn open(path: &Path) -> Result<TableSource, TableError> {
    let file = HdfFile::open(path).map_err(|error| {
        let what = match error {
            HdfError::Io(source) => BadTable::Unreadable(source),
            HdfError::Damaged(what) => BadTable::Damaged(what),
            other => BadTable::NotHdf5(other.to_string()),
        };
        what.of(path)
    })?;
    let source = TableSource::new(path, file);
    let root = &source.file.root;
    let found = source.text(root, schema::FILE_TYPE).unwrap_or_default();
    if found != schema::FILE_TYPE_VALUE {
        return Err(BadTable::Foreign(found).of(path));
    }
    let found = source.text(root, schema::FORMAT_VERSION)?;
    match version(&found) {
        Some((schema::MAJOR_READ, minor))
            if (minor >= schema::SEALED_FROM) == source.file.is_sealed() =>
        {
            Ok(source)
        }
        Some((schema::MAJOR_READ, _)) => {
            let detail =
                "its seal is missing: the file was truncated, or another program has written to it";
            Err(BadTable::Damaged(detail.to_owned()).of(path))
        }
        Some(_) | None => Err(BadTable::Version(found).of(path)),
    }
}

/// Major and minor number in a version text.
fn version(text: &str) -> Option<(u32, u32)> {
    let (major, minor) = text.split_once('.')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}
