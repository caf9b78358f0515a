//! Scenes and sweeps as people give them: a dictionary, a path, or TOML text.

use crate::convert::{from_toml, table};
use crate::errors;
use formats::{parse_scene, read_scene};
use impact::Scene;
use pyo3::prelude::*;
use pyo3::types::PyString;
use std::path::{Path, PathBuf};
use toml::Table;

/// What was given.
#[derive(Debug)]
pub(crate) enum Given {
    /// A dictionary.
    Table(Table),
    /// TOML text.
    Text(String),
    /// A file.
    File(PathBuf),
}

/// Where the files are that a dictionary or a text names.
pub(crate) fn here() -> &'static Path {
    Path::new(".")
}

impl Given {
    /// A text has more than one line, or is one assignment or section; anything else is a path.
    pub(crate) fn new(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = given.py();
        if let Ok(text) = given.cast::<PyString>() {
            let text: String = text.extract()?;
            let is_text = text.contains(['\n', '=']) || text.trim_start().starts_with('[');
            return Ok(if is_text {
                Self::Text(text)
            } else {
                Self::File(PathBuf::from(text))
            });
        }
        if given.hasattr("__fspath__")? {
            return Ok(Self::File(given.extract()?));
        }
        if !given.hasattr("items")? {
            let kind = given.get_type().name()?;
            let message = format!("a scene is a dictionary, a path or TOML text, not {kind}");
            return Err(errors::plain(py, "SceneError", &message));
        }
        table(given, "").map(Self::Table)
    }
}

/// The scene that was given.
pub(crate) fn scene(given: &Bound<'_, PyAny>) -> PyResult<Scene> {
    let py = given.py();
    let given = Given::new(given)?;
    let found = py.detach(|| match &given {
        Given::Table(table) => formats::scene::scene_of(table, here()),
        Given::Text(text) => parse_scene(text, here()),
        Given::File(path) => read_scene(path),
    });
    found.map_err(|error| errors::raised(py, error))
}

/// The scene with every default and material spelled out, as a dictionary.
pub(crate) fn spelled_out<'py>(py: Python<'py>, scene: &Scene) -> PyResult<Bound<'py, PyAny>> {
    from_toml(py, &formats::resolved(scene))
}

/// A scene with every default and material spelled out.
#[pyfunction]
pub(crate) fn resolved<'py>(given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    spelled_out(given.py(), &scene(given)?)
}

/// The sections of a contact that have a key of this name.
#[pyfunction]
pub(crate) fn sections_of(key: &str) -> Vec<&'static str> {
    formats::scene::sections_of(key)
}
