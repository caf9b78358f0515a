//! The contact of one scene, with its history.

use super::ImpactError;
use super::plan::{Plan, accuracy, disc_radius_m, plan};
use crate::contact::quasi_static::expected_contact_time;
use crate::contact::radiation::march_radiation;
use crate::contact::{Collision, Surface, hertz};
use crate::energy::{radiated, work};
use crate::march::{
    Accuracy, FixedDisc, History, MarchError, PunchResponse, StaticShare, Summary, march_explicit,
    march_growing, march_implicit, refine,
};
use crate::scene::{Contact, Model, SCHEMES, Scene, Scheme, Striker, name_of};
use halfspace::{Deflection, Medium, SurfaceResponse};

/// A contact computed, still in collision units.
pub(super) struct Run {
    pub(super) model: Model,
    pub(super) scheme: &'static str,
    pub(super) reason: String,
    pub(super) history: History,
    pub(super) summary: Summary,
    pub(super) error: f64,
    pub(super) radiated: f64,
    pub(super) steps: usize,
}

/// Scheme of the models that need no march.
pub(super) const CLOSED_FORM: &str = "closed form";

/// Chooses the model and runs it.
pub(super) fn contact_run(
    scene: &Scene,
    striker: &Striker,
    collision: &Collision,
    response: &SurfaceResponse,
    medium: &Medium,
) -> Result<Run, ImpactError> {
    let contact = &scene.contact;
    let plan = plan(contact, striker, collision, &Surface::from(response));
    let mut run = match plan.model {
        Model::Hertz | Model::Radiation | Model::QuasiStatic | Model::QuasiStaticRadiation => {
            closed_run(contact, &plan)?
        }
        Model::Growing => {
            let centre = SurfaceResponse::new(medium, Deflection::Centre);
            let punch = PunchResponse::new(&centre);
            let impact = collision.growing_disc(&punch);
            let march = |step| march_growing(&impact, step);
            let mut run = marched(contact, collision, hertz::CONTACT_TIME, march)?;
            run.radiated = work(&run.history.force, &run.history.deflection);
            run
        }
        Model::Wave | Model::Auto => {
            let disc = disc_radius_m(contact, striker);
            let impact = collision.fixed_disc(response, disc, contact.static_share);
            let mut run = match contact.scheme {
                Scheme::Implicit => {
                    let duration = expected_duration(&impact);
                    marched(contact, collision, duration, |step| {
                        march_implicit(&impact, step)
                    })?
                }
                Scheme::Explicit => explicit_run(contact, collision, &impact)?,
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
    run.model = plan.model;
    run.reason = plan.reason(contact);
    Ok(run)
}

fn expected_duration(impact: &FixedDisc<'_>) -> f64 {
    expected_contact_time(match impact.share {
        StaticShare::Full => impact.coupling,
        StaticShare::Dynamic => 0.0,
    })
}

/// The models without a march.
fn closed_run(contact: &Contact, plan: &Plan) -> Result<Run, ImpactError> {
    let found = plan.closed_form()?;
    let coupling = plan.coupling();
    let duration = expected_contact_time(coupling);
    let step = duration / accuracy(contact).first_steps().max(100.0);
    Ok(Run {
        model: plan.model,
        scheme: CLOSED_FORM,
        reason: String::new(),
        steps: 0,
        history: march_radiation(coupling, plan.damping(), step),
        radiated: found.summary.loss,
        summary: found.summary,
        error: found.error,
    })
}

fn marched(
    contact: &Contact,
    collision: &Collision,
    duration: f64,
    march: impl Fn(f64) -> Result<History, MarchError>,
) -> Result<Run, ImpactError> {
    let (history, summary, error) = match contact.step_s {
        Some(step_s) => {
            let step = step_s / collision.units().time_s;
            let history = march(step)?;
            let summary = Summary::new(&history)?;
            let finer = Summary::new(&march(0.5 * step)?)?;
            (history, summary, summary.distance(&finer) * 4.0 / 3.0)
        }
        None => {
            let accuracy = Accuracy {
                deflection: Some(contact.tolerance),
                ..accuracy(contact)
            };
            let step = duration / accuracy.first_steps();
            let refined = refine(march, step, accuracy)?;
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
    contact: &Contact,
    collision: &Collision,
    impact: &FixedDisc<'_>,
) -> Result<Run, ImpactError> {
    let step = match contact.step_s {
        Some(step_s) => step_s / collision.units().time_s,
        None => expected_duration(impact) / EXPLICIT_STEPS,
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
