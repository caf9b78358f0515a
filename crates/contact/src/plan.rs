//! Which model a contact is computed with.

use crate::choose::{Choice, Family, Groups, Rung};
use crate::collision::Collision;
use crate::error::ContactError;
use crate::law::area_dashpot::AreaDashpot;
use crate::law::quasi_static::quasi_static_radiation;
use crate::law::radiation::radiation;
use crate::march::refine::Accuracy;
use crate::settings::{Model, Scheme, Settings, StaticShare};
use crate::summary::Summary;
use crate::surface::Surface;

/// First-order loss 1 - e^2 up to which the radiation models are used: half of the energy.
const LARGEST_LOSS: f64 = 0.5;

/// A model, its dimensionless groups and, where `auto` chose, its choice.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Never [`Model::Auto`].
    pub model: Model,
    /// Groups of the family that the scene states.
    pub groups: Groups,
    choice: Option<Choice>,
}

/// The model that is asked for or that `auto` chooses.
///
/// `surface` is the response of the half-space for the deflection that the settings ask for.
#[must_use]
pub fn plan(settings: &Settings, collision: &Collision, surface: &Surface) -> Plan {
    let groups = groups(settings, collision, surface);
    let chosen = |model| Plan {
        model,
        groups,
        choice: None,
    };
    if settings.model != Model::Auto {
        return chosen(settings.model);
    }
    if settings.scheme == Scheme::Explicit {
        return chosen(Model::Wave);
    }
    let choice = groups.choose(&accuracy(settings));
    let model = match (choice.rung, groups.family) {
        (Rung::FullMemory, Family::Growing) => Model::Growing,
        (Rung::FullMemory, Family::Full | Family::Dynamic) => Model::Wave,
        (Rung::QuasiStatic, Family::Full) => Model::QuasiStatic,
        (Rung::Radiation, Family::Full) => Model::QuasiStaticRadiation,
        (Rung::QuasiStatic, Family::Growing | Family::Dynamic) => Model::Hertz,
        (Rung::Radiation, Family::Growing | Family::Dynamic) => Model::Radiation,
        (Rung::AreaDashpot, _) => Model::AreaDashpot,
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
    #[must_use]
    pub fn coupling(&self) -> f64 {
        match self.model {
            Model::QuasiStatic | Model::QuasiStaticRadiation => self.groups.coupling,
            Model::Hertz
            | Model::Radiation
            | Model::AreaDashpot
            | Model::Wave
            | Model::Growing
            | Model::Auto => 0.0,
        }
    }

    /// c of the radiated loss, zero where the model has none.
    pub(crate) fn damping(&self) -> f64 {
        match self.model {
            Model::Radiation | Model::QuasiStaticRadiation => self.groups.lag,
            Model::Hertz
            | Model::AreaDashpot
            | Model::QuasiStatic
            | Model::Wave
            | Model::Growing
            | Model::Auto => 0.0,
        }
    }

    /// Results of [`Model::Hertz`], [`Model::Radiation`] and their quasi-static counterparts.
    ///
    /// # Errors
    /// [`ContactError::LossTooLarge`] where a first-order loss makes no sense.
    pub(crate) fn closed_form(&self) -> Result<ClosedForm, ContactError> {
        let (coupling, lag) = (self.coupling(), self.damping());
        let loss = self.groups.first_order_loss();
        if lag > 0.0 && loss > LARGEST_LOSS {
            return Err(ContactError::LossTooLarge { loss });
        }
        let left_out = self.groups.beyond_radiation().contact.min(1.0);
        let summary = match self.model {
            Model::QuasiStatic | Model::QuasiStaticRadiation => {
                quasi_static_radiation(coupling, lag)
            }
            Model::Hertz
            | Model::Radiation
            | Model::AreaDashpot
            | Model::Wave
            | Model::Growing
            | Model::Auto => radiation(lag),
        };
        // what the next rung adds
        let error = if lag > 0.0 {
            left_out
        } else {
            (0.5 * loss + left_out).min(1.0)
        };
        Ok(ClosedForm { summary, error })
    }

    /// Results of [`Model::AreaDashpot`].
    ///
    /// # Errors
    /// [`ContactError::BeyondDashpot`] where the expansion in the memory makes no sense.
    pub(crate) fn dashpot(&self, terms: &AreaDashpot) -> Result<ClosedForm, ContactError> {
        let left_out = terms.left_out(self.groups.memory);
        if left_out.contact() >= 1.0 {
            return Err(ContactError::BeyondDashpot {
                lag: terms.lag,
                memory: self.groups.memory,
            });
        }
        Ok(ClosedForm {
            summary: terms.summary(),
            error: left_out.contact(),
        })
    }

    /// Why this model, in words.
    #[must_use]
    pub fn reason(&self, settings: &Settings) -> String {
        let family = match self.groups.family {
            Family::Growing => "no disc_radius_m: the contact follows the load",
            Family::Full => "disc_radius_m and the full static share: the paper's disc",
            Family::Dynamic => "disc_radius_m and the dynamic share",
        };
        match (&self.choice, settings.model) {
            (Some(choice), _) => format!("{family}; {}", choice.reason(&accuracy(settings))),
            (None, Model::Auto) => "the explicit scheme marches a fixed disc".to_owned(),
            (None, _) => "asked for by the scene".to_owned(),
        }
    }
}

/// What the settings ask of a contact's results.
pub(crate) fn accuracy(settings: &Settings) -> Accuracy {
    Accuracy::of_contact(settings.tolerance, settings.loss_tolerance)
}

/// Radius of the disc of the fixed models in m: that of the settings, or the tip's.
#[must_use]
pub fn disc_radius_m(settings: &Settings, collision: &Collision) -> f64 {
    settings.disc_radius_m.unwrap_or(collision.tip_radius_m)
}

/// Radius of the disc that loads the half-space in m where the model fixes it; none for a contact that follows the load.
#[must_use]
pub fn fixed_disc_m(model: Model, settings: &Settings, collision: &Collision) -> Option<f64> {
    match model {
        Model::Growing | Model::AreaDashpot | Model::Hertz | Model::Radiation => {
            settings.disc_radius_m
        }
        Model::Wave | Model::QuasiStatic | Model::QuasiStaticRadiation | Model::Auto => {
            Some(disc_radius_m(settings, collision))
        }
    }
}

/// The groups of the family that the settings state.
fn groups(settings: &Settings, collision: &Collision, surface: &Surface) -> Groups {
    let fixed = match settings.model {
        Model::Wave | Model::QuasiStatic | Model::QuasiStaticRadiation => true,
        Model::Hertz | Model::Radiation | Model::AreaDashpot | Model::Growing => false,
        Model::Auto => settings.disc_radius_m.is_some() || settings.scheme == Scheme::Explicit,
    };
    let lag = collision.lag(surface);
    if !fixed {
        return Groups {
            family: Family::Growing,
            coupling: 0.0,
            lag,
            memory: collision.contact_wave_time() * surface.punch_memory(),
        };
    }
    let disc = disc_radius_m(settings, collision);
    let (coupling, wave_time) = collision.disc_groups(surface.static_compliance, disc);
    let (family, coupling) = match settings.static_share {
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
