//! One contact: its model chosen, its scheme run. Single impacts, sweeps and charts all come through here.

use crate::choose::Family;
use crate::collision::Collision;
use crate::disc::FixedDisc;
use crate::energy::radiated;
use crate::error::ContactError;
use crate::law::area_dashpot::AreaDashpot;
use crate::law::hertz;
use crate::law::pulse::pulse;
use crate::law::quasi_static::expected_contact_time;
use crate::law::radiation::damped_force;
use crate::march::error::MarchError;
use crate::march::explicit::march_explicit;
use crate::march::growing::march_growing;
use crate::march::history::History;
use crate::march::implicit::march_into;
use crate::march::refine::{Accuracy, halve};
use crate::march::workspace::Workspace;
use crate::plan::{Plan, accuracy, disc_radius_m, plan};
use crate::response::disc::DiscResponse;
use crate::response::punch::PunchResponse;
use crate::response::shelf::Responses;
use crate::settings::{Model, Scheme, Settings, StaticShare};
use crate::spectral::solved::SolvedContact;
use crate::spectral::waves::PunchWaves;
use crate::spectral::{GrowingContact, GrowingError, solve_growing, work_on_half_space};
use crate::summary::Summary;
use crate::surface::Surface;
use crate::well_posed;
use crate::work::work;
use halfspace::{Deflection, DomainError, Medium, SurfaceResponse};
use std::sync::Arc;

/// A contact solved, in collision units.
#[derive(Debug, Clone, PartialEq)]
pub struct Solved {
    /// The model and its groups.
    pub plan: Plan,
    /// The scheme; none where nothing was marched.
    pub scheme: Option<Scheme>,
    /// Results.
    pub summary: Summary,
    /// Estimated relative error of peak force, contact time, restitution and displacement.
    pub error: f64,
    /// Step of the finest march; none without a march.
    pub step: Option<f64>,
}

/// Solves contacts one after the other with responses from a shelf; one for each thread.
#[derive(Debug)]
pub struct Solver<'a, S: Responses> {
    responses: &'a S,
    workspace: Workspace,
    disc: Option<(u64, Arc<S::Disc>)>,
    punch: Option<(u64, Arc<PunchResponse>)>,
    waves: Option<(u64, Arc<PunchWaves>)>,
    /// The contact solved last, where it was one that follows the load and was not marched.
    growing: Option<SolvedContact>,
}

/// Samples over a contact of a history that was not marched.
const SAMPLES: f64 = 4096.0;

/// Steps over a contact of the explicit scheme when none is given.
const EXPLICIT_STEPS: f64 = 200.0;

impl<'a, S: Responses> Solver<'a, S> {
    /// With a shelf of responses.
    #[must_use]
    pub fn new(responses: &'a S) -> Self {
        Self {
            responses,
            workspace: Workspace::default(),
            disc: None,
            punch: None,
            waves: None,
            growing: None,
        }
    }

    /// The results of a contact.
    ///
    /// # Errors
    /// [`ContactError`].
    pub fn solve(
        &mut self,
        collision: &Collision,
        settings: &Settings,
    ) -> Result<Solved, ContactError> {
        self.solve_to(collision, settings, accuracy(settings))
    }

    /// The results and the samples of a contact, the deflection to the tolerance too.
    ///
    /// # Errors
    /// [`ContactError`].
    pub fn solve_with_history(
        &mut self,
        collision: &Collision,
        settings: &Settings,
    ) -> Result<(Solved, History), ContactError> {
        let asked = Accuracy {
            deflection: Some(settings.tolerance),
            ..accuracy(settings)
        };
        let solved = self.solve_to(collision, settings, asked)?;
        let history = match (&self.growing, solved.scheme) {
            (Some(growing), _) => growing.history(solved.summary.contact_time / SAMPLES),
            (None, Some(_)) => self.workspace.history.clone(),
            (None, None) if solved.plan.model == Model::AreaDashpot => {
                let terms = self.dashpot(collision)?;
                terms.history(solved.summary.contact_time / SAMPLES)
            }
            (None, None) => {
                let force = damped_force(solved.plan.coupling(), solved.plan.damping());
                pulse(
                    force,
                    0.0,
                    &solved.summary,
                    solved.summary.contact_time / SAMPLES,
                )
            }
        };
        Ok((solved, history))
    }

    /// Work that the contact solved last has left in the half-space as waves, relative to the kinetic energy before.
    ///
    /// Where it was marched or followed it comes from the force and the half-space's waves, not from the momentum:
    /// on a disc the work on the mean deflection, in a growing contact that on its punches. Within 1e-3 of itself at a
    /// tolerance of 1e-4, 2e-5 at 1e-6; only a growing contact with a uniform step has the work of its march, of the
    /// march's order. A closed form has its loss.
    ///
    /// # Errors
    /// [`DomainError`] for a Poisson's ratio outside the physics.
    pub fn radiated(
        &mut self,
        collision: &Collision,
        settings: &Settings,
        solved: &Solved,
    ) -> Result<f64, DomainError> {
        Ok(match (solved.plan.model, solved.scheme) {
            (_, None) => solved.summary.loss,
            (Model::Growing, Some(_)) => {
                let waves = self.waves(collision.target_poisson_ratio)?;
                let contact = following(collision, &waves);
                let history = &self.workspace.history;
                match &self.growing {
                    Some(growing) => work_on_half_space(&contact, growing, settings.tolerance),
                    None => work(&history.force, &history.deflection),
                }
            }
            (
                Model::Hertz
                | Model::Radiation
                | Model::AreaDashpot
                | Model::QuasiStatic
                | Model::QuasiStaticRadiation
                | Model::Wave
                | Model::Auto,
                Some(_),
            ) => {
                let ratio = collision.target_poisson_ratio;
                let mean = self.responses.disc(ratio, Deflection::Mean)?;
                let own = self.disc(ratio, settings.deflection)?;
                let impact = disc_of(collision, settings, &*own);
                let history = &self.workspace.history;
                radiated(&impact, &*mean, history, solved.summary.contact_time)
            }
        })
    }

    fn solve_to(
        &mut self,
        collision: &Collision,
        settings: &Settings,
        asked: Accuracy,
    ) -> Result<Solved, ContactError> {
        collision.check()?;
        let ratio = collision.target_poisson_ratio;
        let disc = self.disc(ratio, settings.deflection)?;
        let plan = plan(settings, collision, &Surface::of(&*disc));
        let time_s = collision.units().time_s;
        let step = settings.step_s.map(|step_s| step_s / time_s);
        self.growing = None;
        let is_disc = matches!(plan.groups.family, Family::Full | Family::Dynamic);
        let is_wave = matches!(settings.model, Model::Wave | Model::Auto);
        if is_disc && is_wave && settings.scheme == Scheme::Implicit {
            let impact = disc_of(collision, settings, &*disc);
            well_posed::check(&impact, &mut self.workspace)?;
        }
        let (scheme, found) = match (plan.model, settings.scheme) {
            (
                Model::Hertz | Model::Radiation | Model::QuasiStatic | Model::QuasiStaticRadiation,
                _,
            ) => {
                let closed = plan.closed_form()?;
                let found = Found {
                    summary: closed.summary,
                    error: closed.error,
                    step: None,
                };
                (None, found)
            }
            (Model::AreaDashpot, _) => {
                let terms = self.dashpot(collision)?;
                let closed = plan.dashpot(&terms)?;
                let found = Found {
                    summary: closed.summary,
                    error: closed.error,
                    step: None,
                };
                (None, found)
            }
            (Model::Growing, _) => {
                let followed = match step {
                    None => self.follow(collision, &asked)?,
                    Some(_) => None,
                };
                let found = match followed {
                    Some(found) => found,
                    None => self.march_growing(collision, step, asked)?,
                };
                (Some(Scheme::Implicit), found)
            }
            (Model::Wave | Model::Auto, Scheme::Implicit) => {
                let impact = disc_of(collision, settings, &*disc);
                let found = solve_disc(&mut self.workspace, &impact, step, asked)?;
                (Some(Scheme::Implicit), found)
            }
            (Model::Wave | Model::Auto, Scheme::Explicit) => {
                let response = SurfaceResponse::new(&Medium::new(ratio)?, settings.deflection);
                let impact = disc_of(collision, settings, &response);
                (
                    Some(Scheme::Explicit),
                    explicit(&mut self.workspace, &impact, step)?,
                )
            }
        };
        Ok(Solved {
            plan,
            scheme,
            summary: found.summary,
            error: found.error,
            step: found.step,
        })
    }

    fn disc(&mut self, ratio: f64, deflection: Deflection) -> Result<Arc<S::Disc>, DomainError> {
        if let Some((bits, disc)) = &self.disc
            && *bits == ratio.to_bits()
            && disc.deflection() == deflection
        {
            return Ok(Arc::clone(disc));
        }
        let disc = self.responses.disc(ratio, deflection)?;
        self.disc = Some((ratio.to_bits(), Arc::clone(&disc)));
        Ok(disc)
    }

    /// The terms of the expansion in the memory of a contact that follows the load.
    fn dashpot(&mut self, collision: &Collision) -> Result<AreaDashpot, DomainError> {
        let waves = self.waves(collision.target_poisson_ratio)?;
        let (target_share, wave_time) = (collision.target_share(), collision.contact_wave_time());
        Ok(AreaDashpot::new(target_share, wave_time, &waves))
    }

    /// A contact that follows the load by polynomial pieces; nothing where they do not serve: with a memory as long as
    /// the contact, or a second contact.
    fn follow(
        &mut self,
        collision: &Collision,
        asked: &Accuracy,
    ) -> Result<Option<Found>, ContactError> {
        let waves = self.waves(collision.target_poisson_ratio)?;
        let contact = following(collision, &waves);
        self.growing = match solve_growing(&contact, asked) {
            Ok(solved) => Some(solved),
            // the march has other limits: a memory far shorter than the contact is one to it
            Err(
                GrowingError::Overtaken { .. }
                | GrowingError::StrikesAgain { .. }
                | GrowingError::NotConverged { .. },
            ) => None,
            Err(error) => return Err(error.into()),
        };
        Ok(self.growing.as_ref().map(|growing| Found {
            summary: *growing.summary(),
            error: growing.estimates().contact(),
            step: None,
        }))
    }

    /// The same contact with a uniform step.
    fn march_growing(
        &mut self,
        collision: &Collision,
        step: Option<f64>,
        asked: Accuracy,
    ) -> Result<Found, ContactError> {
        let punch = self.punch(collision.target_poisson_ratio)?;
        let impact = collision.growing_disc(&punch);
        let room = &mut self.workspace;
        Ok(stepped(
            room,
            step,
            (hertz::CONTACT_TIME, 1.0),
            asked,
            |step, room| {
                room.history = march_growing(&impact, step)?;
                Ok(())
            },
        )?)
    }

    fn waves(&mut self, ratio: f64) -> Result<Arc<PunchWaves>, DomainError> {
        if let Some((bits, waves)) = &self.waves
            && *bits == ratio.to_bits()
        {
            return Ok(Arc::clone(waves));
        }
        let waves = self.responses.waves(ratio)?;
        self.waves = Some((ratio.to_bits(), Arc::clone(&waves)));
        Ok(waves)
    }

    fn punch(&mut self, ratio: f64) -> Result<Arc<PunchResponse>, DomainError> {
        if let Some((bits, punch)) = &self.punch
            && *bits == ratio.to_bits()
        {
            return Ok(Arc::clone(punch));
        }
        let punch = self.responses.punch(ratio)?;
        self.punch = Some((ratio.to_bits(), Arc::clone(&punch)));
        Ok(punch)
    }
}

/// Times that the last change over a halving counts for the dynamic share.
const DYNAMIC_CAUTION: f64 = 3.0;

/// Results of a scheme, in collision units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Results.
    pub summary: Summary,
    /// Estimated relative error of peak force, contact time, restitution and displacement.
    pub error: f64,
    /// Step of the finest march; none without a march.
    pub step: Option<f64>,
}

/// An impact on a disc by the implicit scheme: with a step that is given, or halved until the results are as accurate
/// as asked.
///
/// # Errors
/// [`MarchError`].
pub fn solve_disc(
    workspace: &mut Workspace,
    impact: &FixedDisc<'_, impl DiscResponse>,
    step: Option<f64>,
    asked: Accuracy,
) -> Result<Found, MarchError> {
    let duration = expected_contact_time(impact.static_coupling());
    let caution = match impact.share {
        StaticShare::Full => 1.0,
        // the newest force is only just held by the contact law, and errors grow with it
        StaticShare::Dynamic => DYNAMIC_CAUTION,
    };
    let begin = (duration, caution);
    stepped(workspace, step, begin, asked, |step, workspace| {
        march_into(impact, step, &mut workspace.weights, &mut workspace.history)
    })
}

fn following<'w>(collision: &Collision, waves: &'w PunchWaves) -> GrowingContact<'w> {
    GrowingContact {
        waves,
        target_share: collision.target_share(),
        wave_time: collision.contact_wave_time(),
    }
}

fn disc_of<'r, R: DiscResponse>(
    collision: &Collision,
    settings: &Settings,
    response: &'r R,
) -> FixedDisc<'r, R> {
    let radius_m = disc_radius_m(settings, collision);
    collision.fixed_disc(response, radius_m, settings.static_share)
}

/// A march with a step that is given, judged by one with half of it, or halved until the results are as accurate as asked.
///
/// `duration` and `caution`: of the contact, roughly, and how many times the last change counts.
///
/// The workspace keeps the history of the step that counts.
fn stepped(
    workspace: &mut Workspace,
    step: Option<f64>,
    (duration, caution): (f64, f64),
    asked: Accuracy,
    march: impl Fn(f64, &mut Workspace) -> Result<(), MarchError>,
) -> Result<Found, MarchError> {
    let mut run = |step: f64| {
        march(step, workspace)?;
        Summary::new(&workspace.history)
    };
    if let Some(step) = step {
        let finer = run(0.5 * step)?;
        let summary = run(step)?;
        return Ok(Found {
            summary,
            error: summary.distance(&finer) * 4.0 / 3.0,
            step: Some(step),
        });
    }
    let found = halve(
        |step| Ok((run(step)?, ())),
        duration / asked.first_steps(),
        &asked,
        caution,
    )?;
    Ok(Found {
        summary: found.summary,
        error: found.error,
        step: Some(found.step),
    })
}

fn explicit(
    workspace: &mut Workspace,
    impact: &FixedDisc<'_, SurfaceResponse>,
    step: Option<f64>,
) -> Result<Found, MarchError> {
    let step =
        step.unwrap_or_else(|| expected_contact_time(impact.static_coupling()) / EXPLICIT_STEPS);
    let (history, summary) = march_explicit(impact, step)?;
    let (_, finer) = march_explicit(impact, 0.5 * step)?;
    workspace.history = history;
    Ok(Found {
        summary,
        // first order: the rest is as large as the change over one halving
        error: 2.0 * summary.distance(&finer),
        step: Some(step),
    })
}
