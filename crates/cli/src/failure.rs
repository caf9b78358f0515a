//! Failure of a command. Exit codes: 2 for bad input, 1 if the work itself failed, 75 for a temporary failure.

use fault::{Class, Culprit, Fault, Remedy};
use output::OutputError;
use serde::Serialize;
use serde_json::{Map, Value, json};
use std::error::Error;
use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

/// A failure with its message for the user.
#[derive(Debug)]
pub(crate) struct Failure {
    sentence: String,
    remedy: Remedy,
    /// Fields of the JSON error: class, key, value, range, file.
    about: Map<String, Value>,
}

impl Failure {
    /// Bad input that the user can correct: a scene, a file, an argument.
    pub(crate) fn input(error: impl Fault) -> Self {
        let mut failure = Self::from(error);
        failure.remedy = Remedy::Change;
        if failure.about["class"] == Class::Work.name() {
            failure.about["class"] = Class::Scene.name().into();
        }
        failure
    }

    /// The work itself failed.
    pub(crate) fn work(error: impl Display) -> Self {
        error.to_string().into()
    }

    /// A temporary failure: the same command may succeed later.
    pub(crate) fn until_later(error: impl Display) -> Self {
        Self {
            remedy: Remedy::Wait,
            ..Self::work(error)
        }
    }

    /// Failure of work with several parts; an output that cannot be written is reported as in all other commands.
    pub(crate) fn in_part(error: Box<dyn Error + Send + Sync>) -> Self {
        let output = error.downcast::<OutputError>();
        output.map_or_else(Self::work, |output| (*output).into())
    }

    /// Appends the hint `words` if it applies to this error.
    pub(crate) fn hint_if(mut self, helps: bool, words: &str) -> Self {
        if helps {
            self.sentence += words;
        }
        self
    }

    /// Standard output rejects a write.
    pub(crate) fn unprintable(error: std::io::Error) -> Self {
        let output::OutputFault { reason, full } = error.into();
        let told = format!("cannot write to standard output: {reason}");
        if full {
            Self::until_later(told)
        } else {
            Self::work(told)
        }
    }

    /// Prints the failure on standard error, as an object if the command was called with --json, and returns the exit
    /// code.
    pub(crate) fn report(mut self) -> ExitCode {
        if JSON.load(Ordering::Relaxed) {
            (self.about).insert("message".to_owned(), self.sentence.into());
            tell(json!({ "error": self.about }));
        } else {
            tell(format!("error: {}", self.sentence));
        }
        ExitCode::from(match self.remedy {
            Remedy::Change => 2,
            Remedy::Unknown => 1,
            Remedy::Wait => 75,
        })
    }
}

impl<E: Fault> From<E> for Failure {
    fn from(error: E) -> Self {
        let culprit = error.culprit();
        let hint = match (culprit.class, culprit.remedy) {
            (Class::Exists, _) => "; pass --force to replace it",
            (Class::Memory, _) => ", or pass --max-memory GB",
            (Class::OutsideTable, Remedy::Change) => "; use --kernel direct or another table",
            (Class::Scene, _) if names_no_material(&culprit) => {
                "; `hertzlamb materials` lists the names"
            }
            _ => "",
        };
        Self {
            sentence: cut(&error.to_string()) + hint,
            remedy: culprit.remedy,
            about: about(&culprit),
        }
    }
}

/// Whether the error is an unknown material.
fn names_no_material(culprit: &Culprit<'_>) -> bool {
    let is_material = |key: &str| key.rsplit('.').next() == Some("material");
    culprit.key.as_deref().is_some_and(is_material) && culprit.word.is_some()
}

/// A text without its middle, for a file that contains a word of a megabyte.
fn cut(text: &str) -> String {
    /// Characters kept at each end.
    const SHOWN_END: usize = 1000;
    let count = text.chars().count();
    if count <= 2 * SHOWN_END {
        return text.to_owned();
    }
    let first: String = text.chars().take(SHOWN_END).collect();
    let last: String = text.chars().skip(count - SHOWN_END).collect();
    format!("{first}...{last}")
}

/// The JSON fields of an error.
fn about(culprit: &Culprit<'_>) -> Map<String, Value> {
    // JSON numbers are finite
    let number = culprit.number.map(|number| match number.is_finite() {
        true => Value::from(number),
        false => Value::from(number.to_string()),
    });
    let word = culprit.word.as_deref().map(cut).map(Value::from);
    let file = culprit.file.as_deref().map(Path::to_string_lossy);
    let known = [
        ("class", Some(culprit.class.name().into())),
        ("key", culprit.key.as_deref().map(cut).map(Value::from)),
        ("value", number.or(word)),
        ("range", culprit.range.as_deref().map(Value::from)),
        ("limits", culprit.limits.map(|limits| json!(limits))),
        ("suggestion", culprit.suggestion.as_deref().map(Value::from)),
        ("file", file.map(Value::from)),
    ];
    let known = known.into_iter();
    let known = known.filter_map(|(name, value)| Some((name.to_owned(), value?)));
    known.collect()
}

/// Whether the command was called with --json; set before the arguments are parsed.
pub(crate) static JSON: AtomicBool = AtomicBool::new(false);

/// An error as a JSON object with class and message only.
pub(crate) fn object(class: &str, message: &str) -> String {
    let object = json!({ "error": { "class": class, "message": message } });
    line(object)
}

/// Whether only errors are printed (--quiet).
pub(crate) static QUIET: AtomicBool = AtomicBool::new(false);

/// Writes a warning, a note or the progress on standard error, unless --quiet is set.
pub(crate) fn say(text: impl Display) {
    if !QUIET.load(Ordering::Relaxed) {
        tell(text);
    }
}

/// Writes a line on standard error; the work continues if nobody reads it.
fn tell(text: impl Display) {
    let _ = writeln!(std::io::stderr(), "{}", line(text));
}

/// Writes lines on standard output; file names in them must have passed [`line`]. A closed pipe is not an error.
pub(crate) fn print(text: impl Display) -> Result<(), Failure> {
    match writeln!(std::io::stdout(), "{}", visible(text, &['\n', '\t'])) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(Failure::unprintable(error)),
    }
}

/// Prints the report of a command, as one line of JSON or as text.
pub(crate) fn show(json: bool, report: &(impl Serialize + Display)) -> Result<(), Failure> {
    if json {
        print(serde_json::to_string(report).map_err(Failure::work)?)
    } else {
        print(report)
    }
}

/// Lines of a report, each with its name in front.
pub(crate) fn lines<T: Display>(named: impl IntoIterator<Item = (&'static str, T)>) -> String {
    let line = |(name, text)| format!("{name:15}{}", line(text));
    let lines: Vec<String> = named.into_iter().map(line).collect();
    lines.join("\n")
}

/// A text in one line. A new line in a file name would otherwise look like a separate message.
pub(crate) fn line(text: impl Display) -> String {
    visible(text, &['\t'])
}

/// A text with control characters other than `kept` escaped as in JSON: file names may contain them, and terminals obey
/// them.
fn visible(text: impl Display, kept: &[char]) -> String {
    let mut shown = String::new();
    for letter in text.to_string().chars() {
        match letter {
            '\n' if !kept.contains(&letter) => shown += "\\n",
            _ if letter.is_control() && !kept.contains(&letter) => {
                shown += &format!("\\u{:04x}", u32::from(letter));
            }
            _ => shown.push(letter),
        }
    }
    shown
}

/// Fails if standard output was closed before the program began: the system has put nothing in its place.
pub(crate) fn check_stdout() -> Result<(), Failure> {
    let of = |what: &str| format!("/proc/self/{what}/1");
    let to_nothing = std::fs::read_link(of("fd")).is_ok_and(|path| path.ends_with("null"));
    let described = std::fs::read_to_string(of("fdinfo")).unwrap_or_default();
    // the standard library reopens a closed one for reading too, which nobody does for output
    let reads = |line: &str| line.starts_with("flags:") && line.trim_end().ends_with('2');
    if to_nothing && described.lines().any(reads) {
        let closed = "cannot write to standard output: it is closed";
        return Err(Failure::work(closed));
    }
    Ok(())
}
