//! Typed reading of TOML files and tables. Every error contains the full key and the value.
//!
//! Files must be regular, of limited size, and UTF-8.

use super::keys::{FINITE, Range, full_name, keys_of, named, number};
use crate::error::SceneError;
use contact::{Choice, nearest};
use num_complex::Complex64;
use std::fs::File;
use std::io::{self, Read};
use std::ops::RangeInclusive;
use std::path::Path;
use toml::{Table, Value};

/// One section of a scene, or its root.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TomlSection<'a> {
    pub(crate) name: &'a str,
    table: &'a Table,
}

impl<'a> TomlSection<'a> {
    pub(crate) fn root(table: &'a Table) -> Self {
        Self { name: "", table }
    }

    pub(crate) fn of(name: &'a str, table: &'a Table) -> Self {
        Self { name, table }
    }

    /// The same under another name.
    pub(super) fn renamed<'n>(&self, name: &'n str) -> TomlSection<'n>
    where
        'a: 'n,
    {
        TomlSection {
            name,
            table: self.table,
        }
    }

    pub(crate) fn key(&self, key: &str) -> String {
        if self.name.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.name)
        }
    }

    /// Fails for the first key that is not allowed.
    pub(crate) fn allow(
        &self,
        allowed: impl IntoIterator<Item = &'static str>,
    ) -> Result<(), SceneError> {
        let allowed: Vec<&str> = allowed.into_iter().collect();
        let Some(key) = self.names().find(|key| !allowed.contains(key)) else {
            return Ok(());
        };
        let near = nearest(key, allowed.iter().copied()).or_else(|| full_name(key));
        let known = format!("known keys: {}", allowed.join(", "));
        Err(SceneError::unknown_key(self.key(key), near, &known))
    }

    /// Fails for the first key that the table of keys does not list in a section.
    pub(super) fn allow_keys_of(&self, section: &str) -> Result<(), SceneError> {
        self.allow(keys_of(section).map(|key| key.name))
    }

    /// Names of all keys.
    pub(crate) fn names(&self) -> impl Iterator<Item = &'a str> {
        self.table.keys().map(String::as_str)
    }

    /// The value of a key, of any type.
    pub(crate) fn value(&self, key: &str) -> Option<&'a Value> {
        self.table.get(key)
    }

    /// The value of a key as `read` converts it; an error if the value is not `expected`.
    pub(crate) fn typed<T>(
        &self,
        key: &str,
        expected: &'static str,
        of: impl FnOnce(&'a Value) -> Option<T>,
    ) -> Result<Option<T>, SceneError> {
        let typed = |value| of(value).ok_or_else(|| self.wrong_kind(key, value, expected));
        self.value(key).map(typed).transpose()
    }

    /// The table of a key, if its value is a table.
    pub(crate) fn inner(&self, key: &'a str) -> Option<TomlSection<'a>> {
        let table = self.value(key)?.as_table()?;
        Some(TomlSection { name: key, table })
    }

    /// The table of an existing key.
    pub(crate) fn subsection(
        &self,
        key: &'a str,
        expected: &'static str,
    ) -> Result<TomlSection<'a>, SceneError> {
        let wrong = || self.wrong_kind(key, &self.table[key], expected);
        self.inner(key).ok_or_else(wrong)
    }

    /// A subsection such as [target].
    pub(crate) fn section(&self, key: &'a str) -> Result<Option<TomlSection<'a>>, SceneError> {
        let table = self.typed(key, "a section", Value::as_table)?;
        Ok(table.map(|table| TomlSection { name: key, table }))
    }

    /// A list of subsections such as [[probe]], with the names of their elements.
    pub(crate) fn list(&self, key: &str) -> Result<Vec<(String, &'a Table)>, SceneError> {
        let expected = "a list of sections [[..]]";
        if let Some(one) = self.value(key).filter(|value| value.is_table()) {
            let brackets = format!("a list: write [[{key}]] for [{key}]");
            return Err(self.wrong_kind(key, one, &brackets));
        }
        let items = self.typed(key, expected, Value::as_array)?;
        let named = items.into_iter().flatten().enumerate().map(|(i, item)| {
            let table = item.as_table();
            let table = table.ok_or_else(|| self.wrong_kind(key, item, expected))?;
            Ok((format!("{}[{}]", self.key(key), i + 1), table))
        });
        named.collect()
    }

    /// A number of a scene, in the range that the table of keys sets.
    pub(super) fn number(&self, key: &str) -> Result<Option<f64>, SceneError> {
        let range = number(key).and_then(|known| known.range);
        self.number_in(key, range.unwrap_or(FINITE))
    }

    /// A required number of a scene.
    pub(super) fn needed(&self, key: &str) -> Result<f64, SceneError> {
        let hint = number(key).map_or("", |known| known.hint);
        self.number(key)?.ok_or_else(|| self.missing(key, hint))
    }

    /// All subsections except the keys `other`.
    pub(crate) fn subsections(&self, other: &[&str]) -> Result<Vec<TomlSection<'a>>, SceneError> {
        let names = self.names().filter(|name| !other.contains(name));
        names
            .map(|name| self.subsection(name, "a section of scene keys"))
            .collect()
    }

    pub(crate) fn number_in(&self, key: &str, range: Range) -> Result<Option<f64>, SceneError> {
        // a value that varies in a sweep
        let many = |value: &&Value| value.is_array() || value.is_table();
        let expected = match self.value(key).filter(many) {
            Some(_) if number(key).is_some() => {
                "a number; to vary it, list its values in [product] of a sweep file"
            }
            Some(_) | None => "a number",
        };
        match self.typed(key, expected, as_number)? {
            Some(x) if !(range.holds)(x) => {
                Err(SceneError::out_of_range(self.key(key), x, range.name))
            }
            found => Ok(found),
        }
    }

    pub(crate) fn required(&self, key: &str, range: Range, hint: &str) -> Result<f64, SceneError> {
        let number = self.number_in(key, range)?;
        number.ok_or_else(|| self.missing(key, hint))
    }

    pub(crate) fn missing(&self, key: &str, hint: &str) -> SceneError {
        SceneError::missing(self.key(key), hint)
    }

    pub(crate) fn text(&self, key: &str) -> Result<Option<&'a str>, SceneError> {
        self.typed(key, "a string", Value::as_str)
    }

    /// A required string.
    pub(crate) fn needed_text(&self, key: &str, hint: &str) -> Result<&'a str, SceneError> {
        self.text(key)?.ok_or_else(|| self.missing(key, hint))
    }

    /// A whole number in a range.
    pub(crate) fn count(
        &self,
        key: &str,
        range: RangeInclusive<usize>,
        name: &'static str,
    ) -> Result<Option<usize>, SceneError> {
        let whole = |value| self.whole(key, value, &range, name);
        self.value(key).map(whole).transpose()
    }

    /// A pair of whole numbers in a range.
    pub(super) fn counts(
        &self,
        key: &str,
        range: RangeInclusive<usize>,
        name: &'static str,
    ) -> Result<Option<[usize; 2]>, SceneError> {
        let whole = |value| self.whole(key, value, &range, name);
        let pair = |value: &'a Value| value.as_array().filter(|items| items.len() == 2);
        let pair = self.typed(key, "a pair of whole numbers", pair)?;
        pair.map(|items| Ok([whole(&items[0])?, whole(&items[1])?]))
            .transpose()
    }

    /// A list of numbers.
    pub(super) fn numbers(&self, key: &str) -> Result<Option<Vec<f64>>, SceneError> {
        self.typed(key, "a list of numbers", |value| {
            value.as_array()?.iter().map(as_number).collect()
        })
    }

    /// A list of complex numbers, each a pair of its real and imaginary part, or its real part alone.
    pub(super) fn roots(&self, key: &str) -> Result<Option<Vec<Complex64>>, SceneError> {
        let root = |value: &Value| match value.as_array().map(Vec::as_slice) {
            Some([re, im]) => Some(Complex64::new(as_number(re)?, as_number(im)?)),
            Some(_) => None,
            None => Some(as_number(value)?.into()),
        };
        let expected = "a list of pairs such as [[-1e4, 2e6], [-1e4, -2e6]], real and imaginary parts in rad/s";
        self.typed(key, expected, |value| {
            value.as_array()?.iter().map(root).collect()
        })
    }

    /// A pair of words; a whole number is accepted as a word.
    pub(crate) fn words(
        &self,
        key: &str,
        expected: &'static str,
    ) -> Result<Option<[String; 2]>, SceneError> {
        let word = |value: &Value| match value {
            Value::String(text) => Some(text.clone()),
            Value::Integer(number) => Some(number.to_string()),
            _ => None,
        };
        self.typed(key, expected, |value| {
            let [first, second] = value.as_array()?.as_slice() else {
                return None;
            };
            Some([word(first)?, word(second)?])
        })
    }

    fn whole(
        &self,
        key: &str,
        value: &Value,
        range: &RangeInclusive<usize>,
        name: &'static str,
    ) -> Result<usize, SceneError> {
        let number = value.as_integer();
        let number = number.ok_or_else(|| self.wrong_kind(key, value, "a whole number"))?;
        let count = usize::try_from(number).ok().filter(|n| range.contains(n));
        count.ok_or_else(|| SceneError::out_of_range(self.key(key), number as f64, name))
    }

    /// One of the values of a choice.
    pub(crate) fn choice<T: Choice>(&self, key: &str) -> Result<Option<T>, SceneError> {
        let word = self.text(key)?;
        word.map(|word| self.named(key, word, named)).transpose()
    }

    /// The value of a word of a choice; the error lists all words.
    pub(super) fn named<T>(
        &self,
        key: &str,
        word: &str,
        by: impl FnOnce(&str) -> Result<T, String>,
    ) -> Result<T, SceneError> {
        by(word).map_err(|known| SceneError::unknown_choice(self.key(key), word, &known))
    }

    /// Different values of a choice, as a list; empty if the key is missing.
    pub(crate) fn choices<T: Choice>(&self, key: &str) -> Result<Vec<T>, SceneError> {
        let items = self.typed(key, "a list of words", Value::as_array)?;
        let mut found: Vec<T> = Vec::new();
        for item in items.into_iter().flatten() {
            let word = item.as_str();
            let word = word.ok_or_else(|| self.wrong_kind(key, item, "a word"))?;
            let choice = self.named(key, word, named)?;
            if found.contains(&choice) {
                return Err(SceneError::conflict(
                    format!("{} = \"{word}\"", self.key(key)),
                    format!("\"{word}\""),
                    "each word may occur once",
                ));
            }
            found.push(choice);
        }
        Ok(found)
    }

    /// Whether a flag is true; false if the key is missing.
    pub(super) fn flag(&self, key: &str) -> Result<bool, SceneError> {
        let flag = self.typed(key, "true or false", Value::as_bool)?;
        Ok(flag.unwrap_or(false))
    }

    pub(crate) fn wrong_kind(&self, key: &str, value: &Value, expected: &str) -> SceneError {
        let mut shown = value.to_string().replace('\n', " ");
        if shown.chars().count() > 60 {
            shown = shown.chars().take(57).chain("...".chars()).collect();
        }
        SceneError::wrong_kind(self.key(key), shown, expected)
    }
}

/// The value as a number; whole numbers count as numbers.
pub(crate) fn as_number(value: &Value) -> Option<f64> {
    value.as_float().or(value.as_integer().map(|i| i as f64))
}

/// Parses the TOML of a scene or a sweep.
pub fn parse(text: &str) -> Result<Table, SceneError> {
    text.parse::<Table>().map_err(|error| {
        let place = error.span().map_or(0, |span| span.start);
        let (before, after) = text.split_at_checked(place).unwrap_or((text, ""));
        let line = before.matches('\n').count() + 1;
        let reason = error.message().replace('\n', " ");
        let comma = decimal_comma(before, after);
        SceneError::told(format!("line {line} is not valid TOML: {reason}{comma}"))
    })
}

/// Hint for a number such as 0,5.
fn decimal_comma(before: &str, after: &str) -> &'static str {
    let is_digit = |c: char| c.is_ascii_digit();
    let before = before.trim_end_matches([' ', '\t']);
    let after = after.strip_prefix(',').unwrap_or_default();
    if before.ends_with(is_digit) && after.starts_with(is_digit) {
        "; numbers need a decimal point, not a comma"
    } else {
        ""
    }
}

/// Largest size of a TOML file in bytes; the parsed table needs some fifty times as much memory.
pub const MOST_OF_TOML: u64 = 8 << 20;
/// Largest size of a force record in bytes.
pub(crate) const MOST_OF_RECORD: u64 = 256 << 20;

/// First bytes of HDF5 files.
const HDF5: &[u8] = b"\x89HDF\r\n";

/// Parses TOML within the size limit of a file.
///
/// # Errors
/// [`SceneError`].
pub fn parse_text(text: &str) -> Result<Table, SceneError> {
    if text.len() as u64 > MOST_OF_TOML {
        let (found, most) = (text.len() >> 20, MOST_OF_TOML >> 20);
        let sentence = format!("the text has {found} MB, but a scene has at most {most} MB");
        return Err(SceneError::told(sentence));
    }
    parse(text)
}

/// The text of a TOML file.
pub fn read_text(path: &Path) -> Result<String, SceneError> {
    read_text_up_to(path, MOST_OF_TOML)
}

/// The text of a regular file of at most `most` bytes: a pipe would block, and a device never ends.
pub(crate) fn read_text_up_to(path: &Path, most: u64) -> Result<String, SceneError> {
    let system = |error: io::Error| SceneError::unreadable(path, error);
    let known = std::fs::metadata(path).map_err(system)?;
    if !known.is_file() {
        return Err(SceneError::unreadable(path, "it is not a regular file"));
    }
    // files of /proc claim to be empty, and some, such as /proc/kmsg, block forever
    if known.len() == 0 {
        return Ok(String::new());
    }
    let file = File::open(path).map_err(system)?;
    text_of(file, path, most)
}

/// The TOML text on standard input.
pub(crate) fn read_standard() -> Result<String, SceneError> {
    text_of(io::stdin(), Path::new("standard input"), MOST_OF_TOML)
}

/// All text of a source, up to `most` bytes; `path` is its name in errors.
fn text_of(source: impl Read, path: &Path, most: u64) -> Result<String, SceneError> {
    let fault = |reason: String| SceneError::unreadable(path, reason);
    let mut bytes = Vec::new();
    let read = source.take(most + 1).read_to_end(&mut bytes);
    read.map_err(|error| fault(error.to_string()))?;
    if bytes.len() as u64 > most {
        return Err(fault(format!("it has more than {} MB", most >> 20)));
    }
    if let Some(text) = from_utf16(&bytes) {
        return text
            .ok_or_else(|| fault("it begins like UTF-16, but is not valid UTF-16".to_owned()));
    }
    String::from_utf8(bytes).map_err(|error| {
        let (bytes, valid) = (error.as_bytes(), error.utf8_error().valid_up_to());
        let line = bytes[..valid].split(|&byte| byte == b'\n').count();
        fault(if bytes.starts_with(HDF5) {
            "it is an HDF5 file, but text is required".to_owned()
        } else {
            format!("line {line} is not UTF-8")
        })
    })
}

/// The text of bytes with a byte order mark of UTF-16, as LabVIEW and Excel write them. The inner option is none for
/// damaged text.
fn from_utf16(bytes: &[u8]) -> Option<Option<String>> {
    let read: fn([u8; 2]) -> u16 = match bytes {
        [0xff, 0xfe, ..] => u16::from_le_bytes,
        [0xfe, 0xff, ..] => u16::from_be_bytes,
        _ => return None,
    };
    let units = bytes[2..].chunks(2);
    let units: Option<Vec<u16>> = units.map(|two| Some(read(two.try_into().ok()?))).collect();
    Some(units.and_then(|units| String::from_utf16(&units).ok()))
}
