//! Builds and extends kernel tables.

use crate::errors;
use crate::impact_outcome::replace;
use crate::scene::table;
use crate::work::{Ticker, Way, run};
use pyo3::prelude::*;
use pyo3::types::PyString;
use std::path::{Path, PathBuf};
use tabulator::{BuildError, Extension, Grid, PRESETS, Summary, build_over, refine};

/// A grid as it was given.
enum Named {
    Preset(String),
    File(PathBuf),
    Text(String),
}

impl Named {
    fn new(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = given.py();
        if let Ok(name) = given.cast::<PyString>() {
            let name: String = name.extract()?;
            let is_file = Path::new(&name)
                .extension()
                .is_some_and(|end| end == "toml");
            if PRESETS.contains(&name.as_str()) {
                return Ok(Self::Preset(name));
            } else if is_file {
                return Ok(Self::File(PathBuf::from(name)));
            }
            let words = format!("{}, or the name of a .toml file", PRESETS.join(", "));
            return Err(errors::unknown(py, "grid", &name, &[&words]));
        }
        if given.hasattr("__fspath__")? {
            return Ok(Self::File(given.extract()?));
        }
        Ok(Self::Text(table(given, "")?.to_string()))
    }

    fn grid(&self) -> Result<Grid, BuildError> {
        match self {
            Self::Preset(name) => Ok(Grid::preset(name)?.unwrap_or_else(Grid::demo)),
            Self::File(path) => Grid::from_file(path),
            Self::Text(text) => Grid::parse(text),
        }
    }
}

/// What differs from the grid.
struct Changes {
    nu: Option<Vec<f64>>,
    r_max: Option<f64>,
    z_max: Option<f64>,
    time_factor: Option<f64>,
    /// An error, and the length of the pulses for which it is asked.
    accuracy: Option<(f64, f64)>,
}

impl Changes {
    fn apply(self, grid: &mut Grid, ticker: &Ticker) -> Result<(), BuildError> {
        if let Some(mut ratios) = self.nu {
            ratios.sort_by(f64::total_cmp);
            ratios.dedup();
            grid.poisson_ratios = ratios;
            grid.exact_ratios.clear();
        }
        grid.r.max = self.r_max.unwrap_or(grid.r.max);
        grid.z.max = self.z_max.unwrap_or(grid.z.max);
        grid.time_factor = self.time_factor.unwrap_or(grid.time_factor);
        if let Some((tolerance, pulse)) = self.accuracy {
            (*grid, _) = refine(grid, tolerance, pulse, ticker)?;
        }
        Ok(())
    }
}

/// Builds a table; its points, bytes and time in s.
#[pyfunction]
#[pyo3(signature = (path, grid, nu=None, r_max=None, z_max=None, time_factor=None, accuracy=None, overwrite=false, threads=None, progress=None))]
#[allow(
    clippy::too_many_arguments,
    reason = "the Python layer gives them names"
)]
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
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(usize, u64, f64)> {
    let named = Named::new(grid)?;
    let changes = Changes {
        nu,
        r_max,
        z_max,
        time_factor,
        accuracy,
    };
    let way = Way { threads, progress };
    let built = run(py, &way, move |ticker| {
        output::TABLE.check(&path)?;
        let mut grid = named.grid()?;
        changes.apply(&mut grid, ticker)?;
        build_over(&grid, &path, replace(overwrite), ticker)
    })?;
    summary(py, built)
}

/// Adds slices and reach to a table; its points, bytes and time in s.
#[pyfunction]
#[pyo3(signature = (path, nu=None, r_max=None, z_max=None, time_factor=None, threads=None, progress=None))]
#[allow(
    clippy::too_many_arguments,
    reason = "the Python layer gives them names"
)]
pub(crate) fn extend(
    py: Python<'_>,
    path: PathBuf,
    nu: Option<Vec<f64>>,
    r_max: Option<f64>,
    z_max: Option<f64>,
    time_factor: Option<f64>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(usize, u64, f64)> {
    let extension = Extension {
        exact_ratios: nu.unwrap_or_default(),
        r_max,
        z_max,
        time_factor,
    };
    let way = Way { threads, progress };
    let built = run(py, &way, move |ticker| {
        tabulator::extend(&path, &extension, ticker)
    })?;
    summary(py, built)
}

fn summary(py: Python<'_>, built: Result<Summary, BuildError>) -> PyResult<(usize, u64, f64)> {
    let summary = built.map_err(|error| errors::raised(py, error))?;
    Ok((summary.points, summary.bytes, summary.wall_s))
}
