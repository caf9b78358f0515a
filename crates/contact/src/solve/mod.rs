//! One contact: its model chosen, its scheme run. Single impacts, sweeps and charts all come through here.
//!
//! In reading order: `choose` the model, `outcome` the series that sweeps share.

// the outer count is a solver's own: threads that count together wait for each other
#![allow(clippy::redundant_allocation)]

pub(crate) mod choose;
pub(crate) mod outcome;

use crate::accuracy::{Accuracy, Found};
use crate::collision::Collision;
use crate::disc::radiated::radiated;
use crate::disc::refine::{explicit, march_finely, solve_disc};
use crate::disc::stability;
use crate::error::ContactError;
use crate::growing::dashpot::solve_springs;
use crate::growing::equations::March;
use crate::growing::quick::quick;
use crate::growing::solve_growing;
use crate::growing::solved::SolvedContact;
use crate::growing::work::work_on_half_space;
use crate::growing::yielding::DAMPED;
use crate::history::History;
use crate::law::area_dashpot::AreaDashpot;
use crate::law::yielding::{Flow, Yielding};
use crate::settings::{Memory, Model, Physics, Scheme, Settings};
use crate::solve::choose::{Chosen, accuracy, choose, disc_of};
use crate::solve::outcome::{Outcomes, Place};
use crate::summary::Summary;
use crate::waves::cache::{Exact, Responses};
use crate::waves::punch::PunchWaves;
use crate::waves::response::DiscResponse;
use halfspace::{Deflection, DomainError};
use std::sync::Arc;

/// A contact solved, in collision units.
#[derive(Debug, Clone, PartialEq)]
pub struct Solved {
    /// The model.
    pub chosen: Chosen,
    /// The scheme; none where nothing was marched.
    pub scheme: Option<Scheme>,
    /// Results.
    pub summary: Summary,
    /// Estimated relative error of peak force, contact time, restitution and displacement.
    pub error: f64,
    /// Step of the finest march; none without a march.
    pub step: Option<f64>,
    /// Work left in the half-space as waves, relative to the kinetic energy before.
    ///
    /// Where the contact was marched or followed it comes from the force and the half-space's waves, not from the momentum:
    /// on a disc the work on the mean deflection, in a growing contact that on its punches. Within 1e-3 of itself at a
    /// tolerance of 1e-4, 2e-5 at 1e-6. A closed form has its loss, a series of outcomes that of its marches.
    pub radiated: f64,
    /// What has flowed; none of a contact that has not yielded.
    pub flow: Option<Flow>,
}

impl Chosen {
    fn solved(self, scheme: Option<Scheme>, found: Found, radiated: f64) -> Solved {
        Solved {
            chosen: self,
            scheme,
            summary: found.summary,
            error: found.error,
            step: found.step,
            radiated,
            flow: None,
        }
    }
}

/// Solves contacts one after the other with responses from a cache; one for each thread.
#[derive(Debug)]
pub struct Solver<'a, S: Responses> {
    responses: &'a S,
    outcomes: Option<&'a Outcomes>,
    /// Of the latest march.
    history: History,
    /// What was made last, with the bits of its Poisson's ratio.
    disc: Option<(u64, Arc<Arc<S::Disc>>)>,
    waves: Option<(u64, Arc<Arc<PunchWaves>>)>,
    /// The contact solved last, where it was one that follows the load and was not marched.
    growing: Option<SolvedContact>,
}

/// Largest tolerance to which the history of an area dashpot is solved: its deflection, which is 1e-3 to 1e-1 of the
/// indentation, is within 1e-2 then, and its work within 1e-3 (`tests/history.rs`).
const COARSEST: f64 = 1e-4;

/// Error of a contact with memory that yields over the estimate of one that does not: 1.3 at most on 80 random pairs of metals.
const YIELDS: f64 = 2.0;

impl<'a, S: Responses> Solver<'a, S> {
    /// With a cache of responses.
    pub fn new(responses: &'a S) -> Self {
        Self {
            responses,
            outcomes: None,
            history: History::default(),
            disc: None,
            waves: None,
            growing: None,
        }
    }

    /// With a cache of responses, and series in place of marches where results alone are asked for.
    pub fn sharing(responses: &'a S, outcomes: &'a Outcomes) -> Self {
        Self {
            outcomes: Some(outcomes),
            ..Self::new(responses)
        }
    }

    /// The series that pay for so many contacts, of which some are given.
    pub fn outcomes(
        &mut self,
        contacts: usize,
        some: impl Iterator<Item = (Collision, Settings)>,
    ) -> Outcomes {
        let places = some.map(|(collision, settings)| self.place(&collision, &settings));
        Outcomes::of(contacts, places)
    }

    /// Where a contact lies among those that have series.
    fn place(&mut self, collision: &Collision, settings: &Settings) -> Option<Place> {
        collision.check().ok()?;
        let ratio = collision.target_poisson_ratio;
        let disc = self.disc(ratio, settings.deflection).ok()?;
        let yielding = collision.yielding(settings).ok()?.filter(Yielding::begins);
        let chosen = choose(settings, collision, &**disc, yielding.is_some());
        if let Some(yielding) = yielding {
            return Place::of_fit(&chosen, &yielding, settings);
        }
        Place::of(&chosen, collision, settings, &**disc)
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
        let mut history = match (&self.growing, solved.scheme) {
            (Some(growing), _) => History::of_pieces(growing),
            (None, Some(Scheme::Implicit)) if settings.step_s.is_none() => {
                let disc = self.disc(collision.target_poisson_ratio, settings.deflection)?;
                let impact = disc_of(settings, collision, &**disc);
                march_finely(&impact, duration, settings.tolerance)
                    .ok()
                    .filter(|fine| fine.error <= solved.error.max(settings.tolerance))
                    .unwrap_or_else(|| self.history.clone())
            }
            (None, Some(_)) => self.history.clone(),
            (None, None) => self.without_memory(collision, &solved.chosen, settings.tolerance)?,
        };
        if history.error.is_infinite() || solved.flow.is_some() {
            history.error = solved.error;
        }
        Ok((solved, history))
    }

    /// The history of an elastic contact on a half-space that answers at once.
    fn without_memory(
        &mut self,
        collision: &Collision,
        chosen: &Chosen,
        tolerance: f64,
    ) -> Result<History, ContactError> {
        match chosen.memory() {
            // its expansion has the results of the contact with memory, but not its first and last instants
            Memory::Dashpot => {
                let waves = self.waves(collision.target_poisson_ratio)?;
                let contact = collision.growing_contact(&waves);
                let asked = Accuracy::of_contact(tolerance.min(COARSEST), None);
                Ok(History::of_pieces(&solve_growing(&contact, &asked)?))
            }
            Memory::None | Memory::FirstOrder | Memory::Full => {
                let pieces = solve_springs(chosen.coupling(), chosen.damping())?;
                Ok(History {
                    // that of the results
                    error: f64::INFINITY,
                    ..History::of_pieces(&pieces)
                })
            }
        }
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
        let impact = || disc_of(settings, collision, &**disc);
        if let Some(yielding) = collision.yielding(settings)?.filter(Yielding::begins) {
            let chosen = choose(settings, collision, &**disc, true);
            if let Some(solved) = self.yielded(collision, settings, &yielding, chosen, &asked)? {
                return Ok(solved);
            }
        }
        let chosen = choose(settings, collision, &**disc, false);
        if let (Some(outcomes), None) = (self.outcomes, asked.deflection)
            && let Some(place) = Place::of(&chosen, collision, settings, &**disc)
            && let Some((summary, radiated, error)) = outcomes.at(&place, self.responses)
        {
            return Ok(chosen.solved(None, Found::new(summary, error, None), radiated));
        }
        let in_times = |step_s: f64| step_s / collision.units().time_s;
        let step = settings.step_s.map(in_times);
        let is_disc = match chosen.regime.physics {
            Physics::Disc(_) => true,
            Physics::Growing | Physics::Yielding => false,
        };
        if is_disc && settings.model.has_schemes() && settings.scheme == Scheme::Implicit {
            stability::check(&impact(), &mut self.history)?;
        }
        let (scheme, found, work) = match (chosen.memory(), chosen.regime.physics) {
            (Memory::None | Memory::FirstOrder, _) => (None, chosen.closed_form()?, None),
            (Memory::Dashpot, _) => (None, chosen.dashpot(&self.dashpot(collision)?)?, None),
            (Memory::Full, Physics::Growing | Physics::Yielding) => {
                let (found, work) = self.grow(collision, asked)?;
                (Some(Scheme::Implicit), found, Some(work))
            }
            (Memory::Full, Physics::Disc(_)) => {
                let room = &mut self.history;
                let found = match settings.scheme {
                    Scheme::Implicit => solve_disc(room, &impact(), step, asked)?,
                    Scheme::Explicit => {
                        let response = Exact.disc(ratio, settings.deflection)?;
                        explicit(room, &disc_of(settings, collision, &*response), step)?
                    }
                };
                let mean = self.responses.disc(ratio, Deflection::Mean)?;
                let duration = found.summary.contact_time;
                let work = radiated(&impact(), &*mean, &self.history, duration);
                (Some(settings.scheme), found, Some(work))
            }
        };
        let radiated = work.unwrap_or(found.summary.loss);
        Ok(chosen.solved(scheme, found, radiated))
    }

    /// A contact that yields; nothing where waves keep it from doing so.
    fn yielded(
        &mut self,
        collision: &Collision,
        settings: &Settings,
        yielding: &Yielding,
        mut chosen: Chosen,
        asked: &Accuracy,
    ) -> Result<Option<Solved>, ContactError> {
        if let Some(over) = yielding.trusted_ratio().filter(|_| !yielding.rebounds()) {
            let velocity_m_s = collision.velocity_m_s;
            let trusted_m_s = velocity_m_s / over;
            return Err(ContactError::NoRebound {
                velocity_m_s,
                trusted_m_s,
            });
        }
        let follows_memory = match chosen.memory() {
            Memory::None | Memory::FirstOrder | Memory::Dashpot => false,
            Memory::Full => true,
        };
        if follows_memory {
            let waves = self.waves(collision.target_poisson_ratio)?;
            let contact = collision.growing_contact(&waves);
            match yielding.remembered(&contact, asked) {
                Ok(found) => self.growing = found,
                Err(_) if chosen.by_auto.is_some() => chosen.model = Model::AreaDashpot,
                Err(error) => return Err(error.into()),
            }
        }
        let (_, [left_out, _]) = chosen.regime.without_memory();
        let first_order_loss = chosen.regime.first_order_loss();
        let (lag, memory) = match chosen.memory() {
            Memory::None => (0.0, false),
            Memory::FirstOrder | Memory::Dashpot => (chosen.regime.lag, false),
            Memory::Full => (chosen.regime.lag, true),
        };
        // the history of a single impact has its results too
        let alone = !memory && asked.deflection.is_none();
        let series = || {
            let place = Place::of_fit(&chosen, yielding, settings)?;
            let (summary, radiated, error) = self.outcomes?.at(&place, self.responses)?;
            let works = [summary.loss - radiated, radiated];
            let flow = Flow::new(yielding, summary.peak_displacement.sqrt(), works);
            Some((summary, flow, error))
        };
        let quickly = || quick(yielding, lag).map(|(summary, flow)| (summary, flow, 0.0));
        let results = alone.then(|| series().or_else(quickly)).flatten();
        if !memory && results.is_none() {
            let lost = |_| ContactError::NotFollowed;
            self.growing = March::damped(lag, DAMPED).follow(yielding).map_err(lost)?;
        }
        let followed = self.growing.as_ref();
        let pieces = followed.and_then(|one| Some((one.summary, one.flow?, 0.0)));
        let Some((summary, flow, of_series)) = results.or(pieces) else {
            return Ok(None);
        };
        let error = match chosen.memory() {
            Memory::None => first_order_loss + left_out,
            Memory::FirstOrder | Memory::Dashpot => left_out + of_series,
            Memory::Full => YIELDS * followed.map_or(0.0, |one| one.estimates.contact()),
        };
        let found = Found::new(summary, error.min(1.0), None);
        let scheme = memory.then_some(Scheme::Implicit);
        Ok(Some(Solved {
            flow: Some(flow),
            ..chosen.solved(scheme, found, flow.radiated)
        }))
    }

    fn disc(
        &mut self,
        ratio: f64,
        deflection: Deflection,
    ) -> Result<Arc<Arc<S::Disc>>, DomainError> {
        self.disc
            .take_if(|(_, disc)| disc.disc().deflection != deflection);
        remembered(&mut self.disc, ratio, || {
            self.responses.disc(ratio, deflection)
        })
    }

    fn waves(&mut self, ratio: f64) -> Result<Arc<Arc<PunchWaves>>, DomainError> {
        remembered(&mut self.waves, ratio, || self.responses.waves(ratio))
    }

    /// The terms of the expansion in the memory of a contact that follows the load.
    fn dashpot(&mut self, collision: &Collision) -> Result<AreaDashpot, DomainError> {
        let waves = self.waves(collision.target_poisson_ratio)?;
        Ok(AreaDashpot::new(&collision.growing_contact(&waves)))
    }

    /// A contact that follows the load, and the energy that it radiates.
    fn grow(
        &mut self,
        collision: &Collision,
        asked: Accuracy,
    ) -> Result<(Found, f64), ContactError> {
        let waves = self.waves(collision.target_poisson_ratio)?;
        let contact = collision.growing_contact(&waves);
        let solved = solve_growing(&contact, &asked)?;
        let found = Found::new(solved.summary, solved.estimates.contact(), None);
        let radiated = work_on_half_space(&contact, &solved, asked.tolerance);
        self.growing = Some(solved);
        Ok((found, radiated))
    }
}

/// What belongs to a Poisson's ratio, made where the latest is another's.
fn remembered<T>(
    latest: &mut Option<(u64, Arc<T>)>,
    ratio: f64,
    make: impl FnOnce() -> Result<T, DomainError>,
) -> Result<Arc<T>, DomainError> {
    match latest {
        Some((bits, made)) if *bits == ratio.to_bits() => Ok(Arc::clone(made)),
        Some(_) | None => {
            let (_, made) = latest.insert((ratio.to_bits(), Arc::new(make()?)));
            Ok(Arc::clone(made))
        }
    }
}
