//! Scenes and sweeps as people give them: a dictionary, a path, or TOML text.

use crate::errors::{self, raise, raised};
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
        let py = given.py();
        let read = |path: PathBuf| -> PyResult<Self> {
            let text = py.detach(|| read_text(&path)).map_err(raise(py))?;
            let table = parse_table(&text)
                .map_err(|error| error.in_file(&path))
                .map_err(raise(py))?;
            let file = Some(path);
            Ok(Self { table, file })
        };
        if let Ok(text) = given.cast::<PyString>() {
            let text: String = text.extract()?;
            if !text.contains(['\n', '=']) && !text.trim_start().starts_with('[') {
                return read(PathBuf::from(text));
            }
            let (table, file) = (parse_table(&text).map_err(raise(py))?, None);
            return Ok(Self { table, file });
        }
        if given.hasattr("__fspath__")? {
            return read(given.extract()?);
        }
        if !given.hasattr("items")? {
            let kind = given.get_type().name()?;
            let message = format!("a scene is a dictionary, a path or TOML text, not {kind}");
            return Err(errors::plain(py, "SceneError", &message));
        }
        let (table, file) = (table(given, "", 0)?, None);
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
    found.map_err(raise(py))
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
    if value.cast::<PyDict>().is_ok() {
        return Ok(Some(Value::Table(table(value, name, deep)?)));
    }
    // before the numbers: True is an int to Python
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(Some(Value::Boolean(flag.is_true())));
    }
    if let Ok(number) = value.cast::<PyFloat>() {
        return Ok(Some(Value::Float(number.extract()?)));
    }
    if value.cast::<PyInt>().is_ok() {
        return Ok(Some(match value.extract::<i64>() {
            Ok(number) => Value::Integer(number),
            Err(_) => Value::Float(value.extract()?),
        }));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Some(Value::String(text.extract()?)));
    }
    // scalars and arrays of numpy, which know how to become Python's
    if value.hasattr("tolist")? {
        return to_toml(&value.call_method0("tolist")?, name, deep + 1);
    }
    if value.hasattr("__fspath__")? {
        return to_toml(&value.call_method0("__fspath__")?, name, deep + 1);
    }
    if value.hasattr("items")? {
        return Ok(Some(Value::Table(table(value, name, deep)?)));
    }
    let Ok(items) = value.try_iter() else {
        return Err(wrong(name, value, "a number, a word, a list or a section"));
    };
    let mut found = Vec::new();
    for (place, item) in items.enumerate() {
        let name = format!("{name}[{}]", place + 1);
        match to_toml(&item?, &name, deep + 1)? {
            Some(item) => found.push(item),
            None => {
                return Err(wrong(
                    &name,
                    &value.py().None().into_bound(value.py()),
                    "a value",
                ));
            }
        }
    }
    Ok(Some(Value::Array(found)))
}

fn wrong(name: &str, value: &Bound<'_, PyAny>, expected: &'static str) -> PyErr {
    let shown = value
        .repr()
        .map_or_else(|_| "?".to_owned(), |text| text.to_string());
    let short: String = shown.chars().take(60).collect();
    let error = SceneError::wrong_kind(name.to_owned(), short, expected);
    raised(value.py(), error)
}

/// What TOML text says, as a dictionary.
pub(crate) fn from_toml<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    let table: Result<Table, String> = text.parse().map_err(|e: toml::de::Error| e.to_string());
    let value = table.and_then(|table| serde_json::to_value(table).map_err(|e| e.to_string()));
    from_json(py, &value.map_err(raise(py))?)
}
