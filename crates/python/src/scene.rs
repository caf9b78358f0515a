//! Scenes and sweeps as people give them: a dictionary, a path, or TOML text.

use crate::errors::{self, raise};
use formats::SceneError;
use formats::scene::{MOST_OF_TOML, parse_table, parse_text, read_text, resolved_table, scene_of};
use impact::Scene;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString};
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// What was given, and the file that it is in, beside which the files are that it names.
#[derive(Debug)]
pub(crate) struct Given {
    table: Table,
    file: Option<PathBuf>,
}

impl Given {
    /// A text has more than one line, or is one assignment or section; anything else is a path.
    pub(crate) fn new(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        let path: PathBuf = if let Ok(text) = given.cast::<PyString>() {
            let text: String = text.extract()?;
            if text.contains(['\n', '=']) || text.trim_start().starts_with('[') {
                let read = text.len().min(MOST_OF_TOML as usize);
                errors::check_memory(read, "bytes of TOML", TOKENS)?;
                let (table, file) = (parse_text(&text).map_err(raise)?, None);
                return Ok(Self { table, file });
            }
            text.into()
        } else if given.hasattr("__fspath__")? {
            given.extract()?
        } else if given.hasattr("items")? {
            let (table, file) = (table(given, "", 0)?, None);
            return Ok(Self { table, file });
        } else {
            let kind = given.get_type().name()?;
            let message = format!("a scene is a dictionary, a path or TOML text, not {kind}");
            return Err(errors::plain("SceneError", &message));
        };
        let text = given.py().detach(|| read_text(&path)).map_err(raise)?;
        let table = parse_table(&text).map_err(|error| raise(error.in_file(&path)))?;
        let file = Some(path);
        Ok(Self { table, file })
    }

    /// What it is read as, with the folder of its files; an error names the file.
    pub(crate) fn read<T>(
        &self,
        of: impl FnOnce(&Table, &Path) -> Result<T, SceneError>,
    ) -> Result<T, SceneError> {
        let folder = self.file.as_ref().and_then(|path| path.parent());
        let found = of(&self.table, folder.unwrap_or(Path::new(".")));
        found.map_err(|error| match &self.file {
            Some(path) => error.in_file(path),
            None => error,
        })
    }
}

/// The scene that was given.
pub(crate) fn scene(given: &Bound<'_, PyAny>) -> PyResult<Scene> {
    let py = given.py();
    let given = Given::new(given)?;
    let found = py.detach(|| given.read(scene_of));
    found.map_err(raise)
}

/// The scene with every default and material spelled out, as a dictionary.
pub(crate) fn spelled_out<'py>(py: Python<'py>, scene: &Scene) -> PyResult<Bound<'py, PyAny>> {
    to_python(py, Value::Table(resolved_table(scene)))
}

/// A scene with every default and material spelled out.
#[pyfunction]
pub(crate) fn resolved<'py>(given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    spelled_out(given.py(), &scene(given)?)
}

/// The sections of a contact that have a key of this name; `others` are names that may stand in its place.
#[pyfunction]
pub(crate) fn sections_of(key: &str, others: Vec<String>) -> PyResult<Vec<&'static str>> {
    let others: Vec<&str> = others.iter().map(String::as_str).collect();
    formats::scene::sections_of(key, &others).map_err(raise)
}

/// A mapping of Python, which lies so deep in others, as a table; keys whose value is None are left out.
pub(crate) fn table(mapping: &Bound<'_, PyAny>, name: &str, deep: usize) -> PyResult<Table> {
    let mut found = Table::new();
    for item in mapping.call_method0("items")?.try_iter()? {
        if found.len() == MOST_KEYS {
            let shown = if name.is_empty() { "a scene" } else { name };
            return Err(wrong(shown, mapping, "of at most 1000 keys"));
        }
        let (key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item?.extract()?;
        let Ok(key) = key.extract::<String>() else {
            return Err(wrong(name, &key, "the name of a key"));
        };
        let full = if name.is_empty() {
            key.clone()
        } else {
            format!("{name}.{key}")
        };
        if let Some(value) = to_toml(&value, &full, deep + 1)? {
            found.insert(key, value);
        }
    }
    Ok(found)
}

/// Containers in one another at most, as in a text.
const MOST_DEEP: usize = 80;
/// Keys of a section at most: ten times as many as any has, so that an endless mapping is refused.
const MOST_KEYS: usize = 1000;
/// Entries of a list at most: as many as the values of an axis of a sweep.
const MOST_ENTRIES: usize = 10_000_000;
/// Bytes that an entry of a list takes, about: a number or a word, or a section with some keys.
const ENTRY: [usize; 2] = [2 * size_of::<Value>(), 1500];
/// Bytes that the tokens of a byte of TOML take at most, about.
const TOKENS: usize = 120;

/// One value; nothing for None.
fn to_toml(value: &Bound<'_, PyAny>, name: &str, deep: usize) -> PyResult<Option<Value>> {
    if value.is_none() {
        return Ok(None);
    }
    if deep > MOST_DEEP {
        return Err(wrong("a value", value, "at most 80 containers deep"));
    }
    let found = if value.cast::<PyDict>().is_ok() {
        Value::Table(table(value, name, deep)?)
    } else if let Ok(flag) = value.cast::<PyBool>() {
        // before the numbers: True is an int to Python
        Value::Boolean(flag.is_true())
    } else if let Ok(number) = value.cast::<PyFloat>() {
        Value::Float(number.extract()?)
    } else if value.cast::<PyInt>().is_ok() {
        whole(value)?
    } else if let Ok(text) = value.cast::<PyString>() {
        Value::String(text.extract()?)
    } else if value.hasattr("tolist")? {
        // scalars and arrays of numpy and of others
        let arrays = value.py().import("hertzlamb._arrays")?;
        let listed = arrays.call_method1("listed", (name, value))?;
        return to_toml(&listed, name, deep + 1);
    } else if value.hasattr("__fspath__")? {
        return to_toml(&value.call_method0("__fspath__")?, name, deep + 1);
    } else if value.hasattr("items")? {
        Value::Table(table(value, name, deep)?)
    } else if let Ok(count) = value.len() {
        Value::Array(list(value, count, name, deep)?)
    } else if value.try_iter().is_ok() {
        return Err(wrong(name, value, "a list: it has no length"));
    } else {
        return Err(wrong(name, value, "a number, a word, a list or a section"));
    };
    Ok(Some(found))
}

/// A whole number; one beyond all floats is infinite, as in a text.
fn whole(value: &Bound<'_, PyAny>) -> PyResult<Value> {
    if let Ok(whole) = value.extract() {
        return Ok(Value::Integer(whole));
    }
    let number = value.extract().or_else(|_: PyErr| {
        let sign = if value.lt(0)? { -1.0 } else { 1.0 };
        PyResult::Ok(sign * f64::INFINITY)
    })?;
    Ok(Value::Float(number))
}

/// The entries of a list of a known length; an iterator that goes on beyond it is cut there.
fn list(value: &Bound<'_, PyAny>, count: usize, name: &str, deep: usize) -> PyResult<Vec<Value>> {
    if count > MOST_ENTRIES {
        let key = format!("the number of entries of {name}");
        let error = SceneError::out_of_range(key, count as f64, "[0, 10000000]");
        return Err(raise(error));
    }
    let mut found = Vec::new();
    for (place, item) in value.try_iter()?.take(count).enumerate() {
        let name = format!("{name}[{}]", place + 1);
        let none = || value.py().None().into_bound(value.py());
        let known = to_toml(&item?, &name, deep + 1)?;
        let known = known.ok_or_else(|| wrong(&name, &none(), "a value"))?;
        if place == 0 {
            // the others are likely of its kind
            let bytes = ENTRY[usize::from(known.is_table())];
            errors::check_memory(count, &format!("entries such as {name}"), bytes)?;
        }
        found.push(known);
    }
    Ok(found)
}

fn wrong(name: &str, value: &Bound<'_, PyAny>, expected: &'static str) -> PyErr {
    raise(SceneError::wrong_kind(
        name.to_owned(),
        errors::shown(value),
        expected,
    ))
}

/// TOML text as a dictionary.
pub(crate) fn from_toml<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    let table: Result<Table, String> = text.parse().map_err(|e: toml::de::Error| e.to_string());
    to_python(py, Value::Table(table.map_err(raise)?))
}

/// A value of TOML as Python's.
fn to_python(py: Python<'_>, value: Value) -> PyResult<Bound<'_, PyAny>> {
    match value {
        Value::String(text) => text.into_bound_py_any(py),
        Value::Integer(whole) => whole.into_bound_py_any(py),
        Value::Float(number) => number.into_bound_py_any(py),
        Value::Boolean(flag) => flag.into_bound_py_any(py),
        Value::Datetime(instant) => instant.to_string().into_bound_py_any(py),
        Value::Array(items) => {
            let items = items.into_iter().map(|item| to_python(py, item));
            items.collect::<PyResult<Vec<_>>>()?.into_bound_py_any(py)
        }
        Value::Table(table) => {
            let found = PyDict::new(py);
            for (key, value) in table {
                found.set_item(key, to_python(py, value)?)?;
            }
            Ok(found.into_any())
        }
    }
}
