//! Python values: read-only numpy arrays, and values from JSON.

use numpy::ndarray::ArrayD;
use numpy::{Element, IntoPyArray, PyArrayDyn, PyArrayMethods, PyReadonlyArray1};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

/// A numpy array of any number of dimensions.
pub(crate) type Array<'py, T = f64> = Bound<'py, PyArrayDyn<T>>;

/// The numbers as an array of the given shape, without a copy; read-only, since several objects may share it.
pub(crate) fn frozen<'py, T: Element>(
    py: Python<'py>,
    numbers: Vec<T>,
    shape: &[usize],
) -> PyResult<Array<'py, T>> {
    let array = ArrayD::from_shape_vec(shape, numbers);
    let array = array.map_err(|error| PyTypeError::new_err(error.to_string()))?;
    let array = array.into_pyarray(py);
    array.try_readwrite()?.make_nonwriteable();
    Ok(array)
}

/// The numbers as a read-only array of one dimension, see [`frozen`].
pub(crate) fn vector<'py, T: Element>(py: Python<'py>, numbers: Vec<T>) -> PyResult<Array<'py, T>> {
    let length = numbers.len();
    frozen(py, numbers, &[length])
}

/// Array (place, 6) of the six fields at each place.
pub(crate) fn fields<'py>(py: Python<'py>, places: Vec<[f64; 6]>) -> PyResult<Array<'py>> {
    let shape = [places.len(), 6];
    frozen(py, places.into_flattened(), &shape)
}

/// The numbers of an array, in order.
pub(crate) fn numbers(array: &PyReadonlyArray1<'_, f64>) -> Vec<f64> {
    array.as_array().iter().copied().collect()
}

/// Converts a JSON value to Python.
pub(crate) fn from_json<'py>(
    py: Python<'py>,
    value: &serde_json::Value,
) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?
        .call_method1("loads", (value.to_string(),))
}
