//! A text file: regular, and no longer than a grid can be.

use std::fs::File;
use std::io::{Error, Read, Result};
use std::path::Path;

/// Bytes at most.
const MOST: u64 = 1 << 20;

/// The text of a regular file: a pipe would wait for its other end, a device never ends.
pub(crate) fn read(path: &Path) -> Result<String> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(Error::other("it is not a regular file"));
    }
    let mut text = String::new();
    File::open(path)?.take(MOST + 1).read_to_string(&mut text)?;
    if text.len() as u64 > MOST {
        return Err(Error::other("it has more than 1 MB"));
    }
    Ok(text)
}
