//! Why there is no picture; and what is looked for by its name, with the error that it is not there.

use crate::request::Kind;
use contact::{Choice, nearest};
use formats::stored::{FileKind, ReadError, StoredQuantity};
use impact::FieldsError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A picture that cannot be composed, told in one sentence.
#[derive(Debug, Error)]
pub enum PlotError {
    /// A file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Files of different kinds.
    #[error("{} is {first}, and {} is {second}: one picture shows files of one kind", paths[0].display(), paths[1].display())]
    Mixed {
        /// The two files.
        paths: [PathBuf; 2],
        /// What the first is.
        first: FileKind,
        /// What the second is.
        second: FileKind,
    },
    /// A kind of picture that a file does not give.
    #[error("{} is {found}, which has no picture {kind}; it has {allowed}", path.display())]
    Unsuitable {
        /// The file.
        path: PathBuf,
        /// What it is.
        found: FileKind,
        /// What was asked for.
        kind: Kind,
        /// What can be.
        allowed: String,
    },
    /// A kind of picture of one file, asked of several.
    #[error("the picture {kind} shows one file, and {given} were given")]
    OneFile {
        /// What was asked for.
        kind: Kind,
        /// Files given.
        given: usize,
    },
    /// An animation of what does not move.
    #[error("an animation shows the waves in the section of an impact, and {} is {found}{}", path.display(), shown_as(*kind))]
    NotMoving {
        /// The file.
        path: PathBuf,
        /// What it is.
        found: FileKind,
        /// What was asked for.
        kind: Option<Kind>,
    },
    /// What a picture shows is not in the file.
    #[error("{} has no {what}: {hint}", path.display())]
    Absent {
        /// The file.
        path: PathBuf,
        /// What is missing.
        what: &'static str,
        /// What to do.
        hint: &'static str,
    },
    /// A quantity that is not there.
    #[error("{quantity} is not in {}{}; it has {allowed}", path.display(), did_you_mean(suggestion.as_deref()))]
    Quantity {
        /// The file.
        path: PathBuf,
        /// What was asked for.
        quantity: String,
        /// The nearest that is there.
        suggestion: Option<String>,
        /// What is there.
        allowed: String,
    },
    /// A quantity that the scene did not ask for.
    #[error("{} has no {quantity}: give the scene [output] quantities = [\"{quantity}\"]", path.display())]
    NotComputed {
        /// The file.
        path: PathBuf,
        /// What was asked for.
        quantity: String,
    },
    /// Times for a picture of all of them.
    #[error("the picture {kind} shows all times: only waves and axis show those that are given")]
    AllTimes {
        /// What is shown.
        kind: Kind,
    },
    /// Limits that are no interval, or not one of what is shown.
    #[error("the limits {low}:{high} are not those of a picture: {why}")]
    Limits {
        /// The lower one.
        low: f64,
        /// The upper one.
        high: f64,
        /// Why not.
        why: &'static str,
    },
    /// A value of a key that a sweep has not.
    #[error("{key} = {value} is not in {}; it has {allowed}", path.display())]
    Value {
        /// The file.
        path: PathBuf,
        /// The key.
        key: String,
        /// What was asked for.
        value: String,
        /// What is there.
        allowed: String,
    },
    /// More curves than a picture can show.
    #[error("{} would give {count} curves, and {most} can be told apart: choose among them, such as by --at {key}=VALUE", path.display())]
    TooMany {
        /// The file.
        path: PathBuf,
        /// Curves.
        count: usize,
        /// Curves that can be shown.
        most: usize,
        /// A key that varies.
        key: String,
    },
    /// A key of words along an axis of numbers.
    #[error("{key} has no numbers to draw along")]
    NoNumbers {
        /// The key.
        key: String,
    },
    /// A kernel table cannot be read.
    #[error(transparent)]
    Table(#[from] lookup::TableError),
    /// The fields could not be computed.
    #[error(transparent)]
    Fields(#[from] FieldsError),
}

impl PlotError {
    /// A kind of picture that a file of another kind does not give.
    pub(crate) fn unsuitable(path: &Path, found: FileKind, kind: Kind) -> Self {
        Self::Unsuitable {
            path: path.to_owned(),
            found,
            kind,
            allowed: match Kind::of(found).as_slice() {
                [] => "none".to_owned(),
                names => names.join(", "),
            },
        }
    }

    /// What a picture shows is not in the file.
    pub(crate) fn absent(path: &Path, what: &'static str, hint: &'static str) -> Self {
        let path = path.to_owned();
        Self::Absent { path, what, hint }
    }

    /// A word that is none of those that a file has: `said` is what was asked for, of which `word` may be misspelt.
    pub(crate) fn unknown<'a>(
        path: &Path,
        said: impl Into<String>,
        word: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        if impact::Quantity::named(word).is_some() {
            return Self::NotComputed {
                path: path.to_owned(),
                quantity: word.to_owned(),
            };
        }
        let known: Vec<&str> = known.into_iter().collect();
        Self::Quantity {
            path: path.to_owned(),
            quantity: said.into(),
            suggestion: nearest(word, known.iter().copied()),
            allowed: known.join(", "),
        }
    }
}

/// The only one of some files or paths.
pub(crate) fn only<T>(given: &[T], kind: Kind) -> Result<&T, PlotError> {
    match given {
        [only] => Ok(only),
        several => Err(PlotError::OneFile {
            kind,
            given: several.len(),
        }),
    }
}

/// The quantities of some names among those of a file.
pub(crate) fn chosen(
    path: &Path,
    known: &[StoredQuantity],
    names: &[impl AsRef<str>],
) -> Result<Vec<StoredQuantity>, PlotError> {
    let find = |name: &str| {
        let found = known.iter().find(|quantity| quantity.name == name);
        let all = || known.iter().map(|quantity| quantity.name.as_str());
        found
            .cloned()
            .ok_or_else(|| PlotError::unknown(path, name, name, all()))
    };
    names.iter().map(|name| find(name.as_ref())).collect()
}

fn shown_as(kind: Option<Kind>) -> String {
    kind.map_or_else(String::new, |kind| format!(", shown as {kind}"))
}

fn did_you_mean(suggestion: Option<&str>) -> String {
    suggestion.map_or_else(String::new, |word| format!(" (did you mean {word}?)"))
}
