//! Histories that sensors measure: means over their faces, and the outputs of their responses.

use crate::convolution::mean::FaceAt;
use crate::convolution::{Convolution, Trace};
use crate::error::ImpactError;
use crate::face::MeanPlan;
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
    /// Estimated error of each sample of it; zero before the first arrival.
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
    let error = |time_s: &f64| match *time_s < arrival_s[0] {
        true => 0.0,
        false => mean.error,
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
        output: mean.samples.clone(),
        output_error: times_s.iter().map(error).collect(),
        mean,
        sensor: sensor.clone(),
    })
}
