//! Responses of the sensors of a scene to a short triangle of force.

use super::TraceError;
use crate::error::SceneError;
use contact::Plasticity;
use impact::{
    ForceRecord, Impact, ImpactError, KernelChoice, Load, Measured, Scene, Sensor, SensorHistory,
    simulate,
};
use inverse::Pulse;

/// Samples of the simulation for each force step, at least: outputs between them are read off a polynomial.
const FINER: f64 = 16.0;

/// Radius of the disc that stands for a growing contact over the largest: the force has its middle there.
const MIDDLE: f64 = 0.87;

/// Responses on the force step.
pub(super) struct Responses(Vec<Response>);

/// Of one sensor.
pub(super) struct Response {
    /// Sample k is k force steps after the middle of the triangle.
    pub(super) samples: Vec<f64>,
    /// Force steps from the middle of the triangle until the first wave arrives.
    pub(super) arrival: usize,
    /// Time in s after which it has an echo that the scene does not; infinite where there is none.
    pub(super) echo_s: f64,
}

impl Responses {
    /// Of the sensors of a scene to a triangle of 1 N, one force step wide on either side, for so many force steps and as many as waves
    /// take to the last sensor.
    pub(super) fn of(scene: &Scene, (step_s, count): (f64, usize)) -> Result<Self, TraceError> {
        let speeds = contact::WaveSpeeds::of(&scene.target).map_err(ImpactError::from)?;
        let reach = |sensor: &Sensor| (sensor.r_m + sensor.face_radius_m).hypot(sensor.z_m);
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
        own.duration_s = Some(step_s * (count + 4) as f64);
        (own.probes, own.section, own.low_pass_hz) = (Vec::new(), None, None);
        for sensor in &mut own.sensors {
            sensor.response = None;
            sensor.measured = integrated(sensor.measured).0;
        }
        let outcome = simulate(&own, &KernelChoice::Direct)?;
        let times_s = &outcome.series.time_s;
        let of = |(history, sensor): (&SensorHistory, &Sensor)| {
            let output = outputs(times_s, &history.mean.samples, sensor)?;
            let at = |k: usize| read(times_s, &output, step_s * (k + 1) as f64);
            let samples: Vec<f64> = (0..count).map(at).collect();
            Ok(Response {
                arrival: (history.arrival_s[0] / step_s) as usize,
                echo_s: history.valid_until_s,
                samples,
            })
        };
        let all = outcome.sensors.iter().zip(&scene.sensors);
        all.map(of).collect::<Result<_, TraceError>>().map(Self)
    }

    /// When the trace of a sensor is largest, in force steps after a pulse begins that lasts so many.
    pub(super) fn largest(&self, sensor: usize, pulse: &Pulse, duration: usize) -> usize {
        let own = &self.0[sensor].samples;
        let force: Vec<f64> = (0..=duration)
            .map(|k| pulse.at(k as f64 / duration as f64)[0])
            .collect();
        let at = |n: usize| -> f64 {
            let terms = force.iter().enumerate().take(n + 1);
            terms
                .map(|(k, force)| force * own[n - k])
                .sum::<f64>()
                .abs()
        };
        let all: Vec<f64> = (0..own.len()).map(at).collect();
        let larger = |a: usize, b: usize| if all[b] > all[a] { b } else { a };
        (0..all.len()).fold(0, larger)
    }

    /// Of a sensor.
    pub(super) fn of_sensor(&self, sensor: usize) -> &Response {
        &self.0[sensor]
    }

    /// Force steps that the first wave takes to the sensor that it reaches first: so long before a trace a blow may begin.
    pub(super) fn travel_steps(&self) -> usize {
        self.0.iter().map(|own| own.arrival).min().unwrap_or(0)
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

/// The displacement whose rate a quantity is, and how often it is differentiated.
fn integrated(measured: Measured) -> (Measured, usize) {
    match measured {
        Measured::DisplacementR | Measured::DisplacementZ | Measured::StressZz => (measured, 0),
        Measured::VelocityR => (Measured::DisplacementR, 1),
        Measured::VelocityZ => (Measured::DisplacementZ, 1),
        Measured::AccelerationR => (Measured::DisplacementR, 2),
        Measured::AccelerationZ => (Measured::DisplacementZ, 2),
    }
}

/// The output of a sensor from the mean displacement over its face: short waves of the triangle need kernels that are averaged
/// themselves, which rates do not have.
fn outputs(times_s: &[f64], means: &[f64], sensor: &Sensor) -> Result<Vec<f64>, TraceError> {
    let step_s = times_s[1] - times_s[0];
    let mut found = means.to_vec();
    for _ in 0..integrated(sensor.measured).1 {
        let last = found.len() - 1;
        let slope = |n: usize| {
            let ends = [n.saturating_sub(1), (n + 1).min(last)];
            (found[ends[1]] - found[ends[0]]) / (step_s * (ends[1] - ends[0]) as f64)
        };
        found = (0..=last).map(slope).collect();
    }
    match &sensor.response {
        None => Ok(found),
        Some(own) => {
            let output = own.response.apply(step_s, &found);
            Ok(output.map_err(SceneError::from)?.samples)
        }
    }
}

/// A history at a time, by a polynomial through the samples next to it.
fn read(times_s: &[f64], samples: &[f64], time_s: f64) -> f64 {
    let after = times_s.partition_point(|t| *t < time_s);
    let first = after.saturating_sub(2).min(times_s.len() - 4);
    let node = |k: usize| times_s[first + k];
    let weights = (0..4).map(|k| {
        let others = (0..4).filter(|i| *i != k);
        let factors = others.map(|i| (time_s - node(i)) / (node(k) - node(i)));
        samples[first + k] * factors.product::<f64>()
    });
    weights.sum()
}
