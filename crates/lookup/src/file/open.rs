//! Opening: what is compared before anything else is read.

use super::error::TableError;
use super::source::Source;
use crate::schema;
use hdfread::HdfError;
use std::path::Path;

/// Opens the table at `path` for reading.
///
/// In this order: it is a regular file; its seal is right; it is HDF5; its kind and version are known. What is read
/// later is compared with the seal then.
///
/// # Errors
/// [`TableError`].
pub(super) fn open(path: &Path) -> Result<Source, TableError> {
    let (file, seal) = ledger::open(path).map_err(|error| {
        let (path, detail) = (path.to_owned(), error.to_string());
        match error {
            HdfError::Io(source) => TableError::Unreadable { path, source },
            HdfError::NotAFile => TableError::Unreadable {
                path,
                source: std::io::Error::other(detail),
            },
            HdfError::Damaged { what } => TableError::Damaged { path, detail: what },
            _ => TableError::NotHdf5 { path, detail },
        }
    })?;
    let source = Source::new(path, file, seal);
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
        Some((schema::MAJOR_READ, minor)) if (minor >= schema::SEALED_FROM) == source.is_sealed() => {
            Ok(source)
        }
        Some((schema::MAJOR_READ, _)) => Err(TableError::Damaged {
            path: path.to_owned(),
            detail: "its seal is gone: it was cut short, or something has written to it since it was made".to_owned(),
        }),
        Some(_) | None => Err(TableError::Version {
            path: path.to_owned(),
            found,
        }),
    }
}

/// Major and minor number of a version.
fn version(text: &str) -> Option<(u32, u32)> {
    let (major, minor) = text.split_once('.')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}
