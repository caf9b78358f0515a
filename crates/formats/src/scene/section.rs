//! TOML files and typed reading of their tables: every error names the full key and the value found.
//!
//! A file is regular, of a bounded size, and UTF-8.

use super::keys::{FINITE, Range, full_name, keys_of, named, number};
use crate::error::SceneError;
use contact::{Choice, nearest};
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

    pub(crate) fn key(&self, key: &str) -> String {
        if self.name.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.name)
        }
    }

    /// Reports the first key that is not allowed here.
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

    /// Reports the first key that the table of keys does not have in a section.
    pub(super) fn allow_keys_of(&self, section: &str) -> Result<(), SceneError> {
        self.allow(keys_of(section).map(|key| key.name))
    }

    /// Names of all keys.
    pub(crate) fn names(&self) -> impl Iterator<Item = &'a str> {
        self.table.keys().map(String::as_str)
    }

    /// The value of a key, whatever it is.
    pub(crate) fn value(&self, key: &str) -> Option<&'a Value> {
        self.table.get(key)
    }

    /// What a key holds, where it is there; otherwise it is not what was expected.
    pub(crate) fn typed<T>(
        &self,
        key: &str,
        expected: &'static str,
        of: impl FnOnce(&'a Value) -> Option<T>,
    ) -> Result<Option<T>, SceneError> {
        let typed = |value| of(value).ok_or_else(|| self.wrong_kind(key, value, expected));
        self.value(key).map(typed).transpose()
    }

    /// The table of a key that holds one.
    pub(crate) fn inner(&self, key: &'a str) -> Option<TomlSection<'a>> {
        let table = self.value(key)?.as_table()?;
        Some(TomlSection { name: key, table })
    }

    /// The table of a key that is there.
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

    /// A number of a scene, in the range that the table of keys gives it.
    pub(super) fn number(&self, key: &str) -> Result<Option<f64>, SceneError> {
        let range = number(key).and_then(|known| known.range);
        self.number_in(key, range.unwrap_or(FINITE))
    }

    /// A number of a scene that is needed.
    pub(super) fn needed(&self, key: &str) -> Result<f64, SceneError> {
        let hint = number(key).map_or("", |known| known.hint);
        self.number(key)?.ok_or_else(|| self.missing(key, hint))
    }

    /// All subsections but for the keys `other`.
    pub(crate) fn subsections(&self, other: &[&str]) -> Result<Vec<TomlSection<'a>>, SceneError> {
        let names = self.names().filter(|name| !other.contains(name));
        names
            .map(|name| self.subsection(name, "a section of scene keys"))
            .collect()
    }

    pub(crate) fn number_in(&self, key: &str, range: Range) -> Result<Option<f64>, SceneError> {
        // what varies in a sweep
        let many = |value: &&Value| value.is_array() || value.is_table();
        let expected = match self.value(key).filter(many) {
            Some(_) if number(key).is_some() => {
                "a number; a sweep varies it: put the values below [product] of a sweep file"
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

    /// A string that is needed.
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

    /// A pair of words; a whole number is one, too.
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

    /// What one of the words of a choice says, which are told where it is none of them.
    pub(super) fn named<T>(
        &self,
        key: &str,
        word: &str,
        by: impl FnOnce(&str) -> Result<T, String>,
    ) -> Result<T, SceneError> {
        by(word).map_err(|known| SceneError::unknown_choice(self.key(key), word, &known))
    }

    /// Different values of a choice, as a list; none where the key is not there.
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
                    "each word stands once",
                ));
            }
            found.push(choice);
        }
        Ok(found)
    }

    /// Whether a key says true; no where it is not there.
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

/// A whole number is a number.
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

/// What is said of a number such as 0,5.
fn decimal_comma(before: &str, after: &str) -> &'static str {
    let is_digit = |c: char| c.is_ascii_digit();
    let before = before.trim_end_matches([' ', '\t']);
    let after = after.strip_prefix(',').unwrap_or_default();
    if before.ends_with(is_digit) && after.starts_with(is_digit) {
        "; numbers have a decimal point, no comma"
    } else {
        ""
    }
}

/// Bytes of a TOML file at most: a parsed one takes some fifty times its size.
pub const MOST_OF_TOML: u64 = 8 << 20;
/// Bytes of a force record at most.
pub(crate) const MOST_OF_RECORD: u64 = 256 << 20;

/// How HDF5 files start.
const HDF5: &[u8] = b"\x89HDF\r\n";

/// Parses TOML that is no longer than a file of it may be.
///
/// # Errors
/// [`SceneError`].
pub fn parse_text(text: &str) -> Result<Table, SceneError> {
    if text.len() as u64 > MOST_OF_TOML {
        let (found, most) = (text.len() >> 20, MOST_OF_TOML >> 20);
        let sentence = format!("the text has {found} MB, more than the {most} MB of a scene");
        return Err(SceneError::told(sentence));
    }
    parse(text)
}

/// The text of a TOML file.
pub fn read_text(path: &Path) -> Result<String, SceneError> {
    read_text_up_to(path, MOST_OF_TOML)
}

/// The text of a regular file of at most so many bytes: a pipe would wait for its other end, a device never ends.
pub(crate) fn read_text_up_to(path: &Path, most: u64) -> Result<String, SceneError> {
    let system = |error: io::Error| SceneError::unreadable(path, error);
    let known = std::fs::metadata(path).map_err(system)?;
    if !known.is_file() {
        return Err(SceneError::unreadable(path, "it is not a regular file"));
    }
    // files of the system itself say that they have nothing, and some, such as /proc/kmsg, wait for good
    if known.len() == 0 {
        return Ok(String::new());
    }
    let file = File::open(path).map_err(system)?;
    text_of(file, path, most)
}

/// The TOML that standard input has.
pub(crate) fn read_standard() -> Result<String, SceneError> {
    text_of(io::stdin(), Path::new("standard input"), MOST_OF_TOML)
}

/// All text that a source of a name has, up to so many bytes.
fn text_of(source: impl Read, path: &Path, most: u64) -> Result<String, SceneError> {
    let fault = |reason: String| SceneError::unreadable(path, reason);
    let mut bytes = Vec::new();
    let read = source.take(most + 1).read_to_end(&mut bytes);
    read.map_err(|error| fault(error.to_string()))?;
    if bytes.len() as u64 > most {
        return Err(fault(format!("it has more than {} MB", most >> 20)));
    }
    if let Some(text) = from_utf16(&bytes) {
        return text.ok_or_else(|| fault("it begins as UTF-16, and is none".to_owned()));
    }
    String::from_utf8(bytes).map_err(|error| {
        let (bytes, valid) = (error.as_bytes(), error.utf8_error().valid_up_to());
        let line = bytes[..valid].split(|&byte| byte == b'\n').count();
        fault(if bytes.starts_with(HDF5) {
            "it is an HDF5 file, needed text".to_owned()
        } else {
            format!("line {line} is not UTF-8")
        })
    })
}

/// The text of bytes that begin with a byte order mark of UTF-16, as those of LabVIEW and Excel do; none inside where it is
/// damaged.
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
