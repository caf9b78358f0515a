//! How a command fails: exit code 2 for bad input, 1 when the work itself failed, 75 when it may be tried again.

use fault::{Class, Culprit, Fault, Remedy};
use output::OutputError;
use serde_json::{Map, Value, json};
use std::error::Error;
use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

/// A failure with its sentence for the user.
#[derive(Debug)]
pub(crate) struct Failure {
    sentence: String,
    remedy: Remedy,
    /// What it is about, for programs.
    about: Map<String, Value>,
}

impl Failure {
    /// The user can mend it: a scene, a file, an argument.
    pub(crate) fn input(error: impl Fault) -> Self {
        let mut failure = Self::from(error);
        failure.remedy = Remedy::Change;
        if failure.about["class"] == Class::Work.name() {
            failure.about["class"] = Class::Scene.name().into();
        }
        failure
    }

    /// The work could not be done.
    pub(crate) fn work(error: impl Display) -> Self {
        error.to_string().into()
    }

    /// What stands in the way may go.
    pub(crate) fn until_later(error: impl Display) -> Self {
        Self {
            remedy: Remedy::Wait,
            ..Self::work(error)
        }
    }

    /// Work of many parts failed; an output that cannot be written is told as everywhere.
    pub(crate) fn in_part(error: Box<dyn Error + Send + Sync>) -> Self {
        let output = error.downcast::<OutputError>();
        output.map_or_else(Self::work, |output| (*output).into())
    }

    /// The same with what to do, where it is this error that it helps against.
    pub(crate) fn hint_if(mut self, helps: bool, words: &str) -> Self {
        if helps {
            self.sentence += words;
        }
        self
    }

    /// Standard output does not take what is written.
    pub(crate) fn unprintable(error: std::io::Error) -> Self {
        let output::Fault { reason, full } = error.into();
        let told = format!("cannot write to standard output: {reason}");
        if full {
            Self::until_later(told)
        } else {
            Self::work(told)
        }
    }

    /// Prints it on standard error, as an object where the command was to print one, and gives the exit code.
    pub(crate) fn report(mut self) -> ExitCode {
        if wants_json() {
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
            (Class::Exists, _) => "; give --force to replace it",
            (Class::Memory, _) => ", or give --max-memory GB",
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

/// Whether a material is unknown.
fn names_no_material(culprit: &Culprit<'_>) -> bool {
    let is_material = |key: &str| key.rsplit('.').next() == Some("material");
    culprit.key.as_deref().is_some_and(is_material) && culprit.word.is_some()
}

/// A text without its middle, where a file has a word of a megabyte.
fn cut(text: &str) -> String {
    /// Letters of each end.
    const END: usize = 1000;
    let count = text.chars().count();
    if count <= 2 * END {
        return text.to_owned();
    }
    let first: String = text.chars().take(END).collect();
    let last: String = text.chars().skip(count - END).collect();
    format!("{first}...{last}")
}

/// What is known of an error.
fn about(culprit: &Culprit<'_>) -> Map<String, Value> {
    let number = culprit.number.map(Value::from);
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

/// Whether the command was to print JSON, told before its arguments are understood.
pub(crate) fn wants_json() -> bool {
    std::env::args_os().any(|argument| argument == "--json")
}

/// Whether only errors are told.
pub(crate) static QUIET: AtomicBool = AtomicBool::new(false);

/// Writes a warning, a note or how far the work is on standard error, unless only errors are wanted.
pub(crate) fn say(text: impl Display) {
    if !QUIET.load(Ordering::Relaxed) {
        tell(text);
    }
}

/// Writes a line on standard error; where nobody takes it, the work goes on all the same.
pub(crate) fn tell(text: impl Display) {
    let _ = writeln!(std::io::stderr(), "{}", visible(text));
}

/// Writes a line on standard output; a closed pipe ends the program quietly.
pub(crate) fn print(text: impl Display) -> Result<(), Failure> {
    match writeln!(std::io::stdout(), "{}", visible(text)) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == ErrorKind::BrokenPipe => std::process::exit(0),
        Err(error) => Err(Failure::unprintable(error)),
    }
}

/// Prints a report: one line of JSON, or text.
pub(crate) fn show(json: bool, value: &Value, text: impl Display) -> Result<(), Failure> {
    if json { print(value) } else { print(text) }
}

/// Lines of a report, each with its name.
pub(crate) fn lines<T: Display>(named: impl IntoIterator<Item = (&'static str, T)>) -> String {
    let line = |(name, text)| format!("{name:15}{text}");
    let lines: Vec<String> = named.into_iter().map(line).collect();
    lines.join("\n")
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
    // open for reading too, as nobody opens it for output
    let reads = |line: &str| line.starts_with("flags:") && line.trim_end().ends_with('2');
    if to_nothing && described.lines().any(reads) {
        let closed = "cannot write to standard output: it is closed";
        return Err(Failure::work(closed));
    }
    Ok(())
}
