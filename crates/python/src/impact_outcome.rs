//! One impact: computed, looked at by the names of results files, written.

use crate::errors::{self, raise};
use crate::scene::{scene, spelled_out};
use crate::table::{Opened, Table};
use crate::values::{from_json, frozen, matrix, vector};
use crate::work::run;
use contact::{Choice, Unknown};
use formats::quantities::{Kind, Labels, QUANTITIES, labels_of};
use formats::results::schema;
use formats::{Existing, Output, json_report, stage_results, stage_results_csv};
use impact::{
    Allowance, KernelChoice, Outcome as Computed, Peaks, ProbeFields, Scene, SectionFields,
    simulate_within,
};
use output::{CSV, HDF5};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

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
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Outcome> {
    let (py, start) = (given.py(), Instant::now());
    let scene = scene(given)?;
    let opened = table.map(|table| Arc::clone(&table.get().opened));
    let kernels = kernels(py, kernel, opened.clone())?;
    let (result, scene) = run(py, threads, progress, move |ticker| {
        let allowance = Allowance {
            memory_bytes: max_memory_bytes.unwrap_or_else(output::free_memory),
            go_on: &|forecast| {
                ticker.of(forecast.points as u64);
                !ticker.is_stopped()
            },
            watch: &|| ticker.more(1),
        };
        (simulate_within(&scene, &kernels, &allowance), scene)
    })?;
    let file = opened.as_ref().map(|opened| opened.file.path());
    let computed = result.map_err(|error| errors::raised_in(py, error, file))?;
    Ok(Outcome {
        found: Arc::new((scene, computed)),
        wall_s: start.elapsed().as_secs_f64(),
    })
}

/// Yield pressure or velocity of a scene from what was measured of a rebound, by name.
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
    let unknown = errors::one_of(py, "unknown", unknown, &known)?;
    let scene = scene(given)?;
    let found = run(py, None, None, move |_| {
        formats::infer(&scene, (&measured, &values), error, unknown)
    })?;
    from_json(py, &found.map_err(raise(py))?.1)
}

fn kernels(py: Python<'_>, name: &str, table: Option<Arc<Opened>>) -> PyResult<KernelChoice> {
    match (name, table) {
        ("direct", _) | ("auto", None) => Ok(KernelChoice::Direct),
        ("table", Some(table)) => Ok(KernelChoice::Table(table)),
        ("auto", Some(table)) => Ok(KernelChoice::Auto(table)),
        ("table", None) => Err(errors::plain(
            py,
            "SceneError",
            "kernel = \"table\" needs a table: give table=hertzlamb.Table.open(...)",
        )),
        _ => Err(errors::unknown(
            py,
            "kernel",
            name,
            &["auto", "direct", "table"],
        )),
    }
}

#[pymethods]
impl Outcome {
    /// The scalar results by name; None where one does not exist.
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

    /// What `hertzlamb impact --json` prints.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (scene, computed) = &*self.found;
        from_json(py, &json_report(scene, computed, self.wall_s))
    }

    /// What the user should know.
    fn warnings(&self) -> Vec<String> {
        self.found.1.warnings.clone()
    }

    /// The scene with every default and material spelled out.
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

    /// Fields at the probes by name: (probe, time), with errors and places by probe.
    fn probes<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let (scene, computed) = &*self.found;
        let time_s = &computed.series.time_s;
        let found = computed.probes.as_ref();
        let found = found.map(|fields| at_probes(py, fields, time_s, scene.peaks));
        found.transpose()
    }

    /// Fields on the section by name: (time, z, r), with errors and arrivals by place.
    fn section<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let found = self.found.1.section.as_ref();
        found.map(|section| on_section(py, section)).transpose()
    }

    /// Writes the command's results file.
    fn save(&self, py: Python<'_>, path: PathBuf, overwrite: bool) -> PyResult<()> {
        self.write(py, path, overwrite, false)
    }

    /// Writes the command's table of text.
    fn save_csv(&self, py: Python<'_>, path: PathBuf, overwrite: bool) -> PyResult<()> {
        self.write(py, path, overwrite, true)
    }
}

impl Outcome {
    fn write(&self, py: Python<'_>, path: PathBuf, overwrite: bool, csv: bool) -> PyResult<()> {
        let found = Arc::clone(&self.found);
        run(py, None, None, move |_| {
            let ending = if csv { CSV } else { HDF5 };
            ending.check(&path)?;
            let output = Output::claim(&path, Existing::replaced(overwrite))?;
            let (scene, computed) = &*found;
            if csv {
                stage_results_csv(&output, scene, computed)?.commit()
            } else {
                stage_results(&output, scene, computed)?.commit()
            }
        })?
        .map_err(raise(py))
    }
}

/// Columns by name.
fn columns_of<'py, 'a>(
    py: Python<'py>,
    columns: impl Iterator<Item = (&'static Labels<'static>, &'a [f64])>,
) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    for ((name, ..), column) in columns {
        found.set_item(name, vector(py, column.to_vec())?)?;
    }
    Ok(found)
}

/// A name with the suffix of its error.
fn error_of(name: &str) -> String {
    format!("{name}{}", schema::ERROR_SUFFIX)
}

/// Fields at probes: (probe, time), with errors, places and, where they are asked for, peaks by probe.
fn at_probes<'py>(
    py: Python<'py>,
    fields: &ProbeFields,
    time_s: &[f64],
    peaks: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    for (place, column) in schema::PLACES.iter().zip([&fields.r_m, &fields.z_m]) {
        found.set_item(place.0, vector(py, column.clone())?)?;
    }
    let arrivals: Vec<f64> = fields.arrival_s.iter().flatten().copied().collect();
    let shape = [fields.arrival_s.len(), 3];
    found.set_item(schema::ARRIVALS.0, frozen(py, arrivals, &shape)?)?;
    let valid = vector(py, fields.valid_until_s.clone())?;
    found.set_item(schema::VALID_UNTIL.0, valid)?;
    for ((name, ..), values, errors) in schema::histories(fields) {
        found.set_item(name, matrix(py, values)?)?;
        found.set_item(error_of(name), vector(py, errors.clone())?)?;
        if peaks {
            let mut largest = Peaks::default();
            for samples in values {
                largest.push(time_s, samples);
            }
            put_peaks(&found, name, largest, &[values.len()])?;
        }
    }
    Ok(found)
}

/// Fields on a section: (time, z, r), with errors, arrivals and, where they are asked for, peaks by place.
fn on_section<'py>(py: Python<'py>, section: &SectionFields) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    let scales = [&section.time_s, &section.z_m, &section.r_m];
    for (scale, column) in schema::MAP_SCALES.iter().zip(scales) {
        found.set_item(scale.0, vector(py, column.clone())?)?;
    }
    let place = [section.z_m.len(), section.r_m.len()];
    let frames = [section.time_s.len(), place[0], place[1]];
    let waves = [3, place[0], place[1]];
    let arrivals = section.arrival_s.concat();
    found.set_item(schema::ARRIVALS.0, frozen(py, arrivals, &waves)?)?;
    let values = section.values.iter().zip(&section.errors);
    let names: Vec<_> = labels_of(&section.quantities).map(|row| row.0).collect();
    for (&name, (values, errors)) in names.iter().zip(values) {
        found.set_item(name, frozen(py, values.clone(), &frames)?)?;
        found.set_item(error_of(name), frozen(py, errors.clone(), &place)?)?;
    }
    for (name, largest) in names.into_iter().zip(section.peaks.iter().flatten()) {
        put_peaks(&found, name, largest.clone(), &place)?;
    }
    Ok(found)
}

/// The largest values over time and their instants.
fn put_peaks(
    found: &Bound<'_, PyDict>,
    name: &str,
    largest: Peaks,
    shape: &[usize],
) -> PyResult<()> {
    let columns = [largest.values, largest.time_s];
    for (suffix, column) in schema::PEAK_SUFFIXES.iter().zip(columns) {
        found.set_item(
            format!("{name}{suffix}"),
            frozen(found.py(), column, shape)?,
        )?;
    }
    Ok(())
}
