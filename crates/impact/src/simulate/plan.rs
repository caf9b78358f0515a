//! Which model a scene is computed with.

use super::ImpactError;
use crate::choose::{Choice, Family, Groups, Rung};
use crate::contact::quasi_static::quasi_static_radiation;
use crate::contact::radiation::radiation;
use crate::contact::{Collision, Surface};
use crate::march::{Accuracy, StaticShare, Summary};
use crate::scene::{Contact, Model, Scheme, Striker};

/// First-order loss 1 - e^2 up to which the radiation models are used: half of the energy.
const LARGEST_LOSS: f64 = 0.5;

/// A model, its dimensionless groups and, where `auto` chose, its choice.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Plan {
    /// Never [`Model::Auto`].
    pub(crate) model: Model,
    /// Groups of the family that the scene states.
    pub(crate) groups: Groups,
    choice: Option<Choice>,
}

/// The model that a scene asks for or that `auto` chooses.
///
/// `surface` is the response of the half-space of the deflection that the scene asks for.
pub(crate) fn plan(
    contact: &Contact,
    striker: &Striker,
    collision: &Collision,
    surface: &Surface,
) -> Plan {
    let groups = groups(contact, striker, collision, surface);
    let chosen = |model| Plan {
        model,
        groups,
        choice: None,
    };
    if contact.model != Model::Auto {
        return chosen(contact.model);
    }
    if contact.scheme == Scheme::Explicit {
        return chosen(Model::Wave);
    }
    let choice = groups.choose(&accuracy(contact));
    let model = match (choice.rung, groups.family) {
        (Rung::FullMemory, Family::Growing) => Model::Growing,
        (Rung::FullMemory, Family::Full | Family::Dynamic) => Model::Wave,
        (Rung::QuasiStatic, Family::Full) => Model::QuasiStatic,
        (Rung::Radiation, Family::Full) => Model::QuasiStaticRadiation,
        (Rung::QuasiStatic, Family::Growing | Family::Dynamic) => Model::Hertz,
        (Rung::Radiation, Family::Growing | Family::Dynamic) => Model::Radiation,
    };
    Plan {
        model,
        groups,
        choice: Some(choice),
    }
}

/// Results of a model without a march.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ClosedForm {
    pub(crate) summary: Summary,
    /// Estimated relative error.
    pub(crate) error: f64,
}

impl Plan {
    /// sigma of the quasi-static spring.
    pub(crate) fn coupling(&self) -> f64 {
        match self.model {
            Model::QuasiStatic | Model::QuasiStaticRadiation => self.groups.coupling,
            Model::Hertz | Model::Radiation | Model::Wave | Model::Growing | Model::Auto => 0.0,
        }
    }

    /// c of the radiated loss, zero where the model has none.
    pub(crate) fn damping(&self) -> f64 {
        match self.model {
            Model::Radiation | Model::QuasiStaticRadiation => self.groups.lag,
            Model::Hertz | Model::QuasiStatic | Model::Wave | Model::Growing | Model::Auto => 0.0,
        }
    }

    /// Results of [`Model::Hertz`], [`Model::Radiation`] and their quasi-static counterparts.
    ///
    /// # Errors
    /// [`ImpactError::LossTooLarge`] where a first-order loss makes no sense.
    pub(crate) fn closed_form(&self) -> Result<ClosedForm, ImpactError> {
        let (coupling, lag) = (self.coupling(), self.damping());
        let loss = self.groups.first_order_loss();
        if lag > 0.0 && loss > LARGEST_LOSS {
            return Err(ImpactError::LossTooLarge { loss });
        }
        let left_out = self.groups.beyond_radiation().contact.min(1.0);
        let summary = match self.model {
            Model::QuasiStatic | Model::QuasiStaticRadiation => {
                quasi_static_radiation(coupling, lag)
            }
            Model::Hertz | Model::Radiation | Model::Wave | Model::Growing | Model::Auto => {
                radiation(lag)
            }
        };
        // what the next rung adds
        let error = if lag > 0.0 {
            left_out
        } else {
            (0.5 * loss + left_out).min(1.0)
        };
        Ok(ClosedForm { summary, error })
    }

    /// Why this model, in words.
    pub(crate) fn reason(&self, contact: &Contact) -> String {
        let family = match self.groups.family {
            Family::Growing => "no disc_radius_m: the contact follows the load",
            Family::Full => "disc_radius_m and the full static share: the paper's disc",
            Family::Dynamic => "disc_radius_m and the dynamic share",
        };
        match (&self.choice, contact.model) {
            (Some(choice), _) => format!("{family}; {}", choice.reason(&accuracy(contact))),
            (None, Model::Auto) => "the explicit scheme marches a fixed disc".to_owned(),
            (None, _) => "asked for by the scene".to_owned(),
        }
    }
}

/// What a scene asks of its contact.
pub(crate) fn accuracy(contact: &Contact) -> Accuracy {
    Accuracy::of_contact(contact.tolerance, contact.loss_tolerance)
}

/// Radius of the disc of the fixed models in m: that of the scene, or the tip's.
pub(crate) fn disc_radius_m(contact: &Contact, striker: &Striker) -> f64 {
    contact.disc_radius_m.unwrap_or(striker.tip_radius_m)
}

/// The groups of the family that a scene states.
fn groups(
    contact: &Contact,
    striker: &Striker,
    collision: &Collision,
    surface: &Surface,
) -> Groups {
    let fixed = match contact.model {
        Model::Wave | Model::QuasiStatic | Model::QuasiStaticRadiation => true,
        Model::Hertz | Model::Radiation | Model::Growing => false,
        Model::Auto => contact.disc_radius_m.is_some() || contact.scheme == Scheme::Explicit,
    };
    let lag = collision.lag_of(surface);
    if !fixed {
        return Groups {
            family: Family::Growing,
            coupling: 0.0,
            lag,
            memory: collision.contact_wave_time() * surface.punch_memory(),
        };
    }
    let disc = disc_radius_m(contact, striker);
    let (coupling, wave_time) = collision.disc_groups(surface.static_compliance, disc);
    let (family, coupling) = match contact.static_share {
        StaticShare::Full => (Family::Full, coupling),
        StaticShare::Dynamic => (Family::Dynamic, 0.0),
    };
    Groups {
        family,
        coupling,
        lag,
        memory: wave_time * surface.memory,
    }
}
