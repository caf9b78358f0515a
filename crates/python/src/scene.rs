//! Scenes and sweeps as people give them: a dictionary, a path, or TOML text.

use crate::errors::{self, raise};
use crate::values::from_json;
use formats::SceneError;
use formats::scene::{parse_table, read_text, scene_of};
use impact::Scene;
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
                let (table, file) = (parse_table(&text).map_err(raise)?, None);
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
    from_toml(py, &formats::resolved(scene))
}

/// A scene with every default and material spelled out.
#[pyfunction]
pub(crate) fn resolved<'py>(given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    spelled_out(given.py(), &scene(given)?)
}

/// The sections of a contact that have a key of this name.
#[pyfunction]
pub(crate) fn sections_of(key: &str) -> Vec<&'static str> {
    formats::scene::sections_of(key)
}

/// A mapping of Python, which lies so deep in others, as a table; keys whose value is None are left out.
pub(crate) fn table(mapping: &Bound<'_, PyAny>, name: &str, deep: usize) -> PyResult<Table> {
    let mut found = Table::new();
    for item in mapping.call_method0("items")?.try_iter()? {
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
        let whole = value.extract::<i64>().map(Value::Integer);
        whole.or_else(|_| value.extract().map(Value::Float))?
    } else if let Ok(text) = value.cast::<PyString>() {
        Value::String(text.extract()?)
    } else if value.hasattr("tolist")? {
        // scalars and arrays of numpy, which know how to become Python's
        return to_toml(&value.call_method0("tolist")?, name, deep + 1);
    } else if value.hasattr("__fspath__")? {
        return to_toml(&value.call_method0("__fspath__")?, name, deep + 1);
    } else if value.hasattr("items")? {
        Value::Table(table(value, name, deep)?)
    } else if let Ok(items) = value.try_iter() {
        let mut found = Vec::new();
        for (place, item) in items.enumerate() {
            let name = format!("{name}[{}]", place + 1);
            let none = || value.py().None().into_bound(value.py());
            let known = to_toml(&item?, &name, deep + 1)?;
            found.push(known.ok_or_else(|| wrong(&name, &none(), "a value"))?);
        }
        Value::Array(found)
    } else {
        return Err(wrong(name, value, "a number, a word, a list or a section"));
    };
    Ok(Some(found))
}

fn wrong(name: &str, value: &Bound<'_, PyAny>, expected: &'static str) -> PyErr {
    let shown = value.repr().map(|text| text.to_string());
    let shown = shown.unwrap_or_else(|_| "?".to_owned());
    let short: String = shown.chars().take(60).collect();
    let error = SceneError::wrong_kind(name.to_owned(), short, expected);
    raise(error)
}

/// What TOML text says, as a dictionary.
pub(crate) fn from_toml<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    let table: Result<Table, String> = text.parse().map_err(|e: toml::de::Error| e.to_string());
    let value = table.and_then(|table| serde_json::to_value(table).map_err(|e| e.to_string()));
    from_json(py, &value.map_err(raise)?)
}
