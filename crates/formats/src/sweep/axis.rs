//! The keys that vary and their values.

use super::drawn::Drawn;
use crate::error::SceneError;
use crate::section::Section;
use toml::{Table, Value};

/// Values of a key along an axis.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers.
    Numbers(Vec<f64>),
    /// Words, such as materials or models.
    Texts(Vec<String>),
    /// Random numbers, which are not held.
    Drawn(Drawn),
}

impl Values {
    /// How many.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len(),
            Self::Texts(texts) => texts.len(),
            Self::Drawn(drawn) => drawn.len(),
        }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One of the numbers; nothing of words.
    #[must_use]
    pub fn number(&self, index: usize) -> Option<f64> {
        match self {
            Self::Numbers(numbers) => numbers.get(index).copied(),
            Self::Texts(_) => None,
            Self::Drawn(drawn) => (index < drawn.len()).then(|| drawn.at(index)),
        }
    }

    /// Those that a key of a section lists.
    pub(super) fn read(section: &Section<'_>, key: &str) -> Result<Self, SceneError> {
        let Some(value) = section.value(key) else {
            return Err(section.missing(key, "a list of values"));
        };
        let wrong = || section.wrong_kind(key, value, "a list of numbers or of words");
        let items = match value {
            Value::Array(items) if !items.is_empty() => items,
            _ => return Err(wrong()),
        };
        if items.iter().all(Value::is_str) {
            let words = items.iter().filter_map(Value::as_str).map(str::to_owned);
            return Ok(Self::Texts(words.collect()));
        }
        let number = |item: &Value| match item {
            Value::Float(x) => Some(*x),
            Value::Integer(i) => Some(*i as f64),
            _ => None,
        };
        let numbers: Option<Vec<f64>> = items.iter().map(number).collect();
        numbers.map(Self::Numbers).ok_or_else(wrong)
    }

    /// One of them as TOML.
    pub(crate) fn get(&self, index: usize) -> Value {
        match self {
            Self::Numbers(numbers) => Value::Float(numbers[index]),
            Self::Texts(texts) => Value::String(texts[index].clone()),
            Self::Drawn(drawn) => Value::Float(drawn.at(index)),
        }
    }
}

/// A scene key with its values along an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Section of the scene.
    pub section: String,
    /// Key in that section.
    pub key: String,
    /// Values.
    pub values: Values,
}

impl Column {
    /// The full name, such as `striker.mass_kg`.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{}.{}", self.section, self.key)
    }

    /// Puts a value into a scene.
    pub(crate) fn put(&self, scene: &mut Table, value: Value) -> Result<(), SceneError> {
        let section = scene
            .entry(self.section.clone())
            .or_insert_with(|| Value::Table(Table::new()));
        match section {
            Value::Table(table) => {
                table.insert(self.key.clone(), value);
                Ok(())
            }
            other => Err(SceneError::WrongKind {
                key: self.section.clone(),
                value: other.to_string(),
                expected: "a section",
            }),
        }
    }
}

/// One dimension of a sweep: one key, or several that vary together.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The key, or "list", or "sample".
    pub name: String,
    /// Its keys; all have as many values as the axis is long.
    pub columns: Vec<Column>,
    /// Length.
    pub len: usize,
}

/// Number of rows of some axes, or nothing when it is beyond all counting.
pub(crate) fn rows(axes: &[Axis]) -> Option<usize> {
    axes.iter()
        .try_fold(1_usize, |rows, axis| rows.checked_mul(axis.len))
}

/// Index along each axis of a row; the last axis runs fastest.
pub(crate) fn place(axes: &[Axis], row: usize, place: &mut Vec<usize>) {
    place.clear();
    place.resize(axes.len(), 0);
    let mut rest = row;
    for (slot, axis) in place.iter_mut().zip(axes).rev() {
        *slot = rest % axis.len;
        rest /= axis.len;
    }
}
