//! The results file: HDF5, as `data-schema/results.md` writes it down.
//!
//! Every name on disk is a constant of [`schema`]. The file is written beside its final name and
//! renamed when it is complete.

use crate::simulate::{Fields, Outcome};
use hdf5::{Dataset, File, Group};
use lookup::labels::{attach_scale, set_scale, text};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Names and versions on disk.
pub mod schema {
    /// Value of the attribute `file_type`.
    pub const FILE_TYPE: &str = "hertzlamb results";
    /// Version of the format: the first number changes when a reader of the old one would fail.
    pub const FORMAT_VERSION: &str = "1.0";
    /// Datasets in the root, with unit and description.
    pub const SERIES: [(&str, &str, &str); 5] = [
        ("time", "s", "time since the first touch"),
        ("force", "N", "contact force, positive in compression"),
        (
            "displacement",
            "m",
            "displacement of the striker, positive into the half-space",
        ),
        (
            "velocity",
            "m/s",
            "velocity of the striker, positive into the half-space",
        ),
        (
            "deflection",
            "m",
            "deflection of the half-space in the contact law, positive inwards",
        ),
    ];
    /// Group of the probes.
    pub const PROBES: &str = "probes";
    /// Coordinates of the probes.
    pub const PLACES: [(&str, &str, &str); 2] = [
        ("r", "m", "distance from the axis"),
        ("z", "m", "depth below the surface"),
    ];
    /// Fields at the probes, in the order of the kernels.
    pub const FIELDS: [(&str, &str, &str); 6] = [
        (
            "displacement_r",
            "m",
            "radial displacement, positive outwards",
        ),
        (
            "displacement_z",
            "m",
            "axial displacement, positive into the half-space",
        ),
        ("stress_rr", "Pa", "radial stress, negative in compression"),
        ("stress_tt", "Pa", "hoop stress, negative in compression"),
        ("stress_zz", "Pa", "axial stress, negative in compression"),
        ("stress_rz", "Pa", "shear stress"),
    ];
    /// Appended to the name of a field: the estimate of its error.
    pub const ERROR_SUFFIX: &str = "_error";
    /// Arrivals of the first P, S and Rayleigh wave.
    pub const ARRIVALS: (&str, &str, &str) = (
        "arrival",
        "s",
        "time after the first touch at which the first P, S and Rayleigh wave arrive",
    );
    /// Text attributes of the root.
    pub const TEXTS: [&str; 13] = [
        "file_type",
        "format_version",
        "software_version",
        "model",
        "scheme",
        "static_share",
        "deflection_of",
        "reason",
        "kernel",
        "table_id",
        "table_format_version",
        "warnings",
        "scene",
    ];
    /// Number attributes of the root.
    pub const NUMBERS: [&str; 16] = [
        "peak_force_n",
        "peak_force_time_s",
        "contact_time_s",
        "rebound_velocity_m_s",
        "restitution",
        "peak_displacement_m",
        "peak_deflection_m",
        "impulse_n_s",
        "initial_energy_j",
        "radiated_energy_j",
        "energy_residual",
        "contacts",
        "relative_error_estimate",
        "march_steps",
        "march_step_s",
        "disc_radius_m",
    ];
}

/// A results file that could not be written.
#[derive(Debug, Error)]
pub enum OutputError {
    /// The file exists and may not be replaced.
    #[error("{} exists already; give --force to replace it", path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// The place cannot be written to.
    #[error("cannot write {}: {reason}", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// The system's or the HDF5 library's reason.
        reason: String,
    },
}

/// What to do with an existing file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Existing {
    /// Keep it and report it.
    Keep,
    /// Replace it once the new one is complete.
    Replace,
}

/// Checks, before any work, that a file can be written.
///
/// # Errors
/// [`OutputError`] when it exists and is kept, or when its folder cannot take it.
pub fn check(path: &Path, existing: Existing) -> Result<(), OutputError> {
    let fault = |reason: &str| OutputError::Unwritable {
        path: path.to_owned(),
        reason: reason.to_owned(),
    };
    if path.is_dir() {
        return Err(fault("it is a folder"));
    }
    if path.exists() && existing == Existing::Keep {
        return Err(OutputError::Exists {
            path: path.to_owned(),
        });
    }
    let folder = folder(path);
    if path.file_name().is_none() {
        return Err(fault("it has no file name"));
    }
    if !folder.is_dir() {
        return Err(fault(&format!(
            "the folder {} does not exist",
            folder.display()
        )));
    }
    let part = part(path);
    std::fs::File::create(&part).map_err(|error| fault(&error.to_string()))?;
    let _ = std::fs::remove_file(&part);
    Ok(())
}

/// Writes a file through a closure that is given a name beside the final one.
///
/// # Errors
/// [`OutputError`]; nothing is left under either name unless it was there before.
pub fn write_whole(
    path: &Path,
    existing: Existing,
    write: impl FnOnce(&Path) -> Result<(), String>,
) -> Result<(), OutputError> {
    check(path, existing)?;
    let part = part(path);
    let done =
        write(&part).and_then(|()| std::fs::rename(&part, path).map_err(|error| error.to_string()));
    done.map_err(|reason| {
        let _ = std::fs::remove_file(&part);
        OutputError::Unwritable {
            path: path.to_owned(),
            reason,
        }
    })
}

fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        Some(_) | None => Path::new("."),
    }
}

fn part(path: &Path) -> PathBuf {
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned());
    folder(path).join(format!(
        ".{}.{}.part",
        name.unwrap_or_default(),
        std::process::id()
    ))
}

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

fn vector(
    group: &Group,
    described: &(&str, &str, &str),
    samples: &[f64],
) -> Result<Dataset, hdf5::Error> {
    let dataset = group
        .new_dataset::<f64>()
        .shape([samples.len()])
        .obj_track_times(false)
        .create(described.0)?;
    dataset.write_raw(samples)?;
    describe(&dataset, described)?;
    Ok(dataset)
}

fn matrix(
    group: &Group,
    described: &(&str, &str, &str),
    shape: [usize; 2],
    samples: &[f64],
) -> Result<Dataset, hdf5::Error> {
    let dataset = group
        .new_dataset::<f64>()
        .shape(shape)
        .obj_track_times(false)
        .create(described.0)?;
    dataset.write_raw(samples)?;
    describe(&dataset, described)?;
    Ok(dataset)
}

fn describe(dataset: &Dataset, described: &(&str, &str, &str)) -> Result<(), hdf5::Error> {
    text(dataset, "units", described.1)?;
    text(dataset, "long_name", described.2)
}
