//! The force behind traces of sensors.

use crate::errors::{one_of, raise};
use crate::scene::{scene, spelled_out};
use crate::values::{from_json, frozen, numbers, vector};
use crate::work::run;
use contact::Choice;
use formats::Existing;
use formats::traces::{
    Given, InferredForce, KnownOf, Traces, force_report, infer_force, stage_force,
};
use formats::{Output, resolved};
use impact::Scene;
use numpy::PyReadonlyArray1;
use output::HDF5;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;

/// The force behind traces.
#[pyclass(module = "hertzlamb._core", frozen)]
pub(crate) struct Force {
    found: Arc<(Scene, InferredForce)>,
}

/// Infers the force; `blows` are lists of traces, each a list of sensors.
#[pyfunction]
#[pyo3(name = "force")]
pub(crate) fn infer_force_of(
    given: &Bound<'_, PyAny>,
    time_s: PyReadonlyArray1<'_, f64>,
    blows: Vec<Vec<PyReadonlyArray1<'_, f64>>>,
    noise: Vec<f64>,
    unknown_gains: Vec<usize>,
    impulse_n_s: Option<[f64; 2]>,
    lambda_: Option<f64>,
    window_s: Option<[f64; 2]>,
    known: Option<&str>,
    restitution: Option<f64>,
) -> PyResult<Force> {
    let py = given.py();
    let names: Vec<_> = KnownOf::ALL.iter().map(|&one| (one.name(), one)).collect();
    let known = known
        .map(|word| one_of("known", word, &names))
        .transpose()?;
    let given_too = Given {
        noise,
        unknown_gains,
        impulse_n_s,
        lambda: lambda_,
        window_s,
        known,
        restitution,
    };
    let time_s = numbers(&time_s);
    let traces = |sensors: &Vec<PyReadonlyArray1<'_, f64>>| {
        Traces::new(&time_s, sensors.iter().map(numbers).collect()).map_err(raise)
    };
    let blows: Vec<Traces> = blows.iter().map(traces).collect::<PyResult<_>>()?;
    let scene = scene(given)?;
    let (found, scene) = run(py, None, None, move |_| {
        (infer_force(&scene, &blows, &given_too), scene)
    })?;
    Ok(Force {
        found: Arc::new((scene, found.map_err(raise)?)),
    })
}

#[pymethods]
impl Force {
    /// The report of `hertzlamb infer --trace --json`.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        from_json(py, &force_report(&self.found.1))
    }

    /// Arrays by name: time, force, low, high, l_curve (point, 3), predicted (sensor, time), predicted_time.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let own = &self.found.1;
        let (history, predicted) = (&own.found.history, &own.found.predicted);
        let times = |start_s: f64, step_s: f64, count: usize| {
            vector(
                py,
                (0..count)
                    .map(|i| start_s + i as f64 * step_s)
                    .collect::<Vec<f64>>(),
            )
        };
        let found = PyDict::new(py);
        let start_s = history.start_s + own.start_s;
        found.set_item(
            "time",
            times(start_s, history.step_s, history.force_n.len())?,
        )?;
        for (name, samples) in [
            ("force", &history.force_n),
            ("low", &history.low_n),
            ("high", &history.high_n),
        ] {
            found.set_item(name, vector(py, samples.clone())?)?;
        }
        let rows = history.l_curve.iter();
        let rows: Vec<f64> = rows
            .flat_map(|own| [own.lambda, own.residual, own.roughness])
            .collect();
        found.set_item("l_curve", frozen(py, rows, &[history.l_curve.len(), 3])?)?;
        let count = predicted.first().map_or(0, Vec::len);
        found.set_item("predicted_time", times(own.start_s, own.step_s, count)?)?;
        found.set_item(
            "predicted",
            frozen(py, predicted.concat(), &[predicted.len(), count])?,
        )?;
        Ok(found)
    }

    /// The scene with every default and material property written out.
    fn scene<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        spelled_out(py, &self.found.0)
    }

    /// Writes the force as HDF5.
    fn save(&self, py: Python<'_>, path: PathBuf, overwrite: bool) -> PyResult<()> {
        let found = Arc::clone(&self.found);
        run(py, None, None, move |_| {
            HDF5.check(&path)?;
            let output = Output::claim(&path, Existing::replaced(overwrite))?;
            stage_force(&output, &resolved(&found.0), &found.1)?.commit()
        })?
        .map_err(raise)
    }
}
