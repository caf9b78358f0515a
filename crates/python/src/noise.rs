//! Noise of many impacts.

use crate::errors::raise;
use crate::scene::Given;
use crate::values::{frozen, vector};
use crate::work::{Threads, run};
use formats::noise::{NoiseResults, NoiseSpec, stage_noise};
use formats::{Existing, Output};
use output::HDF5;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;
use tabulator::Progress;

/// Computed noise.
#[pyclass(module = "hertzlamb._core", frozen)]
pub(crate) struct Noise {
    found: Arc<(NoiseSpec, NoiseResults)>,
}

/// Computes noise; `progress` is called with the finished and the total units of each stage.
#[pyfunction]
#[pyo3(name = "noise")]
pub(crate) fn compute_noise(
    given: &Bound<'_, PyAny>,
    threads: Option<Threads>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Noise> {
    let py = given.py();
    let given = Given::new(given)?;
    let spec = py
        .detach(|| given.read(NoiseSpec::from_table))
        .map_err(raise)?;
    let found = run(py, threads, progress, move |ticker| {
        let found = spec.compute(None, |stage, done, all| {
            ticker.total(stage, all as u64);
            ticker.at(done as u64);
            !ticker.is_stopped()
        });
        found.map(|results| results.map(|results| (spec, results)))
    })?;
    let found = found.map_err(raise)?;
    let found = found.ok_or_else(|| PyKeyboardInterrupt::new_err("the noise was stopped"))?;
    Ok(Noise {
        found: Arc::new(found),
    })
}

#[pymethods]
impl Noise {
    /// Arrays by their names in the file, and the names of the receivers.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (spec, results) = &*self.found;
        let found = PyDict::new(py);
        let names: Vec<&str> = results
            .noise
            .receivers
            .iter()
            .map(|one| one.name.as_str())
            .collect();
        found.set_item("receiver", names)?;
        for ((name, ..), dimensions, values) in results.arrays() {
            let shape: Vec<usize> = dimensions.iter().map(|one| results.length(*one)).collect();
            found.set_item(name, frozen(py, values, &shape)?)?;
        }
        if let (Some(traces), Some(recording)) = (&results.traces, spec.recording) {
            let (count, all) = (results.noise.receivers.len(), traces.len());
            let times = (0..all / count).map(|i| i as f64 * recording.step_s);
            found.set_item("time", vector(py, times.collect::<Vec<f64>>())?)?;
            found.set_item(
                "velocity",
                frozen(py, traces.clone(), &[count, all / count])?,
            )?;
        }
        Ok(found)
    }

    /// Mean rate in 1/s, radiated power in W, number of impacts, number of contacts that were solved in full.
    fn numbers(&self) -> (f64, f64, usize, usize) {
        let noise = &self.found.1.noise;
        (
            noise.rate_per_s(),
            noise.radiated_w(),
            noise.blows.len(),
            noise.pulses.solved(),
        )
    }

    /// Writes the noise as HDF5.
    fn save(&self, py: Python<'_>, path: PathBuf, overwrite: bool) -> PyResult<()> {
        let found = Arc::clone(&self.found);
        run(py, None, None, move |_| {
            HDF5.check(&path)?;
            let output = Output::claim(&path, Existing::replaced(overwrite))?;
            stage_noise(&output, &found.0, &found.1)?.commit()
        })?
        .map_err(raise)
    }
}
