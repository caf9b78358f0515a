//! Text files: regular, of a bounded size, UTF-8.

use crate::error::SceneError;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Bytes of a TOML file at most: a parsed one takes some fifty times its size.
const MOST_OF_TOML: u64 = 8 << 20;
/// Bytes of a force record at most.
pub(crate) const MOST_OF_RECORD: u64 = 256 << 20;

/// How HDF5 files start.
const HDF5: &[u8] = b"\x89HDF\r\n";

/// The text of a TOML file.
pub(crate) fn read_text(path: &Path) -> Result<String, SceneError> {
    read_text_up_to(path, MOST_OF_TOML)
}

/// The text of a regular file of at most so many bytes: a pipe would wait for its other end, a device never ends.
pub(crate) fn read_text_up_to(path: &Path, most: u64) -> Result<String, SceneError> {
    let fault = |reason: String| SceneError::Unreadable {
        path: path.to_owned(),
        reason,
    };
    let system = |error: io::Error| fault(error.to_string());
    if !std::fs::metadata(path).map_err(system)?.is_file() {
        return Err(fault("it is not a regular file".to_owned()));
    }
    let file = File::open(path).map_err(system)?;
    text_of(file, path, most)
}

/// The TOML that standard input has.
pub(super) fn read_standard() -> Result<String, SceneError> {
    text_of(io::stdin(), Path::new("standard input"), MOST_OF_TOML)
}

/// All text that a source of a name has, up to so many bytes.
fn text_of(source: impl Read, path: &Path, most: u64) -> Result<String, SceneError> {
    let fault = |reason: String| SceneError::Unreadable {
        path: path.to_owned(),
        reason,
    };
    let mut bytes = Vec::new();
    let read = source.take(most + 1).read_to_end(&mut bytes);
    read.map_err(|error| fault(error.to_string()))?;
    if bytes.len() as u64 > most {
        return Err(fault(format!("it has more than {} MB", most >> 20)));
    }
    let starts_as_hdf5 = bytes.starts_with(HDF5);
    String::from_utf8(bytes).map_err(|error| {
        fault(if starts_as_hdf5 {
            "it is an HDF5 file, needed text".to_owned()
        } else {
            let line = error.as_bytes()[..error.utf8_error().valid_up_to()]
                .split(|&byte| byte == b'\n')
                .count();
            format!("line {line} is not UTF-8")
        })
    })
}
