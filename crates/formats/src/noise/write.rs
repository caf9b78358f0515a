//! Writes noise: `data-schema/noise.md`.

use super::{NoiseResults, NoiseSpec};
use crate::hdf::{attach_scales, numbers, scalar, scale, set_scale, stage, text, texts};
use crate::quantities::Labels;
use crate::schema::noise as schema;
use hdf5::File;
use noise::{Errors, Motion};
use output::{Output, OutputError, Staged};

/// Writes noise into an output that was claimed before the work; committing it gives the file its name.
pub fn stage_noise<'a>(
    output: &'a Output,
    spec: &NoiseSpec,
    results: &NoiseResults,
) -> Result<Staged<'a>, OutputError> {
    let kind = [schema::FILE_TYPE, schema::FORMAT_VERSION];
    stage(output, kind, |file| fill(file, spec, results))
}

/// Dimension of an array.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// Receivers.
    Receiver,
    /// Frequencies.
    Frequency,
    /// Distances at which shares are stated.
    Edge,
}

/// An array of results: name with unit and meaning, dimensions, numbers.
pub type Described = (Labels<'static>, Vec<Dimension>, Vec<f64>);

/// Parts of an error, and all of it first.
fn parts(errors: &Errors) -> [f64; 6] {
    let Errors {
        sampling,
        pulses,
        contact_size,
        response,
        quadrature,
    } = *errors;
    let total = errors.total();
    [total, sampling, pulses, contact_size, response, quadrature]
}

impl NoiseResults {
    /// Length of a dimension.
    pub fn length(&self, dimension: Dimension) -> usize {
        match dimension {
            Dimension::Receiver => self.noise.receivers.len(),
            Dimension::Frequency => self.spectra.frequency_hz.len(),
            Dimension::Edge => self.spectra.distance_m[0].len(),
        }
    }

    /// Places, spectra, errors and shares; the first is the frequency.
    pub fn arrays(&self) -> Vec<Described> {
        use Dimension::{Edge, Frequency, Receiver};
        let (noise, spectra) = (&self.noise, &self.spectra);
        let each = 0..noise.receivers.len();
        let mut found = vec![
            (
                schema::FREQUENCY,
                vec![Frequency],
                spectra.frequency_hz.clone(),
            ),
            (schema::FORCE, vec![Frequency], spectra.force_n2_s2.clone()),
            (
                schema::DISTANCE,
                vec![Receiver, Edge],
                spectra.distance_m.concat(),
            ),
        ];
        let shares = each
            .clone()
            .flat_map(|i| spectra.share(i).flatten().copied());
        let all = vec![Receiver, Frequency, Edge];
        found.push((schema::SHARE, all, shares.collect()));
        for (axis, described) in schema::PLACES.into_iter().enumerate() {
            let place = |one: &noise::Receiver| match axis {
                2 => one.depth_m,
                axis => one.place_m[axis],
            };
            let places = noise.receivers.iter().map(place);
            found.push((described, vec![Receiver], places.collect()));
        }
        let motions = [Motion::Vertical, Motion::Horizontal].into_iter();
        let motions = motions.flat_map(|motion| (0..3).map(move |rate| (motion, rate)));
        for (described, (motion, rate)) in schema::POWERS.into_iter().zip(motions) {
            let rows = each.clone().flat_map(|i| spectra.power(i, motion, rate));
            found.push((described, vec![Receiver, Frequency], rows.collect()));
        }
        for (place, described) in schema::ERRORS.into_iter().enumerate() {
            let rows = each.clone().flat_map(|i| spectra.errors(i));
            let rows = rows.map(|errors| parts(errors)[place]);
            found.push((described, vec![Receiver, Frequency], rows.collect()));
        }
        found
    }
}

fn fill(file: &File, spec: &NoiseSpec, results: &NoiseResults) -> Result<(), hdf5::Error> {
    let NoiseResults {
        noise,
        spectra,
        traces,
    } = results;
    for (name, value) in [("noise", &spec.text), ("noise_sha256", &spec.sha256)] {
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
    let edges: Vec<i64> = (0..results.length(Dimension::Edge) as i64).collect();
    let edge = scale(file, &schema::EDGE, &edges)?;
    let frequency = scale(file, &schema::FREQUENCY, &spectra.frequency_hz)?;
    let scale_of = |dimension: &Dimension| match dimension {
        Dimension::Receiver => &receiver,
        Dimension::Frequency => &frequency,
        Dimension::Edge => &edge,
    };
    for (described, dimensions, values) in results.arrays().iter().skip(1) {
        let shape: Vec<usize> = dimensions.iter().map(|one| results.length(*one)).collect();
        let dataset = numbers(file, described, &shape, values)?;
        attach_scales(
            &dataset,
            &dimensions.iter().map(scale_of).collect::<Vec<_>>(),
        )?;
    }
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
