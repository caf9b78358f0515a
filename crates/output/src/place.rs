//! The file behind a name, and outputs that are inputs, or each other.

use crate::error::{OutputError, OutputFault};
use crate::journal::sum;
use std::ffi::{OsStr, OsString};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Links that are followed one after the other.
const MOST_LINKS: usize = 40;

/// Whether a name stands for standard output.
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

/// Where a file of this name is, or would be made: links are followed, also one to a file that is not there yet.
///
/// # Errors
/// [`OutputError::Unwritable`] when it is no regular file, or its folder is not there.
pub fn behind(path: &Path) -> Result<PathBuf, OutputError> {
    file_behind(path).map_err(|fault| OutputError::place(path, fault))
}

fn file_behind(path: &Path) -> Result<PathBuf, OutputFault> {
    if is_standard(path) {
        return Err("standard output does not take such a file; give a name, ./- for a file that is called so".into());
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
        // a name that is too long, for one
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
    Err("it is a link to itself, or too many links one after the other".into())
}

/// Refuses what is no file that can be replaced.
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

/// `path` with something before and after its name; long names are replaced by a hash, so that there is room for both.
pub(crate) fn beside(path: &Path, before: &str, after: &str) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    if name.len() > 180 {
        let hash = u64::from_le_bytes(sum(name.as_encoded_bytes()));
        name = format!("{hash:016x}").into();
    }
    let whole = [OsStr::new(before), &name, OsStr::new(after)];
    folder(path).join(whole.into_iter().collect::<OsString>())
}

/// What a file that a command reads is to it, such as "the scene", and where it is.
pub type Role = (&'static str, PathBuf);

/// Refuses, before any work, an output that is an input of the same command, and two outputs that are one file.
///
/// Files are compared by what they are, not by name: also through links of both kinds.
///
/// # Errors
/// [`OutputError::Refused`]; or that an output cannot be written at all.
pub fn apart(outputs: &[&Path], inputs: &[Role]) -> Result<(), OutputError> {
    let mut seen: Vec<(&Path, _)> = Vec::new();
    for &output in outputs {
        let this = identity(&behind(output)?);
        if let Some((first, _)) = seen.iter().find(|(_, other)| *other == this) {
            let reason = format!(
                "and {} are the same file: give each output a name of its own",
                output.display()
            );
            return Err(OutputError::Refused((*first).to_owned(), reason));
        }
        if let Some((role, input)) = inputs.iter().find(|(_, input)| identity(input) == this) {
            let other = Some(input).filter(|input| *input != output);
            let other = other.map_or(String::new(), |input| format!(" as {}", input.display()));
            let reason =
                format!("is {role} that this command reads{other}: give the output another name");
            return Err(OutputError::Refused(output.to_owned(), reason));
        }
        seen.push((output, this));
    }
    Ok(())
}

/// What a file is, whatever it is called: device and number of one that is there; elsewhere, and where nothing is yet, the
/// folder with its links followed, and the name.
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

/// A format in words, such as "an HDF5 file", and how the names of its files end: without the dot, the usual one first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ending(pub &'static str, pub &'static [&'static str]);

/// HDF5; sections open in ParaView under the last of its endings.
pub const HDF5: Ending = Ending("an HDF5 file", &["h5", "hdf5", "hdf", "vtkhdf"]);

/// A kernel table.
pub const TABLE: Ending = Ending("a kernel table (HDF5)", &["h5", "hdf5", "hdf"]);

/// A part of a kernel table.
pub const SHARD: Ending = Ending("a shard", &["shard", "part", "blocks"]);

/// Rows in columns that are compressed.
pub const PARQUET: Ending = Ending("a Parquet file", &["parquet"]);

/// Rows: HDF5, or Parquet.
pub const ROWS: Ending = Ending(
    "an HDF5 or a Parquet file",
    &["h5", "hdf5", "hdf", "vtkhdf", "parquet"],
);

/// Text in columns.
pub const CSV: Ending = Ending("text in columns", &["csv", "txt"]);

impl Ending {
    /// Whether a name ends so.
    pub fn is_of(self, path: &Path) -> bool {
        path.extension().is_some() && self.check(path).is_ok()
    }

    /// Refuses a name with the ending of another format; a name without one is accepted.
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
        let reason = format!("is to be {format}: its name ends with .{allowed}, not with .{found}");
        Err(OutputError::Refused(path.to_owned(), reason))
    }
}
