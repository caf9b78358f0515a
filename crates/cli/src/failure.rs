//! How a command fails: exit code 2 for bad input, 1 when the work itself failed, 75 when it may be tried again.

use std::fmt::Display;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

/// A failure with its sentence for the user.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The user can mend it: a scene, a file, an argument.
    Input(String),
    /// The work could not be done.
    Work(String),
    /// The same may succeed later: there is no space left, or another run is at it.
    Again(String),
}

impl Failure {
    pub(crate) fn input(error: impl Display) -> Self {
        Self::Input(error.to_string())
    }

    pub(crate) fn work(error: impl Display) -> Self {
        Self::Work(error.to_string())
    }

    /// Standard output does not take what is written.
    pub(crate) fn unprintable(error: std::io::Error) -> Self {
        let output::Fault { reason, full } = error.into();
        let sentence = format!("cannot write to standard output: {reason}");
        if full {
            Self::Again(sentence)
        } else {
            Self::Work(sentence)
        }
    }

    /// Prints the sentence on standard error and gives the exit code.
    pub(crate) fn report(&self) -> ExitCode {
        let (message, code) = match self {
            Self::Input(message) => (message, 2),
            Self::Work(message) => (message, 1),
            Self::Again(message) => (message, 75),
        };
        tell(format!("error: {message}"));
        ExitCode::from(code)
    }
}

impl From<formats::OutputError> for Failure {
    fn from(error: formats::OutputError) -> Self {
        match error {
            exists @ formats::OutputError::Exists { .. } => {
                Self::input(format!("{exists}; give --force to replace it"))
            }
            unbuilt @ formats::OutputError::Unbuilt { .. } => Self::input(format!(
                "{unbuilt}: build it with `cargo build --release --package hertzlamb-cli --features parquet`"
            )),
            again if again.may_be_tried_again() => Self::Again(again.to_string()),
            failed @ formats::OutputError::Failed { .. } => Self::work(failed),
            other => Self::input(other),
        }
    }
}

impl From<impact::ImpactError> for Failure {
    fn from(error: impact::ImpactError) -> Self {
        use contact::{ContactError as C, MarchError as M};
        use impact::{FieldError, FieldsError as F, ImpactError as E, TooMuch};
        match error {
            E::Contact(C::March(
                M::NoSolution { .. }
                | M::TooLong { .. }
                | M::NotConverged { .. }
                | M::Unstable { .. },
            )) => Self::work(error),
            E::Fields(F::Field(FieldError::Table { .. })) => {
                Self::input(format!("{error}; use --kernel direct or another table"))
            }
            E::TooMuch(TooMuch::Memory(_)) => {
                Self::input(format!("{error}, or give --max-memory GB"))
            }
            E::TooMuch(_)
            | E::NotFinite(_)
            | E::Contact(_)
            | E::Source(_)
            | E::Fields(_)
            | E::TooManySamples(_)
            | E::Domain(_)
            | E::NoDisc => Self::input(error),
        }
    }
}

/// Whether only errors are told.
static QUIET: AtomicBool = AtomicBool::new(false);

/// From now on tells only errors.
pub(crate) fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Whether only errors are told.
pub(crate) fn is_quiet() -> bool {
    QUIET.load(Ordering::Relaxed)
}

/// Writes a warning, a note or how far the work is on standard error, unless only errors are wanted.
pub(crate) fn say(text: impl Display) {
    if !is_quiet() {
        tell(text);
    }
}

/// Writes a line on standard error; where nobody takes it, the work goes on all the same.
pub(crate) fn tell(text: impl Display) {
    use std::io::Write;
    let _ = writeln!(std::io::stderr(), "{}", visible(text));
}

/// Writes a line on standard output; a closed pipe ends the program quietly.
pub(crate) fn print(text: impl Display) -> Result<(), Failure> {
    use std::io::{ErrorKind, Write};
    match writeln!(std::io::stdout(), "{}", visible(text)) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == ErrorKind::BrokenPipe => std::process::exit(0),
        Err(error) => Err(Failure::unprintable(error)),
    }
}

/// A text as it is, but for control characters, which names of files may have and which terminals obey.
fn visible(text: impl Display) -> String {
    let mut shown = String::new();
    for letter in text.to_string().chars() {
        if letter.is_control() && !['\n', '\t'].contains(&letter) {
            shown.extend(letter.escape_default());
        } else {
            shown.push(letter);
        }
    }
    shown
}

/// Fails where standard output was closed before the program began: the system has put nothing in its place.
pub(crate) fn check_stdout() -> Result<(), Failure> {
    let of = |what: &str| format!("/proc/self/{what}/1");
    let to_nothing = std::fs::read_link(of("fd")).is_ok_and(|path| path.ends_with("null"));
    let described = std::fs::read_to_string(of("fdinfo")).unwrap_or_default();
    let flags = described
        .lines()
        .find_map(|line| line.strip_prefix("flags:"));
    // open for reading too, as nobody opens it for output
    let both = flags.is_some_and(|flags| flags.trim().ends_with('2'));
    if to_nothing && both {
        return Err(Failure::work(
            "cannot write to standard output: it is closed",
        ));
    }
    Ok(())
}
