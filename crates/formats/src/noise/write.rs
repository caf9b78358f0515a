//! Writes noise: `data-schema/noise.md`.

use super::{NoiseResults, NoiseSpec};
use crate::hdf::{
    attach_scales, new_file, numbers, reason, scalar, scale, set_scale, text, texts, vector,
};
use crate::schema::noise as schema;
use hdf5::File;
use noise::{Errors, Motion};
use output::{Output, OutputError, OutputFault, Staged};

/// Writes noise into an output that was claimed before the work; committing it gives the file its name.
pub fn stage_noise<'a>(
    output: &'a Output,
    spec: &NoiseSpec,
    results: &NoiseResults,
) -> Result<Staged<'a>, OutputError> {
    output.stage_made(|name| {
        new_file(name, |file, _| {
            fill(file, spec, results).map_err(|error| OutputFault::from(reason(&error)))
        })
    })
}

/// Parts of an error, and all of it first.
fn parts(errors: &Errors) -> [f64; 6] {
    let Errors {
        sampling,
        pulses,
        contact_size,
        response,
        quadrature,
    } = *errors;
    [
        errors.total(),
        sampling,
        pulses,
        contact_size,
        response,
        quadrature,
    ]
}

fn fill(file: &File, spec: &NoiseSpec, results: &NoiseResults) -> Result<(), hdf5::Error> {
    let NoiseResults {
        noise,
        spectra,
        traces,
    } = results;
    for (name, value) in [
        ("file_type", schema::FILE_TYPE),
        ("format_version", schema::FORMAT_VERSION),
        ("software_version", env!("CARGO_PKG_VERSION")),
        ("noise", &spec.text),
        ("noise_sha256", &spec.sha256),
    ] {
        text(file, name, value)?;
    }
    let counts = [noise.blows.len(), noise.pulses.solved()].map(|count| count as f64);
    let values = [noise.rate_per_s(), noise.radiated_w(), counts[0], counts[1]];
    for (name, value) in schema::NUMBERS.into_iter().zip(values) {
        scalar(file, name, value)?;
    }
    let count = noise.receivers.len();
    let names: Vec<String> = noise.receivers.iter().map(|one| one.name.clone()).collect();
    let receiver = texts(file, &schema::RECEIVERS, &names)?;
    set_scale(&receiver, schema::RECEIVERS.0)?;
    for (axis, described) in schema::PLACES.iter().enumerate() {
        let place = |i: usize| match axis {
            2 => noise.receivers[i].depth_m,
            axis => noise.receivers[i].place_m[axis],
        };
        let places: Vec<f64> = (0..count).map(place).collect();
        attach_scales(&vector(file, described, &places)?, &[&receiver])?;
    }
    let frequency = scale(file, &schema::FREQUENCY, &spectra.frequency_hz)?;
    attach_scales(
        &vector(file, &schema::FORCE, &spectra.force_n2_s2)?,
        &[&frequency],
    )?;
    let shape = [count, spectra.frequency_hz.len()];
    let motions = [Motion::Vertical, Motion::Horizontal].into_iter();
    let motions = motions.flat_map(|motion| (0..3).map(move |derivatives| (motion, derivatives)));
    for (described, (motion, derivatives)) in schema::POWERS.iter().zip(motions) {
        let rows = (0..count).flat_map(|i| spectra.power(i, motion, derivatives));
        let dataset = numbers(file, described, &shape, &rows.collect::<Vec<f64>>())?;
        attach_scales(&dataset, &[&receiver, &frequency])?;
    }
    for (place, described) in schema::ERRORS.iter().enumerate() {
        let rows =
            (0..count).flat_map(|i| spectra.errors(i).map(move |errors| parts(errors)[place]));
        let dataset = numbers(file, described, &shape, &rows.collect::<Vec<f64>>())?;
        attach_scales(&dataset, &[&receiver, &frequency])?;
    }
    let edges = spectra.distance_m[0].len();
    let edge = scale(
        file,
        &schema::EDGE,
        &(0..edges as i64).collect::<Vec<i64>>(),
    )?;
    let distances = numbers(
        file,
        &schema::DISTANCE,
        &[count, edges],
        &spectra.distance_m.concat(),
    )?;
    attach_scales(&distances, &[&receiver, &edge])?;
    let shares = (0..count).flat_map(|i| spectra.share(i).flatten().copied());
    let shares = shares.collect::<Vec<f64>>();
    let dataset = numbers(file, &schema::SHARE, &[shape[0], shape[1], edges], &shares)?;
    attach_scales(&dataset, &[&receiver, &frequency, &edge])?;
    if let (Some(traces), Some(recording)) = (traces, spec.recording) {
        let group = file.create_group(schema::TRACES)?;
        let samples = traces.len() / count;
        let times = (0..samples).map(|i| i as f64 * recording.step_s);
        let time = scale(&group, &schema::TIME, &times.collect::<Vec<f64>>())?;
        let dataset = numbers(&group, &schema::VELOCITY, &[count, samples], traces)?;
        attach_scales(&dataset, &[&receiver, &time])?;
    }
    Ok(())
}
