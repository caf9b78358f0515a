//! Materials, and the units and descriptions of all results.

use crate::errors::raise;
use crate::values::from_json;
use contact::{Choice, Library, Model};
use formats::quantities::{FIELDS, Kind, Labels, QUANTITIES, labels_of};
use formats::schema::results as schema;
use formats::sweep::described_keys;
use formats::{material_report, read_materials};
use impact::Quantity as FieldQuantity;
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Dictionaries of the materials whose name, group or source contains `search`.
#[pyfunction]
#[pyo3(signature = (search, file=None))]
pub(crate) fn materials<'py>(
    py: Python<'py>,
    search: &str,
    file: Option<PathBuf>,
) -> PyResult<Bound<'py, PyAny>> {
    let mut library = Library::built_in().clone();
    if let Some(path) = file {
        let own = py.detach(|| read_materials(&path));
        library = library.extended(&own.map_err(raise)?);
    }
    let found: Value = library.search(search).map(material_report).collect();
    from_json(py, &found)
}

/// Unit and description of every name in the results, by the part of the results that contains it.
#[pyfunction]
pub(crate) fn describe(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    let part = |list: &[Labels<'_>]| -> Value {
        let pairs = list
            .iter()
            .map(|(name, unit, meaning)| ((*name).to_owned(), json!([unit, meaning])));
        Value::Object(pairs.collect())
    };
    let quantities = QUANTITIES.iter().map(|quantity| {
        let kind = match quantity.kind {
            Kind::Real => "real",
            Kind::Count => "count",
        };
        let row = json!([quantity.unit, quantity.meaning, kind]);
        (quantity.name.to_owned(), row)
    });
    let keys = described_keys().map(|key| (key.name, json!([key.unit, key.meaning])));
    let more: Vec<_> = labels_of(FieldQuantity::ALL).skip(FIELDS.len()).collect();
    let found = json!({
        "keys": Value::Object(keys.collect()),
        "more": part(&more),
        "quantities": Value::Object(quantities.collect()),
        "series": part(&schema::SERIES),
        "energy": part(&schema::ENERGIES),
        "fields": part(&FIELDS),
        "places": part(&schema::PLACES),
        "outputs": part(&schema::OUTPUTS),
        "arrival": part(&[schema::ARRIVALS, schema::VALID_UNTIL, schema::ECHO_ARRIVALS]),
        "map": part(&schema::MAP_SCALES),
        "waves": schema::WAVES,
        "models": Model::ALL.iter().map(|model| model.name()).collect::<Vec<_>>(),
    });
    from_json(py, &found)
}
