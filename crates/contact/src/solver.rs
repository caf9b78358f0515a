//! One contact: its model chosen, its scheme run. Single impacts, sweeps and charts all come through here.

use crate::choose::Family;
use crate::collision::Collision;
use crate::disc::FixedDisc;
use crate::energy::radiated;
use crate::error::ContactError;
use crate::law::area_dashpot::AreaDashpot;
use crate::law::hertz;
use crate::law::pulse::pulse;
use crate::law::radiation::damped_force;
use crate::march::fine::march_finely;
use crate::march::growing::march_growing;
use crate::march::history::History;
use crate::march::refine::Accuracy;
use crate::march::workspace::Workspace;
use crate::plan::{Plan, accuracy, disc_radius_m, plan};
use crate::response::disc::DiscResponse;
use crate::response::punch::PunchResponse;
use crate::response::shelf::Responses;
use crate::schemes::{Found, explicit, solve_disc, stepped};
use crate::settings::{Model, Scheme, Settings};
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

/// Samples over a contact of a history that was not marched, and of one that has its pieces too.
const SAMPLES: f64 = 4096.0;
const GROWING_SAMPLES: f64 = 256.0;

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

    /// The results and the history of a contact: the deflection to the tolerance too, and the force at each instant with an
    /// error of its own, [`History::error`].
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
        let duration = solved.summary.contact_time;
        let mut history = match (&self.growing, solved.scheme) {
            (Some(growing), _) => growing.history(duration / GROWING_SAMPLES),
            (None, Some(Scheme::Implicit))
                if solved.plan.model == Model::Wave && settings.step_s.is_none() =>
            {
                let disc = self.disc(collision.target_poisson_ratio, settings.deflection)?;
                let impact = disc_of(collision, settings, &*disc);
                march_finely(&impact, duration, settings.tolerance)
                    .ok()
                    .filter(|fine| fine.error <= solved.error.max(settings.tolerance))
                    .unwrap_or_else(|| self.workspace.history.clone())
            }
            (None, Some(_)) => self.workspace.history.clone(),
            (None, None) if solved.plan.model == Model::AreaDashpot => {
                self.dashpot(collision)?.history(duration / SAMPLES)
            }
            (None, None) => {
                let force = damped_force(solved.plan.coupling(), solved.plan.damping());
                pulse(force, 0.0, &solved.summary, duration / SAMPLES)
            }
        };
        if history.error.is_infinite() {
            history.error = solved.error;
        }
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
        let step = settings
            .step_s
            .map(|step_s| step_s / collision.units().time_s);
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
            ) => (None, plan.closed_form()?.into()),
            (Model::AreaDashpot, _) => {
                let terms = self.dashpot(collision)?;
                (None, plan.dashpot(&terms)?.into())
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
        remembered(&mut self.waves, ratio, || self.responses.waves(ratio))
    }

    fn punch(&mut self, ratio: f64) -> Result<Arc<PunchResponse>, DomainError> {
        remembered(&mut self.punch, ratio, || self.responses.punch(ratio))
    }
}

/// What belongs to a Poisson's ratio, made where the last one was another.
fn remembered<T>(
    last: &mut Option<(u64, Arc<T>)>,
    ratio: f64,
    make: impl FnOnce() -> Result<Arc<T>, DomainError>,
) -> Result<Arc<T>, DomainError> {
    match last {
        Some((bits, made)) if *bits == ratio.to_bits() => Ok(Arc::clone(made)),
        Some(_) | None => {
            let made = make()?;
            *last = Some((ratio.to_bits(), Arc::clone(&made)));
            Ok(made)
        }
    }
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
