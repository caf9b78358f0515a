//! Opening: what is compared before the HDF5 library is asked, and what is refused before a number is read.

use super::error::TableError;
use super::seal::{self, Cover, Verdict};
use super::source::{Source, first_line};
use crate::schema;
use std::path::Path;

/// Opens the table at `path` for reading.
///
/// In this order: it is a regular file; its seal is right; the HDF5 library opens it, with filter plugins off; its
/// kind and version are known; all its links are hard ones.
///
/// # Errors
/// [`TableError`].
pub(super) fn open(path: &Path) -> Result<Source, TableError> {
    let cover = cover(path)?;
    let file = plain(|| hdf5::File::open(path)).map_err(|error| TableError::NotHdf5 {
        path: path.to_owned(),
        detail: first_line(&error),
    })?;
    let bytes = std::fs::metadata(path).map_or(0, |data| data.len());
    let source = Source::new(path, file, bytes, cover);
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

/// Runs `work` where the HDF5 library loads no filters from shared libraries, in this process from now on.
fn plain<T>(work: impl FnOnce() -> T) -> T {
    // SAFETY: a number that the library keeps, set under its lock; the binding takes the mask, 0 for no
    // plugins, for a pointer. The built-in filters are no plugins.
    #[allow(unsafe_code)]
    hdf5::sync::sync(|| unsafe {
        hdf5_sys::h5pl::H5PLset_loading_state(std::ptr::null_mut());
    });
    work()
}

/// Major and minor number of a version.
fn version(text: &str) -> Option<(u32, u32)> {
    let (major, minor) = text.split_once('.')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}
