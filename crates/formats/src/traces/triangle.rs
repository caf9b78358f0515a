//! Responses of the sensors of a scene to a short triangle of force.

use super::TraceError;
use crate::error::SceneError;
use contact::Plasticity;
use impact::{
    ForceRecord, Impact, ImpactError, KernelChoice, Load, Measured, Scene, SensorHistory, simulate,
};

/// Samples of the simulation for each force step, at least: outputs between them are read off a polynomial.
const FINER: f64 = 4.0;

/// Radius of the disc that stands for a growing contact over the largest: the force has its middle there.
const MIDDLE: f64 = 0.87;

/// Part of the largest response from which on it shows.
const SHOWN: f64 = 0.02;

/// Responses on the force step.
pub(super) struct Responses(Vec<Response>);

/// Of one sensor.
pub(super) struct Response {
    /// Sample k is k force steps after the middle of the triangle.
    pub(super) samples: Vec<f64>,
    /// Force steps until it shows.
    pub(super) shown: usize,
    /// Time in s after which it has an echo that the scene does not; infinite where there is none.
    pub(super) echo_s: f64,
}

impl Responses {
    /// Of the sensors of a scene to a triangle of 1 N, one force step wide on either side, for so many force steps and as many as waves
    /// take to the last sensor. Velocities and accelerations without a response are means over a step of the traces.
    pub(super) fn of(
        scene: &Scene,
        (step_s, count): (f64, usize),
        trace_step_s: f64,
    ) -> Result<Self, TraceError> {
        let speeds = contact::WaveSpeeds::of(&scene.target).map_err(ImpactError::from)?;
        let reach = |sensor: &impact::Sensor| (sensor.r_m + sensor.face_radius_m).hypot(sensor.z_m);
        let farthest_m = scene.sensors.iter().map(reach).fold(0.0, f64::max);
        let lead = (farthest_m / speeds.p / step_s).ceil() as usize;
        let count = count + lead + 4;
        let triangle = ForceRecord::new(vec![0.0, step_s, 2.0 * step_s], vec![0.0, 1.0, 0.0]);
        let triangle = triangle.map_err(|error| SceneError::told(error.to_string()))?;
        let mut own = scene.clone();
        own.settings.disc_radius_m = Some(disc_m(scene)?);
        own.settings.plasticity = Plasticity::None;
        own.load = Load::Record(triangle);
        own.settings.step_s = Some(step_s / FINER);
        own.duration_s = Some(step_s * (count + 4) as f64 + trace_step_s);
        (own.probes, own.section, own.low_pass_hz) = (Vec::new(), None, None);
        let outcome = simulate(&own, &KernelChoice::Direct)?;
        let times_s = &outcome.series.time_s;
        let of = |history: &SensorHistory| {
            let sensor = &history.sensor;
            let is_rate = !matches!(
                sensor.measured,
                Measured::DisplacementR | Measured::DisplacementZ | Measured::StressZz
            );
            let width_s = match (is_rate, &sensor.response) {
                (true, None) => trace_step_s,
                (true, Some(_)) | (false, _) => 0.0,
            };
            let middle_s = |k: usize| step_s * (k + 1) as f64;
            let at = |k: usize| mean(times_s, &history.output, [middle_s(k), width_s]);
            let samples: Vec<f64> = (0..count).map(at).collect();
            let largest = samples.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
            let shown = samples.iter().position(|x| x.abs() > SHOWN * largest);
            Response {
                shown: shown.unwrap_or(0),
                echo_s: history.valid_until_s,
                samples,
            }
        };
        Ok(Self(outcome.sensors.iter().map(of).collect()))
    }

    /// Of a sensor.
    pub(super) fn of_sensor(&self, sensor: usize) -> &Response {
        &self.0[sensor]
    }

    /// Force steps that the first wave takes to the sensor that it reaches first: so long before a trace a blow may begin.
    pub(super) fn travel_steps(&self) -> usize {
        self.0.iter().map(|own| own.shown).min().unwrap_or(0)
    }
}

/// Radius of the loaded disc in m: that of the scene, or of a striker's contact.
fn disc_m(scene: &Scene) -> Result<f64, TraceError> {
    match (scene.settings.disc_radius_m, scene.strike()) {
        (Some(radius_m), _) => Ok(radius_m),
        (None, Some(strike)) => {
            let run = Impact::of(scene, strike)
                .solve()
                .map_err(ImpactError::Contact)?;
            Ok(MIDDLE * run.excitation().units().disc_radius_m)
        }
        (None, None) => {
            let hint = "a force without a striker requires the radius of the loaded disc";
            Err(SceneError::missing("contact.disc_radius_m", hint).into())
        }
    }
}

/// A history at a time, or its mean over a width around it, by parabolas through its samples.
fn mean(times_s: &[f64], samples: &[f64], [at_s, width_s]: [f64; 2]) -> f64 {
    /// Points of a mean.
    const POINTS: usize = 16;
    let value = |time_s: f64| {
        let after = times_s.partition_point(|t| *t < time_s);
        let first = after.saturating_sub(2).min(times_s.len() - 4);
        let node = |k: usize| times_s[first + k];
        let weights = (0..4).map(|k| {
            let others = (0..4).filter(|i| *i != k);
            let factors = others.map(|i| (time_s - node(i)) / (node(k) - node(i)));
            samples[first + k] * factors.product::<f64>()
        });
        weights.sum::<f64>()
    };
    if width_s == 0.0 {
        return value(at_s);
    }
    let part = |i: usize| (i as f64 + 0.5) / POINTS as f64 - 0.5;
    let all = (0..POINTS).map(|i| value(at_s + width_s * part(i)));
    all.sum::<f64>() / POINTS as f64
}
