//! The finished file: written beside its name, read back, compared, renamed.

use crate::error::BuildError;
use lookup::{Content, TableError};
use std::path::{Path, PathBuf};

/// What to do when the output exists already.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Leave it and report [`BuildError::Exists`].
    Keep,
    /// Replace it when the new table is complete and verified.
    Replace,
}

/// Refuses a file that is in the way, and what is no file whatever `existing` says: a device would become one.
pub(crate) fn refuse(path: &Path, existing: Existing) -> Result<(), BuildError> {
    let Ok(there) = std::fs::metadata(path) else {
        return Ok(());
    };
    match existing {
        Existing::Keep => Err(BuildError::Exists {
            path: path.to_owned(),
        }),
        Existing::Replace if there.is_file() => Ok(()),
        Existing::Replace => Err(BuildError::File {
            action: "replace",
            path: path.to_owned(),
            source: std::io::Error::other("it is not a file"),
        }),
    }
}

/// Writes under `NAME.part`, reads back, compares, renames. Returns the size of the file.
pub(crate) fn finish(content: &Content, path: &Path) -> Result<u64, BuildError> {
    let part = beside(path, ".part");
    // A link would be written through, a device written to.
    if std::fs::symlink_metadata(&part).is_ok_and(|there| !there.is_file()) {
        let detail = "something that is not a file has its name".to_owned();
        return Err(TableError::Unwritable { path: part, detail }.into());
    }
    let done = write_checked(content, &part, path);
    if done.is_err() {
        // What could be written takes room and is of no use; the journal has all of it.
        let _ = std::fs::remove_file(&part);
    }
    done
}

fn write_checked(content: &Content, part: &Path, path: &Path) -> Result<u64, BuildError> {
    let failed = |action, path: &Path| {
        let path = path.to_owned();
        move |source| BuildError::File {
            action,
            path,
            source,
        }
    };
    lookup::write(part, content)?;
    let back = lookup::read(part)?;
    lookup::check_hash(part, &back)?;
    let file = std::fs::File::open(part).map_err(failed("open", part))?;
    file.sync_all().map_err(failed("flush", part))?;
    std::fs::rename(part, path).map_err(failed("rename the finished table to", path))?;
    let data = std::fs::metadata(path).map_err(failed("look at", path))?;
    Ok(data.len())
}

/// `path` with `suffix` appended to its name.
pub(crate) fn beside(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(suffix);
    PathBuf::from(name)
}
