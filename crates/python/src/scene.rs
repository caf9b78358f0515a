//! Conversion of scenes and sweeps: dictionaries, paths and TOML text to TOML tables, and back.

use crate::errors::{self, raise};
use formats::SceneError;
use formats::scene::{MOST_OF_TOML, parse_table, parse_text, read_text, resolved_table, scene_of};
use impact::Scene;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString};
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// A scene, sweep or grid as a TOML table.
#[derive(Debug)]
pub(crate) struct Given {
    table: Table,
    /// File that contains it; the relative paths in it refer to the folder of this file.
    file: Option<PathBuf>,
}

impl Given {
    /// Reads a dictionary, a path or a text.
    ///
    /// A string that has several lines, contains `=` or begins with `[` is TOML text; any other string is a path.
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

    /// Applies a reader to the table and the folder of its relative paths; an error names the file.
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

/// The scene of a dictionary, path or text.
pub(crate) fn scene(given: &Bound<'_, PyAny>) -> PyResult<Scene> {
    let py = given.py();
    let given = Given::new(given)?;
    let found = py.detach(|| given.read(scene_of));
    found.map_err(raise)
}

/// The scene with every default and material property written out, as a dictionary.
pub(crate) fn spelled_out<'py>(py: Python<'py>, scene: &Scene) -> PyResult<Bound<'py, PyAny>> {
    to_python(py, Value::Table(resolved_table(scene)))
}

/// The scene of a dictionary, path or text, with every default and material property written out.
#[pyfunction]
pub(crate) fn resolved<'py>(given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    spelled_out(given.py(), &scene(given)?)
}

/// The sections of a contact that have a key of this name; `others` are further names that a suggestion may contain.
#[pyfunction]
pub(crate) fn sections_of(key: &str, others: Vec<String>) -> PyResult<Vec<&'static str>> {
    let others: Vec<&str> = others.iter().map(String::as_str).collect();
    formats::scene::sections_of(key, &others).map_err(raise)
}

/// Converts a Python mapping to a TOML table; keys whose value is None are skipped. `deep` counts the containers around it.
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

/// Largest depth of nested containers, as in a text.
const MOST_DEEP: usize = 80;
/// Largest number of keys in a section: ten times that of any valid section, so that an endless mapping is rejected.
const MOST_KEYS: usize = 1000;
/// Largest number of entries in a list: that of the values of a sweep axis.
const MOST_ENTRIES: usize = 10_000_000;
/// Approximate memory in bytes of a list entry: a number or string, and a section with some keys.
const ENTRY: [usize; 2] = [2 * size_of::<Value>(), 1500];
/// Approximate upper bound on the memory in bytes that the parser needs for a byte of TOML.
const TOKENS: usize = 120;

/// Converts a value to TOML; none for None.
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
        // before the integers, since True is an int in Python
        Value::Boolean(flag.is_true())
    } else if let Ok(number) = value.cast::<PyFloat>() {
        Value::Float(number.extract()?)
    } else if value.cast::<PyInt>().is_ok() {
        whole(value)?
    } else if let Ok(text) = value.cast::<PyString>() {
        Value::String(text.extract()?)
    } else if value.hasattr("tolist")? {
        // scalars and arrays of numpy and other libraries
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

/// An integer; one that no float can represent becomes infinite, as in a text.
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

/// The entries of a list; an iterator is read up to the length that the list reports.
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
            // all entries are assumed to be like the first
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

/// Converts TOML text to a dictionary.
pub(crate) fn from_toml<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    let table: Result<Table, String> = text.parse().map_err(|e: toml::de::Error| e.to_string());
    to_python(py, Value::Table(table.map_err(raise)?))
}

/// Converts a TOML value to Python.
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
