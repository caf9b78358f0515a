//! One impact: computed, looked at, written.

use crate::errors::{self, OrRaise};
use crate::fields::{at_probes, on_section};
use crate::scene::{scene, spelled_out};
use crate::table::Opened;
use crate::table::Table;
use crate::values::{from_json, vector};
use crate::work::{Way, run};
use contact::{Choice, Unknown};
use formats::quantities::{Kind, Labels, QUANTITIES};
use formats::results::schema;
use formats::{Existing, Output, json_report, stage_results, stage_results_csv};
use impact::{Allowance, KernelChoice, Outcome as Computed, Scene, simulate_within};
use output::{CSV, HDF5};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// The results of an impact.
#[pyclass(module = "hertzlamb._core", frozen)]
pub(crate) struct Outcome {
    found: Arc<Found>,
}

struct Found {
    scene: Scene,
    computed: Computed,
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
    let way = Way { threads, progress };
    let (result, scene) = run(py, &way, move |ticker| {
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
    let file = opened.as_ref().map(|opened| opened.path());
    let computed = result.map_err(|error| errors::raised_in(py, error, file))?;
    let wall_s = start.elapsed().as_secs_f64();
    Ok(Outcome {
        found: Arc::new(Found {
            scene,
            computed,
            wall_s,
        }),
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
    let found = run(py, &Way::default(), move |_| {
        formats::infer(&scene, (&measured, &values), error, unknown)
    })?;
    from_json(py, &found.or_raise(py)?.1)
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

/// Names with their arrays; none where there is nothing.
type Arrays<'py> = PyResult<Option<Bound<'py, PyDict>>>;

#[pymethods]
impl Outcome {
    /// The scalar results by name; None where one does not exist.
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        for quantity in &QUANTITIES {
            let value = quantity.of(&self.found.computed);
            match (quantity.kind, value) {
                (Kind::Count, Some(count)) => found.set_item(quantity.name, count as u64)?,
                (Kind::Real | Kind::Count, real) => found.set_item(quantity.name, real)?,
            }
        }
        Ok(found)
    }

    /// What `hertzlamb impact --json` prints.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let Found {
            scene,
            computed,
            wall_s,
        } = &*self.found;
        from_json(py, &json_report(scene, computed, *wall_s))
    }

    /// What the user should know.
    fn warnings(&self) -> Vec<String> {
        self.found.computed.warnings.clone()
    }

    /// The scene with every default and material spelled out.
    fn scene<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        spelled_out(py, &self.found.scene)
    }

    /// Time series by name.
    fn series<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let series = &self.found.computed.series;
        let striker = series.striker.as_ref();
        let columns = [
            Some(&series.time_s),
            Some(&series.force_n),
            striker.map(|striker| &striker.displacement_m),
            striker.map(|striker| &striker.velocity_m_s),
            Some(&series.deflection_m),
        ];
        columns_of(py, &schema::SERIES, columns)
    }

    /// Energies over time by name.
    fn energy<'py>(&self, py: Python<'py>) -> Arrays<'py> {
        let Some(energy) = &self.found.computed.series.energy else {
            return Ok(None);
        };
        let columns = [
            energy.kinetic_j.as_ref(),
            energy.work_j.as_ref(),
            Some(&energy.stored_j),
            Some(&energy.radiated_j),
            energy.plastic_j.as_ref(),
        ];
        columns_of(py, &schema::ENERGIES, columns).map(Some)
    }

    /// Fields at the probes by name: (probe, time), with errors and places by probe.
    fn probes<'py>(&self, py: Python<'py>) -> Arrays<'py> {
        let Found {
            scene, computed, ..
        } = &*self.found;
        let time_s = &computed.series.time_s;
        let found = computed.probes.as_ref();
        found
            .map(|fields| at_probes(py, fields, time_s, scene.peaks))
            .transpose()
    }

    /// Fields on the section by name: (time, z, r), with errors and arrivals by place.
    fn section<'py>(&self, py: Python<'py>) -> Arrays<'py> {
        let found = self.found.computed.section.as_ref();
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
        run(py, &Way::default(), move |_| {
            let (ending, existing) = (if csv { CSV } else { HDF5 }, replace(overwrite));
            ending.check(&path)?;
            let output = Output::claim(&path, existing)?;
            let (scene, computed) = (&found.scene, &found.computed);
            if csv {
                stage_results_csv(&output, scene, computed)?.commit()
            } else {
                stage_results(&output, scene, computed)?.commit()
            }
        })?
        .or_raise(py)
    }
}

/// What happens to a file that is there.
pub(crate) fn replace(overwrite: bool) -> Existing {
    if overwrite {
        Existing::Replace
    } else {
        Existing::Keep
    }
}

/// The columns that exist, by name.
fn columns_of<'py, const N: usize>(
    py: Python<'py>,
    described: &[Labels<'_>; N],
    columns: [Option<&Vec<f64>>; N],
) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    for ((name, _, _), column) in described.iter().zip(columns) {
        if let Some(column) = column {
            found.set_item(name, vector(py, column.clone())?)?;
        }
    }
    Ok(found)
}
