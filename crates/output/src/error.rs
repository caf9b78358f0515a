//! What can keep a file from being written, and why its content could not be.

use fault::{Class, Culprit, Remedy};
use std::io::{Error, ErrorKind};
use std::path::{Path, PathBuf};

/// A file that could not be written, or is not to be.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The name is that of another format, of an input, of another output or of a file that is none of the program's.
    #[error("{} {}", .0.display(), .1)]
    Refused(PathBuf, String),
    /// The file exists and may not be replaced.
    #[error("{} exists already and is not replaced", .0.display())]
    Exists(PathBuf),
    /// The place cannot be written to, for the system's or a library's reason.
    #[error("cannot write {}: {}", .0.display(), .1)]
    Unwritable(PathBuf, String),
    /// The content could not be made or written, for such a reason; the file that was there is untouched.
    #[error("cannot write {}: {}", .0.display(), .1)]
    Failed(PathBuf, String),
    /// There is no space left, in words that say where; the file that was there is untouched.
    #[error("cannot write {}: {}; what was there is as it was", .0.display(), .1)]
    Full(PathBuf, String),
    /// Another run writes the same file.
    #[error("another run is writing {}; nothing was changed", .0.display())]
    Busy(PathBuf),
    /// Another run began something there.
    #[error(
        "{} holds the beginning of another {}, or of this one before its settings, its files or the program changed",
        .0.display(), .1
    )]
    Begun(PathBuf, &'static str),
    /// What was begun there cannot be read, for the system's reason.
    #[error("cannot read {}: {}", .0.display(), .1)]
    Unreadable(PathBuf, String),
    /// The format is one that the program was built without.
    #[error("{} is to be {}, which this program was built without", .0.display(), .1)]
    Unbuilt(PathBuf, &'static str),
}

impl OutputError {
    /// A place that cannot be written to.
    pub(crate) fn place(path: &Path, fault: impl Into<OutputFault>) -> Self {
        match Self::writing(path, fault) {
            Self::Failed(path, reason) => Self::Unwritable(path, reason),
            full => full,
        }
    }

    /// A write that failed.
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

/// A reason, and whether it may be gone when the same is tried again: there is no space left.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputFault {
    /// The system's or a library's reason.
    pub reason: String,
    /// Whether there is no space left, on the disk, in a quota, or below a limit of the process.
    pub full: bool,
}

/// The kinds of errors that mean that there is no space left, what the C library calls them, in whose words other libraries
/// pass them on, and how they are told.
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
