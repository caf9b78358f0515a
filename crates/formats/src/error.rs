//! What can be wrong with a scene, or with a file that is read back.

use contact::nearest;
use fault::{Class, Culprit, Fault, number};
use impact::TreatmentError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A scene that cannot be run, told in one sentence with the key, the value and what is allowed; or a file of the program that
/// cannot be read back.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{}", .0.sentence)]
pub struct SceneError(Box<About>);

/// The sentence, and what is in it.
#[derive(Debug, Clone, Default, PartialEq)]
struct About {
    sentence: String,
    /// Of numbers that other rows of a sweep may not have.
    of_numbers: bool,
    key: Option<String>,
    number: Option<f64>,
    word: Option<String>,
    range: Option<String>,
    limits: Option<[f64; 2]>,
    suggestion: Option<String>,
    file: Option<PathBuf>,
}

impl SceneError {
    /// With what is known beside the sentence.
    fn told(sentence: String, known: impl FnOnce(&mut About)) -> Self {
        let mut about = Box::new(About::default());
        about.sentence = sentence;
        known(&mut about);
        Self(about)
    }

    fn of(sentence: String, key: impl Into<String>) -> Self {
        Self::told(sentence, |about| about.key = Some(key.into()))
    }

    /// One that is in a file and names it.
    pub(crate) fn in_sentence(path: &Path, sentence: String) -> Self {
        Self::told(sentence, |about| about.file = Some(path.to_owned()))
    }

    /// A file that cannot be read.
    pub(crate) fn unreadable(path: &Path, reason: impl std::fmt::Display) -> Self {
        Self::in_sentence(path, format!("cannot read {}: {reason}", path.display()))
    }

    /// The file is not what it should be: a sentence that its name begins.
    pub(crate) fn is(path: &Path, what: impl std::fmt::Display) -> Self {
        Self::in_sentence(path, format!("{} {what}", path.display()))
    }

    /// Something that every such file has is missing or wrong.
    pub(crate) fn damaged(path: &Path, what: impl std::fmt::Display) -> Self {
        Self::in_sentence(path, format!("{}: {what}", path.display()))
    }

    /// A text that is not TOML, from a line that counts from 1.
    pub(crate) fn syntax(line: usize, reason: &str) -> Self {
        Self::told(format!("line {line} is not valid TOML: {reason}"), |_| {})
    }

    /// A key that does not exist, with the nearest that does, or what is said otherwise.
    pub(crate) fn unknown_key(key: String, suggestion: Option<String>, otherwise: &str) -> Self {
        let near = suggested(&key, suggestion.as_deref(), otherwise);
        let mut error = Self::of(format!("unknown key {key}{near}"), key);
        error.0.suggestion = suggestion;
        error
    }

    /// A key that must be given.
    pub(crate) fn missing(key: impl Into<String>, hint: &str) -> Self {
        let key = key.into();
        Self::of(format!("{key} is missing: {hint}"), key)
    }

    /// A key beside another that it follows from, or that excludes it.
    pub(crate) fn superfluous(key: String, beside: &str, reason: &str) -> Self {
        let sentence = format!("{key} cannot be given beside {beside}: {reason}");
        Self::of(sentence, key)
    }

    /// A value of the wrong kind.
    #[must_use]
    pub fn wrong_kind(key: String, value: String, expected: &str) -> Self {
        let mut error = Self::of(format!("{key} = {value} is not {expected}"), key);
        error.0.word = Some(value);
        error
    }

    /// A number outside its range.
    pub fn out_of_range(key: impl Into<String>, value: f64, range: &str) -> Self {
        let key = key.into();
        let sentence = format!("{key} = {} is outside {range}", number(value));
        let mut error = Self::of_number(key, value, sentence);
        error.0.range = Some(range.to_owned());
        error
    }

    /// A number that is wrong beside others.
    pub(crate) fn of_number(key: impl Into<String>, value: f64, sentence: String) -> Self {
        let mut error = Self::of(sentence, key);
        (error.0.of_numbers, error.0.number) = (true, Some(value));
        error
    }

    /// A place outside the block, which a key ends.
    pub(crate) fn outside_block(key: String, value: f64, limit_key: &str, limit: f64) -> Self {
        let sentence = format!(
            "{key} = {} is outside [0, {limit}], where {limit_key} ends the block",
            number(value)
        );
        let mut error = Self::of_number(key, value, sentence);
        (error.0.of_numbers, error.0.limits) = (false, Some([0.0, limit]));
        error
    }

    /// A word that is not one of the choices, which commas divide.
    pub(crate) fn unknown_choice(key: String, value: &str, allowed: &str) -> Self {
        let found = nearest(value, allowed.split(", "));
        let near = near(found.as_deref());
        let sentence = format!("{key} = \"{value}\" is not one of {allowed}{near}");
        let mut error = Self::unknown_word(sentence, key, value, found);
        error.0.range = Some(allowed.to_owned());
        error
    }

    /// A material that is not in the library, with the nearest name.
    pub(crate) fn unknown_material(key: String, value: &str, suggestion: Option<String>) -> Self {
        let near = near(suggestion.as_deref());
        let sentence = format!("{key} = \"{value}\" is not in the materials library{near}");
        Self::unknown_word(sentence, key, value, suggestion)
    }

    fn unknown_word(sentence: String, key: String, value: &str, near: Option<String>) -> Self {
        let mut error = Self::of(sentence, key);
        (error.0.word, error.0.suggestion) = (Some(value.to_owned()), near);
        error
    }

    /// Two choices that exclude each other.
    pub(crate) fn conflict(
        first: impl Into<String>,
        second: impl std::fmt::Display,
        reason: &str,
    ) -> Self {
        let first = first.into();
        let sentence = format!("{first} cannot be combined with {second}: {reason}");
        let mut error = Self::of(sentence, first);
        error.0.of_numbers = true;
        error
    }

    /// The same with the path of the file that it is in, unless it names a file already.
    #[must_use]
    pub fn in_file(mut self, path: &Path) -> Self {
        if self.0.file.is_none() {
            self.0.sentence = format!("{}: {}", path.display(), self.0.sentence);
            self.0.file = Some(path.to_owned());
        }
        self
    }

    /// Whether it is of numbers that other rows of a sweep may not have.
    pub(crate) fn is_of_numbers(&self) -> bool {
        self.0.of_numbers
    }

    /// Whether it is of a word that is not known.
    pub(crate) fn is_of_words(&self) -> bool {
        self.0.word.is_some()
    }
}

/// A treatment that the force record cannot have.
impl From<TreatmentError> for SceneError {
    fn from(error: TreatmentError) -> Self {
        Self::told(format!("force.{error}"), |_| {})
    }
}

impl Fault for SceneError {
    fn culprit(&self) -> Culprit<'_> {
        let about = &*self.0;
        Culprit {
            key: about.key.as_deref(),
            number: about.number,
            word: about.word.as_deref(),
            range: about.range.as_deref(),
            limits: about.limits,
            suggestion: about.suggestion.as_deref(),
            file: about.file.as_deref(),
            ..Culprit::of(Class::Scene)
        }
    }
}

fn near(suggestion: Option<&str>) -> String {
    suggestion.map_or_else(String::new, |name| format!("; did you mean {name}?"))
}

/// The nearest key, with its unit where that is all that differs, or what is said otherwise.
fn suggested(key: &str, suggestion: Option<&str>, otherwise: &str) -> String {
    let own = key.rsplit('.').next().and_then(|own| own.rsplit_once('_'));
    match (
        suggestion,
        suggestion.and_then(|near| near.rsplit_once('_')),
    ) {
        (Some(near), Some((stem, unit))) if own.is_some_and(|own| own.0 == stem) => {
            format!("; did you mean {near}, in {unit}?")
        }
        (Some(_), _) => near(suggestion),
        (None, _) => format!(" ({otherwise})"),
    }
}
