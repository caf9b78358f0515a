//! The file behind a name, and outputs that are inputs or identical.

use crate::error::{OutputError, OutputFault};
use crate::journal::sum;
use std::ffi::{OsStr, OsString};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Largest number of consecutive links.
const MOST_LINKS: usize = 40;

/// Whether a name means standard output.
pub fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// The folder of a path.
pub fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        Some(_) | None => Path::new("."),
    }
}

/// Path of the file with this name, existing or not, after following links; the target of a link may not exist yet.
///
/// # Errors
/// [`OutputError::Unwritable`] if it is not a regular file, or its folder does not exist.
pub fn behind(path: &Path) -> Result<PathBuf, OutputError> {
    file_behind(path).map_err(|fault| OutputError::place(path, fault))
}

fn file_behind(path: &Path) -> Result<PathBuf, OutputFault> {
    if is_standard(path) {
        return Err("standard output does not accept such a file; use a file name (./- for a file with the name -)".into());
    }
    if path.as_os_str().is_empty() {
        return Err("the name is empty".into());
    }
    if let Ok(there) = std::fs::metadata(path) {
        regular(&there.file_type())?;
    }
    let real = follow(path)?;
    if real.file_name().is_none() {
        return Err("it has no file name".into());
    }
    let folder = folder(&real);
    let shown = folder.display();
    match std::fs::metadata(folder) {
        Ok(data) if data.is_dir() => {}
        Ok(_) => return Err(format!("{shown} is not a folder").into()),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            return Err(format!("the folder {shown} does not exist").into());
        }
        Err(error) => return Err(error.into()),
    }
    match std::fs::symlink_metadata(&real) {
        // for example a name that is too long
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error.into()),
        Ok(_) | Err(_) => Ok(real),
    }
}

/// The path at the end of a chain of links.
fn follow(path: &Path) -> Result<PathBuf, OutputFault> {
    let mut real = path.to_owned();
    for _ in 0..MOST_LINKS {
        if real.starts_with("/proc") {
            return Err("it is an open file of a process, such as standard output".into());
        }
        if !real.is_symlink() {
            return Ok(real);
        }
        real = folder(&real).join(std::fs::read_link(&real)?);
    }
    Err("it is a link to itself, or a chain of too many links".into())
}

/// Rejects everything except regular files.
fn regular(kind: &std::fs::FileType) -> Result<(), OutputFault> {
    if kind.is_file() {
        return Ok(());
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if kind.is_fifo() {
            return Err("it is a pipe, not a file".into());
        }
        if kind.is_char_device() || kind.is_block_device() {
            return Err("it is a device, not a file".into());
        }
    }
    let what = if kind.is_dir() {
        "it is a folder"
    } else {
        "it is not a file"
    };
    Err(what.into())
}

/// `path` with something before and after its name; long names are replaced by a hash to respect the limit of the
/// system.
pub(crate) fn beside(path: &Path, before: &str, after: &str) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    if name.len() > 180 {
        let hash = u64::from_le_bytes(sum(name.as_encoded_bytes()));
        name = format!("{hash:016x}").into();
    }
    let whole = [OsStr::new(before), &name, OsStr::new(after)];
    folder(path).join(whole.into_iter().collect::<OsString>())
}

/// Role of an input file in a command, such as "the scene", and its path.
pub type Role = (&'static str, PathBuf);

/// Rejects, before any work, an output that is an input of the same command, and two outputs that are the same file.
///
/// Files are compared by identity, not by name: also through symbolic and hard links.
///
/// # Errors
/// [`OutputError::Refused`], or another error if an output cannot be written at all.
pub fn apart(outputs: &[&Path], inputs: &[Role]) -> Result<(), OutputError> {
    let mut seen: Vec<(&Path, _)> = Vec::new();
    for &output in outputs {
        let this = identity(&behind(output)?);
        if let Some((first, _)) = seen.iter().find(|(_, other)| *other == this) {
            let reason = format!(
                "and {} are the same file: choose different names for the outputs",
                output.display()
            );
            return Err(OutputError::Refused((*first).to_owned(), reason));
        }
        if let Some((role, input)) = inputs.iter().find(|(_, input)| identity(input) == this) {
            let other = Some(input).filter(|input| *input != output);
            let other = other.map_or(String::new(), |input| format!(" as {}", input.display()));
            let reason = format!(
                "is {role} that this command reads{other}: choose another name for the output"
            );
            return Err(OutputError::Refused(output.to_owned(), reason));
        }
        seen.push((output, this));
    }
    Ok(())
}

/// Identity of a file, whatever its name: device and number of an existing file. For a new file, or where the system
/// has no such numbers, it is the name and the folder after following links.
fn identity(path: &Path) -> (u64, u64, PathBuf) {
    #[cfg(unix)]
    if let Ok(there) = std::fs::metadata(path) {
        use std::os::unix::fs::MetadataExt;
        return (there.dev(), there.ino(), PathBuf::new());
    }
    let whole = path.canonicalize().or_else(|_| {
        let folder = folder(path).canonicalize()?;
        Ok::<_, std::io::Error>(folder.join(path.file_name().unwrap_or_default()))
    });
    (0, 0, whole.unwrap_or_else(|_| path.to_owned()))
}

/// A format in words, such as "an HDF5 file", and its file extensions without the dot, the usual one first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ending(pub &'static str, pub &'static [&'static str]);

/// HDF5; ParaView opens sections under the last extension.
pub const HDF5: Ending = Ending("an HDF5 file", &["h5", "hdf5", "hdf", "vtkhdf"]);

/// A kernel table.
pub const TABLE: Ending = Ending("a kernel table (HDF5)", &["h5", "hdf5", "hdf"]);

/// A shard of a kernel table.
pub const SHARD: Ending = Ending("a shard", &["shard", "part", "blocks"]);

/// Rows in compressed columns.
pub const PARQUET: Ending = Ending("a Parquet file", &["parquet"]);

/// Rows as HDF5 or Parquet.
pub const ROWS: Ending = Ending(
    "an HDF5 or a Parquet file",
    &["h5", "hdf5", "hdf", "vtkhdf", "parquet"],
);

/// Histories as text or HDF5.
pub const HISTORIES: Ending = Ending(
    "text in columns or an HDF5 file",
    &["csv", "txt", "h5", "hdf5", "hdf", "vtkhdf"],
);

/// Text in columns.
pub const CSV: Ending = Ending("text in columns", &["csv", "txt"]);

impl Ending {
    /// Whether a name has an extension of the format.
    pub fn is_of(self, path: &Path) -> bool {
        path.extension().is_some() && self.check(path).is_ok()
    }

    /// Rejects a name with the extension of another format; a name without an extension is accepted.
    ///
    /// # Errors
    /// [`OutputError::Refused`].
    pub fn check(self, path: &Path) -> Result<(), OutputError> {
        let Some(found) = path.extension() else {
            return Ok(());
        };
        let found = found.to_string_lossy();
        let is = |ending: &&str| found.eq_ignore_ascii_case(ending);
        if self.1.iter().any(is) {
            return Ok(());
        }
        let (format, allowed) = (self.0, self.1.join(" or ."));
        let reason = format!("must be {format} with the extension .{allowed}, not .{found}");
        Err(OutputError::Refused(path.to_owned(), reason))
    }
}
