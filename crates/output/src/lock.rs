//! One run at a time on one name.

use crate::place::beside;
use crate::temporary::Temporary;
use std::fs::{File, TryLockError};
use std::io::{self, ErrorKind};
use std::path::Path;

/// The lock of a name, held until it is dropped: an advisory lock on `.NAME.lock`, which is removed with it.
#[derive(Debug)]
pub(crate) struct Lock {
    // in this order: the name goes while the lock is still held; a file that somebody has put there stays
    _name: Option<Temporary>,
    _file: File,
    /// Whether the file system keeps locks; where it does not, two runs are not kept apart.
    pub(crate) held: bool,
}

impl Lock {
    /// Takes the lock, or says with nothing that another run has it.
    pub(crate) fn take(path: &Path) -> io::Result<Option<Self>> {
        let name = beside(path, ".", ".lock");
        loop {
            if std::fs::symlink_metadata(&name).is_ok_and(|there| !there.is_file()) {
                return Err(io::Error::other(format!(
                    "{} is needed for a lock and is no file",
                    name.display()
                )));
            }
            let file = File::options()
                .read(true)
                .append(true)
                .create(true)
                .open(&name)?;
            let held = match file.try_lock() {
                Ok(()) => true,
                Err(TryLockError::WouldBlock) => return Ok(None),
                Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => false,
                Err(TryLockError::Error(error)) => return Err(error),
            };
            // The run that had the lock may have removed the name after it was opened here.
            if !held || is_at(&file, &name) {
                let ours = file.metadata()?.len() == 0;
                return Ok(Some(Self {
                    _name: ours.then(|| Temporary::known(name)),
                    _file: file,
                    held,
                }));
            }
        }
    }
}

/// Whether an open file is the one under this name.
#[cfg(unix)]
fn is_at(file: &File, name: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    match (file.metadata(), std::fs::symlink_metadata(name)) {
        (Ok(open), Ok(there)) => (open.dev(), open.ino()) == (there.dev(), there.ino()),
        _ => false,
    }
}

#[cfg(not(unix))]
fn is_at(_: &File, name: &Path) -> bool {
    name.exists()
}
