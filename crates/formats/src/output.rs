//! Where a file goes: never half-written, never over another one unasked.

use std::path::{Path, PathBuf};
use thiserror::Error;

/// A file that could not be written.
#[derive(Debug, Error)]
pub enum OutputError {
    /// The file exists and may not be replaced.
    #[error("{} exists already and is not replaced", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// The place cannot be written to.
    #[error("cannot write {}: {reason}", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// The system's or the HDF5 library's reason.
        reason: String,
    },
}

/// What to do with an existing file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Keep it and report it.
    Keep,
    /// Replace it once the new one is complete.
    Replace,
}

/// Checks, before any work, that a file can be written.
///
/// # Errors
/// [`OutputError`] when it exists and is kept, or when its folder cannot take it.
pub fn check(path: &Path, existing: Existing) -> Result<(), OutputError> {
    let fault = |reason: &str| OutputError::Unwritable {
        path: path.to_owned(),
        reason: reason.to_owned(),
    };
    if path.is_dir() {
        return Err(fault("it is a folder"));
    }
    if path.exists() && existing == Existing::Keep {
        return Err(OutputError::Exists {
            path: path.to_owned(),
        });
    }
    let folder = folder(path);
    if path.file_name().is_none() {
        return Err(fault("it has no file name"));
    }
    if !folder.is_dir() {
        return Err(fault(&format!(
            "the folder {} does not exist",
            folder.display()
        )));
    }
    let part = part(path);
    std::fs::File::create(&part).map_err(|error| fault(&error.to_string()))?;
    let _ = std::fs::remove_file(&part);
    Ok(())
}

/// Writes a file through a closure that is given a name beside the final one.
///
/// # Errors
/// [`OutputError`]; nothing is left under either name unless it was there before.
pub fn write_whole(
    path: &Path,
    existing: Existing,
    write: impl FnOnce(&Path) -> Result<(), String>,
) -> Result<(), OutputError> {
    check(path, existing)?;
    let part = part(path);
    let done =
        write(&part).and_then(|()| std::fs::rename(&part, path).map_err(|error| error.to_string()));
    done.map_err(|reason| {
        let _ = std::fs::remove_file(&part);
        OutputError::Unwritable {
            path: path.to_owned(),
            reason,
        }
    })
}

fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        Some(_) | None => Path::new("."),
    }
}

fn part(path: &Path) -> PathBuf {
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned());
    folder(path).join(format!(
        ".{}.{}.part",
        name.unwrap_or_default(),
        std::process::id()
    ))
}
