//! Many impacts: rows of a sweep, and scenes whose keys vary together.

use crate::errors::{self, raise};
use crate::scene::{Given, from_toml};
use crate::values::{Array, frozen, numbers, vector};
use crate::work::{Threads, Ticker, run};
use formats::quantities::QUANTITIES;
use formats::sweep::{
    BLOCK, Held, Spec, SweptKey, Values, check_rows, compute_columns, kept_places, stage_csv,
    stage_rows,
};
use formats::{Existing, Output, SceneError};
use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use output::CSV;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;
use tabulator::Progress;

/// A sweep: a base scene and the keys that vary.
#[pyclass(module = "hertzlamb._core", frozen)]
pub(crate) struct Plan {
    spec: Arc<Spec>,
    /// Indices in [`QUANTITIES`] of the results to keep. Default: all; with `columns`, these and the ones that a sweep
    /// file needs in addition.
    places: Vec<usize>,
}

/// Raises `SceneError` if a sweep in memory may not have that many rows.
#[pyfunction]
pub(crate) fn check_at_once(rows: usize) -> PyResult<()> {
    formats::sweep::check_at_once(rows).map_err(raise)
}

/// The sweep of a dictionary, path or text; `columns` names the results to keep, default: all.
#[pyfunction]
#[pyo3(signature = (given, columns=None))]
pub(crate) fn plan(given: &Bound<'_, PyAny>, columns: Option<Vec<String>>) -> PyResult<Plan> {
    let py = given.py();
    let given = Given::new(given)?;
    let spec = move |_: &Ticker| given.read(Spec::from_table);
    wrapped(run(py, None, None, spec)?, columns)
}

/// The sweep of a scene whose keys (section, key, values) vary together; values are an array of numbers or a list of
/// strings. `columns` names the results to keep, default: all.
#[pyfunction]
#[pyo3(signature = (given, keys, columns=None))]
pub(crate) fn plan_of_columns(
    given: &Bound<'_, PyAny>,
    keys: Vec<(String, String, Bound<'_, PyAny>)>,
    columns: Option<Vec<String>>,
) -> PyResult<Plan> {
    let py = given.py();
    let scene = Given::new(given)?;
    let keys = keys.into_iter().map(|(section, key, values)| {
        let values = match values.extract::<PyReadonlyArray1<'_, f64>>() {
            Ok(array) => Values::Numbers(numbers(&array)),
            Err(_) => Values::Texts(values.extract()?),
        };
        Ok(SweptKey {
            section,
            key,
            values,
        })
    });
    let keys: Vec<SweptKey> = keys.collect::<PyResult<_>>()?;
    let of = |table: &_, folder: &_| Spec::of_columns(table, folder, keys);
    let spec = move |_: &Ticker| scene.read(of);
    wrapped(run(py, None, None, spec)?, columns)
}

/// Largest length of an axis.
const MOST_VALUES: usize = 10_000_000;

fn wrapped(spec: Result<Spec, SceneError>, columns: Option<Vec<String>>) -> PyResult<Plan> {
    let mut spec = spec.map_err(raise)?;
    let mut places = (0..QUANTITIES.len()).collect();
    if let Some(columns) = columns {
        spec.fields = spec.fields.only(&columns).map_err(raise)?;
        places = kept_places(&spec);
    }
    // the axes are handed over as arrays
    if let Some(axis) = spec.axes.iter().find(|axis| axis.len > MOST_VALUES) {
        return Err(raise(SceneError::out_of_range(
            format!("the length of the axis {}", axis.name),
            axis.len as f64,
            "[1, 10000000] in Python, which holds the values of every axis in an array",
        )));
    }
    let spec = Arc::new(spec);
    Ok(Plan { spec, places })
}

/// Results by quantity and row, models by row, and failed rows with their reasons.
type Computed<'py> = (Array<'py>, Array<'py, u8>, Vec<(usize, String)>);

/// Approximate memory in bytes for the reason of a failed row, in Rust and Python together.
const REASON: usize = 500;

#[pymethods]
impl Plan {
    /// Number of rows.
    #[getter]
    fn rows(&self) -> usize {
        self.spec.rows()
    }

    /// Name, length, and values by key of each axis.
    fn axes<'py>(&self, py: Python<'py>) -> PyResult<Vec<(String, usize, Bound<'py, PyDict>)>> {
        let mut found = Vec::new();
        for axis in &self.spec.axes {
            let columns = PyDict::new(py);
            for column in &axis.columns {
                if let Values::Texts(words) = &column.values {
                    columns.set_item(column.name(), words)?;
                } else {
                    let numbers = (0..axis.len).filter_map(|i| column.values.number(i));
                    columns.set_item(column.name(), vector(py, numbers.collect())?)?;
                }
            }
            found.push((axis.name.clone(), axis.len, columns));
        }
        Ok(found)
    }

    /// The sweep with every default and material property written out.
    fn resolved<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        from_toml(py, &self.spec.resolved)
    }

    /// Names of the results to keep, in order.
    fn results(&self) -> Vec<&'static str> {
        let names = self.places.iter().map(|&place| QUANTITIES[place].name);
        names.collect()
    }

    /// Computes `count` rows: `start`, `start + step` and so on.
    #[pyo3(signature = (start, step, count, threads=None, progress=None))]
    fn compute<'py>(
        &self,
        py: Python<'py>,
        start: usize,
        step: usize,
        count: usize,
        threads: Option<Threads>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Computed<'py>> {
        // the results and the model of a row, and as much again for the reasons of failed rows
        errors::check_memory(count, "rows", 2 * 8 * (self.places.len() + 1))?;
        let (spec, places) = (Arc::clone(&self.spec), self.places.clone());
        let (found, short) = run(py, threads, progress, move |ticker| {
            ticker.total("rows", count as u64);
            let mut short = None;
            let found = compute_columns(&spec, start, step, count, places, |done, failed| {
                ticker.at(done as u64);
                short = errors::shortage(failed + BLOCK, "reasons of rows that fail", REASON);
                !ticker.is_stopped() && short.is_none()
            });
            (found, short)
        })?;
        if let Some(short) = short {
            return Err(errors::plain("TooMuchMemory", &short));
        }
        let held = found.map_err(raise)?;
        let held = held.ok_or_else(|| raise("the sweep was stopped"))?;
        let shape = [held.places.len(), held.models.len()];
        let numbers = frozen(py, held.numbers, &shape)?;
        Ok((numbers, vector(py, held.models)?, held.failures))
    }

    /// Writes a sweep file: text if the extension is that of text, otherwise HDF5 or Parquet.
    fn save(
        &self,
        py: Python<'_>,
        path: PathBuf,
        numbers: PyReadonlyArray2<'_, f64>,
        models: PyReadonlyArray1<'_, u8>,
        failures: Vec<(usize, String)>,
        overwrite: bool,
    ) -> PyResult<()> {
        if numbers.shape() != [self.places.len(), self.spec.rows()] {
            let (shape, rows) = (numbers.shape(), self.spec.rows());
            let message = format!("results of the shape {shape:?} are not those of {rows} rows");
            return Err(raise(message));
        }
        let held = Held {
            width: QUANTITIES.len(),
            places: self.places.clone(),
            // in the order of the indices, whatever the layout in memory
            numbers: numbers.as_array().iter().copied().collect(),
            models: models.as_array().iter().copied().collect(),
            failures,
        };
        let spec = Arc::clone(&self.spec);
        run(py, None, None, move |_| {
            let csv = CSV.check(&path).is_ok();
            if !csv {
                check_rows(&path)?;
            }
            let output = Output::claim(&path, Existing::replaced(overwrite))?;
            if csv {
                stage_csv(&output, &spec, &held)?.commit()
            } else {
                stage_rows(&output, &spec, &held)?.commit()
            }
        })?
        .map_err(raise)
    }
}
