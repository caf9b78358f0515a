//! One contact: its model chosen, its scheme run. Single impacts, sweeps and charts all come through here.
//!
//! In reading order: `choose` the model, `outcome` the series that sweeps share, `prepared` the half-space of the latest
//! contact; a [`Solver`] makes a `Task` of each.

pub(crate) mod choose;
pub(crate) mod outcome;
mod prepared;

use crate::accuracy::{Accuracy, Found};
use crate::collision::Collision;
use crate::disc::radiated::radiated;
use crate::disc::refine::{explicit, march_finely, solve_disc};
use crate::disc::{FixedDisc, stability};
use crate::error::{ContactError, MarchError};
use crate::growing::dashpot::solve_springs;
use crate::growing::equations::March;
use crate::growing::quick::quick;
use crate::growing::solved::SolvedContact;
use crate::growing::surface::SurfaceMotion;
use crate::growing::work::work_on_half_space;
use crate::growing::yielding::ERROR_WITH_DASHPOT;
use crate::growing::{solve_growing, solve_growing_on};
use crate::history::History;
use crate::law::area_dashpot::AreaDashpot;
use crate::law::yielding::{Flow, Yielding};
use crate::settings::{Memory, Model, Physics, Scheme, Settings};
use crate::solve::choose::{Chosen, accuracy, choose, disc_of};
use crate::solve::outcome::{CellPlace, Outcomes};
use crate::solve::prepared::Prepared;
use crate::summary::Summary;
use crate::waves::cache::{Exact, Responses};
use crate::waves::punch::GrowingContact;
use halfspace::Deflection;

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
    /// Plastic flow; none if the contact has not yielded.
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

    /// Without a march: the loss is radiated.
    fn in_closed_form(self, found: Found) -> Solved {
        self.solved(None, found, found.summary.loss)
    }

    /// With its plastic flow.
    fn yielded(
        self,
        scheme: Option<Scheme>,
        (summary, flow): (Summary, Flow),
        error: f64,
    ) -> Solved {
        let found = Found::new(summary, error.min(1.0), None);
        Solved {
            flow: Some(flow),
            ..self.solved(scheme, found, flow.radiated)
        }
    }
}

/// Solves contacts one after the other with responses from a cache; one for each thread.
#[derive(Debug)]
pub struct Solver<'a, S: Responses> {
    responses: &'a S,
    outcomes: Option<&'a Outcomes>,
    /// Motion of the surface under growing contacts.
    surface: Option<SurfaceMotion>,
    prepared: Option<Prepared<S::Disc>>,
    /// Room for the samples of a march; those of the latest.
    room: History,
}

/// One contact to be solved.
struct Task<'t, S: Responses> {
    collision: &'t Collision,
    settings: &'t Settings,
    asked: Accuracy,
    responses: &'t S,
    outcomes: Option<&'t Outcomes>,
    surface: Option<&'t SurfaceMotion>,
    prepared: &'t Prepared<S::Disc>,
}

/// A contact solved, with its pieces where it was followed by pieces.
type Followed = (Solved, Option<SolvedContact>);

/// Largest tolerance to which the history of an area dashpot is solved: its deflection, which is 1e-3 to 1e-1 of the
/// indentation, is within 1e-2 then, and its work within 1e-3 (`tests/history.rs`).
const COARSEST_HISTORY: f64 = 1e-4;

/// Estimated error of a contact with memory that yields over that of the pieces: 1.3 at most on 80 random pairs of metals.
/// `tests/plastic.rs` (`estimates_of_contacts_that_yield_hold`) fails at 0.5.
const ERROR_OF_YIELDING: f64 = 2.0;

impl<'a, S: Responses> Solver<'a, S> {
    /// With a cache of responses.
    pub fn new(responses: &'a S) -> Self {
        Self {
            responses,
            outcomes: None,
            surface: None,
            prepared: None,
            room: History::default(),
        }
    }

    /// With a cache of responses, and series in place of marches where no history is needed.
    pub fn sharing(responses: &'a S, outcomes: &'a Outcomes) -> Self {
        Self {
            outcomes: Some(outcomes),
            ..Self::new(responses)
        }
    }

    /// On a surface that moves of itself, as by echoes; growing contacts with the full memory follow it, and `auto` chooses
    /// them.
    pub fn on_surface(&mut self, motion: Option<SurfaceMotion>) {
        self.surface = motion;
    }

    /// The series that pay for so many contacts, of which some are given.
    pub fn outcomes(
        &mut self,
        contacts: usize,
        some: impl Iterator<Item = (Collision, Settings)>,
    ) -> Outcomes {
        let places = some.map(|(collision, settings)| {
            let (task, _) = self.task(&collision, &settings, accuracy(&settings)).ok()?;
            task.place()
        });
        Outcomes::of(contacts, places)
    }

    /// The results of a contact.
    pub fn solve(
        &mut self,
        collision: &Collision,
        settings: &Settings,
    ) -> Result<Solved, ContactError> {
        let (task, room) = self.task(collision, settings, accuracy(settings))?;
        task.solve(room).map(|(solved, _)| solved)
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
        let (task, room) = self.task(collision, settings, asked)?;
        let followed = task.solve(room)?;
        let history = task.history(&followed, room)?;
        Ok((followed.0, history))
    }

    /// A contact with its prepared half-space, and the room for its march.
    fn task<'t>(
        &'t mut self,
        collision: &'t Collision,
        settings: &'t Settings,
        asked: Accuracy,
    ) -> Result<(Task<'t, S>, &'t mut History), ContactError> {
        collision.check()?;
        let (ratio, deflection) = (collision.target_poisson_ratio, settings.deflection);
        let prepared = Prepared::of(&mut self.prepared, self.responses, ratio, deflection)?;
        let task = Task {
            collision,
            settings,
            asked,
            responses: self.responses,
            outcomes: self.outcomes,
            surface: self.surface.as_ref(),
            prepared,
        };
        Ok((task, &mut self.room))
    }
}

impl<S: Responses> Task<'_, S> {
    /// Where the contact lies among those that have series.
    fn place(&self) -> Option<CellPlace> {
        let yielding = self.collision.yielding(self.settings).ok()?;
        match yielding.filter(Yielding::begins) {
            Some(yielding) => CellPlace::of_fit(&self.choose(true), &yielding, self.settings),
            None => self.elastic_place(&self.choose(false)),
        }
    }

    fn elastic_place(&self, chosen: &Chosen) -> Option<CellPlace> {
        CellPlace::of(chosen, self.collision, self.settings, &*self.prepared.disc)
    }

    fn choose(&self, yields: bool) -> Chosen {
        let moves = self.surface.is_some();
        choose(
            self.settings,
            self.collision,
            &*self.prepared.disc,
            (yields, moves),
        )
    }

    /// The impact on the disc of the settings.
    fn disc(&self) -> FixedDisc<'_, S::Disc> {
        disc_of(self.settings, self.collision, &*self.prepared.disc)
    }

    /// The contact that follows the load.
    fn growing(&self) -> Result<GrowingContact<'_>, ContactError> {
        let waves = self.prepared.waves(self.responses)?;
        Ok(self.collision.growing_contact(waves))
    }

    fn solve(&self, room: &mut History) -> Result<Followed, ContactError> {
        let yielding = self.collision.yielding(self.settings)?;
        if let Some(yielding) = yielding.filter(Yielding::begins)
            && let Some(followed) = self.yielded(&yielding)?
        {
            return Ok(followed);
        }
        self.elastic(room)
    }

    /// A contact that does not yield.
    fn elastic(&self, room: &mut History) -> Result<Followed, ContactError> {
        let (chosen, settings) = (self.choose(false), self.settings);
        if let (Some(outcomes), None) = (self.outcomes, self.asked.deflection)
            && let Some(place) = self.elastic_place(&chosen)
            && let Some((summary, radiated, error)) = outcomes.at(&place, self.responses)
        {
            let found = Found::new(summary, error, None);
            return Ok((chosen.solved(None, found, radiated), None));
        }
        let is_disc = match chosen.regime.physics {
            Physics::Disc(_) => true,
            Physics::Growing | Physics::Yielding => false,
        };
        if is_disc && settings.model.has_schemes() && settings.scheme == Scheme::Implicit {
            stability::check(&self.disc(), room)?;
        }
        match (chosen.memory(), chosen.regime.physics) {
            (Memory::None | Memory::FirstOrder, _) => {
                let found = chosen.closed_form()?;
                Ok((chosen.in_closed_form(found), None))
            }
            (Memory::Dashpot, _) => {
                let found = chosen.dashpot(&AreaDashpot::new(&self.growing()?))?;
                Ok((chosen.in_closed_form(found), None))
            }
            (Memory::Full, Physics::Growing | Physics::Yielding) => {
                let contact = self.growing()?;
                let pieces = match solve_growing_on(&contact, self.surface, &self.asked) {
                    // the deflection of a very slow contact is lost in the rounding of its indentation
                    Err(MarchError::NotReached { .. }) if self.asked.deflection.is_some() => {
                        solve_growing_on(&contact, self.surface, &accuracy(settings))?
                    }
                    found => found?,
                };
                let found = Found::new(pieces.summary, pieces.estimates.contact(), None);
                let radiated = match self.surface {
                    None => work_on_half_space(&contact, &pieces, self.asked.tolerance),
                    // what the echoes bring back is part of it
                    Some(_) => pieces.summary.loss,
                };
                let solved = chosen.solved(Some(Scheme::Implicit), found, radiated);
                Ok((solved, Some(pieces)))
            }
            (Memory::Full, Physics::Disc(_)) => {
                let (found, radiated) = self.march(room)?;
                Ok((chosen.solved(Some(settings.scheme), found, radiated), None))
            }
        }
    }

    /// A march on a fixed disc, and the energy that it radiates.
    fn march(&self, room: &mut History) -> Result<(Found, f64), ContactError> {
        let (collision, settings) = (self.collision, self.settings);
        let ratio = collision.target_poisson_ratio;
        let in_times = |step_s: f64| step_s / collision.units().time_s;
        let step = settings.step_s.map(in_times);
        let found = match settings.scheme {
            Scheme::Implicit => solve_disc(room, &self.disc(), step, self.asked)?,
            Scheme::Explicit => {
                let response = Exact.disc(ratio, settings.deflection)?;
                explicit(room, &disc_of(settings, collision, &*response), step)?
            }
        };
        let mean = self.responses.disc(ratio, Deflection::Mean)?;
        let radiated = radiated(&self.disc(), &*mean, room, found.summary.contact_time);
        Ok((found, radiated))
    }

    /// The history of the contact solved, whose march has left its samples in `room`.
    fn history(
        &self,
        (solved, pieces): &Followed,
        room: &History,
    ) -> Result<History, ContactError> {
        let tolerance = self.settings.tolerance;
        let mut history = match (pieces, solved.scheme) {
            (Some(pieces), _) => History::of_pieces(pieces),
            (None, Some(Scheme::Implicit)) if self.settings.step_s.is_none() => {
                march_finely(&self.disc(), solved.summary.contact_time, tolerance)
                    .ok()
                    .filter(|fine| fine.error <= solved.error.max(tolerance))
                    .unwrap_or_else(|| room.clone())
            }
            (None, Some(Scheme::Implicit | Scheme::Explicit)) => room.clone(),
            (None, None) => self.history_without_memory(&solved.chosen)?,
        };
        if history.error.is_infinite() || solved.flow.is_some() {
            history.error = solved.error;
        }
        Ok(history)
    }

    /// The history of an elastic contact whose model has no memory.
    fn history_without_memory(&self, chosen: &Chosen) -> Result<History, ContactError> {
        match chosen.memory() {
            // its expansion has the results of the contact with memory, but not its first and last instants
            Memory::Dashpot => {
                let tolerance = self.settings.tolerance.min(COARSEST_HISTORY);
                let asked = Accuracy::of_contact(tolerance, None);
                Ok(History::of_pieces(&solve_growing(
                    &self.growing()?,
                    &asked,
                )?))
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

    /// A contact that yields; nothing where waves keep it from doing so.
    fn yielded(&self, yielding: &Yielding) -> Result<Option<Followed>, ContactError> {
        if let Some(over) = yielding.trusted_ratio().filter(|_| !yielding.rebounds()) {
            let velocity_m_s = self.collision.velocity_m_s;
            let trusted_m_s = velocity_m_s / over;
            return Err(ContactError::NoRebound {
                velocity_m_s,
                trusted_m_s,
            });
        }
        let mut chosen = self.choose(true);
        match chosen.memory() {
            Memory::None => self.yielded_at_once(yielding, chosen, 0.0),
            Memory::FirstOrder | Memory::Dashpot => {
                let lag = chosen.regime.lag;
                self.yielded_at_once(yielding, chosen, lag)
            }
            Memory::Full => match yielding.remembered(&self.growing()?, &self.asked) {
                Ok(pieces) => Ok(pieces.and_then(|pieces| {
                    let error = ERROR_OF_YIELDING * pieces.estimates.contact();
                    let scheme = Some(Scheme::Implicit);
                    let solved = chosen.yielded(scheme, (pieces.summary, pieces.flow?), error);
                    Some((solved, Some(pieces)))
                })),
                Err(_) if chosen.by_auto.is_some() => {
                    chosen.model = Model::AreaDashpot;
                    let lag = chosen.regime.lag;
                    self.yielded_at_once(yielding, chosen, lag)
                }
                Err(error) => Err(error.into()),
            },
        }
    }

    /// A contact that yields on a half-space that answers at once, with a lag.
    fn yielded_at_once(
        &self,
        yielding: &Yielding,
        chosen: Chosen,
        lag: f64,
    ) -> Result<Option<Followed>, ContactError> {
        let series = || {
            let place = CellPlace::of_fit(&chosen, yielding, self.settings)?;
            let (summary, radiated, error) = self.outcomes?.at(&place, self.responses)?;
            let works = [summary.loss - radiated, radiated];
            let flow = Flow::new(yielding, summary.peak_displacement.sqrt(), works);
            Some(((summary, flow), error))
        };
        let quickly = || quick(yielding, lag).map(|found| (found, 0.0));
        // the history of a single impact has its results too
        let alone = self.asked.deflection.is_none();
        let (found, of_series, pieces) = match alone.then(|| series().or_else(quickly)).flatten() {
            Some((found, error)) => (found, error, None),
            None => {
                let followed = March::damped(lag, ERROR_WITH_DASHPOT).follow(yielding);
                let followed = followed.map_err(|_| ContactError::NotFollowed)?;
                let Some((pieces, flow)) =
                    followed.and_then(|one| one.flow.map(|flow| (one, flow)))
                else {
                    return Ok(None);
                };
                ((pieces.summary, flow), 0.0, Some(pieces))
            }
        };
        let (_, [left_out, _]) = chosen.regime.without_memory();
        let error = match chosen.memory() {
            Memory::None => chosen.regime.first_order_loss() + left_out,
            Memory::FirstOrder | Memory::Dashpot | Memory::Full => left_out + of_series,
        };
        Ok(Some((chosen.yielded(None, found, error), pieces)))
    }
}
