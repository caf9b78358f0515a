//! What can be wrong with a scene.

use ::fault::{Class, Culprit, Fault};
use contact::nearest;
use impact::TreatmentError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A scene that cannot be run, told in one sentence with the key, the value and what is allowed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SceneError {
    /// An error in a file.
    #[error("{}: {error}", path.display())]
    In {
        path: PathBuf,
        /// What is wrong in it.
        error: Box<SceneError>,
    },
    /// The file cannot be read.
    #[error("cannot read {}: {reason}", path.display())]
    Unreadable { path: PathBuf, reason: String },
    /// The text is not TOML.
    #[error("line {line} is not valid TOML: {reason}")]
    Syntax {
        /// Line, from 1.
        line: usize,
        /// The parser's reason.
        reason: String,
    },
    /// A key that does not exist.
    #[error("unknown key {key}{}", suggested(.key, .suggestion, .allowed))]
    UnknownKey {
        key: String,
        /// The nearest key that exists.
        suggestion: Option<String>,
        /// The keys that exist there.
        allowed: String,
    },
    /// A key that must be given is absent.
    #[error("{key} is missing: {hint}")]
    Missing {
        key: String,
        /// What to give.
        hint: String,
    },
    /// A key beside another that it follows from, or that excludes it.
    #[error("{key} cannot be given beside {beside}: {reason}")]
    Superfluous {
        key: String,
        /// What is given already.
        beside: String,
        reason: &'static str,
    },
    /// A value of the wrong kind.
    #[error("{key} = {value} is not {expected}")]
    WrongKind {
        key: String,
        value: String,
        /// What was expected.
        expected: &'static str,
    },
    /// A number outside its range.
    #[error("{key} = {value} is outside {range}")]
    OutOfRange {
        key: String,
        value: f64,
        /// The allowed range in interval notation.
        range: &'static str,
    },
    /// A place outside the block.
    #[error("{key} = {value} is outside [0, {limit}], where {limit_key} ends the block")]
    OutsideBlock {
        key: String,
        value: f64,
        /// What ends the block.
        limit_key: &'static str,
        limit: f64,
    },
    /// A word that is not one of the choices.
    #[error("{key} = \"{value}\" is not one of {allowed}{}", near(nearest_in(.value, .allowed)))]
    UnknownChoice {
        key: String,
        /// The word found.
        value: String,
        allowed: String,
    },
    /// A material that is not in the library.
    #[error("{key} = \"{value}\" is not in the materials library{}", near(.suggestion.as_deref()))]
    UnknownMaterial {
        key: String,
        /// The name found.
        value: String,
        /// The nearest name.
        suggestion: Option<String>,
    },
    /// The same quantity given twice, differently.
    #[error(
        "{section} gives {quantity} twice: {first} from {first_key} and {second} from {second_key}; leave one pair out"
    )]
    Inconsistent {
        /// Section of the scene.
        section: String,
        quantity: &'static str,
        /// Value from the first keys.
        first: f64,
        /// The first keys.
        first_key: &'static str,
        /// Value from the second keys.
        second: f64,
        /// The second keys.
        second_key: &'static str,
    },
    /// Two choices that exclude each other.
    #[error("{first} cannot be combined with {second}: {reason}")]
    Conflict {
        /// The first choice.
        first: String,
        /// The second choice.
        second: String,
        reason: &'static str,
    },
    /// A treatment that the force record cannot have.
    #[error("force.{0}")]
    Treatment(#[from] TreatmentError),
    /// A force file with an unusable row.
    #[error("{} line {line}: {reason}", path.display())]
    ForceFile {
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What is wrong with it.
        reason: String,
    },
}

impl SceneError {
    /// The same with the path of the file that it is in, unless it names a file already.
    #[must_use]
    pub fn in_file(self, path: &Path) -> Self {
        match self {
            named @ (Self::In { .. } | Self::Unreadable { .. } | Self::ForceFile { .. }) => named,
            error => Self::In {
                path: path.to_owned(),
                error: Box::new(error),
            },
        }
    }
}

impl Fault for SceneError {
    fn culprit(&self) -> Culprit<'_> {
        let scene = Culprit::of(Class::Scene);
        match self {
            Self::In { path, error } => {
                let found = error.culprit();
                let file = found.file.or(Some(path));
                Culprit { file, ..found }
            }
            Self::Unreadable { path, .. } | Self::ForceFile { path, .. } => scene.file(path),
            Self::Syntax { .. } | Self::Treatment(_) => scene,
            Self::UnknownKey {
                key, suggestion, ..
            } => Culprit {
                suggestion: suggestion.as_deref(),
                ..scene.key(key)
            },
            Self::Missing { key, .. }
            | Self::Superfluous { key, .. }
            | Self::Conflict { first: key, .. } => scene.key(key),
            Self::WrongKind { key, value, .. } => scene.key(key).word(value),
            Self::UnknownChoice {
                key,
                value,
                allowed,
            } => Culprit {
                suggestion: nearest_in(value, allowed),
                ..scene.key(key).word(value).range(allowed)
            },
            Self::OutOfRange { key, value, range } => scene.key(key).number(*value).range(range),
            Self::OutsideBlock {
                key, value, limit, ..
            } => Culprit {
                limits: Some([0.0, *limit]),
                ..scene.key(key).number(*value)
            },
            Self::UnknownMaterial {
                key,
                value,
                suggestion,
            } => Culprit {
                suggestion: suggestion.as_deref(),
                ..scene.key(key).word(value)
            },
            Self::Inconsistent {
                second_key, second, ..
            } => scene.key(second_key).number(*second),
        }
    }
}

fn near(suggestion: Option<&str>) -> String {
    suggestion.map_or_else(String::new, |name| format!("; did you mean {name}?"))
}

/// The nearest to a word of some that commas divide.
fn nearest_in<'a>(word: &str, allowed: &'a str) -> Option<&'a str> {
    let found = nearest(word, allowed.split(", "))?;
    allowed.split(", ").find(|name| *name == found)
}

/// The nearest key, with its unit where that is all that differs, or what is known.
fn suggested(key: &str, suggestion: &Option<String>, otherwise: &str) -> String {
    let own = key.rsplit('.').next().and_then(|own| own.rsplit_once('_'));
    match (
        suggestion,
        suggestion.as_ref().and_then(|near| near.rsplit_once('_')),
    ) {
        (Some(near), Some((stem, unit))) if own.is_some_and(|own| own.0 == stem) => {
            format!("; did you mean {near}, in {unit}?")
        }
        (Some(_), _) => near(suggestion.as_deref()),
        (None, _) => format!(" ({otherwise})"),
    }
}
