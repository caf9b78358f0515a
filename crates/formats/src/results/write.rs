//! Writes results files, and their histories as text: one table of all quantities over time.

use super::identity::scene_sha256;
use super::section::{beside, waves, write_section};
use super::sensors::write_sensors;
use crate::hdf::{
    attach_scales, numbers, scalar, scale, set_scale, stage, text, texts as words, vector,
};
use crate::quantities::QUANTITIES;
use crate::report::{choices, kernel_name, treatment};
use crate::scene::resolved;
use crate::schema::results as schema;
use contact::Choice;
use hdf5::{Dataset, File};
use impact::{EchoArrivals, EnergySeries, Outcome, ProbeFields, Scene};
use output::{Existing, Output, OutputError, Staged};
use std::io::{BufWriter, Write};
use std::path::Path;

/// Writes the results of a scene.
pub fn write_results(
    path: &Path,
    scene: &Scene,
    outcome: &Outcome,
    existing: Existing,
) -> Result<(), OutputError> {
    let output = Output::claim(path, existing)?;
    stage_results(&output, scene, outcome)?.commit()
}

/// Writes into an output that was claimed before the work; committing it gives the file its name.
pub fn stage_results<'a>(
    output: &'a Output,
    scene: &Scene,
    outcome: &Outcome,
) -> Result<Staged<'a>, OutputError> {
    let kind = [schema::FILE_TYPE, schema::FORMAT_VERSION];
    stage(output, kind, |file| fill(file, scene, outcome))
}

fn fill(file: &File, scene: &Scene, outcome: &Outcome) -> Result<(), hdf5::Error> {
    write_attributes(file, scene, outcome)?;
    let series = &outcome.series;
    let time = scale(file, &schema::SERIES[0], &series.time_s)?;
    for (described, samples) in schema::samples(series).skip(1) {
        let dataset = vector(file, described, samples)?;
        if described.0 == schema::FORCE {
            for (name, value) in treatment(scene) {
                value.map_or(Ok(()), |value| scalar(&dataset, name, value))?;
            }
        }
        attach_scales(&dataset, &[&time])?;
    }
    if let Some(energy) = &series.energy {
        write_energy(file, energy, &series.time_s)?;
    }
    if let Some(fields) = &outcome.probes {
        write_probes(file, fields, &series.time_s)?;
    }
    if !outcome.sensors.is_empty() {
        write_sensors(file, &outcome.sensors, &series.time_s)?;
    }
    if let Some(section) = &outcome.section {
        write_section(file, section)?;
    }
    Ok(())
}

fn write_energy(file: &File, energy: &EnergySeries, time_s: &[f64]) -> Result<(), hdf5::Error> {
    let group = file.create_group(schema::ENERGY)?;
    let time = scale(&group, &schema::SERIES[0], time_s)?;
    for (described, samples) in schema::energies(energy) {
        attach_scales(&vector(&group, described, samples)?, &[&time])?;
    }
    Ok(())
}

fn write_probes(file: &File, fields: &ProbeFields, time_s: &[f64]) -> Result<(), hdf5::Error> {
    let group = file.create_group(schema::PROBES)?;
    let rows = fields.r_m.len();
    let numbered: Vec<i64> = (1..=rows as i64).collect();
    // a group may be opened on its own, so it has its own scales
    let probe = scale(&group, &schema::PROBE, &numbered)?;
    let time = scale(&group, &schema::SERIES[0], time_s)?;
    let wave = waves(&group)?;
    let [r, z] = &schema::PLACES;
    for (described, places) in [(r, &fields.r_m), (z, &fields.z_m)] {
        attach_scales(&vector(&group, described, places)?, &[&probe])?;
    }
    let placed = |dataset: &Dataset, scales: &[&Dataset]| {
        attach_scales(dataset, scales)?;
        text(dataset, schema::COORDINATES, &format!("{} {}", r.0, z.0))
    };
    let arrivals: Vec<f64> = fields.arrival_s.iter().flatten().copied().collect();
    let dataset = numbers(&group, &schema::ARRIVALS, &[rows, 3], &arrivals)?;
    placed(&dataset, &[&probe, &wave])?;
    let valid = vector(&group, &schema::VALID_UNTIL, &fields.valid_until_s)?;
    placed(&valid, &[&probe])?;
    let EchoArrivals {
        names,
        time_s: arrivals_s,
    } = &fields.echoes;
    if !names.is_empty() {
        let echo = words(&group, &schema::ECHO, names)?;
        set_scale(&echo, schema::ECHO.0)?;
        let shape = [rows, names.len()];
        let dataset = numbers(&group, &schema::ECHO_ARRIVALS, &shape, &arrivals_s.concat())?;
        placed(&dataset, &[&probe, &echo])?;
    }
    for (i, (row, values, errors)) in schema::histories(fields).enumerate() {
        let columns = values.first().map_or(0, Vec::len);
        let samples: Vec<f64> = values.iter().flatten().copied().collect();
        let dataset = numbers(&group, &row, &[rows, columns], &samples)?;
        placed(&dataset, &[&probe, &time])?;
        let peaks = fields.peaks.as_ref().map(|peaks| &peaks[i]);
        for (row, numbers) in beside(row, errors, peaks) {
            placed(&vector(&group, &row.labels(), numbers)?, &[&probe])?;
        }
    }
    Ok(())
}

fn write_attributes(file: &File, scene: &Scene, outcome: &Outcome) -> Result<(), hdf5::Error> {
    for (name, value) in texts(scene, outcome) {
        text(file, name, value)?;
    }
    text(file, schema::WARNINGS, &outcome.warnings.join("\n"))?;
    if let Some(cutoff_hz) = scene.low_pass_hz {
        scalar(file, schema::LOW_PASS, cutoff_hz)?;
    }
    text(file, schema::SCENE, &resolved(scene))?;
    text(file, schema::SCENE_SHA256, &scene_sha256(scene))?;
    for quantity in &QUANTITIES {
        if let Some(value) = quantity.of(outcome) {
            scalar(file, quantity.name, value)?;
        }
    }
    Ok(())
}

/// Writes the time series and the traces of the probes into a claimed output, one line per sample.
///
/// Lines that begin with `#` contain the positions of the probes. The next line has the names of the columns with their
/// units, such as `time_s`, `force_n` and `probe1_stress_zz_pa`.
pub fn stage_results_csv<'a>(
    output: &'a Output,
    scene: &Scene,
    outcome: &Outcome,
) -> Result<Staged<'a>, OutputError> {
    output.stage(|file| {
        let mut file = BufWriter::new(file);
        for (i, probe) in (1..).zip(&scene.probes) {
            let (r_m, z_m) = (probe.r_m, probe.z_m);
            writeln!(file, "# probe{i}: r = {r_m} m, z = {z_m} m")?;
        }
        for (i, sensor) in (1..).zip(&scene.sensors) {
            let (r_m, z_m, face_m) = (sensor.r_m, sensor.z_m, sensor.face_radius_m);
            let words = [sensor.measured.name(), sensor.output_unit()];
            writeln!(
                file,
                "# sensor{i}: r = {r_m} m, z = {z_m} m, face radius {face_m} m, {}, output in {}",
                words[0], words[1]
            )?;
        }
        write_columns(&mut file, &columns(outcome))?;
        file.flush()
    })
}

/// Writes columns of one length as text: their names, then a line for each sample.
pub(crate) fn write_columns(
    file: &mut impl Write,
    columns: &[(String, &[f64])],
) -> std::io::Result<()> {
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    writeln!(file, "{}", names.join(","))?;
    let count = columns.first().map_or(0, |(_, samples)| samples.len());
    for i in 0..count {
        for (k, (_, samples)) in columns.iter().enumerate() {
            let comma = if k == 0 { "" } else { "," };
            write!(file, "{comma}{:?}", samples[i])?;
        }
        writeln!(file)?;
    }
    Ok(())
}

/// Column names, which end with the unit, and samples.
fn columns(outcome: &Outcome) -> Vec<(String, &[f64])> {
    let series = schema::samples(&outcome.series);
    let mut found: Vec<_> = series
        .map(|((name, unit, _), samples)| (format!("{name}{}", ending(unit)), samples))
        .collect();
    for ((name, unit, _), values, _) in outcome.probes.iter().flat_map(schema::histories) {
        found.extend((1..).zip(values).map(|(probe, samples)| {
            let name = format!("probe{probe}_{name}{}", ending(unit));
            (name, samples.as_slice())
        }));
    }
    for (i, sensor) in (1..).zip(&outcome.sensors) {
        found.push((format!("sensor{i}_output"), &sensor.output));
    }
    found
}

/// Suffix of a name for a unit: `m/s` becomes `_m_s`.
pub(crate) fn ending(unit: &str) -> String {
    if unit == "1" {
        return String::new();
    }
    format!(
        "_{}",
        unit.to_lowercase().replace('/', "_").replace('^', "")
    )
}

/// Text attributes of the root that identify the file and the method of the scene: its [`choices`], its kernel, and the
/// source of the kernel.
fn texts<'a>(scene: &Scene, outcome: &'a Outcome) -> [(&'static str, &'a str); 10] {
    let [model, scheme, static_share, deflection, reason] = choices(scene, outcome);
    let used = outcome.used.as_ref();
    let table = used.and_then(|used| used.table.as_ref());
    let [id, version] = table.map_or(["", ""], |table| table.each_ref().map(String::as_str));
    [
        ("model", model),
        ("scheme", scheme),
        ("static_share", static_share),
        ("deflection_of", deflection),
        ("reason", reason),
        ("kernel", kernel_name(outcome)),
        ("kernel_reason", used.map_or("", |used| &used.reason)),
        (
            "convolution",
            used.map_or("", |used| used.convolution.name()),
        ),
        ("table_id", id),
        ("table_format_version", version),
    ]
}
