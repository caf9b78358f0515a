//! The file behind a name, and outputs that are inputs, or each other.

use crate::error::OutputError;
use std::ffi::OsStr;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Links that are followed one after the other.
const MOST_LINKS: usize = 40;

/// Whether a name stands for standard output.
#[must_use]
pub fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// The folder of a path.
#[must_use]
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
    let fault = |reason: String| OutputError::place(path, reason);
    if is_standard(path) {
        return Err(fault(
            "standard output does not take such a file; give a name, ./- for a file that is called so".to_owned(),
        ));
    }
    if path.as_os_str().is_empty() {
        return Err(fault("the name is empty".to_owned()));
    }
    if let Ok(there) = std::fs::metadata(path) {
        regular(&there.file_type()).map_err(|what| fault(what.to_owned()))?;
    }
    let real = follow(path).map_err(fault)?;
    if real.file_name().is_none() {
        return Err(fault("it has no file name".to_owned()));
    }
    let folder = folder(&real);
    match std::fs::metadata(folder) {
        Ok(data) if data.is_dir() => {}
        Ok(_) => return Err(fault(format!("{} is not a folder", folder.display()))),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            return Err(fault(format!(
                "the folder {} does not exist",
                folder.display()
            )));
        }
        Err(error) => return Err(OutputError::place(path, error)),
    }
    match std::fs::symlink_metadata(&real) {
        // a name that is too long, for one
        Err(error) if error.kind() != ErrorKind::NotFound => Err(OutputError::place(path, error)),
        Ok(_) | Err(_) => Ok(real),
    }
}

/// The path at the end of a chain of links.
fn follow(path: &Path) -> Result<PathBuf, String> {
    let mut real = path.to_owned();
    for _ in 0..MOST_LINKS {
        if real.starts_with("/proc") {
            return Err("it is an open file of a process, such as standard output".to_owned());
        }
        match std::fs::symlink_metadata(&real) {
            Ok(there) if there.is_symlink() => {
                let target = std::fs::read_link(&real).map_err(|error| error.to_string())?;
                real = folder(&real).join(target);
            }
            Ok(_) | Err(_) => return Ok(real),
        }
    }
    Err("it is a link to itself, or too many links one after the other".to_owned())
}

/// What keeps something from being a file that can be replaced.
fn regular(kind: &std::fs::FileType) -> Result<(), &'static str> {
    if kind.is_file() {
        return Ok(());
    }
    if kind.is_dir() {
        return Err("it is a folder");
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if kind.is_fifo() {
            return Err("it is a pipe, not a file");
        }
        if kind.is_char_device() || kind.is_block_device() {
            return Err("it is a device, not a file");
        }
    }
    Err("it is not a file")
}

/// `path` with something before and after its name; long names are replaced by a hash, so that there is room for both.
pub(crate) fn beside(path: &Path, before: &str, after: &str) -> PathBuf {
    let name = path.file_name().unwrap_or(OsStr::new(""));
    let mut whole = std::ffi::OsString::from(before);
    if name.len() > 180 {
        whole.push(format!("{:016x}", hash(name.as_encoded_bytes())));
    } else {
        whole.push(name);
    }
    whole.push(after);
    folder(path).join(whole)
}

/// Fowler, Noll and Vo's hash.
fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
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
    #[must_use]
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
