//! Computation and extension of kernel tables.

use crate::errors::{self, raise};
use crate::scene::table;
use crate::work::{Threads, run};
use formats::Existing;
use pyo3::prelude::*;
use pyo3::types::PyString;
use std::path::{Path, PathBuf};
use tabulator::{Extension, Grid, PRESETS, build_over, refine};

/// The grid of a preset, a file or a dictionary.
fn grid_of(given: &Bound<'_, PyAny>) -> PyResult<Grid> {
    if let Ok(name) = given.cast::<PyString>() {
        let name: String = name.extract()?;
        let path = Path::new(&name);
        if let Some(grid) = Grid::preset(&name) {
            return Ok(grid);
        } else if path.extension().is_some_and(|end| end == "toml") {
            return Grid::from_file(path).map_err(raise);
        }
        let words = format!("{}, or the path of a .toml file", PRESETS.join(", "));
        return Err(errors::unknown("grid", &name, &[&words]));
    }
    if given.hasattr("__fspath__")? {
        return Grid::from_file(&given.extract::<PathBuf>()?).map_err(raise);
    }
    Grid::parse(&table(given, "", 0)?.to_string()).map_err(raise)
}

/// Computes a table and writes it; `accuracy` is a tolerance and a length of pulses in r0/c1.
#[pyfunction]
#[pyo3(signature = (path, grid, nu=None, r_max=None, z_max=None, time_factor=None, accuracy=None, overwrite=false, threads=None, progress=None))]
pub(crate) fn tabulate(
    py: Python<'_>,
    path: PathBuf,
    grid: &Bound<'_, PyAny>,
    nu: Option<Vec<f64>>,
    r_max: Option<f64>,
    z_max: Option<f64>,
    time_factor: Option<f64>,
    accuracy: Option<(f64, f64)>,
    overwrite: bool,
    threads: Option<Threads>,
    progress: Option<Py<PyAny>>,
) -> PyResult<()> {
    let mut grid = grid_of(grid)?.with(nu, [r_max, z_max, time_factor]);
    let built = run(py, threads, progress, move |ticker| {
        output::TABLE.check(&path)?;
        if let Some((tolerance, pulse)) = accuracy {
            (grid, _) = refine(&grid, tolerance, pulse, ticker)?;
        }
        build_over(&grid, &path, Existing::replaced(overwrite), ticker)
    })?;
    built.map(drop).map_err(raise)
}

/// Adds Poisson's ratios or a larger range to a table.
#[pyfunction]
#[pyo3(signature = (path, nu=None, r_max=None, z_max=None, time_factor=None, threads=None, progress=None))]
pub(crate) fn extend(
    py: Python<'_>,
    path: PathBuf,
    nu: Option<Vec<f64>>,
    r_max: Option<f64>,
    z_max: Option<f64>,
    time_factor: Option<f64>,
    threads: Option<Threads>,
    progress: Option<Py<PyAny>>,
) -> PyResult<()> {
    let extension = Extension {
        exact_ratios: nu.unwrap_or_default(),
        r_max,
        z_max,
        time_factor,
    };
    let built = run(py, threads, progress, move |ticker| {
        tabulator::extend(&path, &extension, ticker)
    })?;
    built.map(drop).map_err(raise)
}
