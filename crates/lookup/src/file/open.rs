//! Opening: what is compared before anything else is read.

use super::error::TableError;
use super::seal::{self, Cover, Verdict};
use super::source::Source;
use crate::schema;
use std::path::Path;

/// Opens the table at `path` for reading.
///
/// In this order: it is a regular file; its seal is right; it is HDF5; its kind and version are known.
///
/// # Errors
/// [`TableError`].
pub(super) fn open(path: &Path) -> Result<Source, TableError> {
    let cover = cover(path)?;
    let file = hdfread::File::open(path).map_err(|error| TableError::NotHdf5 {
        path: path.to_owned(),
        detail: error.to_string(),
    })?;
    let source = Source::new(path, file, cover);
    let root = source.root()?;
    let found = source.text(&root, schema::FILE_TYPE).unwrap_or_default();
    if found != schema::FILE_TYPE_VALUE {
        return Err(TableError::Foreign {
            path: path.to_owned(),
            found,
        });
    }
    let found = source.text(&root, schema::FORMAT_VERSION)?;
    match version(&found) {
        // Formats from 2.2 on have a seal.
        Some((schema::MAJOR_READ, minor)) if (minor >= 2) == (cover == Cover::Sealed) => Ok(source),
        Some((schema::MAJOR_READ, _)) => Err(TableError::Damaged {
            path: path.to_owned(),
            detail: format!("format version {found} and its seal do not agree"),
        }),
        Some(_) | None => Err(TableError::Version {
            path: path.to_owned(),
            found,
        }),
    }
}

/// Whether the bytes are those that were written.
fn cover(path: &Path) -> Result<Cover, TableError> {
    let unreadable = |source| TableError::Unreadable {
        path: path.to_owned(),
        source,
    };
    // Looked at before it is opened: a pipe would wait for its other end.
    if !std::fs::metadata(path).map_err(unreadable)?.is_file() {
        return Err(unreadable(std::io::Error::other("it is not a file")));
    }
    let mut file = std::fs::File::open(path).map_err(unreadable)?;
    match seal::check(&mut file).map_err(unreadable)? {
        Verdict::Right => Ok(Cover::Sealed),
        Verdict::Unsealed => Ok(Cover::ByContent),
        Verdict::NotHdf5 => Err(TableError::NotHdf5 {
            path: path.to_owned(),
            detail: "it does not start as one".to_owned(),
        }),
        Verdict::Damaged(detail) => Err(TableError::Damaged {
            path: path.to_owned(),
            detail: detail.to_owned(),
        }),
    }
}

/// Major and minor number of a version.
fn version(text: &str) -> Option<(u32, u32)> {
    let (major, minor) = text.split_once('.')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}
