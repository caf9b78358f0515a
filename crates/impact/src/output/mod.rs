//! The results file: HDF5, as `data-schema/results.md` writes it down.
//!
//! Every name on disk is a constant of [`schema`]. The file is written beside its final name and
//! renamed when it is complete.

pub(crate) mod hdf;
mod map;
mod place;
pub mod schema;

pub use place::{Existing, OutputError, check, write_whole};

use crate::simulate::{Fields, Outcome};
use hdf::{attach_scale, matrix, set_scale, text, vector};
use hdf5::{Dataset, File};
use std::path::Path;

/// Writes the results of a scene.
///
/// # Errors
/// [`OutputError`].
pub fn write(path: &Path, outcome: &Outcome, existing: Existing) -> Result<(), OutputError> {
    write_whole(path, existing, |part| {
        write_file(part, outcome).map_err(|error| {
            let text = error.to_string();
            text.lines().next().unwrap_or_default().to_owned()
        })
    })
}

fn write_file(path: &Path, outcome: &Outcome) -> Result<(), hdf5::Error> {
    let file = File::create(path)?;
    write_attributes(&file, outcome)?;
    let series = &outcome.series;
    let columns = [
        &series.time_s,
        &series.force_n,
        &series.displacement_m,
        &series.velocity_m_s,
        &series.deflection_m,
    ];
    let mut time: Option<Dataset> = None;
    for (described, samples) in schema::SERIES.iter().zip(columns) {
        let dataset = vector(&file, described, samples)?;
        match &time {
            None => {
                set_scale(&dataset, described.0)?;
                time = Some(dataset);
            }
            Some(time) => attach_scale(&dataset, time, 0)?,
        }
    }
    if let (Some(fields), Some(time)) = (&outcome.fields, &time) {
        write_probes(&file, fields, time)?;
    }
    if let Some(map) = &outcome.map {
        map::write_map(&file, map)?;
    }
    file.flush()?;
    file.close()
}

fn write_probes(file: &File, fields: &Fields, time: &Dataset) -> Result<(), hdf5::Error> {
    let group = file.create_group(schema::PROBES)?;
    let [r, z] = &schema::PLACES;
    vector(&group, r, &fields.r_m)?;
    vector(&group, z, &fields.z_m)?;
    let arrivals: Vec<f64> = fields.arrival_s.iter().flatten().copied().collect();
    let rows = fields.r_m.len();
    matrix(&group, &schema::ARRIVALS, [rows, 3], &arrivals)?;
    for (i, described) in schema::FIELDS.iter().enumerate() {
        let (name, unit, meaning) = *described;
        let columns = fields.values[i].first().map_or(0, Vec::len);
        let samples: Vec<f64> = fields.values[i].iter().flatten().copied().collect();
        let dataset = matrix(&group, described, [rows, columns], &samples)?;
        attach_scale(&dataset, time, 1)?;
        let error = format!("{name}{}", schema::ERROR_SUFFIX);
        let meaning = format!("estimated absolute error: {meaning}");
        vector(&group, &(&error, unit, &meaning), &fields.errors[i])?;
    }
    Ok(())
}

fn write_attributes(file: &File, outcome: &Outcome) -> Result<(), hdf5::Error> {
    let choices = &outcome.choices;
    let (id, version) = match &outcome.table {
        Some((id, version)) => (id.as_str(), version.as_str()),
        None => ("", ""),
    };
    let warnings = outcome.warnings.join("\n");
    let texts = [
        schema::FILE_TYPE,
        schema::FORMAT_VERSION,
        env!("CARGO_PKG_VERSION"),
        choices.model,
        choices.scheme,
        choices.static_share,
        choices.deflection,
        &choices.reason,
        outcome.kernel,
        &outcome.kernel_reason,
        outcome.convolution,
        id,
        version,
        &warnings,
        &outcome.resolved_scene,
    ];
    for (name, value) in schema::TEXTS.into_iter().zip(texts) {
        text(file, name, value)?;
    }
    let r = &outcome.results;
    let numbers = [
        r.peak_force_n,
        r.peak_force_time_s,
        r.contact_time_s,
        r.rebound_velocity_m_s,
        r.restitution,
        r.peak_displacement_m,
        r.peak_deflection_m,
        r.impulse_n_s,
        r.initial_energy_j,
        r.radiated_energy_j,
        r.energy_residual,
        r.contacts as f64,
        outcome.relative_error_estimate,
        outcome.march_steps as f64,
        outcome.march_step_s,
        outcome.disc_radius_m,
    ];
    for (name, value) in schema::NUMBERS.into_iter().zip(numbers) {
        file.new_attr::<f64>().create(name)?.write_scalar(&value)?;
    }
    Ok(())
}
