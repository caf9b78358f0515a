//! One impact: computation, results under the names of results files, and output.

use crate::errors::{one_of, plain, raise, raised_in, unknown};
use crate::scene::{scene, spelled_out};
use crate::table::{Opened, Table};
use crate::values::{from_json, frozen, vector};
use crate::work::{Threads, run};
use contact::{Choice, Unknown};
use formats::quantities::{Described, Kind, Labels, QUANTITIES, labels_of};
use formats::results::beside;
use formats::schema::results as schema;
use formats::{Existing, Output, json_report, stage_results, stage_results_csv};
use impact::{Allowance, KernelChoice, Outcome as Computed, Scene, SensorHistory, simulate_within};
use output::{CSV, HDF5};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;
use tabulator::Progress;

/// The results of an impact.
#[pyclass(module = "hertzlamb._core", frozen)]
pub(crate) struct Outcome {
    found: Arc<(Scene, Computed)>,
    wall_s: f64,
}

/// Computes a scene.
#[pyfunction]
#[pyo3(signature = (given, table, kernel, max_memory_bytes=None, threads=None, progress=None))]
#[pyo3(name = "impact")]
pub(crate) fn run_impact(
    given: &Bound<'_, PyAny>,
    table: Option<&Bound<'_, Table>>,
    kernel: &str,
    max_memory_bytes: Option<f64>,
    threads: Option<Threads>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Outcome> {
    let (py, start) = (given.py(), Instant::now());
    let scene = scene(given)?;
    let opened = table.map(|table| Arc::clone(&table.get().opened));
    let kernels = kernels(kernel, opened.clone())?;
    let (result, scene) = run(py, threads, progress, move |ticker| {
        let allowance = Allowance {
            memory_bytes: max_memory_bytes.unwrap_or_else(output::free_memory),
            go_on: &|forecast| {
                ticker.total("fields", forecast.points as u64);
                !ticker.is_stopped()
            },
            watch: &|| ticker.advance(1),
        };
        (simulate_within(&scene, &kernels, &allowance), scene)
    })?;
    let file = opened.as_ref().map(|opened| opened.file.path());
    let computed = result.map_err(|error| raised_in(error, file))?;
    Ok(Outcome {
        found: Arc::new((scene, computed)),
        wall_s: start.elapsed().as_secs_f64(),
    })
}

/// Infers a yield pressure or velocity from a measurement of a rebound; `measured` is the name of the measurement.
#[pyfunction]
pub(crate) fn infer<'py>(
    given: &Bound<'py, PyAny>,
    measured: String,
    values: Vec<f64>,
    error: f64,
    unknown: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let py = given.py();
    let known: Vec<_> = Unknown::ALL.iter().map(|&one| (one.name(), one)).collect();
    let unknown = one_of("unknown", unknown, &known)?;
    let scene = scene(given)?;
    let found = run(py, None, None, move |_| {
        formats::infer(&scene, (&measured, &values), error, unknown)
    })?;
    from_json(py, &found.map_err(raise)?.1)
}

fn kernels(name: &str, table: Option<Arc<Opened>>) -> PyResult<KernelChoice> {
    match (name, table) {
        ("direct", _) | ("auto", None) => Ok(KernelChoice::Direct),
        ("table", Some(table)) => Ok(KernelChoice::Table(table)),
        ("auto", Some(table)) => Ok(KernelChoice::Auto(table)),
        ("table", None) => Err(plain(
            "SceneError",
            "kernel = \"table\" needs a table: pass table=hertzlamb.Table.open(...)",
        )),
        _ => Err(unknown("kernel", name, &["auto", "direct", "table"])),
    }
}

#[pymethods]
impl Outcome {
    /// The scalar results by name; None for a result that does not exist.
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        for quantity in &QUANTITIES {
            let value = quantity.of(&self.found.1);
            match (quantity.kind, value) {
                (Kind::Count, Some(count)) => found.set_item(quantity.name, count as u64)?,
                (Kind::Real | Kind::Count, real) => found.set_item(quantity.name, real)?,
            }
        }
        Ok(found)
    }

    /// The report of `hertzlamb impact --json`.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (scene, computed) = &*self.found;
        from_json(py, &json_report(scene, computed, self.wall_s))
    }

    /// Messages of all warnings.
    fn warnings(&self) -> Vec<String> {
        self.found.1.warnings.clone()
    }

    /// The scene with every default and material property written out.
    fn scene<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        spelled_out(py, &self.found.0)
    }

    /// Time series by name.
    fn series<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        columns_of(py, schema::samples(&self.found.1.series))
    }

    /// Energies over time by name.
    fn energy<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let energy = self.found.1.series.energy.as_ref();
        let columns = energy.map(|energy| columns_of(py, schema::energies(energy)));
        columns.transpose()
    }

    /// Fields at the probes by name, each (probe, time), with places, errors and requested peaks, each (probe,).
    fn probes<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(fields) = &self.found.1.probes else {
            return Ok(None);
        };
        let places = [&fields.r_m[..], &fields.z_m];
        let found = columns_of(py, schema::PLACES.iter().zip(places))?;
        let arrivals: Vec<f64> = fields.arrival_s.iter().flatten().copied().collect();
        let shape = [fields.arrival_s.len(), 3];
        found.set_item(schema::ARRIVALS.0, frozen(py, arrivals, &shape)?)?;
        let valid = vector(py, fields.valid_until_s.clone())?;
        found.set_item(schema::VALID_UNTIL.0, valid)?;
        let echoes = &fields.echoes;
        if !echoes.names.is_empty() {
            let names = py
                .import("numpy")?
                .call_method1("array", (&echoes.names,))?;
            names.call_method1("setflags", (false,))?;
            found.set_item(schema::ECHO.0, names)?;
            let shape = [fields.r_m.len(), echoes.names.len()];
            let arrivals = frozen(py, echoes.time_s.concat(), &shape)?;
            found.set_item(schema::ECHO_ARRIVALS.0, arrivals)?;
        }
        for (i, (row, values, errors)) in schema::histories(fields).enumerate() {
            let shape = [values.len(), values.first().map_or(0, Vec::len)];
            found.set_item(row.0, frozen(py, values.concat(), &shape)?)?;
            let peaks = fields.peaks.as_ref().map(|peaks| &peaks[i]);
            put_beside(&found, beside(row, errors, peaks), &shape[..1])?;
        }
        Ok(Some(found))
    }

    /// A dictionary of each sensor.
    fn sensors<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let of = |own: &SensorHistory| {
            let found = PyDict::new(py);
            let sensor = &own.sensor;
            let places = [sensor.r_m, sensor.z_m, sensor.face_radius_m];
            for ((name, ..), value) in schema::FACES.iter().zip(places) {
                found.set_item(name, value)?;
            }
            let words = [
                sensor.measured.name(),
                sensor.measured.unit(),
                sensor.output_unit(),
                own.face.name(),
            ];
            for ((name, ..), word) in schema::SENSED.iter().zip(words) {
                found.set_item(name, word)?;
            }
            found.set_item(schema::ARRIVALS.0, vector(py, own.arrival_s.to_vec())?)?;
            found.set_item(schema::VALID_UNTIL.0, own.valid_until_s)?;
            let [mean, mean_error, output, output_error] = schema::OUTPUTS.map(|row| row.0);
            found.set_item(mean_error, own.mean.error)?;
            let histories = [
                (mean, &own.mean.samples),
                (output, &own.output),
                (output_error, &own.output_error),
            ];
            for (name, samples) in histories {
                found.set_item(name, vector(py, samples.clone())?)?;
            }
            Ok(found)
        };
        self.found.1.sensors.iter().map(of).collect()
    }

    /// Fields on the section by name, each (time, z, r), with arrivals (3, z, r), errors and requested peaks, each (z, r).
    fn section<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(section) = &self.found.1.section else {
            return Ok(None);
        };
        let scales = [&section.time_s[..], &section.z_m, &section.r_m];
        let found = columns_of(py, schema::MAP_SCALES.iter().zip(scales))?;
        let place = [section.z_m.len(), section.r_m.len()];
        let frames = [section.time_s.len(), place[0], place[1]];
        let waves = [3, place[0], place[1]];
        let arrivals = section.arrival_s.concat();
        found.set_item(schema::ARRIVALS.0, frozen(py, arrivals, &waves)?)?;
        let values = section.values.iter().zip(&section.errors);
        for (i, (row, (values, errors))) in labels_of(&section.quantities).zip(values).enumerate() {
            found.set_item(row.0, frozen(py, values.clone(), &frames)?)?;
            let peaks = section.peaks.as_ref().map(|peaks| &peaks[i]);
            put_beside(&found, beside(row, errors, peaks), &place)?;
        }
        Ok(Some(found))
    }

    /// Writes a results file, as HDF5 or as text.
    fn save(&self, py: Python<'_>, path: PathBuf, overwrite: bool, csv: bool) -> PyResult<()> {
        let found = Arc::clone(&self.found);
        run(py, None, None, move |_| {
            let ending = if csv { CSV } else { HDF5 };
            ending.check(&path)?;
            let output = Output::claim(&path, Existing::replaced(overwrite))?;
            let stage = if csv {
                stage_results_csv
            } else {
                stage_results
            };
            stage(&output, &found.0, &found.1)?.commit()
        })?
        .map_err(raise)
    }
}

/// A dictionary of arrays from labelled columns.
fn columns_of<'py, 'a, 'b>(
    py: Python<'py>,
    columns: impl Iterator<Item = (&'a Labels<'static>, &'b [f64])>,
) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    for ((name, ..), column) in columns {
        found.set_item(name, vector(py, column.to_vec())?)?;
    }
    Ok(found)
}

/// Adds the errors of a quantity and, if requested, its peaks and their times.
fn put_beside(
    found: &Bound<'_, PyDict>,
    beside: Vec<(Described, &[f64])>,
    shape: &[usize],
) -> PyResult<()> {
    for (described, column) in beside {
        let column = frozen(found.py(), column.to_vec(), shape)?;
        found.set_item(described.name, column)?;
    }
    Ok(())
}
