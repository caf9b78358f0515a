//! A kernel table: opened once, asked often.

use crate::arrays::{frozen, numbers};
use crate::convert::from_json;
use crate::errors;
use crate::tables::{Fault, Opened};
use crate::work::{Ticker, Way, run};
use lookup::{Accuracy, LookupError, Quantiles, Smoothness, TableFile, TraceInfo, schema};
use numpy::{PyArrayDyn, PyReadonlyArray1};
use pyo3::prelude::*;
use rayon::prelude::*;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::Arc;

/// Points that a thread looks up at a time.
const GRAIN: usize = 16;

/// A kernel table on disk.
#[pyclass(module = "hertzlamb._core", frozen)]
pub(crate) struct Table {
    pub(crate) opened: Arc<Opened>,
}

/// What a trace was asked for.
struct Asked {
    nu: f64,
    points: Vec<[f64; 2]>,
    coarsening: u32,
    /// Cells of each trace; those that the table holds otherwise.
    cells: Option<usize>,
    smoothness: Smoothness,
}

/// What a trace gives.
struct Traces {
    /// Step responses averaged over cells: points, cells, fields.
    values: Vec<[f64; 6]>,
    infos: Vec<TraceInfo>,
    cells: usize,
}

/// Why there are no traces.
enum NoTraces {
    Table(Fault),
    Lookup(LookupError),
    Memory(usize),
}

/// Arrays of a trace: values, static fields, errors, and the width of a cell.
type Arrays<'py> = (
    Bound<'py, PyArrayDyn<f64>>,
    Bound<'py, PyArrayDyn<f64>>,
    Bound<'py, PyArrayDyn<f64>>,
    f64,
);

#[pymethods]
impl Table {
    /// The table of a file.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let file = run(py, &Way::default(), move |_| TableFile::open(&path))?;
        let file = file.map_err(|error| errors::table(py, &error))?;
        Ok(Self {
            opened: Arc::new(Opened::new(file)),
        })
    }

    /// Where it is.
    #[getter]
    fn path(&self) -> PathBuf {
        self.opened.path().to_owned()
    }

    /// Its settings and measured errors, as `hertzlamb table info --json` has them.
    fn info<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let opened = Arc::clone(&self.opened);
        let found = run(py, &Way::default(), move |_| info(&opened))?;
        from_json(py, &found.map_err(|error| errors::fault(py, &error))?)
    }

    /// Identity of the settings that it was made with.
    #[getter]
    fn id(&self) -> &str {
        self.opened.id()
    }

    /// Step responses at places of equal number.
    #[pyo3(signature = (nu, r, z, coarsening, cells, smooth, threads=None, progress=None))]
    #[allow(
        clippy::too_many_arguments,
        reason = "the Python layer gives them names"
    )]
    fn trace<'py>(
        &self,
        py: Python<'py>,
        nu: f64,
        r: PyReadonlyArray1<'py, f64>,
        z: PyReadonlyArray1<'py, f64>,
        coarsening: u32,
        cells: Option<usize>,
        smooth: bool,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Arrays<'py>> {
        let places = numbers(&r).into_iter().zip(numbers(&z));
        let asked = Asked {
            nu,
            points: places.map(|(r, z)| [r, z]).collect(),
            coarsening,
            cells,
            smoothness: if smooth {
                Smoothness::Smooth
            } else {
                Smoothness::Linear
            },
        };
        let rows = asked.points.len();
        let opened = Arc::clone(&self.opened);
        let way = Way { threads, progress };
        let found = run(py, &way, move |ticker| asked.traces(&opened, ticker))?;
        let found = found.map_err(|error| match error {
            NoTraces::Table(error) => errors::fault(py, &error),
            NoTraces::Lookup(error) => errors::of_lookup(py, &error, Some(self.opened.path())),
            NoTraces::Memory(cells) => errors::too_much_memory(py, rows, cells),
        })?;
        let width = found.infos.first().map_or(f64::NAN, |info| info.cell_width);
        let still: Vec<f64> = found.infos.iter().flat_map(|i| i.static_part).collect();
        let limits: Vec<f64> = found.infos.iter().flat_map(|i| i.error).collect();
        Ok((
            frozen(py, found.values.into_flattened(), &[rows, found.cells, 6])?,
            frozen(py, still, &[rows, 6])?,
            frozen(py, limits, &[rows, 6])?,
            width,
        ))
    }
}

impl Asked {
    fn traces(&self, opened: &Opened, ticker: &Ticker) -> Result<Traces, NoTraces> {
        let table = opened.whole().map_err(NoTraces::Table)?;
        let held = table.content().slices.iter().map(|slice| slice.cells).max();
        let cells = self
            .cells
            .unwrap_or((held.unwrap_or(0) >> self.coarsening.min(31)).max(1));
        let rows = self.points.len();
        let all = rows.checked_mul(cells).ok_or(NoTraces::Memory(cells))?;
        // asked for before it is taken: an allocation that fails would end the process
        if Vec::<[f64; 6]>::new().try_reserve_exact(all).is_err() {
            return Err(NoTraces::Memory(cells));
        }
        let mut values = vec![[0.0; 6]; all];
        let none = TraceInfo {
            static_part: [0.0; 6],
            cell_width: f64::NAN,
            error: [0.0; 6],
        };
        let mut infos = vec![none; rows];
        ticker.of(rows as u64);
        let chunks = values.par_chunks_mut((GRAIN * cells).max(1));
        let parts = chunks
            .zip(infos.par_chunks_mut(GRAIN))
            .zip(self.points.par_chunks(GRAIN));
        parts
            .try_for_each(|((values, infos), points)| {
                ticker.more(points.len() as u64);
                let (nu, coarsening) = (self.nu, self.coarsening);
                table.traces(self.smoothness, nu, points, coarsening, values, infos)?;
                for (row, info) in values.chunks_exact_mut(cells).zip(infos) {
                    for six in row {
                        for (value, still) in six.iter_mut().zip(info.static_part) {
                            *value += still;
                        }
                    }
                }
                Ok(())
            })
            .map_err(NoTraces::Lookup)?;
        Ok(Traces {
            values,
            infos,
            cells,
        })
    }
}

fn info(opened: &Opened) -> Result<Value, Fault> {
    let (path, table) = (opened.path(), opened.whole()?);
    let content = table.content();
    let origin = &content.origin;
    Ok(json!({
        "file": path.to_string_lossy(),
        "bytes": std::fs::metadata(path).map_or(0, |data| data.len()),
        "id": table.id(),
        "format_version": table.format_version(),
        "software_version": origin.software_version,
        "git_revision": origin.git_revision,
        "created_unix_s": origin.created_unix_s,
        "content_sha256": lookup::content_hash(content),
        "poisson_ratios": table.poisson_ratios(),
        "r_nodes": content.r.len(),
        "z_nodes": content.z.len(),
        "r_max": table.r_max(),
        "z_max": table.z_max(),
        "cell_width": content.cell_width,
        "cells": content.slices.iter().map(|slice| slice.cells).collect::<Vec<_>>(),
        "stencil_points": content.stencil_points,
        "accuracy_asked": origin.accuracy_asked,
        "pulse_lengths": content.pulse_lengths,
        "p99_relative_error": origin.accuracy_reached,
        "relative_errors": content.accuracy().iter().map(relative_errors).collect::<Vec<_>>(),
        "grid": origin.grid,
    }))
}

/// Relative errors measured off the grid with pulses of one length, by region and field.
fn relative_errors(accuracy: &Accuracy) -> Value {
    let fields = |errors: &[Quantiles; 6]| -> Value {
        let named = schema::FIELD_NAMES.into_iter().zip(errors);
        let pairs = named.map(|(name, &Quantiles { p50, p99, max })| {
            (name.to_owned(), json!({"p50": p50, "p99": p99, "max": max}))
        });
        Value::Object(pairs.collect())
    };
    let mut found = json!({
        "pulse_length": accuracy.pulse_length,
        "on_slices": fields(&accuracy.on_slices),
    });
    if let Some(between) = &accuracy.between_slices {
        found["between_slices"] = fields(between);
    }
    found
}
