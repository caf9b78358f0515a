//! One contact: its model chosen, its scheme run. Single impacts, sweeps and charts all come through here.

use crate::collision::Collision;
use crate::disc::history::History;
use crate::disc::refine::{
    Accuracy, Found, Workspace, explicit, march_finely, solve_disc, stepped,
};
use crate::disc::response::DiscResponse;
use crate::disc::{FixedDisc, stability};
use crate::energy::{radiated, work};
use crate::error::ContactError;
use crate::growing::solved::SolvedContact;
use crate::growing::uniform::march_growing;
use crate::growing::waves::PunchWaves;
use crate::growing::work::work_on_half_space;
use crate::growing::{GrowingError, solve_growing};
use crate::law::area_dashpot::AreaDashpot;
use crate::law::hertz;
use crate::law::pulse::pulse;
use crate::law::radiation::damped_force;
use crate::model::choose::{Family, Plan, accuracy, disc_radius_m, plan};
use crate::model::{Model, Rung, Scheme, Settings};
use crate::plastic::Yielding;
use crate::plastic::problem::Waves;
use crate::plastic::quick::quick;
use crate::plastic::solved::{Flow, YieldedContact};
use crate::responses::Responses;
use crate::summary::Summary;
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
    /// What has flowed; none of a contact that has not yielded.
    pub flow: Option<Flow>,
}

/// Solves contacts one after the other with responses from a cache; one for each thread.
#[derive(Debug)]
pub struct Solver<'a, S: Responses> {
    responses: &'a S,
    workspace: Workspace,
    disc: Latest<(u64, Deflection), S::Disc>,
    waves: Latest<u64, PunchWaves>,
    /// The contact solved last, where it was one that follows the load and was not marched.
    growing: Option<SolvedContact>,
    /// The same of one that has yielded.
    yielded: Option<YieldedContact>,
}

/// Samples over a contact of a history that was not marched, and of one that has its pieces too.
const SAMPLES: f64 = 4096.0;
const GROWING_SAMPLES: f64 = 256.0;

/// Error of a piece of a yielding contact with memory over the tolerance, the least, and that without memory.
const PIECE: f64 = 0.3;
const FINEST: f64 = 1e-10;
const FINE: f64 = 1e-9;

impl<'a, S: Responses> Solver<'a, S> {
    /// With a cache of responses.
    #[must_use]
    pub fn new(responses: &'a S) -> Self {
        Self {
            responses,
            workspace: Workspace::default(),
            disc: None,
            waves: None,
            growing: None,
            yielded: None,
        }
    }

    /// The results of a contact.
    pub fn solve(
        &mut self,
        collision: &Collision,
        settings: &Settings,
    ) -> Result<Solved, ContactError> {
        self.solve_to(collision, settings, accuracy(settings))
    }

    /// The results and the history of a contact: the deflection to the tolerance too, and the force at each instant with an
    /// error of its own, [`History::error`].
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
        if let Some(yielded) = &self.yielded {
            let history = History::of_yielded(yielded, duration / GROWING_SAMPLES, solved.error);
            return Ok((solved, history));
        }
        let mut history = match (&self.growing, solved.scheme) {
            (Some(growing), _) => History::of_pieces(growing, duration / GROWING_SAMPLES),
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
        if let Some(flow) = &solved.flow {
            return Ok(flow.radiated);
        }
        Ok(match (solved.plan.model.row(), solved.scheme) {
            (_, None) => solved.summary.loss,
            ((_, false), Some(_)) => {
                let waves = self.waves(collision.target_poisson_ratio)?;
                let contact = collision.growing_contact(&waves);
                let history = &self.workspace.history;
                match &self.growing {
                    Some(growing) => work_on_half_space(&contact, growing, settings.tolerance),
                    None => work(&history.force, &history.deflection),
                }
            }
            ((_, true), Some(_)) => {
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
        self.growing = None;
        self.yielded = None;
        if let Some(yielding) = collision.yielding(settings)?.filter(Yielding::begins) {
            let plan = plan(settings, collision, &*disc, true);
            if let Some(solved) = self.yielded(collision, &yielding, plan, &asked)? {
                return Ok(solved);
            }
        }
        let plan = plan(settings, collision, &*disc, false);
        let step = settings
            .step_s
            .map(|step_s| step_s / collision.units().time_s);
        let is_disc = matches!(plan.groups.family, Family::Full | Family::Dynamic);
        let is_wave = matches!(settings.model, Model::Wave | Model::Auto);
        if is_disc && is_wave && settings.scheme == Scheme::Implicit {
            let impact = disc_of(collision, settings, &*disc);
            stability::check(&impact, &mut self.workspace)?;
        }
        let (scheme, found) = match (plan.model.row(), settings.scheme) {
            ((Rung::QuasiStatic | Rung::Radiation, _), _) => (None, plan.closed_form()?),
            ((Rung::AreaDashpot, _), _) => (None, plan.dashpot(&self.dashpot(collision)?)?),
            ((Rung::FullMemory, false), _) => {
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
            ((Rung::FullMemory, true), Scheme::Implicit) => {
                let impact = disc_of(collision, settings, &*disc);
                let found = solve_disc(&mut self.workspace, &impact, step, asked)?;
                (Some(Scheme::Implicit), found)
            }
            ((Rung::FullMemory, true), Scheme::Explicit) => {
                let response = SurfaceResponse::new(&Medium::new(ratio)?, settings.deflection);
                let impact = disc_of(collision, settings, &response);
                let found = explicit(&mut self.workspace, &impact, step)?;
                (Some(Scheme::Explicit), found)
            }
        };
        Ok(Solved {
            plan,
            scheme,
            summary: found.summary,
            error: found.error,
            step: found.step,
            flow: None,
        })
    }

    /// A contact that yields; nothing where waves keep it from doing so.
    fn yielded(
        &mut self,
        collision: &Collision,
        yielding: &Yielding,
        mut plan: Plan,
        asked: &Accuracy,
    ) -> Result<Option<Solved>, ContactError> {
        let left_out = plan.groups.left_out();
        let automatic = plan.is_automatic();
        let mut found = None;
        if plan.model.row().0 == Rung::FullMemory {
            let punch = self.waves(collision.target_poisson_ratio)?;
            let waves = Waves::Memory(collision.growing_contact(&punch));
            let finest = PIECE * asked.tolerance;
            // a stiff striker's last instants may need finer pieces
            found = follow(
                yielding,
                waves,
                [1.0, 0.1, 0.01].map(|part| (part * finest).max(FINEST)),
            );
            if found.is_none() && !automatic {
                return Err(ContactError::NotFollowed);
            }
            if found.is_none() {
                plan.model = Model::AreaDashpot;
            }
        }
        let with_memory = found.is_some();
        let radiates = plan.model.row().0 != Rung::QuasiStatic;
        let lag = if radiates { plan.groups.lag } else { 0.0 };
        let mut results = None;
        if !with_memory {
            results = quick(yielding, lag);
            // the history of a single impact
            if results.is_none() || asked.deflection.is_some() {
                let waves = Waves::Dashpot(lag);
                // rounding may be in the way of fine pieces
                found = follow(yielding, waves, [FINE, 10.0 * FINE, 100.0 * FINE]);
                if found.is_none() {
                    return Err(ContactError::NotFollowed);
                }
            }
        }
        let contact = found.as_ref();
        let Some((summary, flow)) =
            results.or_else(|| contact.map(|one| (*one.summary(), *one.flow())))
        else {
            return Ok(None);
        };
        if flow.plastic_work <= 0.0 {
            return Ok(None);
        }
        let error = match plan.model.row().0 {
            Rung::QuasiStatic => plan.groups.first_order_loss() + left_out.contact,
            Rung::Radiation | Rung::AreaDashpot => left_out.contact,
            Rung::FullMemory => contact.map_or(0.0, YieldedContact::error),
        };
        let solved = Solved {
            plan,
            scheme: with_memory.then_some(Scheme::Implicit),
            summary,
            error: error.min(1.0),
            step: None,
            flow: Some(flow),
        };
        self.yielded = found;
        Ok(Some(solved))
    }

    fn disc(&mut self, ratio: f64, deflection: Deflection) -> Result<Arc<S::Disc>, DomainError> {
        let made = || self.responses.disc(ratio, deflection);
        remembered(&mut self.disc, (ratio.to_bits(), deflection), made)
    }

    fn waves(&mut self, ratio: f64) -> Result<Arc<PunchWaves>, DomainError> {
        remembered(&mut self.waves, ratio.to_bits(), || {
            self.responses.waves(ratio)
        })
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
        let contact = collision.growing_contact(&waves);
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
        let waves = self.waves(collision.target_poisson_ratio)?;
        let contact = collision.growing_contact(&waves);
        let room = &mut self.workspace;
        Ok(stepped(
            room,
            step,
            (hertz::CONTACT_TIME, 1.0),
            asked,
            |step, room| {
                room.history = march_growing(&contact, step)?;
                Ok(())
            },
        )?)
    }
}

/// A yielding contact followed with the first of some errors of its pieces that serves.
fn follow(yielding: &Yielding, waves: Waves<'_>, errors: [f64; 3]) -> Option<YieldedContact> {
    let mut tries = errors.into_iter();
    tries.find_map(|error| YieldedContact::follow(*yielding, waves, error).ok())
}

/// What was made last, with what it was made for.
type Latest<K, T> = Option<(K, Arc<T>)>;

/// What belongs to a key, made where the last one was another.
fn remembered<K: PartialEq, T>(
    latest: &mut Latest<K, T>,
    key: K,
    make: impl FnOnce() -> Result<Arc<T>, DomainError>,
) -> Result<Arc<T>, DomainError> {
    match latest {
        Some((last, made)) if *last == key => Ok(Arc::clone(made)),
        Some(_) | None => {
            let made = make()?;
            *latest = Some((key, Arc::clone(&made)));
            Ok(made)
        }
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
