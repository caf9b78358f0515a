//! The sensors in a results file: `/sensors`.

use super::section::waves;
use crate::hdf::{attach_scales, numbers, scale, texts, vector};
use crate::schema::results as schema;
use contact::Choice;
use hdf5::File;
use impact::SensorHistory;

pub(super) fn write_sensors(
    file: &File,
    sensors: &[SensorHistory],
    time_s: &[f64],
) -> Result<(), hdf5::Error> {
    let group = file.create_group(schema::SENSORS)?;
    let rows = sensors.len();
    let numbered: Vec<i64> = (1..=rows as i64).collect();
    let sensor = scale(&group, &schema::SENSOR, &numbered)?;
    let time = scale(&group, &schema::SERIES[0], time_s)?;
    let wave = waves(&group)?;
    let faces: [fn(&SensorHistory) -> f64; 3] = [
        |own| own.sensor.r_m,
        |own| own.sensor.z_m,
        |own| own.sensor.face_radius_m,
    ];
    for (described, of) in schema::FACES.iter().zip(faces) {
        let column: Vec<f64> = sensors.iter().map(of).collect();
        attach_scales(&vector(&group, described, &column)?, &[&sensor])?;
    }
    let words: [fn(&SensorHistory) -> String; 4] = [
        |own| own.sensor.measured.name().to_owned(),
        |own| own.sensor.measured.unit().to_owned(),
        |own| own.sensor.output_unit().to_owned(),
        |own| own.face.name().to_owned(),
    ];
    for (described, of) in schema::SENSED.iter().zip(words) {
        let column: Vec<String> = sensors.iter().map(of).collect();
        attach_scales(&texts(&group, described, &column)?, &[&sensor])?;
    }
    let arrivals: Vec<f64> = sensors.iter().flat_map(|own| own.arrival_s).collect();
    let dataset = numbers(&group, &schema::ARRIVALS, &[rows, 3], &arrivals)?;
    attach_scales(&dataset, &[&sensor, &wave])?;
    let valid: Vec<f64> = sensors.iter().map(|own| own.valid_until_s).collect();
    attach_scales(&vector(&group, &schema::VALID_UNTIL, &valid)?, &[&sensor])?;
    let [mean, mean_error, output, output_error] = &schema::OUTPUTS;
    let errors: Vec<f64> = sensors.iter().map(|own| own.mean.error).collect();
    attach_scales(&vector(&group, mean_error, &errors)?, &[&sensor])?;
    let histories: [fn(&SensorHistory) -> &[f64]; 3] = [
        |own| &own.mean.samples,
        |own| &own.output,
        |own| &own.output_error,
    ];
    for (described, of) in [mean, output, output_error].into_iter().zip(histories) {
        let all: Vec<f64> = sensors
            .iter()
            .flat_map(|own| of(own).iter().copied())
            .collect();
        let dataset = numbers(&group, described, &[rows, time_s.len()], &all)?;
        attach_scales(&dataset, &[&sensor, &time])?;
    }
    Ok(())
}
