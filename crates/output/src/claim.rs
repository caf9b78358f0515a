//! From the name of an output to the finished file.

use crate::error::{OutputError, OutputFault};
use crate::handle::{is_at, make};
use crate::place::{behind, folder};
use crate::temporary::{Lock, Temporary, sweep};
use std::fs::File;
use std::io::{self, ErrorKind, Read, Seek};
use std::path::{Path, PathBuf};

/// Treatment of an existing file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Keep it and report it.
    Keep,
    /// Keep it unless it is byte for byte identical to the new content, so that a run that was killed between two
    /// outputs can be resumed.
    KeepUnlessSame,
    /// Replace it once the new one is complete.
    Replace,
}

impl Existing {
    /// [`Self::Replace`] if `may`, [`Self::Keep`] otherwise.
    pub fn replaced(may: bool) -> Self {
        if may { Self::Replace } else { Self::Keep }
    }
}

/// A name that only this run writes to, until it is dropped.
#[derive(Debug)]
pub struct Output {
    /// Name as given by the user.
    pub path: PathBuf,
    /// Path of the file after following links.
    pub real: PathBuf,
    existing: Existing,
    _lock: Lock,
}

impl Output {
    /// Checks that a file can be written, locks its name and removes temporary files that killed runs have left next to
    /// it.
    ///
    /// # Errors
    /// [`OutputError`] if the file exists and must be kept, is not a regular file, its folder is not writable, or
    /// another run writes it.
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

    /// The same name with another treatment of an existing file.
    ///
    /// # Errors
    /// [`OutputError::Exists`] if the file exists and must be kept.
    pub fn over(self, existing: Existing) -> Result<Self, OutputError> {
        refuse(&self.path, &self.real, existing)?;
        Ok(Self { existing, ..self })
    }

    /// Writes the whole content through a closure that receives an empty file, and flushes it.
    ///
    /// # Errors
    /// [`OutputError`]; the final name is untouched.
    pub fn stage<E: Into<OutputFault>>(
        &self,
        fill: impl FnOnce(&File) -> Result<(), E>,
    ) -> Result<Staged<'_>, OutputError> {
        self.stage_made(|name| {
            let file = make(name)?;
            fill(&file).map_err(Into::into)?;
            Ok::<_, OutputFault>(file)
        })
    }

    /// Like [`Self::stage`], with a closure that creates the file itself under an unused name and returns its handle.
    ///
    /// From then on only the handle is used: another user with write access to the folder can replace the name by a
    /// link to another file at any time.
    ///
    /// # Errors
    /// [`OutputError`]; the final name is untouched.
    pub fn stage_made<E: Into<OutputFault>>(
        &self,
        make: impl FnOnce(&Path) -> Result<File, E>,
    ) -> Result<Staged<'_>, OutputError> {
        let staged = || -> Result<Staged<'_>, OutputFault> {
            let part = Temporary::beside(&self.real);
            let file = make(&part.path).map_err(Into::into)?;
            Ok(Staged {
                output: self,
                bytes: self.settle(&file)?,
                file,
                part,
            })
        };
        staged().map_err(|fault| OutputError::writing(&self.path, fault))
    }

    /// [`Self::stage`] and [`Staged::commit`].
    ///
    /// # Errors
    /// [`OutputError`]; the final name is untouched.
    pub fn write<E: Into<OutputFault>>(
        &self,
        fill: impl FnOnce(&File) -> Result<(), E>,
    ) -> Result<(), OutputError> {
        self.stage(fill)?.commit()
    }

    /// Gives a finished file the permissions of the file that it replaces, and flushes it.
    fn settle(&self, file: &File) -> io::Result<u64> {
        if let Ok(old) = std::fs::metadata(&self.real) {
            #[cfg(unix)]
            {
                use std::os::unix::fs::MetadataExt;
                // fails unless this process belongs to the owner or the administrator; this process then stays the
                // owner
                let _ = std::os::unix::fs::fchown(file, Some(old.uid()), Some(old.gid()));
            }
            file.set_permissions(old.permissions())?;
        }
        file.sync_all()?;
        Ok(file.metadata()?.len())
    }
}

/// A complete file without its final name; it is removed unless it is committed.
#[derive(Debug)]
pub struct Staged<'a> {
    output: &'a Output,
    part: Temporary,
    file: File,
    /// Size in bytes.
    pub bytes: u64,
}

impl Staged<'_> {
    /// Gives the file its name and flushes the folder.
    ///
    /// # Errors
    /// [`OutputError`]: the file exists by now and must be kept, or an error of the operating system.
    pub fn commit(self) -> Result<(), OutputError> {
        let (path, real) = (&self.output.path, &self.output.real);
        let (part, existing) = (&self.part.path, self.output.existing);
        let failed = |error: io::Error| OutputError::writing(path, error);
        refuse(path, real, existing)?;
        if existing == Existing::KeepUnlessSame && real.exists() {
            let same = same(&self.file, real).map_err(failed)?;
            return same.then_some(()).ok_or(OutputError::Exists(path.clone()));
        }
        check_place(&self.file, part, path)?;
        std::fs::rename(part, real).map_err(failed)?;
        self.part.forget();
        check_place(&self.file, real, path)?;
        flush(folder(real)).map_err(failed)
    }
}

/// Rejects a file under the temporary name that is not the written one: other users may write to the folder.
fn check_place(written: &File, name: &Path, output: &Path) -> Result<(), OutputError> {
    let what = "another process replaced it while it was written";
    let exchanged = || OutputError::writing(output, what);
    is_at(written, name).then_some(()).ok_or_else(exchanged)
}

/// Rejects an existing file that must be kept.
fn refuse(path: &Path, real: &Path, existing: Existing) -> Result<(), OutputError> {
    match existing {
        Existing::Keep if real.exists() => Err(OutputError::Exists(path.to_owned())),
        Existing::Keep | Existing::KeepUnlessSame | Existing::Replace => Ok(()),
    }
}

/// Flushes a folder, if the system supports that.
fn flush(folder: &Path) -> io::Result<()> {
    use ErrorKind::{InvalidInput, PermissionDenied, Unsupported};
    let flushed = File::open(folder).and_then(|folder| folder.sync_all());
    flushed.or_else(|error| match error.kind() {
        InvalidInput | Unsupported | PermissionDenied => Ok(()),
        _ => Err(error),
    })
}

/// Whether two files have the same content.
fn same(mut one: &File, other: &Path) -> io::Result<bool> {
    let other = File::open(other)?;
    one.rewind()?;
    loop {
        let (left, right) = (piece(one)?, piece(&other)?);
        if left != right || left.is_empty() {
            return Ok(left == right);
        }
    }
}

/// The next MiB of a file, or the rest of it.
fn piece(file: &File) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(1 << 20).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Writes a file through a closure that receives an empty file, which then gets its name.
///
/// # Errors
/// [`OutputError`]; the final name is untouched.
pub fn write_whole<E: Into<OutputFault>>(
    path: &Path,
    existing: Existing,
    write: impl FnOnce(&File) -> Result<(), E>,
) -> Result<(), OutputError> {
    Output::claim(path, existing)?.write(write)
}
