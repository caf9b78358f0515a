//! Errors of scenes, and of the program's own files when they are read back.

use contact::{UnknownMaterial, nearest};
use fault::{Class, Culprit, Fault, number};
use impact::TreatmentError;
use impact::response::ResponseError;
use std::borrow::Cow;
use std::path::Path;
use thiserror::Error;

/// A scene that cannot be computed, or a file of the program that cannot be read back. The message is one sentence with
/// the key, the value and the allowed values.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{}", .0.sentence)]
pub struct SceneError(Box<About>);

/// The sentence and its parts.
#[derive(Debug, Clone, PartialEq)]
struct About {
    sentence: String,
    /// Whether the error concerns numbers, so that other rows of a sweep may be valid.
    of_numbers: bool,
    culprit: Culprit<'static>,
}

impl SceneError {
    /// An error with a sentence only.
    pub(crate) fn told(sentence: String) -> Self {
        Self(Box::new(About {
            sentence,
            of_numbers: false,
            culprit: Culprit::of(Class::Scene),
        }))
    }

    /// An error of a key.
    pub(crate) fn of(sentence: String, key: impl Into<String>) -> Self {
        let mut error = Self::told(sentence);
        error.0.culprit.key = Some(Cow::Owned(key.into()));
        error
    }

    /// An error in a file that the sentence names.
    pub(crate) fn in_sentence(path: &Path, sentence: String) -> Self {
        let mut error = Self::told(sentence);
        error.0.culprit.file = Some(path.to_owned().into());
        error
    }

    /// A file that cannot be read.
    pub(crate) fn unreadable(path: &Path, reason: impl std::fmt::Display) -> Self {
        Self::in_sentence(path, format!("cannot read {}: {reason}", path.display()))
    }

    /// The file has the wrong kind or content; the sentence begins with its name.
    pub(crate) fn is(path: &Path, what: impl std::fmt::Display) -> Self {
        Self::in_sentence(path, format!("{} {what}", path.display()))
    }

    /// The file is damaged: a required part is missing or wrong.
    pub(crate) fn damaged(path: &Path, what: impl std::fmt::Display) -> Self {
        Self::in_sentence(path, format!("{}: {what}", path.display()))
    }

    /// An unknown key, with the nearest known key, or else the hint `otherwise`.
    pub(crate) fn unknown_key(key: String, suggestion: Option<String>, otherwise: &str) -> Self {
        let near = suggestion.as_deref().map(|near| near_key(&key, near));
        let near = near.unwrap_or_else(|| format!(" ({otherwise})"));
        let mut error = Self::of(format!("unknown key {key}{near}"), key);
        error.0.culprit.suggestion = suggestion.map(Into::into);
        error
    }

    /// A required key is missing.
    pub(crate) fn missing(key: impl Into<String>, hint: &str) -> Self {
        let key = key.into();
        Self::of(format!("{key} is missing: {hint}"), key)
    }

    /// A key that follows from another key or excludes it.
    pub(crate) fn superfluous(key: String, beside: &str, reason: &str) -> Self {
        let sentence = format!("{key} cannot be combined with {beside}: {reason}");
        Self::of(sentence, key)
    }

    /// A value of the wrong type.
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

    /// A number that contradicts other numbers.
    pub(crate) fn of_number(key: impl Into<String>, value: f64, sentence: String) -> Self {
        let mut error = Self::of(sentence, key);
        (error.0.of_numbers, error.0.culprit.number) = (true, Some(value));
        error
    }

    /// A place outside the block, whose size `limit_key` sets.
    pub(crate) fn outside_block(key: String, value: f64, limit_key: &str, limit: f64) -> Self {
        let sentence = format!(
            "{key} = {} is outside [0, {limit}]: the block ends at {limit_key}",
            number(value)
        );
        Self::beyond(key, value, limit, sentence)
    }

    /// A number above a limit that follows from other keys.
    fn beyond(key: impl Into<String>, value: f64, limit: f64, sentence: String) -> Self {
        let mut error = Self::of_number(key, value, sentence);
        (error.0.of_numbers, error.0.culprit.limits) = (false, Some([0.0, limit]));
        error
    }

    /// A time to which the echoes of a plate cannot be computed.
    pub(crate) fn late_echoes(value: f64, latest_s: f64) -> Self {
        let key = "target.until_s";
        let sentence = format!(
            "{key} = {} is outside (0, {latest_s:.4e}]: after 16 transits of the plate no digit of its echoes is left; for later times use the modes of the plate (Rayleigh-Lamb)",
            number(value)
        );
        Self::beyond(key, value, latest_s, sentence)
    }

    /// A word that is not one of the choices, which are separated by commas.
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
        // the first may include its value
        let key = first.split_once(" = ").map_or(&*first, |(key, _)| key);
        let mut error = Self::of(sentence, key);
        error.0.of_numbers = true;
        error
    }

    /// Of a key inside a section of a list, such as `sensor[1]`, with which the sentence begins.
    #[must_use]
    pub(crate) fn of_section(mut self, section: &str) -> Self {
        self.0.sentence = format!("{section}.{}", self.0.sentence);
        if let Some(key) = &self.0.culprit.key {
            self.0.culprit.key = Some(format!("{section}.{key}").into());
        }
        self
    }

    /// Adds the path of the file to the sentence, unless the error has a path already.
    #[must_use]
    pub fn in_file(mut self, path: &Path) -> Self {
        if self.0.culprit.file.is_none() {
            self.0.sentence = format!("{}: {}", path.display(), self.0.sentence);
            self.0.culprit.file = Some(path.to_owned().into());
        }
        self
    }

    /// Whether the error concerns numbers, so that other rows of a sweep may be valid.
    pub(crate) fn is_of_numbers(&self) -> bool {
        self.0.of_numbers
    }

    /// Whether the error is an unknown word.
    pub(crate) fn is_of_words(&self) -> bool {
        self.0.culprit.word.is_some()
    }
}

/// A treatment that is impossible for the force record.
impl From<TreatmentError> for SceneError {
    fn from(error: TreatmentError) -> Self {
        let key = format!("force.{}", error.key);
        let mut found = Self::of_number(key, error.value, format!("force.{error}"));
        (found.0.of_numbers, found.0.culprit.limits) = (false, Some(error.limits));
        found
    }
}

/// A response that is impossible.
impl From<ResponseError> for SceneError {
    fn from(error: ResponseError) -> Self {
        let mut found = Self::of(error.to_string(), error.key);
        found.0.culprit.number = error.value;
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

/// The nearest key, with its unit if only the unit differs.
fn near_key(key: &str, suggestion: &str) -> String {
    let own = key.rsplit('.').next().and_then(|own| own.rsplit_once('_'));
    match suggestion.rsplit_once('_') {
        Some((stem, unit)) if own.is_some_and(|own| own.0 == stem) => {
            near(&format!("{suggestion}, in {unit}"))
        }
        _ => near(suggestion),
    }
}
