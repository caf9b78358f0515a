//! Errors of pictures, and the search for names with the error that a name does not exist.

use contact::{Choice, nearest};
use fault::{Class, Culprit, Fault};
use formats::SceneError;
use formats::quantities::Described;
use halfspace::DomainError;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A picture that cannot be composed; the message is one sentence.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PlotError {
    /// A file cannot be read.
    #[error(transparent)]
    Read(#[from] SceneError),
    /// A kernel table cannot be read.
    #[error(transparent)]
    Table(#[from] lookup::TableError),
    /// A number is outside its physical range.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// A sweep that varies words only has no axis to draw along.
    #[error("{} varies no key with numbers: a sweep over words only has no x axis", .0.display())]
    NoAxis(PathBuf),
    /// A picture would have too many curves.
    #[error("{} would give {curves} curves, but at most {most} are distinguishable: select some of them", file.display())]
    TooManyCurves {
        /// The sweep.
        file: PathBuf,
        /// Number of curves.
        curves: usize,
        /// Largest number of curves.
        most: usize,
        /// A value of a key that can be fixed, such as `target.material=steel`.
        example: Option<String>,
    },
    /// A kernel table without a slice.
    #[error("{} has no slice", .0.display())]
    NoSlice(PathBuf),
    /// The request does not match the files, or cannot be drawn.
    #[error("{sentence}")]
    Refused {
        /// The whole sentence.
        sentence: String,
        /// The file at fault.
        file: Option<PathBuf>,
        /// The nearest existing name.
        suggestion: Option<String>,
    },
}

/// A figure with notes for the user.
pub(crate) type Drawn<T> = Result<(T, Vec<String>), PlotError>;

impl PlotError {
    /// A request that cannot be drawn.
    pub(crate) fn refused(file: Option<&Path>, sentence: String) -> Self {
        Self::Refused {
            sentence,
            file: file.map(Path::to_owned),
            suggestion: None,
        }
    }

    /// The file does not contain the data of a picture.
    pub(crate) fn absent(path: &Path, what: &str, hint: &str) -> Self {
        Self::refused(
            Some(path),
            format!("{} has no {what}: {hint}", path.display()),
        )
    }

    /// A key of words along an axis of numbers.
    pub(crate) fn no_numbers(key: &str) -> Self {
        Self::refused(None, format!("{key} has no numbers to draw along"))
    }

    /// A name that the file does not have: `said` is the request, and `word` the part that may be misspelt.
    pub(crate) fn unknown<'a>(
        path: &Path,
        said: impl Display,
        word: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let known: Vec<&str> = known.into_iter().collect();
        // part of a name, such as a quantity without its probe
        let longer = known.iter().filter(|name| name.contains(word));
        let whole = longer.min_by_key(|name| name.len());
        let whole = whole.map(|&name| name.to_owned());
        if whole.is_none() && impact::Quantity::named(word).is_some() {
            let hint = format!("add [output] quantities = [\"{word}\"] to the scene");
            return Self::absent(path, word, &hint);
        }
        let suggestion = whole.or_else(|| nearest(word, known.iter().copied()));
        let near = suggestion.as_ref();
        let near = near.map_or_else(String::new, |word| format!(" (did you mean {word}?)"));
        Self::Refused {
            sentence: format!(
                "{said} does not exist in {}{near}; choose one of {}",
                path.display(),
                known.join(", ")
            ),
            file: Some(path.to_owned()),
            suggestion,
        }
    }
}

impl Fault for PlotError {
    fn culprit(&self) -> Culprit<'_> {
        match self {
            Self::Read(error) => error.culprit(),
            Self::Table(error) => Culprit::of(Class::Table).file(&error.path),
            Self::Domain(_) => Culprit::of(Class::Domain),
            Self::NoAxis(file) | Self::TooManyCurves { file, .. } | Self::NoSlice(file) => {
                Culprit::of(Class::Scene).file(file)
            }
            Self::Refused {
                file, suggestion, ..
            } => Culprit {
                file: file.as_deref().map(Into::into),
                suggestion: suggestion.as_deref().map(Into::into),
                ..Culprit::of(Class::Scene)
            },
        }
    }
}

/// The requested quantities of a file by their names, or else the usual ones.
pub(crate) fn chosen(
    path: &Path,
    known: &[Described],
    asked: &[String],
    usual: &[&str],
) -> Result<Vec<usize>, PlotError> {
    let find = |name: &str| {
        let found = known.iter().position(|quantity| quantity.name == name);
        let all = || known.iter().map(|quantity| quantity.name.as_str());
        found.ok_or_else(|| PlotError::unknown(path, name, name, all()))
    };
    match asked {
        [] => usual.iter().map(|name| find(name)).collect(),
        names => names.iter().map(|name| find(name)).collect(),
    }
}
