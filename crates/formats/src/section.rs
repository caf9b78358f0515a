//! Typed reading of a TOML table: every error names the full key and the value found.

use crate::error::SceneError;
use contact::{Choice, nearest};
use toml::{Table, Value};

/// A range of numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Range {
    /// In interval notation.
    pub(crate) name: &'static str,
    pub(crate) holds: fn(f64) -> bool,
}

pub(crate) const POSITIVE: Range = Range {
    name: "(0, inf)",
    holds: |x| x > 0.0 && x < f64::INFINITY,
};
pub(crate) const FINITE: Range = Range {
    name: "(-inf, inf)",
    holds: f64::is_finite,
};
pub(crate) const NOT_NEGATIVE: Range = Range {
    name: "[0, inf)",
    holds: |x| (0.0..f64::INFINITY).contains(&x),
};
pub(crate) const POISSON: Range = Range {
    name: "(-1, 0.5)",
    holds: |x| x > -1.0 && x < 0.5,
};
pub(crate) const TOLERANCE: Range = Range {
    name: "[1e-9, 0.1]",
    holds: |x| (1e-9..=0.1).contains(&x),
};

/// One section of a scene, or its root.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Section<'a> {
    name: &'a str,
    table: &'a Table,
}

impl<'a> Section<'a> {
    pub(crate) fn root(table: &'a Table) -> Self {
        Self { name: "", table }
    }

    pub(crate) fn name(&self) -> &'a str {
        self.name
    }

    pub(crate) fn key(&self, key: &str) -> String {
        if self.name.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.name)
        }
    }

    /// Reports the first key that is not allowed here.
    pub(crate) fn allow(&self, allowed: &[&str]) -> Result<(), SceneError> {
        match self
            .table
            .keys()
            .find(|key| !allowed.contains(&key.as_str()))
        {
            None => Ok(()),
            Some(key) => Err(SceneError::UnknownKey {
                key: self.key(key),
                suggestion: nearest(key, allowed.iter().copied()),
                allowed: format!("known keys: {}", allowed.join(", ")),
            }),
        }
    }

    /// A subsection such as [target].
    pub(crate) fn section(&self, key: &'a str) -> Result<Option<Section<'a>>, SceneError> {
        match self.table.get(key) {
            None => Ok(None),
            Some(Value::Table(table)) => Ok(Some(Section { name: key, table })),
            Some(other) => Err(self.wrong_kind(key, other, "a section")),
        }
    }

    /// A list of subsections such as [[probe]], with the names of their elements.
    pub(crate) fn list(&self, key: &str) -> Result<Vec<(String, &'a Table)>, SceneError> {
        let Some(value) = self.table.get(key) else {
            return Ok(Vec::new());
        };
        let Value::Array(items) = value else {
            return Err(self.wrong_kind(key, value, "a list of sections [[..]]"));
        };
        items
            .iter()
            .enumerate()
            .map(|(i, item)| match item {
                Value::Table(table) => Ok((format!("{}[{}]", self.key(key), i + 1), table)),
                other => Err(self.wrong_kind(key, other, "a list of sections [[..]]")),
            })
            .collect()
    }

    /// Names of all keys.
    pub(crate) fn names(&self) -> impl Iterator<Item = &'a str> {
        self.table.keys().map(String::as_str)
    }

    /// The table of a key that holds one.
    pub(crate) fn inner(&self, key: &'a str) -> Option<Section<'a>> {
        match self.table.get(key) {
            Some(Value::Table(table)) => Some(Section { name: key, table }),
            Some(_) | None => None,
        }
    }

    /// All subsections but for the keys `other`, by name.
    pub(crate) fn subsections(
        &self,
        other: &[&str],
    ) -> Result<Vec<(String, Section<'a>)>, SceneError> {
        let names = self.names().filter(|name| !other.contains(name));
        names
            .map(|name| match self.table.get(name) {
                Some(Value::Table(table)) => Ok((name.to_owned(), Section { name, table })),
                Some(value) => Err(self.wrong_kind(name, value, "a section of scene keys")),
                None => Err(self.missing(name, "a section of scene keys")),
            })
            .collect()
    }

    /// The value of a key, whatever it is.
    pub(crate) fn value(&self, key: &str) -> Option<&'a Value> {
        self.table.get(key)
    }

    pub(crate) fn of(name: &'a str, table: &'a Table) -> Self {
        Self { name, table }
    }

    pub(crate) fn number(&self, key: &str, range: Range) -> Result<Option<f64>, SceneError> {
        let Some(value) = self.table.get(key) else {
            return Ok(None);
        };
        let number = match value {
            Value::Float(x) => *x,
            Value::Integer(i) => *i as f64,
            other => return Err(self.wrong_kind(key, other, "a number")),
        };
        if (range.holds)(number) {
            Ok(Some(number))
        } else {
            Err(SceneError::OutOfRange {
                key: self.key(key),
                value: number,
                range: range.name,
            })
        }
    }

    pub(crate) fn required(&self, key: &str, range: Range, hint: &str) -> Result<f64, SceneError> {
        self.number(key, range)?
            .ok_or_else(|| self.missing(key, hint))
    }

    pub(crate) fn missing(&self, key: &str, hint: &str) -> SceneError {
        SceneError::Missing {
            key: self.key(key),
            hint: hint.to_owned(),
        }
    }

    pub(crate) fn text(&self, key: &str) -> Result<Option<&'a str>, SceneError> {
        match self.table.get(key) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(other) => Err(self.wrong_kind(key, other, "a string")),
        }
    }

    /// A whole number in a range.
    pub(crate) fn count(
        &self,
        key: &str,
        low: usize,
        high: usize,
        range: &'static str,
    ) -> Result<Option<usize>, SceneError> {
        match self.table.get(key) {
            None => Ok(None),
            Some(value) => self.whole(key, value, low, high, range).map(Some),
        }
    }

    /// A pair of whole numbers in a range.
    pub(crate) fn counts(
        &self,
        key: &str,
        low: usize,
        high: usize,
        range: &'static str,
    ) -> Result<Option<[usize; 2]>, SceneError> {
        match self.table.get(key) {
            None => Ok(None),
            Some(Value::Array(items)) if items.len() == 2 => Ok(Some([
                self.whole(key, &items[0], low, high, range)?,
                self.whole(key, &items[1], low, high, range)?,
            ])),
            Some(other) => Err(self.wrong_kind(key, other, "a pair of whole numbers")),
        }
    }

    fn whole(
        &self,
        key: &str,
        value: &Value,
        low: usize,
        high: usize,
        range: &'static str,
    ) -> Result<usize, SceneError> {
        let Value::Integer(number) = value else {
            return Err(self.wrong_kind(key, value, "a whole number"));
        };
        usize::try_from(*number)
            .ok()
            .filter(|n| (low..=high).contains(n))
            .ok_or(SceneError::OutOfRange {
                key: self.key(key),
                value: *number as f64,
                range,
            })
    }

    /// One of the values of a choice.
    pub(crate) fn choice<T: Choice>(&self, key: &str) -> Result<Option<T>, SceneError> {
        let Some(word) = self.text(key)? else {
            return Ok(None);
        };
        self.named(key, word).map(Some)
    }

    fn named<T: Choice>(&self, key: &str, word: &str) -> Result<T, SceneError> {
        T::named(word).ok_or_else(|| SceneError::UnknownChoice {
            key: self.key(key),
            value: word.to_owned(),
            allowed: T::ALL
                .iter()
                .map(|c| c.name())
                .collect::<Vec<_>>()
                .join(", "),
        })
    }

    /// Different values of a choice, as a list; none where the key is not there.
    pub(crate) fn choices<T: Choice + PartialEq>(&self, key: &str) -> Result<Vec<T>, SceneError> {
        let items = match self.table.get(key) {
            None => return Ok(Vec::new()),
            Some(Value::Array(items)) => items,
            Some(other) => return Err(self.wrong_kind(key, other, "a list of words")),
        };
        let mut found: Vec<T> = Vec::new();
        for item in items {
            let Value::String(word) = item else {
                return Err(self.wrong_kind(key, item, "a word"));
            };
            let choice = self.named(key, word)?;
            if found.contains(&choice) {
                return Err(SceneError::Conflict {
                    first: format!("{} = \"{word}\"", self.key(key)),
                    second: format!("\"{word}\""),
                    reason: "each word stands once",
                });
            }
            found.push(choice);
        }
        Ok(found)
    }

    /// Whether a key says true; no where it is not there.
    pub(crate) fn flag(&self, key: &str) -> Result<bool, SceneError> {
        match self.table.get(key) {
            None => Ok(false),
            Some(Value::Boolean(flag)) => Ok(*flag),
            Some(other) => Err(self.wrong_kind(key, other, "true or false")),
        }
    }

    pub(crate) fn wrong_kind(
        &self,
        key: &str,
        value: &Value,
        expected: &'static str,
    ) -> SceneError {
        let mut shown = value.to_string().replace('\n', " ");
        if shown.chars().count() > 60 {
            shown = shown.chars().take(57).chain("...".chars()).collect();
        }
        SceneError::WrongKind {
            key: self.key(key),
            value: shown,
            expected,
        }
    }
}

/// Parses TOML text.
pub(crate) fn parse(text: &str) -> Result<Table, SceneError> {
    text.parse::<Table>().map_err(|error| SceneError::Syntax {
        line: error.span().map_or(1, |span| {
            text.get(..span.start).unwrap_or(text).matches('\n').count() + 1
        }),
        reason: error.message().replace('\n', " "),
    })
}
