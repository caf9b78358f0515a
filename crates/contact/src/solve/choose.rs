//! `auto`: the cheapest rung of a family of models that meets the tolerance.
//!
//! Within a family (growing contact, fixed disc with the full or the dynamic share) the rungs are
//! quasi-static, one without memory that radiates, and full memory; each is the limit
//! of the next as the memory over the contact time goes to zero.
//! The one that radiates is the area dashpot for a growing contact, the first-order loss for a fixed disc.
//! What a rung leaves out is estimated from three numbers in collision units: the coupling sigma (zero
//! unless the share is full), the lag c and the memory T of the half-space.
//! With l = (5/2) c int p'^2, the first-order loss,
//!
//! ```text
//! quasi-static    peak force, contact time, restitution, displacement   l/2 + what radiation leaves out
//!                 loss                                                  all of it
//! radiation       the same four        0.4 l^2 + (0.12 + 0.07 sigma) l sqrt(T)       fixed disc
//!                                      0.4 l^2 + 0.3 l T + 0.06 l sqrt(T)            growing contact
//!                 loss, relative       0.75 l + 0.8 T^2    and    0.75 l + 0.25 T^2
//! area dashpot    the same four, and the force at any time      0.11 c T^2           growing contact
//!                 loss, relative                                0.0052 T^2
//! ```
//!
//! l/2 and the exponents are those of the expansion in the lag, docs/theory.md (T53): the next order of the restitution
//! is (13/40) l^2, of the loss (13/20) l; the square root comes from the end of contact, where p' has one; T^2 from
//! the third derivative of the force.
//! The coefficients bound the differences from the full memory that were measured over couplings of 1e-3 to 5,
//! memories of 1e-4 to 0.25 and Poisson's ratios of 0 to 0.48, with a margin of about 1.3.
//! Those of the area dashpot are [`left_out`]'s, over memories up to 0.5.
//! `tests/auto.rs` repeats the comparison on random scenes.
//!
//! Theory: `docs/theory.md` (T58).

use crate::accuracy::{Accuracy, Found};
use crate::collision::Collision;
use crate::disc::FixedDisc;
use crate::error::ContactError;
use crate::law::area_dashpot::{AreaDashpot, left_out};
use crate::law::quasi_static::{quasi_static, quasi_static_radiation};
use crate::law::radiation::{LOSS, MOST_LOSS, radiation};
use crate::names::Choice;
use crate::settings::{Model, Plasticity, Rung, Scheme, Settings, StaticShare};
use crate::waves::response::DiscResponse;

/// The physics that a scene states.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Family {
    /// The contact radius follows the load.
    Growing,
    /// Fixed disc whose static deflection is added to Hertz's.
    Full,
    /// Fixed disc without its static deflection.
    Dynamic,
    /// The contact radius follows the load, and the softer body flows.
    Yielding,
}

impl Family {
    /// Its model with so much memory: without any, a disc whose static deflection is left out is no disc.
    fn model(self, rung: Rung) -> Model {
        let on_disc = match self {
            Self::Growing | Self::Yielding => false,
            Self::Full => true,
            Self::Dynamic => rung == Rung::FullMemory,
        };
        let mut models = Model::ALL.iter().copied();
        let found = models.find(|model| model.row() == (rung, on_disc));
        found.unwrap_or(Model::Wave)
    }
}

/// What the choice depends on, in collision units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Groups {
    /// Family.
    pub family: Family,
    /// Static compliance of the disc over Hertz's; only looked at for the full share.
    pub coupling: f64,
    /// c of w = -c p', the dynamic part of the deflection to first order.
    pub lag: f64,
    /// Time after which the half-space has forgotten.
    pub memory: f64,
}

/// What the dashpot of a yielding contact leaves out over c^2, of its loss over c.
///
/// The first bounds what was found on 80 random pairs of metals at 1.05 to 300 times the velocity of yield, 8.7 at most and
/// 1.4 in the median; `tests/plastic.rs` repeats it.
const YIELDING: [f64; 2] = [10.0, 1.0];

/// First-order losses and memories up to which the expansion is trusted at all.
const LARGEST_LOSS: f64 = 0.3;
const LARGEST_MEMORY: f64 = 0.3;

impl Groups {
    /// l = (5/2) c int p'^2 of the quasi-static impact.
    pub fn first_order_loss(&self) -> f64 {
        match self.family {
            Family::Full => quasi_static(self.coupling).1 * self.lag,
            Family::Growing | Family::Dynamic | Family::Yielding => LOSS * self.lag,
        }
    }

    /// What the first order of radiation leaves out: the largest relative error of peak force, contact time, restitution and
    /// displacement, and that of the loss 1 - e^2.
    pub(crate) fn beyond_radiation(&self) -> [f64; 2] {
        let (l, t) = (self.first_order_loss(), self.memory);
        if l > LARGEST_LOSS || t > LARGEST_MEMORY {
            return [1.0; 2];
        }
        let fixed = |coupling: f64| {
            let contact = 0.4 * l * l + (0.12 + 0.07 * coupling) * l * t.sqrt();
            [contact, 0.75 * l + 0.8 * t * t]
        };
        match self.family {
            Family::Full => fixed(self.coupling),
            Family::Dynamic => fixed(0.0),
            Family::Growing | Family::Yielding => {
                let contact = 0.4 * l * l + 0.3 * l * t + 0.06 * l * t.sqrt();
                [contact, 0.75 * l + 0.25 * t * t]
            }
        }
    }

    /// The rung of this family that radiates without memory, and what it leaves out.
    pub(crate) fn without_memory(&self) -> (Rung, [f64; 2]) {
        match self.family {
            // the turning point is a corner: of first order in the memory
            Family::Yielding => {
                let contact = YIELDING[0] * self.lag * self.lag;
                (Rung::AreaDashpot, [contact, YIELDING[1] * self.lag])
            }
            Family::Growing => {
                let errors = left_out(self.lag, self.memory);
                let contact = errors.contact().max(errors.force);
                (Rung::AreaDashpot, [contact, errors.loss])
            }
            Family::Full | Family::Dynamic => (Rung::Radiation, self.beyond_radiation()),
        }
    }

    /// The cheapest rung that meets the accuracy asked for, and its estimated relative error; zero for full memory, whose
    /// error is its step's.
    pub fn choose(&self, accuracy: &Accuracy) -> (Rung, f64) {
        let [first_order, _] = self.beyond_radiation();
        let quasi_static = 0.5 * self.first_order_loss() + first_order;
        if accuracy.loss.is_none() && quasi_static <= accuracy.tolerance {
            return (Rung::QuasiStatic, quasi_static);
        }
        let (radiating, [left_out, of_loss]) = self.without_memory();
        let loss_is_met = accuracy.loss.is_none_or(|asked| of_loss <= asked);
        if left_out <= accuracy.tolerance && loss_is_met {
            return (radiating, left_out);
        }
        (Rung::FullMemory, 0.0)
    }
}

/// A model, its dimensionless groups and, where `auto` chose, its choice.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Never [`Model::Auto`].
    pub model: Model,
    /// Groups of the family that the scene states.
    pub groups: Groups,
    pub(crate) chosen: Option<(Rung, f64)>,
}

/// The model that is asked for or that `auto` chooses.
///
/// `response` is the half-space's for the deflection that the settings ask for.
pub(crate) fn plan(
    settings: &Settings,
    collision: &Collision,
    response: &impl DiscResponse,
    yields: bool,
) -> Plan {
    let fixed = match settings.model {
        Model::Auto => settings.disc_radius_m.is_some() || settings.scheme == Scheme::Explicit,
        asked => asked.row().1,
    };
    let wave_time = collision.contact_wave_time();
    let (mut family, coupling, memory) = if fixed {
        let disc = disc_of(settings, collision, response);
        let family = match settings.static_share {
            StaticShare::Full => Family::Full,
            StaticShare::Dynamic => Family::Dynamic,
        };
        (family, disc.static_coupling(), disc.memory())
    } else {
        (Family::Growing, 0.0, wave_time * response.punch_memory())
    };
    if yields {
        family = Family::Yielding;
    }
    let groups = Groups {
        family,
        coupling,
        lag: collision.lag(wave_time, response),
        memory,
    };
    let auto = settings.model == Model::Auto && settings.scheme == Scheme::Implicit;
    let mut chosen = auto.then(|| groups.choose(&accuracy(settings)));
    if yields && !settings.plasticity.has_memory() && matches!(chosen, Some((Rung::FullMemory, _)))
    {
        let (rung, [left_out, _]) = groups.without_memory();
        chosen = Some((rung, left_out));
    }
    let model = match chosen {
        Some((rung, _)) => groups.family.model(rung),
        None if settings.model == Model::Auto => Model::Wave,
        None => settings.model,
    };
    Plan {
        model,
        groups,
        chosen,
    }
}

impl Plan {
    /// sigma of the quasi-static spring.
    pub fn coupling(&self) -> f64 {
        match self.model.row() {
            (Rung::QuasiStatic | Rung::Radiation, true) => self.groups.coupling,
            (Rung::AreaDashpot | Rung::FullMemory, _) | (_, false) => 0.0,
        }
    }

    /// c of the radiated loss, zero where the model has none.
    pub(crate) fn damping(&self) -> f64 {
        match self.model.row() {
            (Rung::Radiation, _) => self.groups.lag,
            (Rung::QuasiStatic | Rung::AreaDashpot | Rung::FullMemory, _) => 0.0,
        }
    }

    /// Results of [`Model::Hertz`], [`Model::Radiation`] and their quasi-static counterparts.
    ///
    /// # Errors
    /// [`ContactError::LossTooLarge`] where a first-order loss makes no sense.
    pub(crate) fn closed_form(&self) -> Result<Found, ContactError> {
        let (coupling, lag) = (self.coupling(), self.damping());
        let loss = self.groups.first_order_loss();
        if lag > 0.0 && loss > MOST_LOSS {
            return Err(ContactError::LossTooLarge { loss });
        }
        let left_out = self.groups.beyond_radiation()[0].min(1.0);
        let summary = match self.model.row() {
            (_, true) => quasi_static_radiation(coupling, lag),
            (_, false) => radiation(lag),
        };
        // what the next rung adds
        let radiated = if lag > 0.0 { 0.0 } else { 0.5 * loss };
        Ok(Found::new(summary, (radiated + left_out).min(1.0), None))
    }

    /// Results of [`Model::AreaDashpot`].
    ///
    /// # Errors
    /// [`ContactError::BeyondDashpot`] where the expansion in the memory makes no sense.
    pub(crate) fn dashpot(&self, terms: &AreaDashpot) -> Result<Found, ContactError> {
        let (lag, memory) = (terms.lag, self.groups.memory);
        let errors = left_out(lag, memory);
        let error = errors.contact().max(errors.force);
        if error >= 1.0 {
            return Err(ContactError::BeyondDashpot { lag, memory });
        }
        Ok(Found::new(terms.summary(), error, None))
    }

    /// Why this model, in words.
    pub fn reason(&self, settings: &Settings) -> String {
        let yields = match (settings.plasticity, settings.yield_pressure_pa) {
            (Plasticity::JacksonGreen, _) => "the contact yields by the fit for the yield strength",
            (Plasticity::None | Plasticity::Thornton | Plasticity::Recovery, Some(_)) => {
                "the contact yields at the yield_pressure_pa given"
            }
            (Plasticity::None | Plasticity::Thornton | Plasticity::Recovery, None) => {
                "the contact yields at 2.8 times the lower yield strength"
            }
        };
        let family = match self.groups.family {
            Family::Growing => "no disc_radius_m: the contact follows the load",
            Family::Yielding => yields,
            Family::Full => "disc_radius_m and the full static share: the paper's disc",
            Family::Dynamic => "disc_radius_m and the dynamic share",
        };
        let yielding = self.groups.family == Family::Yielding;
        match self.chosen {
            Some((_, error)) if yielding && error > settings.tolerance => {
                format!("{family}; the fit has a dashpot at most, which leaves out {error:.1e}")
            }
            Some((rung, _)) => format!("{family}; {}", self.choice(rung, &accuracy(settings))),
            None if settings.model == Model::Auto => {
                "the explicit scheme marches a fixed disc".to_owned()
            }
            None if yielding => format!("asked for by the scene; {family}"),
            None => "asked for by the scene".to_owned(),
        }
    }

    /// Why `auto` has chosen so, in words.
    fn choice(&self, chosen: Rung, accuracy: &Accuracy) -> String {
        let (first, tolerance) = (0.5 * self.groups.first_order_loss(), accuracy.tolerance);
        let change = format!("radiation changes the results by {first:.1e}");
        let (radiating, [second, loss]) = self.groups.without_memory();
        let rung = match radiating {
            Rung::AreaDashpot => "the area dashpot",
            Rung::QuasiStatic | Rung::Radiation | Rung::FullMemory => "its first order",
        };
        match (chosen, accuracy.loss) {
            (Rung::QuasiStatic, _) => {
                format!("{change}, below the tolerance {tolerance:.1e}: no waves needed")
            }
            (Rung::Radiation, _) => format!(
                "{change}; what its first order leaves out, {second:.1e}, is below the tolerance {tolerance:.1e}"
            ),
            (Rung::AreaDashpot, _) => format!(
                "{change}; what the area dashpot leaves out, {second:.1e} and {loss:.1e} of the loss, is below the tolerance {tolerance:.1e}: no memory needed"
            ),
            (Rung::FullMemory, Some(asked)) if second <= tolerance => format!(
                "{rung} alone would miss the loss by {loss:.1e} of it, above the loss_tolerance {asked:.1e}: full memory"
            ),
            (Rung::FullMemory, _) => format!(
                "{change}; {rung} alone would miss them by {second:.1e}, above the tolerance {tolerance:.1e}: full memory"
            ),
        }
    }
}

/// What the settings ask of a contact's results.
pub(crate) fn accuracy(settings: &Settings) -> Accuracy {
    Accuracy::of_contact(settings.tolerance, settings.loss_tolerance)
}

/// The impact on the disc of the fixed models: of the settings' radius, or of the tip's.
pub(crate) fn disc_of<'r, R: DiscResponse>(
    settings: &Settings,
    collision: &Collision,
    response: &'r R,
) -> FixedDisc<'r, R> {
    let radius_m = settings.disc_radius_m.unwrap_or(collision.tip_radius_m);
    collision.fixed_disc(response, radius_m, settings.static_share)
}

/// Radius of the disc that loads the half-space in m where the model fixes it; none for a contact that follows the load.
pub fn fixed_disc_m(model: Model, settings: &Settings, collision: &Collision) -> Option<f64> {
    let of_tip = model.row().1.then_some(collision.tip_radius_m);
    settings.disc_radius_m.or(of_tip)
}
