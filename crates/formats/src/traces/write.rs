//! Writes the force behind traces: `data-schema/force.md`.

use super::{InferredForce, force_report};
use crate::hdf::{attach_scales, numbers, scalar, scale, stage, text, vector};
use crate::schema::force as schema;
use hdf5::File;
use inverse::LCurvePoint;
use output::{Output, OutputError, Staged};

/// Writes a force into an output that was claimed before the work; committing it gives the file its name.
pub fn stage_force<'a>(
    output: &'a Output,
    scene: &str,
    force: &InferredForce,
) -> Result<Staged<'a>, OutputError> {
    let kind = [schema::FILE_TYPE, schema::FORMAT_VERSION];
    stage(output, kind, |file| fill(file, scene, force))
}

fn fill(file: &File, scene: &str, force: &InferredForce) -> Result<(), hdf5::Error> {
    for (name, value) in [
        ("scene", scene),
        ("report", &force_report(force).to_string()),
    ] {
        text(file, name, value)?;
    }
    let (fit, history) = (&force.found.fit, &force.found.history);
    let start_s = force.blow_start_s();
    let values = [
        fit.peak_n.value,
        fit.peak_n.sd,
        fit.duration_s.value,
        fit.duration_s.sd,
        start_s.value,
        start_s.sd,
        fit.impulse_n_s.value,
        fit.impulse_n_s.sd,
        history.impulse_n_s.value,
        history.impulse_n_s.sd,
        history.variance_reduction,
        history.chi_squared,
        history.degrees_of_freedom,
        history.lambda,
    ];
    for (name, value) in schema::NUMBERS.into_iter().zip(values) {
        scalar(file, name, value)?;
    }
    let start_s = history.start_s + force.start_s;
    let times = |start_s: f64, step_s: f64, count: usize| -> Vec<f64> {
        (0..count).map(|i| start_s + i as f64 * step_s).collect()
    };
    let [time, own, low, high] = &schema::HISTORY;
    let time = scale(
        file,
        time,
        &times(start_s, history.step_s, history.force_n.len()),
    )?;
    let histories = [
        (own, &history.force_n),
        (low, &history.low_n),
        (high, &history.high_n),
    ];
    for (described, samples) in histories {
        attach_scales(&vector(file, described, samples)?, &[&time])?;
    }
    let group = file.create_group(schema::L_CURVE)?;
    let [lambda, residual, roughness] = &schema::L_CURVES;
    let column = |of: fn(&LCurvePoint) -> f64| history.l_curve.iter().map(of).collect::<Vec<f64>>();
    let lambda = scale(&group, lambda, &column(|own| own.lambda))?;
    attach_scales(
        &vector(&group, residual, &column(|own| own.residual))?,
        &[&lambda],
    )?;
    attach_scales(
        &vector(&group, roughness, &column(|own| own.roughness))?,
        &[&lambda],
    )?;
    let group = file.create_group(schema::TRACES)?;
    let predicted = &force.found.predicted;
    let numbered: Vec<i64> = (1..=predicted.len() as i64).collect();
    let sensor = scale(&group, &schema::SENSOR, &numbered)?;
    let count = predicted.first().map_or(0, Vec::len);
    let time = scale(
        &group,
        &schema::HISTORY[0],
        &times(force.start_s, force.step_s, count),
    )?;
    let shape = [predicted.len(), count];
    let dataset = numbers(&group, &schema::PREDICTED, &shape, &predicted.concat())?;
    attach_scales(&dataset, &[&sensor, &time])
}
