//! Values of Python: arrays of numpy that nobody can write into, and what JSON says.

use numpy::ndarray::ArrayD;
use numpy::{Element, IntoPyArray, PyArrayDyn, PyArrayMethods, PyReadonlyArray1};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyList, PyString};

/// The numbers as an array of some shape, without a copy; read-only, since others may look at the same.
pub(crate) fn frozen<'py, T: Element>(
    py: Python<'py>,
    numbers: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let array = ArrayD::from_shape_vec(shape, numbers);
    let array = array.map_err(|error| PyTypeError::new_err(error.to_string()))?;
    let array = array.into_pyarray(py);
    array.try_readwrite()?.make_nonwriteable();
    Ok(array)
}

/// One dimension of [`frozen`].
pub(crate) fn vector<'py, T: Element>(
    py: Python<'py>,
    numbers: Vec<T>,
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    let length = numbers.len();
    frozen(py, numbers, &[length])
}

/// Rows of equal length as an array of two dimensions.
pub(crate) fn matrix<'py>(
    py: Python<'py>,
    rows: &[Vec<f64>],
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let columns = rows.first().map_or(0, Vec::len);
    frozen(py, rows.concat(), &[rows.len(), columns])
}

/// The numbers of an array, in order.
pub(crate) fn numbers(array: &PyReadonlyArray1<'_, f64>) -> Vec<f64> {
    array.as_array().iter().copied().collect()
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
