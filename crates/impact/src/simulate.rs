//! From a scene to its results: contact, then fields.

use crate::choose::{Choice, Rung, choose};
use crate::contact::quasi_static::quasi_static;
use crate::contact::radiation::{LARGEST_LAG, march_radiation, radiation};
use crate::contact::{Collision, hertz};
use crate::convolve::{CellPlan, FieldError, KernelSource, Place, between_samples, convolve};
use crate::energy::{Ledger, radiated, work};
use crate::march::{
    FixedDisc, History, MarchError, PunchResponse, StaticShare, Summary, march_explicit,
    march_growing, march_implicit, refine,
};
use crate::resample::Resampler;
use crate::scene::{
    DEFLECTIONS, Load, MODELS, Model, PrescribedForce, SCHEMES, SHARES, Scene, Scheme, Striker,
    name_of,
};
use crate::units::{CollisionUnits, KernelUnits};
use crate::validity::{Reached, warnings};
use halfspace::{Arrivals, Deflection, DomainError, Medium, Profile, Six, SurfaceResponse};
use lookup::Table;
use rayon::prelude::*;
use std::sync::Arc;
use thiserror::Error;

/// Where the fields' kernels come from.
#[derive(Debug, Clone)]
pub enum KernelChoice {
    /// Computed for each probe.
    Direct,
    /// A table.
    Table(Arc<Table>),
}

/// Why a scene could not be computed.
#[derive(Debug, Error)]
pub enum ImpactError {
    /// The march failed.
    #[error(transparent)]
    March(#[from] MarchError),
    /// A field failed.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A material is outside the physics.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// The radiated loss is not small.
    #[error(
        "model \"radiation\" is a first-order law: it gives a loss of {loss:.3} of the kinetic energy, outside [0, 0.5]; use model \"growing\" or \"wave\""
    )]
    LossTooLarge {
        /// The loss 1 - e^2 of the law.
        loss: f64,
    },
    /// More samples than memory should hold.
    #[error(
        "the output needs {samples:.3e} samples of {step_s:.3e} s, more than {limit}: give a larger step_s or a smaller output.duration_s"
    )]
    TooManySamples {
        /// Samples needed.
        samples: f64,
        /// Their step in s.
        step_s: f64,
        /// Samples allowed.
        limit: usize,
    },
}

/// Names of the choices made.
#[derive(Debug, Clone, PartialEq)]
pub struct Choices {
    /// Model, never "auto"; "prescribed" for a given force.
    pub model: &'static str,
    /// Scheme; "closed form" where nothing was marched.
    pub scheme: &'static str,
    /// Static share.
    pub static_share: &'static str,
    /// Deflection.
    pub deflection: &'static str,
    /// Why this model.
    pub reason: String,
}

/// Scalar results in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Results {
    /// Largest force in N.
    pub peak_force_n: f64,
    /// When it is reached in s.
    pub peak_force_time_s: f64,
    /// Duration of the first contact in s.
    pub contact_time_s: f64,
    /// Velocity of departure in m/s, positive away from the half-space.
    pub rebound_velocity_m_s: f64,
    /// Velocity of departure over velocity of approach.
    pub restitution: f64,
    /// Largest displacement of the striker in m.
    pub peak_displacement_m: f64,
    /// Largest deflection that enters the contact law in m.
    pub peak_deflection_m: f64,
    /// Momentum given to the striker in N s.
    pub impulse_n_s: f64,
    /// Kinetic energy before in J.
    pub initial_energy_j: f64,
    /// Energy radiated into the half-space in J.
    pub radiated_energy_j: f64,
    /// (initial - rebound - radiated)/initial.
    pub energy_residual: f64,
    /// Number of contacts.
    pub contacts: usize,
}

/// Time series of the impact in SI units.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Series {
    /// Time in s, uniform.
    pub time_s: Vec<f64>,
    /// Contact force in N.
    pub force_n: Vec<f64>,
    /// Displacement of the striker in m.
    pub displacement_m: Vec<f64>,
    /// Velocity of the striker in m/s.
    pub velocity_m_s: Vec<f64>,
    /// Deflection that enters the contact law in m.
    pub deflection_m: Vec<f64>,
}

/// Fields at the probes in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Fields {
    /// Distances from the axis in m.
    pub r_m: Vec<f64>,
    /// Depths in m.
    pub z_m: Vec<f64>,
    /// Times of the first P, S and Rayleigh arrival in s, one row a probe.
    pub arrival_s: Vec<[f64; 3]>,
    /// Samples of each field (order of [`halfspace::FIELDS`]), one row a probe.
    pub values: [Vec<Vec<f64>>; 6],
    /// Estimated error of each field, one value a probe.
    pub errors: [Vec<f64>; 6],
}

/// All that a scene gives.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Choices made.
    pub choices: Choices,
    /// Kernel of the fields: "none", "direct" or "table".
    pub kernel: &'static str,
    /// Id and format version of the table.
    pub table: Option<(String, String)>,
    /// Steps of the march over the contact.
    pub march_steps: usize,
    /// Step of the march in s.
    pub march_step_s: f64,
    /// Scalar results; none of the striker's for a prescribed force.
    pub results: Results,
    /// Time series.
    pub series: Series,
    /// Fields at the probes.
    pub fields: Option<Fields>,
    /// Radius of the disc that loads the half-space in the fields, in m.
    pub disc_radius_m: f64,
    /// Estimated relative error of the scalar results.
    pub relative_error_estimate: f64,
    /// What the user should know.
    pub warnings: Vec<String>,
    /// The scene with all defaults.
    pub resolved_scene: String,
}

/// A contact computed, still in collision units.
struct Run {
    model: Model,
    scheme: &'static str,
    reason: String,
    history: History,
    summary: Summary,
    error: f64,
    radiated: f64,
    steps: usize,
}

/// Samples of the output at most.
const MOST_SAMPLES: usize = 4_000_000;

/// Computes a scene.
///
/// # Errors
/// [`ImpactError`].
pub fn simulate(scene: &Scene, kernels: &KernelChoice) -> Result<Outcome, ImpactError> {
    match &scene.load {
        Load::Strike(striker) => strike(scene, striker, kernels),
        Load::Prescribed(force) => prescribed(scene, force, kernels),
    }
}

fn strike(
    scene: &Scene,
    striker: &Striker,
    kernels: &KernelChoice,
) -> Result<Outcome, ImpactError> {
    let contact = &scene.contact;
    let collision = Collision::new(scene, striker);
    let units = collision.units();
    let medium = Medium::new(scene.target.poisson_ratio)?;
    let response = SurfaceResponse::new(&medium, contact.deflection);
    let run = contact_run(scene, striker, &collision, &response, &medium)?;
    let fixed = match run.model {
        Model::Growing | Model::Hertz | Model::Radiation => contact.disc_radius_m,
        Model::Wave | Model::Auto => Some(contact.disc_radius_m.unwrap_or(striker.tip_radius_m)),
    };
    let peak_force_n = run.summary.peak_force * units.force_n;
    let disc_radius_m = fixed.unwrap_or_else(|| collision.contact_radius_m(peak_force_n));
    let results = scale(&run, &collision, &units);
    let mut notes = warnings(
        scene,
        striker,
        &collision,
        &Reached {
            peak_force_n,
            contact_time_s: results.contact_time_s,
            disc_radius_m: fixed,
            contacts: run.summary.contacts,
        },
    );
    if fixed.is_none() && !scene.probes.is_empty() {
        notes.push(format!(
            "the fields are those of a disc of the largest contact radius, {disc_radius_m:.3e} m, throughout"
        ));
    }
    let kernel_units = collision.kernel_units(disc_radius_m);
    let source = source(scene, kernels, &medium)?;
    let grid = Grid::new(
        scene,
        source.as_ref(),
        &kernel_units,
        &medium,
        results.contact_time_s,
        results.contact_time_s,
    )?;
    let resampler = Resampler::new(&run.history);
    let mut series = Series::default();
    for i in 0..grid.count {
        let time_s = i as f64 * grid.step_s;
        let now = resampler.at(time_s / units.time_s);
        series.time_s.push(time_s);
        series.force_n.push(now.force * units.force_n);
        series
            .displacement_m
            .push(now.displacement * units.length_m);
        series
            .velocity_m_s
            .push(now.velocity * units.velocity_m_s());
        series.deflection_m.push(now.deflection * units.length_m);
    }
    if run.model == Model::Wave && contact.scheme == Scheme::Implicit {
        // Anew on the output's step: the march's own step may be coarser than the disc's memory.
        series.deflection_m =
            surface_deflection(scene, &response, &kernel_units, &grid, &series.force_n);
    }
    let fields = match &source {
        Some(source) => Some(fields(
            scene,
            source,
            &kernel_units,
            &medium,
            &grid,
            &series.force_n,
            run.error,
        )?),
        None => None,
    };
    let (kernel, table) = described(source.as_ref());
    Ok(Outcome {
        choices: Choices {
            model: name_of(&MODELS, run.model),
            scheme: run.scheme,
            static_share: name_of(&SHARES, contact.static_share),
            deflection: name_of(&DEFLECTIONS, contact.deflection),
            reason: run.reason,
        },
        kernel,
        table,
        march_steps: run.steps,
        march_step_s: run.history.step * units.time_s,
        results,
        series,
        fields,
        disc_radius_m,
        relative_error_estimate: run.error,
        warnings: notes,
        resolved_scene: scene.resolved(),
    })
}

fn scale(run: &Run, collision: &Collision, units: &CollisionUnits) -> Results {
    let s = &run.summary;
    let ledger = Ledger::new(s.restitution, run.radiated);
    Results {
        peak_force_n: s.peak_force * units.force_n,
        peak_force_time_s: s.peak_force_time * units.time_s,
        contact_time_s: s.contact_time * units.time_s,
        rebound_velocity_m_s: s.restitution * collision.velocity_m_s,
        restitution: s.restitution,
        peak_displacement_m: s.peak_displacement * units.length_m,
        peak_deflection_m: s.peak_deflection * units.length_m,
        impulse_n_s: s.impulse * units.force_n * units.time_s,
        initial_energy_j: collision.energy_j(),
        radiated_energy_j: run.radiated * collision.energy_j(),
        energy_residual: ledger.residual,
        contacts: s.contacts,
    }
}

/// Chooses the model and runs it.
fn contact_run(
    scene: &Scene,
    striker: &Striker,
    collision: &Collision,
    response: &SurfaceResponse,
    medium: &Medium,
) -> Result<Run, ImpactError> {
    let contact = &scene.contact;
    let lag = collision.lag(response);
    let (model, reason) = match contact.model {
        Model::Auto => automatic(scene, collision, response),
        given @ (Model::Hertz | Model::Radiation | Model::Wave | Model::Growing) => {
            (given, "asked for by the scene".to_owned())
        }
    };
    let disc = contact.disc_radius_m.unwrap_or(striker.tip_radius_m);
    let mut run = match model {
        Model::Hertz => hertz_run(contact.tolerance),
        Model::Radiation => radiation_run(lag, contact.tolerance)?,
        Model::Growing => {
            let centre = SurfaceResponse::new(medium, Deflection::Centre);
            let punch = PunchResponse::new(&centre);
            let impact = collision.growing_disc(&punch);
            let march = |step| march_growing(&impact, step);
            let mut run = marched(scene, collision, hertz::CONTACT_TIME, march)?;
            run.radiated = work(&run.history.force, &run.history.deflection);
            run
        }
        Model::Wave | Model::Auto => {
            let impact = collision.fixed_disc(response, disc, contact.static_share);
            let mut run = match contact.scheme {
                Scheme::Implicit => {
                    let duration = expected_contact_time(&impact);
                    marched(scene, collision, duration, |step| {
                        march_implicit(&impact, step)
                    })?
                }
                Scheme::Explicit => explicit_run(scene, collision, &impact)?,
            };
            run.radiated = match contact.deflection {
                Deflection::Mean => radiated(&impact, response, &run.history),
                Deflection::Centre => {
                    let mean = SurfaceResponse::new(medium, Deflection::Mean);
                    radiated(&impact, &mean, &run.history)
                }
            };
            run
        }
    };
    run.model = model;
    run.reason = reason;
    Ok(run)
}

/// A first guess of how long the contact lasts, and so of the step.
fn expected_contact_time(impact: &FixedDisc<'_>) -> f64 {
    match impact.share {
        StaticShare::Full => quasi_static(impact.coupling).contact_time,
        StaticShare::Dynamic => hertz::CONTACT_TIME,
    }
}

fn automatic(scene: &Scene, collision: &Collision, response: &SurfaceResponse) -> (Model, String) {
    let contact = &scene.contact;
    let asked = contact.loss_tolerance;
    match (contact.disc_radius_m, contact.static_share, contact.scheme) {
        (Some(_), StaticShare::Full, Scheme::Implicit | Scheme::Explicit)
        | (Some(_), StaticShare::Dynamic, Scheme::Explicit) => (
            Model::Wave,
            "disc_radius_m and the full static share ask for the paper's disc".to_owned(),
        ),
        (Some(disc), StaticShare::Dynamic, Scheme::Implicit) => {
            let impact = collision.fixed_disc(response, disc, StaticShare::Dynamic);
            let lag = impact.coupling * impact.wave_time * response.relaxation_time();
            rung(
                choose(lag, impact.memory(), contact.tolerance, asked),
                Model::Wave,
            )
        }
        (None, _, Scheme::Explicit) => (
            Model::Wave,
            "the explicit scheme marches a fixed disc, of the tip's radius".to_owned(),
        ),
        (None, _, Scheme::Implicit) => {
            let memory = 2.0 * collision.contact_wave_time() * response.memory();
            let lag = collision.lag(response);
            rung(
                choose(lag, memory, contact.tolerance, asked),
                Model::Growing,
            )
        }
    }
}

fn rung(choice: Choice, full: Model) -> (Model, String) {
    let model = match choice.rung {
        Rung::QuasiStatic => Model::Hertz,
        Rung::Radiation => Model::Radiation,
        Rung::FullMemory => full,
    };
    (model, choice.reason)
}

/// Steps of the first march over a contact at a tolerance.
fn first_steps(tolerance: f64) -> f64 {
    16.0 * (1e-4 / tolerance).max(1.0).powf(0.4)
}

fn marched(
    scene: &Scene,
    collision: &Collision,
    duration: f64,
    march: impl Fn(f64) -> Result<History, MarchError>,
) -> Result<Run, ImpactError> {
    let contact = &scene.contact;
    let (history, summary, error) = match contact.step_s {
        Some(step_s) => {
            let step = step_s / collision.units().time_s;
            let history = march(step)?;
            let summary = Summary::new(&history)?;
            let finer = Summary::new(&march(0.5 * step)?)?;
            (history, summary, summary.distance(&finer) * 4.0 / 3.0)
        }
        None => {
            let step = duration / first_steps(contact.tolerance);
            let refined = refine(march, step, contact.tolerance)?;
            (refined.history, refined.summary, refined.error)
        }
    };
    Ok(Run {
        model: contact.model,
        scheme: name_of(&SCHEMES, Scheme::Implicit),
        reason: String::new(),
        steps: (summary.contact_time / history.step).ceil() as usize,
        history,
        summary,
        error,
        radiated: 0.0,
    })
}

/// Steps over a contact of the explicit scheme when the scene gives none: the paper's ts/200.
const EXPLICIT_STEPS: f64 = 200.0;

fn explicit_run(
    scene: &Scene,
    collision: &Collision,
    impact: &FixedDisc<'_>,
) -> Result<Run, ImpactError> {
    let step = match scene.contact.step_s {
        Some(step_s) => step_s / collision.units().time_s,
        None => expected_contact_time(impact) / EXPLICIT_STEPS,
    };
    let (history, summary) = march_explicit(impact, step)?;
    let (_, finer) = march_explicit(impact, 0.5 * step)?;
    Ok(Run {
        model: Model::Wave,
        scheme: name_of(&SCHEMES, Scheme::Explicit),
        reason: String::new(),
        steps: history.force.len() - 1,
        history,
        summary,
        // first order: the rest is as large as the change over one halving
        error: 2.0 * summary.distance(&finer),
        radiated: 0.0,
    })
}

/// Scheme of the models that need no march.
const CLOSED_FORM: &str = "closed form";

fn hertz_run(tolerance: f64) -> Run {
    let step = hertz::CONTACT_TIME / first_steps(tolerance).max(100.0);
    let mut run = radiation_samples(0.0, step);
    run.summary.restitution = 1.0;
    run
}

fn radiation_run(lag: f64, tolerance: f64) -> Result<Run, ImpactError> {
    if lag > LARGEST_LAG {
        return Err(ImpactError::LossTooLarge {
            loss: radiation(lag).loss,
        });
    }
    let step = hertz::CONTACT_TIME / first_steps(tolerance).max(100.0);
    Ok(radiation_samples(lag, step))
}

fn radiation_samples(lag: f64, step: f64) -> Run {
    let summary = radiation(lag);
    Run {
        model: Model::Radiation,
        scheme: CLOSED_FORM,
        reason: String::new(),
        steps: 0,
        history: march_radiation(lag, step),
        summary,
        // what the first order leaves out is of the size of its square
        error: 2.0 * summary.loss * summary.loss,
        radiated: summary.loss,
    }
}

/// Times of the output.
struct Grid {
    step_s: f64,
    coarsening: u32,
    count: usize,
    pulse_s: f64,
}

impl Grid {
    fn new(
        scene: &Scene,
        source: Option<&KernelSource>,
        units: &KernelUnits,
        medium: &Medium,
        load_end_s: f64,
        pulse_s: f64,
    ) -> Result<Self, ImpactError> {
        // linear between samples: relative error about (1.07 step/duration * pi)^2/8
        let samples = (1.1 / scene.contact.tolerance.sqrt()).clamp(100.0, 4000.0);
        let wanted_s = scene.contact.step_s.unwrap_or(pulse_s / samples);
        let (step_s, coarsening) = match source {
            Some(source) => {
                let (step, coarsening) =
                    source.step(medium.poisson_ratio(), wanted_s / units.time_s());
                (step * units.time_s(), coarsening)
            }
            None => (wanted_s, 0),
        };
        let duration_s = scene
            .duration_s
            .unwrap_or_else(|| default_duration(scene, units, medium, load_end_s));
        let samples = (duration_s / step_s).ceil() + 1.0;
        if samples > MOST_SAMPLES as f64 {
            return Err(ImpactError::TooManySamples {
                samples,
                step_s,
                limit: MOST_SAMPLES,
            });
        }
        Ok(Self {
            step_s,
            coarsening,
            count: samples as usize,
            pulse_s,
        })
    }
}

/// The load and a tenth, or until its last Rayleigh wave has passed the farthest probe.
fn default_duration(scene: &Scene, units: &KernelUnits, medium: &Medium, load_end_s: f64) -> f64 {
    let slowest = medium.rayleigh_speed() * units.longitudinal_speed_m_s;
    let farthest = scene
        .probes
        .iter()
        .map(|probe| (probe.r_m.hypot(probe.z_m) + units.disc_radius_m) / slowest)
        .fold(0.0, f64::max);
    1.1 * load_end_s + 1.05 * farthest
}

fn source(
    scene: &Scene,
    kernels: &KernelChoice,
    medium: &Medium,
) -> Result<Option<KernelSource>, ImpactError> {
    if scene.probes.is_empty() {
        return Ok(None);
    }
    Ok(Some(match kernels {
        KernelChoice::Direct => {
            let tolerance = (1e-3 * scene.contact.tolerance).clamp(1e-12, 1e-8);
            KernelSource::direct(medium, tolerance)?
        }
        KernelChoice::Table(table) => KernelSource::Table(Arc::clone(table)),
    }))
}

fn described(source: Option<&KernelSource>) -> (&'static str, Option<(String, String)>) {
    match source {
        None => ("none", None),
        Some(KernelSource::Direct(_)) => ("direct", None),
        Some(KernelSource::Table(table)) => (
            "table",
            Some((table.id().to_owned(), table.format_version().to_owned())),
        ),
    }
}

fn fields(
    scene: &Scene,
    source: &KernelSource,
    units: &KernelUnits,
    medium: &Medium,
    grid: &Grid,
    force_n: &[f64],
    force_error: f64,
) -> Result<Fields, ImpactError> {
    let radius = units.disc_radius_m;
    let peak = force_n.iter().fold(0.0_f64, |m, p| m.max(p.abs()));
    let (smoothness, sampling) = between_samples(force_n);
    let plan = CellPlan {
        step: grid.step_s / units.time_s(),
        coarsening: grid.coarsening,
        count: grid.count,
        smoothness,
        pulse_length: grid.pulse_s / units.time_s(),
    };
    let rows: Vec<_> = scene
        .probes
        .par_iter()
        .map(|probe| -> Result<_, ImpactError> {
            let place = Place {
                r: probe.r_m / radius,
                z: probe.z_m / radius,
                disc_radius_m: radius,
            };
            let cells = source.cells(medium.poisson_ratio(), place, plan)?;
            let arrivals = Arrivals::new(medium, Profile::Hertz, place.r, place.z)?;
            let direct = arrivals.above.unwrap_or([arrivals.p[0], arrivals.s[0]]);
            let first = [direct[0], direct[1], arrivals.rayleigh[0]];
            let values = convolve(&cells, force_n);
            let variation = cells.variation();
            let error: Six =
                std::array::from_fn(|f| cells.error[f] * peak + variation[f] * sampling);
            Ok((error, first.map(|t| t * units.time_s()), values))
        })
        .collect::<Result<_, _>>()?;
    let mut fields = Fields {
        r_m: scene.probes.iter().map(|p| p.r_m).collect(),
        z_m: scene.probes.iter().map(|p| p.z_m).collect(),
        arrival_s: Vec::new(),
        values: Default::default(),
        errors: Default::default(),
    };
    for (error, arrivals, values) in rows {
        fields.arrival_s.push(arrivals);
        for (f, mut samples) in values.into_iter().enumerate() {
            let unit = if f < 2 {
                units.displacement_m_per_n()
            } else {
                units.stress_pa_per_n()
            };
            let mut largest = 0.0_f64;
            for value in &mut samples {
                *value *= unit;
                largest = largest.max(value.abs());
            }
            fields.errors[f].push(error[f] * unit + force_error * largest);
            fields.values[f].push(samples);
        }
    }
    Ok(fields)
}

/// A prescribed force: no striker, only fields.
fn prescribed(
    scene: &Scene,
    force: &PrescribedForce,
    kernels: &KernelChoice,
) -> Result<Outcome, ImpactError> {
    let medium = Medium::new(scene.target.poisson_ratio)?;
    // the reader has made sure that the disc is given
    let disc_radius_m = scene.contact.disc_radius_m.unwrap_or(1.0);
    let nu = scene.target.poisson_ratio;
    let modulus = scene.target.shear_modulus_pa();
    let units = KernelUnits {
        disc_radius_m,
        longitudinal_speed_m_s: (modulus * (2.0 - 2.0 * nu)
            / (1.0 - 2.0 * nu)
            / scene.target_density_kg_m3)
            .sqrt(),
        shear_modulus_pa: modulus,
    };
    let source = source(scene, kernels, &medium)?;
    let end_s = force.end_s();
    let start_s = force.time_s.first().copied().unwrap_or(0.0);
    let pulse_s = (end_s - start_s).max(f64::MIN_POSITIVE);
    let grid = Grid::new(scene, source.as_ref(), &units, &medium, end_s, pulse_s)?;
    let time_s: Vec<f64> = (0..grid.count).map(|i| i as f64 * grid.step_s).collect();
    let force_n: Vec<f64> = time_s.iter().map(|&t| force.at(t)).collect();
    let response = SurfaceResponse::new(&medium, scene.contact.deflection);
    let deflection_m = surface_deflection(scene, &response, &units, &grid, &force_n);
    let fields = match &source {
        Some(source) => Some(fields(
            scene, source, &units, &medium, &grid, &force_n, 0.0,
        )?),
        None => None,
    };
    let mut notes = Vec::new();
    let gap = force
        .time_s
        .windows(2)
        .map(|t| t[1] - t[0])
        .fold(f64::INFINITY, f64::min);
    if gap < grid.step_s {
        notes.push(format!(
            "samples of the force are as close as {gap:.3e} s, the output step is {:.3e} s: steeper parts are smoothed over a step; give a smaller contact.step_s",
            grid.step_s
        ));
    }
    if force.force_n.iter().any(|&p| p < 0.0) {
        notes.push("the force is negative in places: it pulls there".to_owned());
    }
    let mut peak = (0.0, 0.0);
    let mut impulse_n_s = 0.0;
    for (&t, &p) in force.time_s.iter().zip(&force.force_n) {
        if p > peak.1 {
            peak = (t, p);
        }
    }
    for (t, p) in force.time_s.windows(2).zip(force.force_n.windows(2)) {
        impulse_n_s += 0.5 * (t[1] - t[0]) * (p[0] + p[1]);
    }
    let (kernel, table) = described(source.as_ref());
    Ok(Outcome {
        choices: Choices {
            model: "prescribed",
            scheme: CLOSED_FORM,
            static_share: name_of(&SHARES, StaticShare::Full),
            deflection: name_of(&DEFLECTIONS, scene.contact.deflection),
            reason: "the force is given".to_owned(),
        },
        kernel,
        table,
        march_steps: 0,
        march_step_s: grid.step_s,
        results: Results {
            peak_force_n: peak.1,
            peak_force_time_s: peak.0,
            contact_time_s: pulse_s,
            rebound_velocity_m_s: 0.0,
            restitution: 0.0,
            peak_displacement_m: 0.0,
            peak_deflection_m: deflection_m.iter().copied().fold(0.0, f64::max),
            impulse_n_s,
            initial_energy_j: 0.0,
            radiated_energy_j: joules(&force_n, &deflection_m),
            energy_residual: 0.0,
            contacts: 0,
        },
        series: Series {
            displacement_m: vec![0.0; time_s.len()],
            velocity_m_s: vec![0.0; time_s.len()],
            time_s,
            force_n,
            deflection_m,
        },
        fields,
        disc_radius_m,
        relative_error_estimate: 0.0,
        warnings: notes,
        resolved_scene: scene.resolved(),
    })
}

/// int P dw in J.
fn joules(force_n: &[f64], deflection_m: &[f64]) -> f64 {
    work(force_n, deflection_m) / 2.5
}

/// Deflection of the disc under a sampled force, with the share that the scene asks for.
fn surface_deflection(
    scene: &Scene,
    response: &SurfaceResponse,
    units: &KernelUnits,
    grid: &Grid,
    force_n: &[f64],
) -> Vec<f64> {
    let weights = crate::march::Weights::new(response, grid.step_s, units.time_s());
    let static_m_per_n = response.static_compliance() * units.displacement_m_per_n();
    let share = scene.contact.static_share.factor();
    (0..force_n.len())
        .map(|n| static_m_per_n * (share * force_n[n] - weights.lagging(&force_n[..=n])))
        .collect()
}
