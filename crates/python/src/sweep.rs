//! Many impacts: rows of a sweep, and keys that vary together.

use crate::errors::{self, raise};
use crate::scene::{Given, from_toml};
use crate::values::{Array, frozen, numbers, vector};
use crate::work::{Ticker, run};
use formats::quantities::QUANTITIES;
use formats::sweep::{
    BLOCK, Block, Column, Spec, Values, check_rows, compute_rows, stage_csv, stage_rows,
};
use formats::{Existing, Output, SceneError};
use numpy::{PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use output::CSV;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;
use tabulator::Progress;

/// A sweep: a base scene and what varies.
#[pyclass(module = "hertzlamb._core", frozen)]
pub(crate) struct Plan {
    spec: Arc<Spec>,
}

/// The sweep of a dictionary, a path or a text.
#[pyfunction]
pub(crate) fn plan(given: &Bound<'_, PyAny>) -> PyResult<Plan> {
    let py = given.py();
    let given = Given::new(given)?;
    let spec = move |_: &Ticker| given.read(Spec::from_table);
    wrapped(run(py, None, None, spec)?)
}

/// The sweep of a scene whose keys (section, key) take values together, an array of numbers or a list of words each.
#[pyfunction]
pub(crate) fn plan_of_columns(
    given: &Bound<'_, PyAny>,
    columns: Vec<(String, String, Bound<'_, PyAny>)>,
) -> PyResult<Plan> {
    let py = given.py();
    let scene = Given::new(given)?;
    let columns = columns.into_iter().map(|(section, key, values)| {
        let values = match values.extract::<PyReadonlyArray1<'_, f64>>() {
            Ok(array) => Values::Numbers(numbers(&array)),
            Err(_) => Values::Texts(values.extract()?),
        };
        Ok(Column {
            section,
            key,
            values,
        })
    });
    let columns: Vec<Column> = columns.collect::<PyResult<_>>()?;
    let of = |table: &_, folder: &_| Spec::of_columns(table, folder, columns);
    let spec = move |_: &Ticker| scene.read(of);
    wrapped(run(py, None, None, spec)?)
}

/// Values of an axis at most.
const MOST_VALUES: usize = 10_000_000;

fn wrapped(spec: Result<Spec, SceneError>) -> PyResult<Plan> {
    let spec = spec.map_err(raise)?;
    // the axes are handed over as arrays
    if let Some(axis) = spec.axes.iter().find(|axis| axis.len > MOST_VALUES) {
        return Err(raise(SceneError::out_of_range(
            format!("the length of the axis {}", axis.name),
            axis.len as f64,
            "[1, 10000000] in Python, which has the values of every axis as an array",
        )));
    }
    let spec = Arc::new(spec);
    Ok(Plan { spec })
}

/// Results by row and quantity, models, and failed rows with their reasons.
type Computed<'py> = (Array<'py>, Array<'py, u8>, Vec<(usize, String)>);

/// Bytes that the reason of a failed row takes, in Python and beside it.
const REASON: usize = 500;

#[pymethods]
impl Plan {
    /// Number of rows.
    #[getter]
    fn rows(&self) -> usize {
        self.spec.rows()
    }

    /// The axes: name, length, and the keys along it with their values.
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

    /// Everything spelled out.
    fn resolved<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        from_toml(py, &self.spec.resolved)
    }

    /// Computes the rows from `start` on, every `step`-th.
    #[pyo3(signature = (start, step, count, threads=None, progress=None))]
    fn compute<'py>(
        &self,
        py: Python<'py>,
        start: usize,
        step: usize,
        count: usize,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Computed<'py>> {
        // a row, and room for the reason of one that fails
        errors::check_memory(count, 2 * 8 * (QUANTITIES.len() + 1))?;
        let spec = Arc::clone(&self.spec);
        let (found, short) = run(py, threads, progress, move |ticker| {
            ticker.total("rows", count as u64);
            let mut short = None;
            let found = compute_rows(&spec, start, step, count, |done, failed| {
                ticker.at(done as u64);
                short = errors::shortage(failed + BLOCK, "reasons of rows that fail", REASON);
                !ticker.is_stopped() && short.is_none()
            });
            (found, short)
        })?;
        if let Some(short) = short {
            return Err(errors::plain("TooMuchMemory", &short));
        }
        let block = found.map_err(raise)?;
        let block = block.ok_or_else(|| raise("the sweep was stopped"))?;
        let shape = [block.len(), QUANTITIES.len()];
        let (numbers, models) = (
            frozen(py, block.numbers, &shape)?,
            vector(py, block.models)?,
        );
        Ok((numbers, models, block.failures))
    }

    /// Writes the command's file of all rows, or its text.
    fn save(
        &self,
        py: Python<'_>,
        path: PathBuf,
        numbers: PyReadonlyArray2<'_, f64>,
        models: PyReadonlyArray1<'_, u8>,
        failures: Vec<(usize, String)>,
        overwrite: bool,
    ) -> PyResult<()> {
        let block = Block {
            start: 0,
            width: QUANTITIES.len(),
            numbers: numbers.to_vec()?,
            models: models.to_vec()?,
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
                stage_csv(&output, &spec, &[block])?.commit()
            } else {
                stage_rows(&output, &spec, &[block])?.commit()
            }
        })?
        .map_err(raise)
    }
}
