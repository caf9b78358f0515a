//! The keys that vary and their values.

use super::draws::Drawn;
use crate::error::SceneError;
use crate::scene::keys::{FINITE, POSITIVE};
use crate::scene::section::{TomlSection, as_number};
use crate::schema::sweep::SAMPLE;
use contact::choice;
use toml::{Table, Value};

/// Largest number of values of an axis, except for draws: the values are held in memory.
const MOST_VALUES: usize = 10_000_000;

/// Values of a key along an axis.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers.
    Numbers(Vec<f64>),
    /// Words, such as materials or models.
    Texts(Vec<String>),
    /// Random numbers, which are computed on request.
    Drawn(Drawn),
}

impl Values {
    /// Number of values.
    pub fn count(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len(),
            Self::Texts(texts) => texts.len(),
            Self::Drawn(drawn) => drawn.count(),
        }
    }

    /// One of the numbers; none for words.
    pub fn number(&self, index: usize) -> Option<f64> {
        match self {
            Self::Numbers(numbers) => numbers.get(index).copied(),
            Self::Texts(_) => None,
            Self::Drawn(drawn) => (index < drawn.count()).then(|| drawn.at(index)),
        }
    }

    /// The values that a key lists, or that a range defines.
    pub(crate) fn read(section: &TomlSection<'_>, key: &str) -> Result<Self, SceneError> {
        if let Some(range) = section.inner(key) {
            return spaced(&range).map(Self::Numbers);
        }
        let values = section.typed(key, "a list of numbers or of words", |value| {
            let items = value.as_array().filter(|items| !items.is_empty())?.iter();
            let words = items.clone().map(|item| item.as_str().map(str::to_owned));
            let words: Option<Vec<String>> = words.collect();
            let numbers = || Some(Self::Numbers(items.map(as_number).collect::<Option<_>>()?));
            words.map(Self::Texts).or_else(numbers)
        });
        values?.ok_or_else(|| section.missing(key, "a list of values"))
    }

    /// One of the values as TOML.
    pub(super) fn get(&self, index: usize) -> Value {
        match self {
            Self::Texts(texts) => Value::String(texts[index].clone()),
            Self::Numbers(_) | Self::Drawn(_) => self.number(index).unwrap_or(f64::NAN).into(),
        }
    }

    /// The words, if the values are words.
    pub(super) fn texts(&self) -> Option<&Vec<String>> {
        match self {
            Self::Texts(texts) => Some(texts),
            Self::Numbers(_) | Self::Drawn(_) => None,
        }
    }
}

/// Spacing of the values of a range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Spacing {
    Linear,
    Log,
}

choice!(Spacing: Linear = "linear", Log = "log");

fn spaced(range: &TomlSection<'_>) -> Result<Vec<f64>, SceneError> {
    range.allow(["from", "to", "count", "spacing"])?;
    let spacing = range.choice("spacing")?.unwrap_or(Spacing::Linear);
    let allowed = match spacing {
        Spacing::Linear => FINITE,
        Spacing::Log => POSITIVE,
    };
    let from = range.required("from", allowed, "the first value")?;
    let to = range.required("to", allowed, "the last value")?;
    let count = range
        .count("count", 2..=MOST_VALUES, "[2, 10000000]")?
        .ok_or_else(|| range.missing("count", "how many values"))?;
    let last = (count - 1) as f64;
    let value = |i: usize| match (i as f64 / last, spacing) {
        _ if i + 1 == count => to,
        (fraction, Spacing::Linear) => from + fraction * (to - from),
        (fraction, Spacing::Log) => decade(from, from * (to / from).powf(fraction)),
    };
    Ok((0..count).map(value).collect())
}

/// Rounds a value that is a whole number of decades from `from` except for rounding errors.
fn decade(from: f64, value: f64) -> f64 {
    /// Rounding error of a logarithm and a power, in decades.
    const DECADE_ROUNDING: f64 = 1e-13;
    let decades = (value / from).log10();
    let whole = decades.round();
    let shown = format!("{from:e}");
    match shown.split_once('e') {
        Some((digits, exponent)) if (decades - whole).abs() < DECADE_ROUNDING => {
            let exponent = exponent.parse::<f64>().unwrap_or(0.0) + whole;
            format!("{digits}e{exponent}").parse().unwrap_or(value)
        }
        Some(_) | None => value,
    }
}

/// A scene key with its values along an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct SweptKey {
    /// Section of the scene.
    pub section: String,
    /// Key in that section.
    pub key: String,
    /// Values.
    pub values: Values,
}

impl SweptKey {
    /// The full name, such as `striker.mass_kg`.
    pub fn name(&self) -> String {
        format!("{}.{}", self.section, self.key)
    }

    /// Writes a value into a scene.
    pub(super) fn put(&self, scene: &mut Table, value: Value) -> Result<(), SceneError> {
        let section = scene.entry(&self.section);
        let section = section.or_insert_with(|| Value::Table(Table::new()));
        let Value::Table(table) = section else {
            let (name, shown) = (self.section.clone(), section.to_string());
            return Err(SceneError::wrong_kind(name, shown, "a section"));
        };
        table.insert(self.key.clone(), value);
        Ok(())
    }
}

/// One dimension of a sweep: one key, or several that vary together.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepAxis {
    /// The key, or "list", or "sample".
    pub name: String,
    /// Its keys; each has `len` values.
    pub columns: Vec<SweptKey>,
    /// Number of values.
    pub len: usize,
}

impl SweepAxis {
    /// Whether the axis consists of random draws.
    pub fn is_drawn(&self) -> bool {
        self.name == SAMPLE
    }
}

/// Number of rows of some axes; none if it overflows.
pub(super) fn rows(axes: &[SweepAxis]) -> Option<usize> {
    axes.iter()
        .try_fold(1_usize, |rows, axis| rows.checked_mul(axis.len))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithmic_values_hit_their_decades() {
        let values = |text: &str| {
            let table: Table = text.parse().unwrap_or_default();
            spaced(&TomlSection::of("x", &table)).unwrap_or_default()
        };
        let found = values("from = 2e-4\nto = 20\ncount = 51\nspacing = \"log\"");
        let decades: Vec<f64> = found.iter().copied().step_by(10).collect();
        assert_eq!(decades, [2e-4, 2e-3, 0.02, 0.2, 2.0, 20.0]);
        // no other is moved
        assert_eq!(found[7], 2e-4 * (20.0_f64 / 2e-4).powf(7.0 / 50.0));
        let falling = values("from = 30\nto = 0.003\ncount = 5\nspacing = \"log\"");
        assert_eq!(falling, [30.0, 3.0, 0.3, 0.03, 0.003]);
    }
}
