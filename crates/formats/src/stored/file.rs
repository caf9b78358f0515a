//! Opening a file, whatever it is.

use super::error::ReadError;
use super::kind::FileKind;
use super::parquet::{StoredParquet, is_parquet};
use hdfread::{Attribute, File, HdfError};
use std::io::Read;
use std::path::Path;

/// What the file at `path` is.
///
/// # Errors
/// [`ReadError`] for a file that is not one of the program.
pub fn file_kind(path: &Path) -> Result<FileKind, ReadError> {
    if is_parquet(path) {
        return StoredParquet::open(path).map(|found| found.kind());
    }
    let root = open_hdf5(path)?.root().ok();
    root.and_then(|root| text_of(root.attribute("file_type")))
        .and_then(|found| FileKind::ALL.into_iter().find(|k| k.file_type() == found))
        .ok_or_else(|| ReadError::Foreign {
            path: path.to_owned(),
        })
}

/// Opens an HDF5 file, whatever is in it.
pub(super) fn open_hdf5(path: &Path) -> Result<File, ReadError> {
    let unreadable = |reason: &str| ReadError::Unreadable {
        path: path.to_owned(),
        reason: reason.to_owned(),
    };
    // looked at before it is opened: a pipe would wait for its other end
    let data = std::fs::metadata(path).map_err(|error| unreadable(&error.to_string()))?;
    if !data.is_file() {
        return Err(unreadable("it is not a file"));
    }
    let mut head = Vec::new();
    std::fs::File::open(path)
        .and_then(|file| file.take(256).read_to_end(&mut head))
        .map_err(|error| unreadable(&error.to_string()))?;
    let not = |found| ReadError::NotHdf5 {
        path: path.to_owned(),
        found,
    };
    if !head.starts_with(b"\x89HDF\r\n\x1a\n") {
        let is_text = !head.is_empty() && std::str::from_utf8(&head).is_ok();
        return Err(not(match head.len() {
            0 => "empty",
            _ if head.starts_with(b"PAR1") => "a Parquet file",
            _ if is_text => "text",
            _ => "no HDF5 file",
        }));
    }
    File::open(path).map_err(|_| not("a damaged HDF5 file"))
}

/// A text attribute, where it is one.
pub(super) fn text_of(attribute: Result<Attribute, HdfError>) -> Option<String> {
    attribute.ok()?.text().ok()
}
