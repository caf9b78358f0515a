//! The force behind traces of the sensors of a scene.
//!
//! The scene has the block, the sensors and perhaps the striker, whose law and radius are then known; its velocity is a guess. Its
//! sensors are simulated under a short triangle of force, and the crate `inverse` finds the force whose responses are the traces.
//!
//! `read` reads traces from text, `triangle` computes the responses, and `write` writes the force.

mod read;
mod triangle;
#[cfg(feature = "hdf5")]
mod write;

pub use read::read_traces;
pub(crate) use read::{Columns, read_columns};
#[cfg(feature = "hdf5")]
pub use write::stage_force;

use crate::error::SceneError;
use contact::{Plasticity, Shape};
use fault::{Culprit, Fault};
use impact::{Impact, ImpactError, Scene};
use inverse::{
    Ball, Estimate, Gain, Inferred, InverseError, Known, Noise, Problem, Pulse, Trace, average,
    ball, momentum,
};
use serde_json::{Value, json};
use thiserror::Error;
use triangle::Responses;

/// Traces of the sensors of a scene, in its order and in the units of their outputs, at equidistant times.
#[derive(Debug, Clone, PartialEq)]
pub struct Traces {
    /// Time of the first sample in s, in the clock of the traces.
    pub start_s: f64,
    /// Time between samples in s.
    pub step_s: f64,
    /// Samples of each sensor.
    pub samples: Vec<Vec<f64>>,
}

impl Traces {
    /// Of times in s that are equidistant to a thousandth of a step, and the samples of each sensor.
    ///
    /// # Errors
    /// [`SceneError`] for other times, and for lists of different lengths.
    pub fn new(time_s: &[f64], samples: Vec<Vec<f64>>) -> Result<Self, SceneError> {
        /// Fraction of a step by which a time may be off.
        const UNEVEN: f64 = 1e-3;
        let wrong = |sentence: String| Err(SceneError::of(sentence, "trace"));
        let count = time_s.len();
        if count < 2 {
            return wrong(format!(
                "a trace has {count} samples, but at least 2 are required"
            ));
        }
        if let Some(other) = samples.iter().find(|own| own.len() != count) {
            return wrong(format!(
                "the time has {count} samples and a trace {}",
                other.len()
            ));
        }
        let start_s = time_s[0];
        let step_s = (time_s[count - 1] - start_s) / (count - 1) as f64;
        let off = |(i, t): (usize, &f64)| (t - start_s - i as f64 * step_s).abs();
        let most = time_s.iter().enumerate().map(off).fold(0.0, f64::max);
        // not a number fails as well
        if !(step_s > 0.0 && most <= UNEVEN * step_s * (count as f64).sqrt()) {
            return wrong(format!(
                "the times of the traces are not equidistant: with a step of {step_s:.6e} s one is off by {most:.1e} s; resample the traces"
            ));
        }
        Ok(Self {
            start_s,
            step_s,
            samples,
        })
    }
}

/// What is known in addition to the scene and the traces.
#[derive(Debug, Clone, Default)]
pub struct Given {
    /// Standard deviation of white noise, one for all traces or one for each, in their units. Default: the noise of the quiet
    /// beginning of each.
    pub noise: Vec<f64>,
    /// Sensors, from 1, whose gain is not known.
    pub unknown_gains: Vec<usize>,
    /// Impulse in N s with its standard deviation.
    pub impulse_n_s: Option<[f64; 2]>,
    /// Weight of the squared second differences in 1/N^2. Default: from the traces.
    pub lambda: Option<f64>,
    /// Times in s, in the clock of the traces, between which the force may differ from zero.
    pub window_s: Option<[f64; 2]>,
    /// The property of a ball that is known. Default: its radius, for a scene with a striker.
    pub known: Option<KnownOf>,
    /// Restitution of the blow, by which the impulse is a momentum.
    pub restitution: Option<f64>,
}

/// The property of a striker that its scene is trusted for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KnownOf {
    /// Radius of its tip.
    Radius,
    /// Density of a ball.
    Density,
    /// Mass.
    Mass,
}

contact::choice!(KnownOf: Radius = "radius", Density = "density", Mass = "mass");

/// The force behind traces, with all that it rests on.
#[derive(Debug, Clone)]
pub struct InferredForce {
    /// Fit, history, noise, predicted traces; times in s from the first sample.
    pub found: Inferred,
    /// Time of the first sample in s, in the clock of the traces.
    pub start_s: f64,
    /// Time between samples of the traces in s.
    pub step_s: f64,
    /// The ball, for a scene with a striker.
    pub ball: Option<Ball>,
    /// Momentum before the blow in N s, if its restitution is known.
    pub momentum_n_s: Option<Estimate>,
    /// Shifts in s by which repeated drops were aligned; empty for one.
    pub shifts_s: Vec<f64>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

impl InferredForce {
    /// When the fitted pulse begins in s, in the clock of the traces.
    pub fn blow_start_s(&self) -> Estimate {
        let fitted = self.found.fit.start_s;
        Estimate {
            value: self.start_s + fitted.value,
            ..fitted
        }
    }
}

/// Why there is no force.
#[derive(Debug, Error)]
pub enum TraceError {
    /// The scene or the traces.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The responses of its sensors.
    #[error(transparent)]
    Impact(#[from] ImpactError),
    /// The traces do not determine a force.
    #[error(transparent)]
    Inverse(#[from] InverseError),
}

impl Fault for TraceError {
    fn culprit(&self) -> Culprit<'_> {
        match self {
            Self::Scene(error) => error.culprit(),
            Self::Impact(error) => error.culprit(),
            Self::Inverse(error) => error.culprit(),
        }
    }
}

/// Samples of a force in a contact, for which the corners of lines between them are not seen; at most so many for each sample of a
/// trace.
const IN_CONTACT: f64 = 100.0;
const MOST_OVERSAMPLING: usize = 16;

/// Standard deviations of the noise above which a sample is part of the blow.
const SEEN: f64 = 6.0;

/// Part of the samples before the blow that is not counted as quiet, where the law tells when it begins, and where only the noise does,
/// above which a slow beginning shows late.
const NOT_QUIET: [f64; 2] = [0.1, 0.5];

/// The force behind the traces of one blow, or of repeated ones, which are aligned and averaged.
///
/// # Errors
/// [`TraceError`] with the key or the trace at fault.
pub fn infer_force(
    scene: &Scene,
    blows: &[Traces],
    given: &Given,
) -> Result<InferredForce, TraceError> {
    let (traces, sds, shifts_s) = averaged(scene, blows, given)?;
    let (pulse, contact_s, mut warnings) = pulse(scene)?;
    let oversampling = match contact_s {
        None => 1,
        Some(contact_s) => {
            let needed = (IN_CONTACT * traces.step_s / contact_s).ceil() as usize;
            needed.clamp(1, MOST_OVERSAMPLING)
        }
    };
    let step_s = traces.step_s / oversampling as f64;
    let count = traces.samples[0].len();
    let responses = Responses::of(scene, (step_s, count * oversampling))?;
    let lead = responses.travel_steps();
    let mut problem = Problem {
        oversampling,
        lead,
        window_s: given.window_s.map(|span| span.map(|t| t - traces.start_s)),
        impulse_n_s: given.impulse_n_s.map(|[value, sd]| Estimate { value, sd }),
        lambda: given.lambda,
        ..Problem::new(traces.step_s, Vec::new(), &pulse)
    };
    for (i, samples) in traces.samples.iter().enumerate() {
        let own = responses.of_sensor(i);
        let begins_s = begins_s(
            samples,
            traces.step_s,
            &responses,
            (i, &pulse, contact_s, step_s),
        );
        let arrives_s = begins_s + own.arrival as f64 * step_s;
        let left_out = NOT_QUIET[usize::from(contact_s.is_none())];
        let quiet = ((1.0 - left_out) * arrives_s / traces.step_s).max(0.0) as usize;
        let is_unknown = given.unknown_gains.contains(&(i + 1));
        let echo_s = own.echo_s + begins_s;
        if echo_s <= 0.0 || arrives_s <= 0.0 && given.noise.is_empty() && sds.is_empty() {
            return Err(early(i + 1, begins_s + traces.start_s));
        }
        problem.traces.push(Trace {
            samples: samples.clone(),
            response: own.samples.clone(),
            noise: match (noise(given, i), sds.get(i)) {
                (Some(sigma), _) => Noise::White(sigma),
                (None, Some(Some(sigma))) => Noise::White(*sigma),
                (None, _) => Noise::Quiet(0..quiet),
            },
            gain: if is_unknown {
                Gain::Unknown
            } else {
                Gain::Known(1.0)
            },
            valid_until_s: Some(echo_s).filter(|t| t.is_finite()),
        });
    }
    let found = inverse::infer(&problem)?;
    let (made, momentum_n_s) = behind(scene, &found, given)?;
    warnings.extend(unexplained(&found));
    Ok(InferredForce {
        found,
        start_s: traces.start_s,
        step_s: traces.step_s,
        ball: made,
        momentum_n_s,
        shifts_s,
        warnings,
    })
}

/// A warning about traces that neither the pulse of the law nor any force explains.
fn unexplained(found: &Inferred) -> Option<String> {
    /// Chi-squared over the degrees of freedom.
    const MUCH: f64 = 4.0;
    let (fit, history) = (&found.fit, &found.history);
    let of_fit = fit.chi_squared / fit.degrees_of_freedom.max(1) as f64;
    let of_history = history.chi_squared / history.degrees_of_freedom.max(1.0);
    let who = match (of_fit > MUCH, of_history > MUCH) {
        (false, false) => return None,
        (true, false) => {
            "the pulse of the contact law does not explain the traces, but the history does: use its peak and impulse"
        }
        (_, true) => {
            "no force explains the traces: check the response and its sign, the distance, the wave speeds and the noise"
        }
    };
    Some(format!(
        "{who} (chi-squared over the degrees of freedom {of_fit:.3} with the fit, {of_history:.3} with the history)"
    ))
}

/// The traces of all blows as one, with the standard deviation of the noise of each mean where there are several, and their shifts.
type Means = (Traces, Vec<Option<f64>>, Vec<f64>);

fn averaged(scene: &Scene, blows: &[Traces], given: &Given) -> Result<Means, TraceError> {
    let wrong = |sentence: String| TraceError::Scene(SceneError::of(sentence, "trace"));
    let Some(first) = blows.first() else {
        return Err(wrong("there is no trace".to_owned()));
    };
    if scene.sensors.is_empty() {
        let hint = "the traces are those of the sensors of the scene: describe each in a section [[sensor]]";
        return Err(TraceError::Scene(SceneError::missing("sensor", hint)));
    }
    if given.noise.len() > 1 && given.noise.len() != scene.sensors.len() {
        let (found, sensors) = (given.noise.len(), scene.sensors.len());
        return Err(wrong(format!(
            "there are {found} values of the noise, but the scene has {sensors} sensors: give one for all, or one for each"
        )));
    }
    let sensors = scene.sensors.len();
    if let Some(other) = (given.unknown_gains.iter()).find(|i| !(1..=sensors).contains(*i)) {
        return Err(wrong(format!(
            "unknown_gains has {other}, but the sensors of the scene are numbered from 1 to {sensors}"
        )));
    }
    for blow in blows {
        let (traces, sensors) = (blow.samples.len(), scene.sensors.len());
        if traces != sensors {
            return Err(wrong(format!(
                "there are {traces} traces, but the scene has {sensors} sensors: they need the same number and order"
            )));
        }
        if (blow.step_s / first.step_s - 1.0).abs() > 1e-6 {
            return Err(wrong(format!(
                "the steps of repeated blows differ, {} s and {} s: resample one of them",
                fault::rounded(first.step_s),
                fault::rounded(blow.step_s)
            )));
        }
    }
    if blows.len() == 1 {
        return Ok((first.clone(), Vec::new(), Vec::new()));
    }
    let drops: Vec<Vec<Vec<f64>>> = blows.iter().map(|blow| blow.samples.clone()).collect();
    let found = average(&drops, first.step_s)?;
    let of_mean = |sd: &Vec<f64>| {
        let square = sd.iter().map(|sd| sd * sd).sum::<f64>() / sd.len() as f64;
        Some(square.sqrt())
    };
    let sds = found.sd.iter().map(of_mean).collect();
    let samples = found.mean;
    let mean = Traces { samples, ..*first };
    Ok((mean, sds, found.shifts_s))
}

/// The pulse of the contact law, about how long the contact takes in s, and warnings about it; Hertz's pulse of unknown length without
/// a striker.
fn pulse(scene: &Scene) -> Result<(Pulse, Option<f64>, Vec<String>), TraceError> {
    /// Samples of the pulse of a contact that yields.
    const SAMPLES: usize = 400;
    let Some(strike) = scene.strike() else {
        return Ok((Pulse::hertz(), None, Vec::new()));
    };
    let run = Impact::of(scene, strike).solve();
    let run = run.map_err(ImpactError::Contact)?;
    let contact_s = run.results.contact_time_s;
    if scene.settings.plasticity == Plasticity::None {
        return Ok((Pulse::hertz(), Some(contact_s), run.warnings));
    }
    let at = |i: usize| {
        run.excitation()
            .force_n(contact_s * i as f64 / SAMPLES as f64)
    };
    let force_n: Vec<f64> = (0..=SAMPLES).map(at).collect();
    Ok((Pulse::sampled(&force_n)?, Some(contact_s), run.warnings))
}

/// A trace whose blow began long before it.
fn early(trace: usize, begins_s: f64) -> TraceError {
    let sentence = format!(
        "by its largest sample the blow of trace {trace} begins at {begins_s:.3e} s, so that its waves arrive before the trace begins: record more before the trigger, pass the noise, or check the scene"
    );
    TraceError::Scene(SceneError::of(sentence, "trace"))
}

/// The noise that is given for a trace.
fn noise(given: &Given, trace: usize) -> Option<f64> {
    match given.noise[..] {
        [one] => Some(one),
        ref each => each.get(trace).copied(),
    }
}

/// About when a blow begins, in s after the first sample of a trace: its largest sample is where that of the law's pulse is; for a
/// blow of unknown length no later than the first sample above the noise of its beginning.
fn begins_s(
    samples: &[f64],
    trace_step_s: f64,
    responses: &Responses,
    (sensor, pulse, contact_s, step_s): (usize, &Pulse, Option<f64>, f64),
) -> f64 {
    /// The least that a noise is measured of.
    const FEWEST: usize = 16;
    let largest = samples.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
    if let Some(contact_s) = contact_s {
        let duration = (contact_s / step_s).round().max(1.0) as usize;
        let expected = responses.largest(sensor, pulse, duration);
        let found = samples.iter().position(|x| x.abs() >= largest).unwrap_or(0);
        return found as f64 * trace_step_s - expected as f64 * step_s;
    }
    let first = &samples[..FEWEST.min(samples.len())];
    let mean = first.iter().sum::<f64>() / first.len() as f64;
    let square = first.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / first.len() as f64;
    let level = (SEEN * square.sqrt()).max(1e-9 * largest);
    let seen = samples.iter().position(|x| x.abs() > level);
    let own = responses.of_sensor(sensor);
    seen.unwrap_or(samples.len()) as f64 * trace_step_s - own.arrival as f64 * step_s
}

/// The ball and the momentum behind a fit.
fn behind(
    scene: &Scene,
    found: &Inferred,
    given: &Given,
) -> Result<(Option<Ball>, Option<Estimate>), TraceError> {
    let momentum_n_s = given
        .restitution
        .map(|e| momentum(&found.fit, e))
        .transpose()?;
    let Some(strike) = scene
        .strike()
        .filter(|_| scene.settings.plasticity == Plasticity::None)
    else {
        return Ok((None, momentum_n_s));
    };
    let striker = &strike.striker;
    let known = match given.known.unwrap_or(KnownOf::Radius) {
        KnownOf::Radius => Known::Radius(striker.tip_radius_m),
        KnownOf::Mass => Known::Mass(striker.mass_kg),
        KnownOf::Density => match (striker.material.density_kg_m3, striker.shape) {
            (Some(density), Some(Shape::Ball { .. })) => Known::Density(density),
            _ => {
                let hint = "a known density needs a striker with shape = \"ball\" and a density";
                return Err(SceneError::missing("striker.density_kg_m3", hint).into());
            }
        },
    };
    let collision = contact::Collision::new(&scene.target, striker, strike.velocity_m_s);
    let made = ball(&found.fit, collision.effective_modulus_pa, known)?;
    Ok((Some(made), momentum_n_s))
}

/// The report of a force; times in the clock of the traces.
pub fn force_report(force: &InferredForce) -> Value {
    let of = |own: &Estimate| json!({ "value": own.value, "sd": own.sd });
    let (fit, history) = (&force.found.fit, &force.found.history);
    json!({
        "fit": {
            "peak_force_n": of(&fit.peak_n),
            "contact_time_s": of(&fit.duration_s),
            "start_s": of(&force.blow_start_s()),
            "impulse_n_s": of(&fit.impulse_n_s),
            "chi_squared": fit.chi_squared,
            "degrees_of_freedom": fit.degrees_of_freedom,
            "gains": fit.gains.iter().map(of).collect::<Vec<_>>(),
        },
        "history": {
            "peak_force_n": of(&history.peak_n),
            "impulse_n_s": of(&history.impulse_n_s),
            "lambda": history.lambda,
            "chi_squared": history.chi_squared,
            "degrees_of_freedom": history.degrees_of_freedom,
            "error_factor": history.error_factor,
            "variance_reduction": history.variance_reduction,
            "gains": history.gains.iter().map(of).collect::<Vec<_>>(),
        },
        "noise": force.found.noise.iter().map(|own| json!({
            "sigma": own.sigma,
            "order": own.order,
            "quiet_samples": own.quiet.as_ref().map(ExactSizeIterator::len),
            "signal_to_noise": own.signal_to_noise,
        })).collect::<Vec<_>>(),
        "jackknife": force.found.jackknife.as_ref().map(|own| json!({
            "peak_force_n": own.peak_n,
            "impulse_n_s": own.impulse_n_s,
            "peak_sd_n": own.peak_sd_n,
            "impulse_sd_n_s": own.impulse_sd_n_s,
        })),
        "ball": force.ball.as_ref().map(|own| json!({
            "radius_m": of(&own.radius_m),
            "mass_kg": of(&own.mass_kg),
            "velocity_m_s": of(&own.velocity_m_s),
        })),
        "momentum_n_s": force.momentum_n_s.as_ref().map(of),
        "shifts_s": force.shifts_s,
        "warnings": force.warnings,
    })
}
