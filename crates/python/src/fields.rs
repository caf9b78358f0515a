//! Fields at probes and on sections as arrays, by the names of results files.

use crate::values::{frozen, matrix, vector};
use formats::quantities::labels_of;
use formats::results::schema;
use impact::{Peaks, ProbeFields, SectionFields};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A name with the suffix of its error.
fn error_of(name: &str) -> String {
    format!("{name}{}", schema::ERROR_SUFFIX)
}

/// Fields at probes: (probe, time), with errors, places and, where they are asked for, peaks by probe.
pub(crate) fn at_probes<'py>(
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
pub(crate) fn on_section<'py>(
    py: Python<'py>,
    section: &SectionFields,
) -> PyResult<Bound<'py, PyDict>> {
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
