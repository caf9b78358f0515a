//! Opening: what is compared before anything else is read.

use super::error::{BadTable, TableError};
use super::seal::{self, Cover, Verdict};
use super::source::Source;
use crate::schema;
use std::path::Path;

/// Opens the table at `path` for reading.
///
/// In this order: it is a regular file; its seal is right; it is HDF5; its kind and version are known.
pub(super) fn open(path: &Path) -> Result<Source, TableError> {
    let cover = cover(path)?;
    let file = hdfread::File::open(path);
    let file = file.map_err(|error| BadTable::NotHdf5(error.to_string()).of(path))?;
    let source = Source::new(path, file, cover);
    let root = source.root()?;
    let found = source.text(&root, schema::FILE_TYPE).unwrap_or_default();
    if found != schema::FILE_TYPE_VALUE {
        return Err(BadTable::Foreign(found).of(path));
    }
    let found = source.text(&root, schema::FORMAT_VERSION)?;
    match version(&found) {
        // Formats from 2.2 on have a seal.
        Some((schema::MAJOR_READ, minor)) if (minor >= 2) == (cover == Cover::Sealed) => Ok(source),
        Some((schema::MAJOR_READ, _)) => {
            let detail = format!("format version {found} and its seal do not agree");
            Err(BadTable::Damaged(detail).of(path))
        }
        Some(_) | None => Err(BadTable::Version(found).of(path)),
    }
}

/// Whether the bytes are those that were written.
fn cover(path: &Path) -> Result<Cover, TableError> {
    let unreadable = |source| BadTable::Unreadable(source).of(path);
    // Looked at before it is opened: a pipe would wait for its other end.
    if !std::fs::metadata(path).map_err(unreadable)?.is_file() {
        return Err(unreadable(std::io::Error::other("it is not a file")));
    }
    let mut file = std::fs::File::open(path).map_err(unreadable)?;
    match seal::check(&mut file).map_err(unreadable)? {
        Verdict::Right => Ok(Cover::Sealed),
        Verdict::Unsealed => Ok(Cover::ByContent),
        Verdict::NotHdf5 => Err(BadTable::NotHdf5("it does not start as one".to_owned()).of(path)),
        Verdict::Damaged(detail) => Err(BadTable::Damaged(detail.to_owned()).of(path)),
    }
}

/// Major and minor number of a version.
fn version(text: &str) -> Option<(u32, u32)> {
    let (major, minor) = text.split_once('.')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}
