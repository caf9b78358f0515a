//! What can be wrong with a scene, or with a file that is read back.

use contact::{UnknownMaterial, nearest};
use fault::{Class, Culprit, Fault, number};
use impact::TreatmentError;
use std::borrow::Cow;
use std::path::Path;
use thiserror::Error;

/// A scene that cannot be run, told in one sentence with the key, the value and what is allowed; or a file of the program that
/// cannot be read back.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{}", .0.sentence)]
pub struct SceneError(Box<About>);

/// The sentence, and what is in it.
#[derive(Debug, Clone, PartialEq)]
struct About {
    sentence: String,
    /// Of numbers that other rows of a sweep may not have.
    of_numbers: bool,
    culprit: Culprit<'static>,
}

impl SceneError {
    /// One of which no more is known.
    pub(crate) fn told(sentence: String) -> Self {
        Self(Box::new(About {
            sentence,
            of_numbers: false,
            culprit: Culprit::of(Class::Scene),
        }))
    }

    /// One of a key.
    pub(crate) fn of(sentence: String, key: impl Into<String>) -> Self {
        let mut error = Self::told(sentence);
        error.0.culprit.key = Some(Cow::Owned(key.into()));
        error
    }

    /// One that is in a file and names it.
    pub(crate) fn in_sentence(path: &Path, sentence: String) -> Self {
        let mut error = Self::told(sentence);
        error.0.culprit.file = Some(path.to_owned().into());
        error
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

    /// A key that does not exist, with the nearest that does, or what is said otherwise.
    pub(crate) fn unknown_key(key: String, suggestion: Option<String>, otherwise: &str) -> Self {
        let near = suggestion.as_deref().map(|near| near_key(&key, near));
        let near = near.unwrap_or_else(|| format!(" ({otherwise})"));
        let mut error = Self::of(format!("unknown key {key}{near}"), key);
        error.0.culprit.suggestion = suggestion.map(Into::into);
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
    pub fn wrong_kind(key: String, value: String, expected: &str) -> Self {
        let mut error = Self::of(format!("{key} = {value} is not {expected}"), key);
        error.0.culprit.word = Some(value.into());
        error
    }

    /// A number outside its range.
    pub fn out_of_range(key: impl Into<String>, value: f64, range: &str) -> Self {
        let key = key.into();
        let sentence = format!("{key} = {} is outside {range}", number(value));
        let mut error = Self::of_number(key, value, sentence);
        error.0.culprit.range = Some(range.to_owned().into());
        error
    }

    /// A number that is wrong beside others.
    pub(crate) fn of_number(key: impl Into<String>, value: f64, sentence: String) -> Self {
        let mut error = Self::of(sentence, key);
        (error.0.of_numbers, error.0.culprit.number) = (true, Some(value));
        error
    }

    /// A place outside the block, which a key ends.
    pub(crate) fn outside_block(key: String, value: f64, limit_key: &str, limit: f64) -> Self {
        let sentence = format!(
            "{key} = {} is outside [0, {limit}], where {limit_key} ends the block",
            number(value)
        );
        let mut error = Self::of_number(key, value, sentence);
        (error.0.of_numbers, error.0.culprit.limits) = (false, Some([0.0, limit]));
        error
    }

    /// A word that is not one of the choices, which commas divide.
    pub(crate) fn unknown_choice(key: String, value: &str, allowed: &str) -> Self {
        let suggestion = nearest(value, allowed.split(", "));
        let near = suggestion.as_deref().map_or_else(String::new, near);
        let sentence = format!("{key} = \"{value}\" is not one of {allowed}{near}");
        let mut error = Self::unknown_word(sentence, key, value.to_owned(), suggestion);
        error.0.culprit.range = Some(allowed.to_owned().into());
        error
    }

    /// A material that is not in the library, with the nearest name.
    pub(crate) fn unknown_material(key: String, unknown: UnknownMaterial) -> Self {
        let sentence = format!("{key} = {unknown}");
        Self::unknown_word(sentence, key, unknown.name, unknown.suggestion)
    }

    fn unknown_word(sentence: String, key: String, word: String, near: Option<String>) -> Self {
        let mut error = Self::of(sentence, key);
        error.0.culprit.word = Some(word.into());
        error.0.culprit.suggestion = near.map(Into::into);
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
        // the first of them may stand there with its value
        let key = first.split_once(" = ").map_or(&*first, |(key, _)| key);
        let mut error = Self::of(sentence, key);
        error.0.of_numbers = true;
        error
    }

    /// The same with the path of the file that it is in, unless it names a file already.
    #[must_use]
    pub fn in_file(mut self, path: &Path) -> Self {
        if self.0.culprit.file.is_none() {
            self.0.sentence = format!("{}: {}", path.display(), self.0.sentence);
            self.0.culprit.file = Some(path.to_owned().into());
        }
        self
    }

    /// Whether it is of numbers that other rows of a sweep may not have.
    pub(crate) fn is_of_numbers(&self) -> bool {
        self.0.of_numbers
    }

    /// Whether it is of a word that is not known.
    pub(crate) fn is_of_words(&self) -> bool {
        self.0.culprit.word.is_some()
    }
}

/// A treatment that the force record cannot have.
impl From<TreatmentError> for SceneError {
    fn from(error: TreatmentError) -> Self {
        let key = format!("force.{}", error.key);
        let mut found = Self::of_number(key, error.value, format!("force.{error}"));
        (found.0.of_numbers, found.0.culprit.limits) = (false, Some(error.limits));
        found
    }
}

impl Fault for SceneError {
    fn culprit(&self) -> Culprit<'_> {
        self.0.culprit.clone()
    }
}

fn near(suggestion: &str) -> String {
    format!("; did you mean {suggestion}?")
}

/// The nearest key, with its unit where that is all that differs.
fn near_key(key: &str, suggestion: &str) -> String {
    let own = key.rsplit('.').next().and_then(|own| own.rsplit_once('_'));
    match suggestion.rsplit_once('_') {
        Some((stem, unit)) if own.is_some_and(|own| own.0 == stem) => {
            near(&format!("{suggestion}, in {unit}"))
        }
        _ => near(suggestion),
    }
}
