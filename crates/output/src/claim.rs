//! From a name to the finished file under it.

use crate::error::{Fault, OutputError};
use crate::place::{behind, folder};
use crate::temporary::{Lock, Temporary, sweep};
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

/// What to do with an existing file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Keep it and report it.
    Keep,
    /// Keep it unless it is, byte by byte, what is written: a run that was killed between two outputs goes on.
    KeepUnlessSame,
    /// Replace it once the new one is complete.
    Replace,
}

impl Existing {
    /// Keeps it unless it may be replaced.
    pub fn replaced(may: bool) -> Self {
        if may { Self::Replace } else { Self::Keep }
    }
}

/// A name that this run alone writes to, until it is dropped.
#[derive(Debug)]
pub struct Output {
    /// The name that was given.
    pub path: PathBuf,
    /// The file that is written, behind links.
    pub real: PathBuf,
    existing: Existing,
    _lock: Lock,
}

impl Output {
    /// Checks that a file can be written, locks its name and removes what killed runs left beside it.
    ///
    /// # Errors
    /// [`OutputError`] when it exists and is kept, is no file, when its folder cannot take it or another run writes it.
    pub fn claim(path: &Path, existing: Existing) -> Result<Self, OutputError> {
        let real = behind(path)?;
        let exists = || refuse(path, &real, existing);
        let lock = match Lock::take(&real) {
            Ok(Some(lock)) => lock,
            Ok(None) => return Err(OutputError::Busy(path.to_owned())),
            Err(error) => {
                exists()?;
                return Err(OutputError::place(path, error));
            }
        };
        if lock.held {
            sweep(&real);
        }
        exists()?;
        Ok(Self {
            path: path.to_owned(),
            existing,
            _lock: lock,
            real,
        })
    }

    /// The same name with another answer to what is there already.
    ///
    /// # Errors
    /// [`OutputError::Exists`] when it exists and is kept.
    pub fn over(self, existing: Existing) -> Result<Self, OutputError> {
        refuse(&self.path, &self.real, existing)?;
        Ok(Self { existing, ..self })
    }

    /// Writes the whole content through a closure that is given the name of an empty file, and flushes it.
    ///
    /// # Errors
    /// [`OutputError`]; the final name is untouched.
    pub fn stage<E: Into<Fault>>(
        &self,
        fill: impl FnOnce(&Path) -> Result<(), E>,
    ) -> Result<Staged<'_>, OutputError> {
        let staged = || -> Result<Staged<'_>, Fault> {
            let part = Temporary::beside(&self.real)?;
            fill(&part.path).map_err(Into::into)?;
            Ok(Staged {
                output: self,
                bytes: self.settle(&part.path)?,
                part,
            })
        };
        staged().map_err(|fault| OutputError::writing(&self.path, fault))
    }

    /// [`Self::stage`] and [`Staged::commit`]; gives the size of the file.
    ///
    /// # Errors
    /// [`OutputError`]; the final name is untouched.
    pub fn write<E: Into<Fault>>(
        &self,
        fill: impl FnOnce(&Path) -> Result<(), E>,
    ) -> Result<u64, OutputError> {
        let staged = self.stage(fill)?;
        let bytes = staged.bytes;
        staged.commit()?;
        Ok(bytes)
    }

    /// Gives a finished file the permissions of the one that it replaces, and flushes it.
    fn settle(&self, part: &Path) -> io::Result<u64> {
        let file = File::options().read(true).write(true).open(part)?;
        if let Ok(old) = std::fs::metadata(&self.real) {
            #[cfg(unix)]
            {
                use std::os::unix::fs::MetadataExt;
                // for the owner alone to do; a file in his folder is his all the same
                let _ = std::os::unix::fs::fchown(&file, Some(old.uid()), Some(old.gid()));
            }
            file.set_permissions(old.permissions())?;
        }
        file.sync_all()?;
        Ok(file.metadata()?.len())
    }
}

/// A whole file that has no name yet; without a commit it is removed.
#[derive(Debug)]
pub struct Staged<'a> {
    output: &'a Output,
    part: Temporary,
    bytes: u64,
}

impl Staged<'_> {
    /// Gives the file its name and flushes the folder.
    ///
    /// # Errors
    /// [`OutputError`]: it exists by now and is kept, or the system's reason.
    pub fn commit(self) -> Result<(), OutputError> {
        let (path, real) = (&self.output.path, &self.output.real);
        let (part, existing) = (&self.part.path, self.output.existing);
        let failed = |error: io::Error| OutputError::writing(path, error);
        refuse(path, real, existing)?;
        if existing == Existing::KeepUnlessSame && real.exists() {
            let same = same(part, real).map_err(failed)?;
            return same.then_some(()).ok_or(OutputError::Exists(path.clone()));
        }
        std::fs::rename(part, real).map_err(failed)?;
        self.part.forget();
        flush(folder(real)).map_err(failed)
    }
}

/// Refuses a file that is there and is kept.
fn refuse(path: &Path, real: &Path, existing: Existing) -> Result<(), OutputError> {
    match existing {
        Existing::Keep if real.exists() => Err(OutputError::Exists(path.to_owned())),
        Existing::Keep | Existing::KeepUnlessSame | Existing::Replace => Ok(()),
    }
}

/// Flushes a folder; one that cannot be is left to the system.
fn flush(folder: &Path) -> io::Result<()> {
    use ErrorKind::{InvalidInput, PermissionDenied, Unsupported};
    let flushed = File::open(folder).and_then(|folder| folder.sync_all());
    flushed.or_else(|error| match error.kind() {
        InvalidInput | Unsupported | PermissionDenied => Ok(()),
        _ => Err(error),
    })
}

/// Whether two files hold the same bytes.
fn same(one: &Path, other: &Path) -> io::Result<bool> {
    let (one, other) = (File::open(one)?, File::open(other)?);
    loop {
        let (left, right) = (piece(&one)?, piece(&other)?);
        if left != right || left.is_empty() {
            return Ok(left == right);
        }
    }
}

/// The next MiB of a file, or what it has left.
fn piece(file: &File) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(1 << 20).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Writes a file through a closure that is given a name beside the final one.
///
/// # Errors
/// [`OutputError`]; the final name is untouched.
pub fn write_whole<E: Into<Fault>>(
    path: &Path,
    existing: Existing,
    write: impl FnOnce(&Path) -> Result<(), E>,
) -> Result<(), OutputError> {
    Output::claim(path, existing)?.write(write).map(drop)
}
