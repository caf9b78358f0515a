//! Histories that sensors measure: means over their faces, and the outputs of their responses.

use crate::convolution::mean::FaceAt;
use crate::convolution::{Convolution, Trace};
use crate::error::ImpactError;
use crate::face::MeanPlan;
use crate::response::{Response, ResponseError};
use crate::scene::{Scene, Sensor};
use rayon::prelude::*;

/// The histories of a sensor in SI units, at the times of the output.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorHistory {
    /// The sensor.
    pub sensor: Sensor,
    /// Times of the first P, S and Rayleigh arrival at the nearest point of its face in s; infinite for a Rayleigh wave where there
    /// is none.
    pub arrival_s: [f64; 3],
    /// When the first echo from the faces of the block arrives, in s; infinite where no face is known.
    pub valid_until_s: f64,
    /// How the mean over its face was computed.
    pub face: FaceMean,
    /// Mean of the measured quantity over the face, and its estimated error.
    pub mean: Trace,
    /// Output of the response; the mean itself without one.
    pub output: Vec<f64>,
    /// Estimated error of each sample of it; zero before the first arrival, unless the output has a low pass.
    pub output_error: Vec<f64>,
}

/// How the mean over a face was computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FaceMean {
    /// The face is a point.
    Point,
    /// So many larger discs stand for the load and the face.
    Discs(usize),
    /// The fields on so many circles were averaged.
    Circles(usize),
    /// The kernels were averaged.
    Kernels,
}

impl FaceMean {
    /// Its name in files and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Discs(_) => "discs",
            Self::Circles(_) => "circles",
            Self::Kernels => "kernels",
        }
    }
}

/// The histories of a scene's sensors by a convolution that has the rates they measure.
pub(crate) fn at_sensors(
    convolution: &Convolution<'_>,
    scene: &Scene,
    (plans, watch): (&[MeanPlan], &(dyn Fn() + Sync)),
) -> Result<Vec<SensorHistory>, ImpactError> {
    let times_s = convolution.times_s();
    let of = |(sensor, plan): (&Sensor, &MeanPlan)| {
        let found = history(convolution, scene, (sensor, plan), &times_s)?;
        watch();
        Ok(found)
    };
    scene.sensors.par_iter().zip(plans).map(of).collect()
}

fn history(
    convolution: &Convolution<'_>,
    scene: &Scene,
    (sensor, plan): (&Sensor, &MeanPlan),
    times_s: &[f64],
) -> Result<SensorHistory, ImpactError> {
    let face = FaceAt {
        r_m: sensor.r_m,
        z_m: sensor.z_m,
        radius_m: sensor.face_radius_m,
    };
    let mut means = convolution.mean(face, plan)?;
    let mean = means.swap_remove(sensor.measured.index(convolution.quantities));
    let excitation = convolution.grid.excitation;
    let (speeds, radius_m) = (excitation.speeds(), excitation.units().disc_radius_m);
    let arrival_s = excitation.arrivals_s(sensor.nearest_m());
    let reach_m = radius_m + sensor.face_radius_m;
    let echo_s = speeds.first_echo_s(&scene.target, [sensor.r_m, sensor.z_m], reach_m);
    // a low pass without delay sees the arrival before
    let is_still = |time_s: f64| convolution.grid.low_pass_hz.is_none() && time_s < arrival_s[0];
    let error = |time_s: &f64| match is_still(*time_s) {
        true => 0.0,
        false => mean.error,
    };
    let errors: Vec<f64> = times_s.iter().map(error).collect();
    let (output, output_error) = match &sensor.response {
        None => (mean.samples.clone(), errors),
        Some(own) => {
            let step_s = convolution.grid.step_s;
            let found = through(&own.response, step_s, times_s, (&mean.samples, &errors));
            found.map_err(ImpactError::Response)?
        }
    };
    Ok(SensorHistory {
        arrival_s,
        valid_until_s: echo_s.map_or(f64::INFINITY, |t| excitation.start_s() + t),
        face: match plan {
            MeanPlan::Point => FaceMean::Point,
            MeanPlan::Discs(discs) => FaceMean::Discs(discs.shares.len()),
            MeanPlan::Circles(count, _) => FaceMean::Circles(*count),
            MeanPlan::Exact => FaceMean::Kernels,
        },
        output,
        output_error,
        mean,
        sensor: sensor.clone(),
    })
}

/// The output of a response and its error, of samples and their errors at times that are multiples of a step from the first: between
/// runs of samples a history is constant.
fn through(
    response: &Response,
    step_s: f64,
    times_s: &[f64],
    (samples, errors): (&[f64], &[f64]),
) -> Result<(Vec<f64>, Vec<f64>), ResponseError> {
    let start_s = times_s.first().copied().unwrap_or(0.0);
    let place = |time_s: &f64| ((time_s - start_s) / step_s).round() as usize;
    let places: Vec<usize> = times_s.iter().map(place).collect();
    let mut all = Vec::new();
    for (place, sample) in places.iter().zip(samples) {
        let last = all.last().copied().unwrap_or(0.0);
        all.resize((*place).max(all.len()), last);
        all.push(*sample);
    }
    let found = response.apply(step_s, &all)?;
    let error = |(place, own): (&usize, &f64)| match *own > 0.0 {
        true => found.error[*place] + found.largest_gain * own,
        false => 0.0,
    };
    let output = places.iter().map(|place| found.samples[*place]).collect();
    Ok((output, places.iter().zip(errors).map(error).collect()))
}

/// A warning about the part of a sensor's mean at frequencies at which its response is not known.
pub(crate) fn outside(histories: &[SensorHistory], step_s: f64) -> Vec<String> {
    /// Fraction of the energy from which on it is reported.
    const COUNTS: f64 = 1e-4;
    let of = |(i, own): (usize, &SensorHistory)| {
        let response = &own.sensor.response.as_ref()?.response;
        let part = response.outside(step_s, &own.mean.samples).ok()?;
        let [low_hz, high_hz] = response.limits_hz();
        (part > COUNTS).then(|| {
            format!(
                "{:.2} % of the energy of the input of sensor {i} lies outside its response, which is known from {low_hz:.3e} to {high_hz:.3e} Hz: the output leaves it out",
                100.0 * part
            )
        })
    };
    (1..).zip(histories).filter_map(of).collect()
}
