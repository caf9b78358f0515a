//! Errors of writing files, and their reasons.

use fault::{Class, Culprit, Remedy};
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

/// A file that could not be written, or must not be written.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The name is that of another format, of an input, of another output or of a file of another program.
    #[error("{} {}", .0.display(), .1)]
    Refused(PathBuf, String),
    /// The file exists and must not be replaced.
    #[error("{} exists already and was not replaced", .0.display())]
    Exists(PathBuf),
    /// The place is not writable; the reason comes from the system or a library.
    #[error("cannot write {}: {}", .0.display(), .1)]
    Unwritable(PathBuf, String),
    /// The content could not be created or written; an existing file is unchanged.
    #[error("cannot write {}: {}", .0.display(), .1)]
    Failed(PathBuf, String),
    /// No space is left; the message contains the place. An existing file is unchanged.
    #[error("cannot write {}: {}; an existing file is unchanged", .0.display(), .1)]
    Full(PathBuf, String),
    /// Another run writes the same file.
    #[error("another run is writing {}; nothing was changed", .0.display())]
    Busy(PathBuf),
    /// Another run has begun other work there.
    #[error(
        "{} contains the beginning of another {}, or of this one before its settings, its files or the program changed",
        .0.display(), .1
    )]
    Begun(PathBuf, &'static str),
    /// The beginning of other work cannot be read; the reason comes from the system.
    #[error("cannot read {}: {}", .0.display(), .1)]
    Unreadable(PathBuf, String),
    /// The format is one that the program was built without.
    #[error("{} has the name of {}, but this program was built without that format", .0.display(), .1)]
    Unbuilt(PathBuf, &'static str),
}

impl OutputError {
    /// An error of a place that is not writable.
    pub(crate) fn place(path: &Path, fault: impl Into<OutputFault>) -> Self {
        match Self::writing(path, fault) {
            Self::Failed(path, reason) => Self::Unwritable(path, reason),
            full => full,
        }
    }

    /// An error of a failed write.
    pub fn writing(path: &Path, fault: impl Into<OutputFault>) -> Self {
        let OutputFault { reason, full } = fault.into();
        let path = path.to_owned();
        if full {
            Self::Full(path, reason)
        } else {
            Self::Failed(path, reason)
        }
    }
}

impl fault::Fault for OutputError {
    fn culprit(&self) -> Culprit<'_> {
        let (class, remedy, path) = match self {
            Self::Exists(path) => (Class::Exists, Remedy::Change, path),
            Self::Failed(path, _) => (Class::Output, Remedy::Unknown, path),
            Self::Full(path, _) | Self::Busy(path) => (Class::Output, Remedy::Wait, path),
            Self::Unwritable(path, _)
            | Self::Refused(path, _)
            | Self::Begun(path, _)
            | Self::Unreadable(path, _)
            | Self::Unbuilt(path, _) => (Class::Output, Remedy::Change, path),
        };
        Culprit {
            remedy,
            ..Culprit::of(class).file(path)
        }
    }
}

/// A reason, and whether a retry may succeed because only space was missing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputFault {
    /// The reason of the system or a library.
    pub reason: String,
    /// Whether no space is left: on the disk, in a quota, or below a limit of the process.
    pub full: bool,
}

/// The errors that mean that no space is left: their kinds, their names in the C library, which other libraries pass
/// on, and their messages.
const FULL: [(ErrorKind, &str, &str); 3] = [
    (
        ErrorKind::StorageFull,
        "No space left on device",
        "no space left on the disk",
    ),
    (
        ErrorKind::QuotaExceeded,
        "Disk quota exceeded",
        "no space left in the quota",
    ),
    (
        ErrorKind::FileTooLarge,
        "File too large",
        "no space left below the largest size of a file that is set for this process (ulimit -f)",
    ),
];

impl OutputFault {
    fn of(reason: String, is: impl Fn(ErrorKind, &str) -> bool) -> Self {
        let found = FULL.iter().find(|(kind, text, _)| is(*kind, text));
        Self {
            full: found.is_some(),
            reason: found.map_or(reason, |(.., words)| (*words).to_owned()),
        }
    }
}

impl From<Error> for OutputFault {
    fn from(error: Error) -> Self {
        Self::of(error.to_string(), |kind, _| kind == error.kind())
    }
}

impl From<String> for OutputFault {
    fn from(reason: String) -> Self {
        Self::of(reason.clone(), |_, text| reason.contains(text))
    }
}

impl From<&str> for OutputFault {
    fn from(reason: &str) -> Self {
        reason.to_owned().into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_disk_is_known_from_the_system_and_from_texts() {
        for (number, words) in [(28, "on the disk"), (122, "quota"), (27, "ulimit")] {
            let system = Error::from_raw_os_error(number);
            let passed_on = OutputFault::from(format!("a library failed: {system}"));
            assert_eq!(OutputFault::from(system), passed_on);
            assert!(passed_on.full, "{passed_on:?}");
            assert!(
                passed_on.reason.starts_with("no space left"),
                "{passed_on:?}"
            );
            assert!(passed_on.reason.contains(words), "{passed_on:?}");
        }
        assert!(!OutputFault::from(Error::from(ErrorKind::PermissionDenied)).full);
        assert!(!OutputFault::from("no such thing".to_owned()).full);
    }
}
