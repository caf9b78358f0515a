//! Why there is no picture; and what is looked for by its name, with the error that it is not there.

use contact::{Choice, nearest};
use fault::{Class, Culprit, Fault};
use formats::SceneError;
use formats::quantities::Described;
use halfspace::DomainError;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A picture that cannot be composed, told in one sentence.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PlotError {
    /// A file cannot be read.
    #[error(transparent)]
    Read(#[from] SceneError),
    /// A kernel table cannot be read.
    #[error(transparent)]
    Table(#[from] lookup::TableError),
    /// A number is outside the physics.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// A sweep over words alone has no axis to draw along.
    #[error("{} has no key of numbers that varies: a sweep over words alone has no axis to draw along", .0.display())]
    NoAxis(PathBuf),
    /// A picture would have more curves than can be told apart.
    #[error("{} would give {curves} curves, and {most} can be told apart: choose among them", file.display())]
    TooManyCurves {
        /// The sweep.
        file: PathBuf,
        /// Its curves.
        curves: usize,
        /// Curves that can be told apart.
        most: usize,
        /// A value of a key that can be held, such as `target.material=steel`.
        example: Option<String>,
    },
    /// A kernel table without a slice.
    #[error("{} has no slice", .0.display())]
    NoSlice(PathBuf),
    /// What is asked for is not in the files, or not to be drawn.
    #[error("{sentence}")]
    Refused {
        /// The whole sentence.
        sentence: String,
        /// The file at fault.
        file: Option<PathBuf>,
        /// The nearest name that is there.
        suggestion: Option<String>,
    },
}

/// What is drawn, with sentences for its user.
pub(crate) type Drawn<T> = Result<(T, Vec<String>), PlotError>;

impl PlotError {
    /// What is asked for is not to be drawn.
    pub(crate) fn refused(file: Option<&Path>, sentence: String) -> Self {
        Self::Refused {
            sentence,
            file: file.map(Path::to_owned),
            suggestion: None,
        }
    }

    /// What a picture shows is not in the file.
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

    /// A word that is none of those that a file has: `said` is what was asked for, of which `word` may be misspelt.
    pub(crate) fn unknown<'a>(
        path: &Path,
        said: impl Display,
        word: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let known: Vec<&str> = known.into_iter().collect();
        // a part of a name, such as that of a quantity without its probe
        let longer = known.iter().filter(|name| name.contains(word));
        let whole = longer.min_by_key(|name| name.len());
        let whole = whole.map(|&name| name.to_owned());
        if whole.is_none() && impact::Quantity::named(word).is_some() {
            let hint = format!("give the scene [output] quantities = [\"{word}\"]");
            return Self::absent(path, word, &hint);
        }
        let suggestion = whole.or_else(|| nearest(word, known.iter().copied()));
        let near = suggestion.as_ref();
        let near = near.map_or_else(String::new, |word| format!(" (did you mean {word}?)"));
        Self::Refused {
            sentence: format!(
                "{said} is not in {}{near}; it has {}",
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

/// Which of the quantities of a file are asked for by their names; without names the usual ones.
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
