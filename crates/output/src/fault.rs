//! Why the content of a file could not be written.

use std::io::{Error, ErrorKind};

/// A reason, and whether it may be gone when the same is tried again: there is no space left.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The system's or a library's reason.
    pub reason: String,
    /// Whether there is no space left, on the disk, in a quota, or below a limit of the process.
    pub full: bool,
}

/// The kinds of errors that mean that there is no space left, and how they are told.
const FULL: [(ErrorKind, &str); 3] = [
    (ErrorKind::StorageFull, "no space left on the disk"),
    (ErrorKind::QuotaExceeded, "no space left in the quota"),
    (
        ErrorKind::FileTooLarge,
        "no space left below the largest size of a file that is set for this process (ulimit -f)",
    ),
];

/// What the C library calls those errors, in whose words other libraries pass them on.
const MESSAGES: [(&str, ErrorKind); 3] = [
    ("No space left on device", ErrorKind::StorageFull),
    ("Disk quota exceeded", ErrorKind::QuotaExceeded),
    ("File too large", ErrorKind::FileTooLarge),
];

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        let known = FULL.iter().find(|(kind, _)| *kind == error.kind());
        Self {
            reason: known.map_or_else(|| error.to_string(), |(_, words)| (*words).to_owned()),
            full: known.is_some(),
        }
    }
}

impl From<String> for Fault {
    fn from(reason: String) -> Self {
        match MESSAGES.iter().find(|(text, _)| reason.contains(text)) {
            Some((_, kind)) => Error::from(*kind).into(),
            None => Self {
                reason,
                full: false,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_disk_is_known_from_the_system_and_from_texts() {
        for (number, words) in [(28, "on the disk"), (122, "quota"), (27, "ulimit")] {
            let system = Error::from_raw_os_error(number);
            let passed_on = Fault::from(format!("a library failed: {system}"));
            assert_eq!(Fault::from(system), passed_on);
            assert!(passed_on.full, "{passed_on:?}");
            assert!(
                passed_on.reason.starts_with("no space left"),
                "{passed_on:?}"
            );
            assert!(passed_on.reason.contains(words), "{passed_on:?}");
        }
        assert!(!Fault::from(Error::from(ErrorKind::PermissionDenied)).full);
        assert!(!Fault::from("no such thing".to_owned()).full);
    }
}
