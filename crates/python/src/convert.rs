//! Values of TOML and JSON as Python's, and back.

use formats::SceneError;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString};
use toml::{Table, Value};

/// Why a value of Python is no value of a scene.
pub(crate) enum NoValue {
    /// It is of a kind that scenes do not have.
    Scene(SceneError),
    /// Python itself failed.
    Python(PyErr),
}

impl From<PyErr> for NoValue {
    fn from(error: PyErr) -> Self {
        Self::Python(error)
    }
}

/// A mapping of Python as a table; keys whose value is None are left out.
pub(crate) fn table(mapping: &Bound<'_, PyAny>, name: &str) -> Result<Table, NoValue> {
    table_in(mapping, name, 0)
}

/// One that lies so deep in others.
fn table_in(mapping: &Bound<'_, PyAny>, name: &str, deep: usize) -> Result<Table, NoValue> {
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
fn to_toml(value: &Bound<'_, PyAny>, name: &str, deep: usize) -> Result<Option<Value>, NoValue> {
    if value.is_none() {
        return Ok(None);
    }
    if deep > MOST_DEEP {
        return Err(wrong("a value", value, "no more than 80 containers deep"));
    }
    if value.cast::<PyDict>().is_ok() {
        return Ok(Some(Value::Table(table_in(value, name, deep)?)));
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
        return Ok(Some(Value::Table(table_in(value, name, deep)?)));
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

fn wrong(name: &str, value: &Bound<'_, PyAny>, expected: &'static str) -> NoValue {
    let shown = value
        .repr()
        .map_or_else(|_| "?".to_owned(), |text| text.to_string());
    let short: String = shown.chars().take(60).collect();
    NoValue::Scene(SceneError::WrongKind {
        key: name.to_owned(),
        value: short,
        expected,
    })
}

/// A table as a dictionary.
pub(crate) fn dict<'py>(py: Python<'py>, table: &Table) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    for (key, value) in table {
        found.set_item(key, from_toml(py, value)?)?;
    }
    Ok(found)
}

fn from_toml<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::String(text) => PyString::new(py, text).into_any(),
        Value::Integer(number) => number.into_pyobject(py)?.into_any(),
        Value::Float(number) => PyFloat::new(py, *number).into_any(),
        Value::Boolean(flag) => PyBool::new(py, *flag).to_owned().into_any(),
        Value::Datetime(date) => PyString::new(py, &date.to_string()).into_any(),
        Value::Array(items) => {
            let items: Vec<_> = items
                .iter()
                .map(|item| from_toml(py, item))
                .collect::<PyResult<_>>()?;
            PyList::new(py, items)?.into_any()
        }
        Value::Table(inner) => dict(py, inner)?.into_any(),
    })
}

/// A value of JSON as Python's.
pub(crate) fn from_json<'py>(
    py: Python<'py>,
    value: &serde_json::Value,
) -> PyResult<Bound<'py, PyAny>> {
    use serde_json::Value as Json;
    Ok(match value {
        Json::Null => py.None().into_bound(py),
        Json::Bool(flag) => PyBool::new(py, *flag).to_owned().into_any(),
        Json::Number(number) => match (number.as_i64(), number.as_f64()) {
            (Some(whole), _) => whole.into_pyobject(py)?.into_any(),
            (None, Some(real)) => PyFloat::new(py, real).into_any(),
            (None, None) => return Err(PyTypeError::new_err(number.to_string())),
        },
        Json::String(text) => PyString::new(py, text).into_any(),
        Json::Array(items) => {
            let items: Vec<_> = items
                .iter()
                .map(|item| from_json(py, item))
                .collect::<PyResult<_>>()?;
            PyList::new(py, items)?.into_any()
        }
        Json::Object(pairs) => {
            let found = PyDict::new(py);
            for (key, value) in pairs {
                found.set_item(key, from_json(py, value)?)?;
            }
            found.into_any()
        }
    })
}
