//! The materials, and what every name of a result means.

use crate::convert::from_json;
use crate::errors;
use contact::{Choice, Library, Model};
use formats::quantities::{Kind, QUANTITIES, described};
use formats::read_materials;
use formats::results::schema;
use impact::Quantity as FieldQuantity;
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Materials that match a word, as dictionaries.
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
        library = library.extended(&own.map_err(|error| errors::scene(py, &error))?);
    }
    let found: Vec<Value> = library
        .search(search)
        .map(|m| {
            json!({
                "name": m.name,
                "group": m.group,
                "youngs_modulus_pa": m.youngs_modulus_pa,
                "poisson_ratio": m.poisson_ratio,
                "density_kg_m3": m.density_kg_m3,
                "longitudinal_speed_m_s": m.longitudinal_speed_m_s(),
                "shear_speed_m_s": m.shear_speed_m_s(),
                "yield_strength_pa": m.yield_strength_pa,
                "tensile_strength_pa": m.tensile_strength_pa,
                "fracture_toughness_pa_sqrt_m": m.fracture_toughness_pa_sqrt_m,
                "source": m.source,
            })
        })
        .collect();
    from_json(py, &Value::Array(found))
}

/// Unit and meaning of every name of a result, by the part of the results that it is in.
#[pyfunction]
pub(crate) fn describe(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    let part = |list: &[(&str, &str, &str)]| -> Value {
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
    let more: Vec<(&str, &str, &str)> = FieldQuantity::ALL.iter().map(|&q| described(q)).collect();
    let found = json!({
        "more": part(&more),
        "quantities": Value::Object(quantities.collect()),
        "series": part(&schema::SERIES),
        "energy": part(&schema::ENERGIES),
        "fields": part(&schema::FIELDS),
        "places": part(&schema::PLACES),
        "arrival": part(&[schema::ARRIVALS, schema::VALID_UNTIL]),
        "map": part(&schema::MAP_SCALES),
        "waves": schema::WAVES,
        "models": Model::ALL.iter().map(|model| model.name()).collect::<Vec<_>>(),
    });
    from_json(py, &found)
}
