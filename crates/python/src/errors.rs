//! Converts errors to exceptions of `hertzlamb._errors`, with the values in their messages as attributes.

use crate::values::from_json;
use fault::{Class, Fault};
use pyo3::exceptions::PyOverflowError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Map, Value};
use std::ops::RangeInclusive;
use std::path::Path;

/// An exception of a class in `hertzlamb._errors`, with attributes.
fn exception(class: &str, message: &str, fields: Map<String, Value>) -> PyErr {
    let made = |py: Python<'_>| -> PyResult<PyErr> {
        let class = py.import("hertzlamb._errors")?.getattr(class)?;
        let fields = from_json(py, &fields.into())?;
        let made = class.call((message,), Some(fields.cast::<PyDict>()?))?;
        Ok(PyErr::from_value(made))
    };
    Python::attach(made).unwrap_or_else(|error| error)
}

/// The exception for an error.
pub(crate) fn raise(error: impl Fault) -> PyErr {
    raised_in(error, None)
}

/// The exception for an error in work with a file; adds the file if the error does not name one.
pub(crate) fn raised_in(error: impl Fault, file: Option<&Path>) -> PyErr {
    let culprit = error.culprit();
    let (class, key) = match culprit.class {
        Class::Scene => ("SceneError", "key"),
        Class::Domain => ("DomainError", "argument"),
        Class::OutsideTable => ("OutsideTable", "axis"),
        Class::Table => ("BadTable", "key"),
        Class::Impact => ("ImpactError", "key"),
        Class::Memory => ("TooMuchMemory", "key"),
        Class::Exists => ("OutputExists", "key"),
        Class::Output => ("OutputError", "key"),
        Class::Work => ("WorkError", "key"),
    };
    let mut message = error.to_string();
    if culprit.class == Class::Exists {
        message.push_str("; pass overwrite=True to replace it");
    }
    let of_a_file = matches!(culprit.class, Class::OutsideTable | Class::Table);
    let file = culprit.file.as_deref().or(file.filter(|_| of_a_file));
    let value = culprit.number.map(Value::from);
    let [low, high] = [0, 1].map(|i| culprit.limits.map(|limits| limits[i]));
    let known = [
        (key, culprit.key.map(Value::from)),
        ("value", value.or(culprit.word.map(Value::from))),
        ("range", culprit.range.map(Value::from)),
        ("low", low.map(Value::from)),
        ("high", high.map(Value::from)),
        ("suggestion", culprit.suggestion.map(Value::from)),
        ("file", file.map(Path::to_string_lossy).map(Value::from)),
    ];
    let known = known.into_iter();
    let known = known.filter_map(|(name, value)| Some((name.to_owned(), value?)));
    exception(class, &message, known.collect())
}

/// An exception with a message and no attributes.
pub(crate) fn plain(class: &str, message: &str) -> PyErr {
    exception(class, message, Map::new())
}

/// The value that the argument `what` names, or a `DomainError` with the allowed names.
pub(crate) fn one_of<T: Copy>(what: &str, found: &str, all: &[(&str, T)]) -> PyResult<T> {
    let known = all.iter().find(|(name, _)| *name == found);
    let names = all.iter().map(|(name, _)| *name);
    let otherwise = || unknown(what, found, &names.collect::<Vec<_>>());
    known.map(|(_, value)| *value).ok_or_else(otherwise)
}

/// The `DomainError` for a name that the argument `what` does not allow.
pub(crate) fn unknown(what: &str, found: &str, allowed: &[&str]) -> PyErr {
    let allowed = allowed.join(", ");
    let message = format!("{what} = \"{found}\" is not one of {allowed}");
    let fields = [("argument", what), ("value", found), ("range", &allowed)];
    let fields = fields.map(|(name, word)| (name.to_owned(), word.into()));
    exception("DomainError", &message, fields.into_iter().collect())
}

/// The `DomainError` for an argument outside its range; `value` is its text.
pub(crate) fn outside(argument: &str, value: &str, range: &str) -> PyErr {
    let message = format!("{argument} = {value} is outside {range}");
    let mut fields = Map::new();
    fields.insert("argument".to_owned(), argument.into());
    let number = value.parse().map_or(Value::from(value), |x: f64| x.into());
    fields.insert("value".to_owned(), number);
    fields.insert("range".to_owned(), range.into());
    exception("DomainError", &message, fields)
}

/// The value of an integer argument, or a `DomainError` that shows the range as `name`.
pub(crate) fn whole_in(
    argument: &str,
    value: &Bound<'_, PyAny>,
    range: RangeInclusive<usize>,
    name: &str,
) -> PyResult<usize> {
    let found = value.extract::<usize>();
    let is_large = |error: &PyErr| error.is_instance_of::<PyOverflowError>(value.py());
    let found = match found {
        Err(error) if !is_large(&error) => return Err(error),
        found => found.ok().filter(|whole| range.contains(whole)),
    };
    found.ok_or_else(|| outside(argument, &shown(value), name))
}

/// The `repr` of a value, cut after 60 characters.
pub(crate) fn shown(value: &Bound<'_, PyAny>) -> String {
    let shown = value.repr().map(|text| text.to_string());
    let shown = shown.unwrap_or_else(|_| "?".to_owned());
    match shown.char_indices().nth(60) {
        Some((end, _)) => format!("{}...", &shown[..end]),
        None => shown,
    }
}

/// Raises `TooMuchMemory` if `count` things of `bytes` each need more than the free memory.
pub(crate) fn check_memory(count: usize, things: &str, bytes: usize) -> PyResult<()> {
    let short = shortage(count, things, bytes);
    short.map_or(Ok(()), |short| Err(plain("TooMuchMemory", &short)))
}

/// The message if `count` things of `bytes` each need more than the free memory, otherwise none.
pub(crate) fn shortage(count: usize, things: &str, bytes: usize) -> Option<String> {
    let (needed, free) = (count as f64 * bytes as f64, output::free_memory());
    (needed > free).then(|| {
        format!(
            "{count} {things} need about {:.3} GB of memory, more than the {:.3} GB that are free: compute fewer at a time",
            1e-9 * needed,
            1e-9 * free
        )
    })
}
