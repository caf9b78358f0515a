//! `auto`: the least memory of the half-space with which the physics of a scene meets the tolerance.
//!
//! For each physics (growing contact, fixed disc with the full or the dynamic share, contact that yields) there are three
//! models: quasi-static, one without memory that radiates, and full memory; each is the limit of the next as the memory over
//! the contact time goes to zero.
//! The one that radiates is the area dashpot for a growing contact, the first-order loss for a fixed disc.
//! The error of a smaller memory is estimated from three numbers in collision units: the coupling sigma (zero
//! unless the share is full), the lag c and the memory T of the half-space.
//! With l = (5/2) c int p'^2, the first-order loss,
//!
//! ```text
//! quasi-static    peak force, contact time, restitution, displacement   l/2 + error of radiation
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
use crate::settings::{Memory, Model, Physics, Plasticity, Scheme, Settings, StaticShare};
use crate::waves::response::DiscResponse;

/// Physics of a contact and its dimensionless groups, on which the choice of a memory depends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Regime {
    /// Physics.
    pub physics: Physics,
    /// Static compliance of the disc over Hertz's; zero but for the full share.
    pub coupling: f64,
    /// c of w = -c p', the dynamic part of the deflection to first order.
    pub lag: f64,
    /// Time after which the half-space has forgotten, in collision times.
    pub memory: f64,
}

/// Truncation error of the dashpot of a yielding contact over c^2, and that of its loss over c.
///
/// The first bounds the errors of 80 random pairs of metals at 1.05 to 300 times the velocity of yield, 8.7 at most and
/// 1.4 in the median; `tests/plastic.rs` repeats it.
const YIELDING: [f64; 2] = [10.0, 1.0];

/// First-order losses and memories up to which the expansion is trusted at all.
const LARGEST_LOSS: f64 = 0.3;
const LARGEST_MEMORY: f64 = 0.3;

impl Regime {
    /// l = (5/2) c int p'^2 of the quasi-static impact.
    pub fn first_order_loss(&self) -> f64 {
        match self.physics {
            Physics::Disc(StaticShare::Full) => quasi_static(self.coupling).1 * self.lag,
            Physics::Growing | Physics::Disc(StaticShare::Dynamic) | Physics::Yielding => {
                LOSS * self.lag
            }
        }
    }

    /// Truncation error of the first order of radiation: the largest relative error of peak force, contact time, restitution and
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
        match self.physics {
            Physics::Disc(StaticShare::Full) => fixed(self.coupling),
            Physics::Disc(StaticShare::Dynamic) => fixed(0.0),
            Physics::Growing | Physics::Yielding => {
                let contact = 0.4 * l * l + 0.3 * l * t + 0.06 * l * t.sqrt();
                [contact, 0.75 * l + 0.25 * t * t]
            }
        }
    }

    /// The best model without the full memory, and its truncation error.
    pub(crate) fn without_memory(&self) -> (Memory, [f64; 2]) {
        match self.physics {
            // the turning point is a corner: of first order in the memory
            Physics::Yielding => {
                let contact = YIELDING[0] * self.lag * self.lag;
                (Memory::Dashpot, [contact, YIELDING[1] * self.lag])
            }
            Physics::Growing => {
                let errors = left_out(self.lag, self.memory);
                let contact = errors.contact().max(errors.force);
                (Memory::Dashpot, [contact, errors.loss])
            }
            Physics::Disc(StaticShare::Full | StaticShare::Dynamic) => {
                (Memory::FirstOrder, self.beyond_radiation())
            }
        }
    }

    /// The least memory that meets the tolerances, and its estimated relative error; zero for the full memory, whose
    /// error is its step's.
    pub fn choose(&self, accuracy: &Accuracy) -> (Memory, f64) {
        let [first_order, _] = self.beyond_radiation();
        let quasi_static = 0.5 * self.first_order_loss() + first_order;
        if accuracy.loss.is_none() && quasi_static <= accuracy.tolerance {
            return (Memory::None, quasi_static);
        }
        let (radiating, [left_out, of_loss]) = self.without_memory();
        let loss_is_met = accuracy.loss.is_none_or(|asked| of_loss <= asked);
        if left_out <= accuracy.tolerance && loss_is_met {
            return (radiating, left_out);
        }
        (Memory::Full, 0.0)
    }
}

/// The model of a contact: that of the scene, or the choice of `auto`.
#[derive(Debug, Clone, PartialEq)]
pub struct Chosen {
    /// The word for it, never [`Model::Auto`].
    pub model: Model,
    /// Physics and dimensionless groups.
    pub regime: Regime,
    /// Memory that `auto` chose, with its estimated error; none of a model that the scene names.
    pub(crate) by_auto: Option<(Memory, f64)>,
    /// Whether the surface moves of itself, which only the full memory knows.
    pub(crate) surface_moves: bool,
}

/// The model of the scene, or the choice of `auto`.
///
/// `response` is the half-space's for the deflection that the settings ask for.
pub(crate) fn choose(
    settings: &Settings,
    collision: &Collision,
    response: &impl DiscResponse,
    (yields, surface_moves): (bool, bool),
) -> Chosen {
    let fixed = match settings.model {
        Model::Auto => settings.disc_radius_m.is_some() || settings.scheme == Scheme::Explicit,
        Model::Hertz
        | Model::Radiation
        | Model::QuasiStatic
        | Model::QuasiStaticRadiation
        | Model::Wave
        | Model::Growing
        | Model::AreaDashpot => settings.model.on_disc(),
    };
    let wave_time = collision.contact_wave_time();
    let (elastic, coupling, memory) = if fixed {
        let disc = disc_of(settings, collision, response);
        let physics = Physics::Disc(settings.static_share);
        (physics, disc.static_coupling(), disc.memory())
    } else {
        (Physics::Growing, 0.0, wave_time * response.punch_memory())
    };
    let regime = Regime {
        physics: if yields { Physics::Yielding } else { elastic },
        coupling,
        lag: collision.lag(wave_time, response),
        memory,
    };
    let auto = settings.model == Model::Auto && settings.scheme == Scheme::Implicit;
    let by_auto = auto.then(|| {
        let (memory, error) = match surface_moves {
            true => (Memory::Full, 0.0),
            false => regime.choose(&accuracy(settings)),
        };
        match memory {
            Memory::Full if yields && !settings.plasticity.has_memory() => {
                let (memory, [left_out, _]) = regime.without_memory();
                (memory, left_out)
            }
            Memory::None | Memory::FirstOrder | Memory::Dashpot | Memory::Full => (memory, error),
        }
    });
    let model = match by_auto {
        Some((memory, _)) => regime.physics.model(memory),
        None if settings.model == Model::Auto => Model::Wave,
        None => settings.model,
    };
    Chosen {
        model,
        regime,
        by_auto,
        surface_moves,
    }
}

impl Chosen {
    /// Memory of the half-space in the model.
    pub fn memory(&self) -> Memory {
        self.model.memory()
    }

    /// sigma of the quasi-static spring; zero of a model whose memory contains the static deflection.
    pub fn coupling(&self) -> f64 {
        match self.memory() {
            Memory::None | Memory::FirstOrder => self.regime.coupling,
            Memory::Dashpot | Memory::Full => 0.0,
        }
    }

    /// c of the radiated loss, zero where the model has none.
    pub(crate) fn damping(&self) -> f64 {
        match self.memory() {
            Memory::FirstOrder => self.regime.lag,
            Memory::None | Memory::Dashpot | Memory::Full => 0.0,
        }
    }

    /// Results of [`Model::Hertz`], [`Model::Radiation`] and their quasi-static counterparts.
    ///
    /// # Errors
    /// [`ContactError::LossTooLarge`] where a first-order loss makes no sense.
    pub(crate) fn closed_form(&self) -> Result<Found, ContactError> {
        let (coupling, lag) = (self.coupling(), self.damping());
        let loss = self.regime.first_order_loss();
        if lag > 0.0 && loss > MOST_LOSS {
            return Err(ContactError::LossTooLarge { loss });
        }
        let left_out = self.regime.beyond_radiation()[0].min(1.0);
        let summary = match self.regime.physics {
            Physics::Disc(StaticShare::Full) => quasi_static_radiation(coupling, lag),
            Physics::Disc(StaticShare::Dynamic) | Physics::Growing | Physics::Yielding => {
                radiation(lag)
            }
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
        let (lag, memory) = (terms.lag, self.regime.memory);
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
            (Plasticity::JacksonGreen, _) => {
                "the contact yields according to the fit for the yield strength"
            }
            (Plasticity::None | Plasticity::Thornton | Plasticity::Recovery, Some(_)) => {
                "the contact yields at the given yield_pressure_pa"
            }
            (Plasticity::None | Plasticity::Thornton | Plasticity::Recovery, None) => {
                "the contact yields at 2.8 times the lower yield strength"
            }
        };
        let physics = match self.regime.physics {
            Physics::Growing => "no disc_radius_m: the contact follows the load",
            Physics::Yielding => yields,
            Physics::Disc(StaticShare::Full) => {
                "disc_radius_m and the full static share: the paper's disc"
            }
            Physics::Disc(StaticShare::Dynamic) => "disc_radius_m and the dynamic share",
        };
        let yielding = match self.regime.physics {
            Physics::Yielding => true,
            Physics::Growing | Physics::Disc(_) => false,
        };
        match self.by_auto {
            Some((_, error)) if yielding && error > settings.tolerance => {
                format!("{physics}; the fit allows only a dashpot, whose error is {error:.1e}")
            }
            Some(_) if self.surface_moves => {
                format!("{physics}; an echo returns before it ends: full memory")
            }
            Some((memory, _)) => format!("{physics}; {}", self.choice(memory, &accuracy(settings))),
            None if settings.model == Model::Auto => {
                "the explicit scheme requires a fixed disc".to_owned()
            }
            None if yielding => format!("set in the scene; {physics}"),
            None => "set in the scene".to_owned(),
        }
    }

    /// Why `auto` has chosen so, in words.
    fn choice(&self, chosen: Memory, accuracy: &Accuracy) -> String {
        let (first, tolerance) = (0.5 * self.regime.first_order_loss(), accuracy.tolerance);
        let change = format!("radiation changes the results by {first:.1e}");
        let (radiating, [second, loss]) = self.regime.without_memory();
        let best = match radiating {
            Memory::Dashpot => "the area dashpot",
            Memory::None | Memory::FirstOrder | Memory::Full => "its first order",
        };
        match (chosen, accuracy.loss) {
            (Memory::None, _) => {
                format!("{change}, below the tolerance {tolerance:.1e}: no waves needed")
            }
            (Memory::FirstOrder, _) => format!(
                "{change}; the error of its first order, {second:.1e}, is below the tolerance {tolerance:.1e}"
            ),
            (Memory::Dashpot, _) => format!(
                "{change}; the errors of the area dashpot, {second:.1e} and {loss:.1e} of the loss, are below the tolerance {tolerance:.1e}: no memory needed"
            ),
            (Memory::Full, Some(asked)) if second <= tolerance => format!(
                "the loss of {best} alone has a relative error of {loss:.1e}, above the loss_tolerance {asked:.1e}: full memory"
            ),
            (Memory::Full, _) => format!(
                "{change}; {best} alone has an error of {second:.1e}, above the tolerance {tolerance:.1e}: full memory"
            ),
        }
    }
}

/// Tolerances of the settings on the results of a contact.
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
    let of_tip = model.on_disc().then_some(collision.tip_radius_m);
    settings.disc_radius_m.or(of_tip)
}
