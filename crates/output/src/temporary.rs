//! Files that exist only during a run, next to its output: temporary files, and the lock that lets only one run write
//! to a name.

use crate::handle::{is_at, without_links};
use crate::place::{beside, folder};
use std::collections::BTreeSet;
use std::fs::{File, TryLockError as Unlocked};
use std::hash::{BuildHasher, RandomState};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::Duration;

/// The files that this process would leave if it ended now.
static LIVE: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Random hexadecimal digits of a temporary name.
const DIGITS: usize = 16;
/// File extension of temporary names.
const SUFFIX: &str = ".part";

fn live() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    LIVE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the unfinished files of this process. It may be called at any moment, even while this thread adds to the
/// list.
pub fn abandon() {
    /// Attempts to lock the list, a millisecond apart.
    const TRIES: usize = 100;
    for _ in 0..TRIES {
        let live = match LIVE.try_lock() {
            Ok(mut live) => std::mem::take(&mut *live),
            Err(TryLockError::Poisoned(live)) => std::mem::take(&mut *live.into_inner()),
            Err(TryLockError::WouldBlock) => {
                std::thread::sleep(Duration::from_millis(1));
                continue;
            }
        };
        for path in live {
            let _ = std::fs::remove_file(path);
        }
        return;
    }
}

/// A file that is removed when it is dropped.
#[derive(Debug)]
pub(crate) struct Temporary {
    pub(crate) path: PathBuf,
}

impl Temporary {
    /// A random name next to `path`, for a file that will be created.
    pub(crate) fn beside(path: &Path) -> Self {
        // registered before the file exists, so that it is removed whenever the run ends
        Self::known(beside(path, ".", &format!(".{:016x}{SUFFIX}", random())))
    }

    /// A file with this name, which exists or will be created.
    pub(crate) fn known(path: PathBuf) -> Self {
        live().insert(path.clone());
        Self { path }
    }

    /// Keeps the file when this value is dropped.
    pub(crate) fn forget(self) {
        live().remove(&self.path);
        std::mem::forget(self);
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if live().remove(&self.path) {
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

/// Removes temporary files of `path`; the caller holds its lock, so that none of them belongs to a run.
pub(crate) fn sweep(path: &Path) {
    let prefix = beside(path, ".", ".");
    let prefix = prefix.file_name().unwrap_or_default().as_encoded_bytes();
    let Ok(entries) = std::fs::read_dir(folder(path)) else {
        return;
    };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let random = name
            .as_encoded_bytes()
            .strip_prefix(prefix)
            .and_then(|rest| rest.strip_suffix(SUFFIX.as_bytes()));
        let ours = random.is_some_and(|random| {
            random.len() == DIGITS && random.iter().all(u8::is_ascii_hexdigit)
        });
        if ours && entry.file_type().is_ok_and(|kind| kind.is_file()) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// A number that differs between calls and between processes.
fn random() -> u64 {
    RandomState::new().hash_one(std::process::id())
}

/// The lock of a name, held until it is dropped: an advisory lock on `.NAME.lock`, which is removed with it.
#[derive(Debug)]
pub(crate) struct Lock {
    // dropped in this order: the name is removed while the lock is held; a file of another process under that name
    // stays
    _name: Option<Temporary>,
    _file: File,
    /// Whether the file system supports locks; if it does not, concurrent runs are not prevented.
    pub(crate) held: bool,
}

impl Lock {
    /// Acquires the lock; none if another run has it.
    pub(crate) fn take(path: &Path) -> io::Result<Option<Self>> {
        let name = beside(path, ".", ".lock");
        loop {
            if std::fs::symlink_metadata(&name).is_ok_and(|there| !there.is_file()) {
                return Err(io::Error::other(format!(
                    "{} is needed for a lock but is not a regular file",
                    name.display()
                )));
            }
            let mut options = File::options();
            options.read(true).append(true).create(true);
            let file = without_links(&mut options).open(&name)?;
            let held = match file.try_lock() {
                Ok(()) => true,
                Err(Unlocked::WouldBlock) => return Ok(None),
                Err(Unlocked::Error(error)) if keeps_no_locks(&error) => false,
                Err(Unlocked::Error(error)) => return Err(error),
            };
            // The previous owner of the lock may have removed the name after it was opened here.
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

/// Whether the file system has no locks, or no service that keeps them (NFS).
fn keeps_no_locks(error: &io::Error) -> bool {
    #[cfg(unix)]
    if rustix::io::Errno::from_io_error(error) == Some(rustix::io::Errno::NOLCK) {
        return true;
    }
    error.kind() == ErrorKind::Unsupported
}
